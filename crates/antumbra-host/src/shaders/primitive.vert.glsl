// A box round a primitive, or the whole picture for what has no box.
uniform mat4 u_projection;
uniform mat4 u_to_view;    // from the primitive's space
uniform vec3 u_center;     // of the box, in the primitive's space
uniform vec3 u_half_size;  // zero: the whole picture

// Corners by bit (x 1, y 2, z 4), faces counter-clockwise seen from outside.
const int CORNERS[36] = int[36](5, 1, 3, 5, 3, 7, 0, 4, 6, 0, 6, 2, 2, 6, 7, 2, 7, 3,
                                0, 1, 5, 0, 5, 4, 4, 5, 7, 4, 7, 6, 0, 2, 3, 0, 3, 1);

void main() {
    int corner = CORNERS[gl_VertexID];
    vec3 p = vec3(corner & 1, (corner >> 1) & 1, corner >> 2) * 2.0 - 1.0;
    if (u_half_size == vec3(0.0)) {
        // The last face alone, seen from inside.
        gl_Position = vec4(p.xy * (gl_VertexID >= 30 ? 1.0 : 0.0), 0.0, 1.0);
    } else {
        gl_Position = u_projection * (u_to_view * vec4(u_center + p * u_half_size, 1.0));
    }
}
