// The factor on the host's pixels, from the sums of all batches.

uniform highp SURFACE_SAMPLER u_all;
uniform highp SURFACE_SAMPLER u_taken;
uniform ivec2 u_visibility_offset;
uniform vec3 u_ambient;
uniform float u_gamma;

layout(location = 0) out vec4 o_ratio;

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy) + u_visibility_offset;
    vec3 taken = texelFetch(u_taken, texel, SURFACE_INDEX).rgb;
    if (taken == vec3(0.0)) {
        discard;
    }
    vec3 all = texelFetch(u_all, texel, SURFACE_INDEX).rgb + u_ambient;
    vec3 ratio = 1.0 - taken / max(all, vec3(1e-30));
    o_ratio = vec4(host_factor(ratio, u_gamma), 1.0);
}
