// A face of a shadow map in shades of grey.
in vec2 v_at;
out vec4 o_color;

uniform highp sampler2D u_map;
uniform ivec2 u_corner; // of the face, texels
uniform int u_side;     // of a face, texels
uniform vec2 u_range;   // distances of the lightest and the darkest shade, metres
uniform vec3 u_scale;   // distance is x / depth where z is 1, else x + y * depth

void main() {
    // Mirrored, as the light sees it.
    vec2 at = vec2(1.0 - v_at.x, v_at.y);
    ivec2 texel = u_corner + clamp(ivec2(at * float(u_side)), ivec2(0), ivec2(u_side - 1));
    float depth = texelFetch(u_map, texel, 0).r;
    if (depth <= 0.0) {
        o_color = vec4(0.0, 0.0, 0.0, 1.0);
        return;
    }
    float distance = u_scale.z == 1.0 ? u_scale.x / depth : u_scale.x + u_scale.y * depth;
    float part = clamp((distance - u_range.x) / max(u_range.y - u_range.x, 1e-6), 0.0, 1.0);
    o_color = vec4(vec3(mix(0.95, 0.16, part)), 1.0);
}
