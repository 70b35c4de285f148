// The shade of a light's umbra and penumbra, over the host's pixels.

uniform highp SURFACE_SAMPLER u_sums;  // darkness of the umbra, of the penumbra, unused, and what they cover
uniform ivec2 u_sums_offset;           // from this target's pixel to its texel
uniform int u_linear;                  // 1 for linear pixels, 0 for displayed ones

layout(location = 0) out vec4 o_result;

void main() {
    vec4 sums = texelFetch(u_sums, ivec2(gl_FragCoord.xy) + u_sums_offset, SURFACE_INDEX);
    if (!(sums.w > 0.0)) {
        discard;
    }
    float k = 1.0 - min(max(sums.x, sums.y) / sums.w, 1.0);
    o_result = vec4(vec3(u_linear == 1 ? linear_grey(k) : k), sums.w);
}
