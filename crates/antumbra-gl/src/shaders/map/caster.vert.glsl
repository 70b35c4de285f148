// A mesh as a light sees it.

layout(location = 0) in vec3 a_position;

uniform mat4 u_clip;  // to x, y of the map's face, depth times w, and w

out float v_depth;

void main() {
    vec4 p = u_clip * vec4(a_position, 1.0);
    // z is between 0 and w: inside whichever half of clip space the host has chosen (glClipControl).
    gl_Position = p;
    v_depth = p.z;
}
