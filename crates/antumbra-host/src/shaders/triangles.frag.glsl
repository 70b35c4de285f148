// A triangle, lit without shadows.
uniform float u_near;        // window depth = near / distance

in vec3 v_normal;
flat in vec4 v_plane;
flat in vec2 v_range;

void main() {
    vec3 sight = line_of_sight();
    // Where the line of sight meets the triangle's plane: exact to float32's rounding, which distances
    // interpolated over a small and slanted triangle are not. A triangle seen almost edge-on is where its
    // corners are.
    float slope = dot(v_plane.xyz, sight);
    float distance = clamp(slope == 0.0 ? v_range.x : v_plane.w / slope, v_range.x, v_range.y);
    distance = max(distance, u_near);
    vec3 normal = normalize(v_normal);
    gl_FragDepth = max(u_near / distance, 1e-37);  // the far end is still something, not the background
    write_surface(sight * distance, slope > 0.0 ? -normal : normal);
}
