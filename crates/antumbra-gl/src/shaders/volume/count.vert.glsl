// Polygons of shadow volumes, each with the plane that tells which points it is counted for.

layout(location = 0) in vec3 a_position;  // clip space: x, y, w
layout(location = 1) in vec4 a_plane;     // view space
layout(location = 2) in vec2 a_lift;
layout(location = 3) in highp uint a_id;

flat out vec4 v_plane;
flat out vec2 v_lift;
flat out highp uint v_id;

void main() {
    v_plane = a_plane;
    v_lift = a_lift;
    v_id = a_id;
    // In the middle of the depth range: neither the near nor the far plane cuts a volume.
    gl_Position = vec4(a_position.xy, 0.0, a_position.z);
}
