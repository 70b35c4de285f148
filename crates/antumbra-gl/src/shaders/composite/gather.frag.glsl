// The darkness of a light's shadow from those of up to four of its components.

uniform highp SURFACE_SAMPLER u_cover;  // of a pixel, a channel a component
uniform highp SURFACE_SAMPLER u_dark;   // the same times the shadow's darkness
uniform vec2 u_share;                   // x: 1 if the first component is the central one; y: of each in the penumbra

layout(location = 0) out vec4 o_sum;

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    vec4 cover = texelFetch(u_cover, texel, SURFACE_INDEX);
    vec4 dark = texelFetch(u_dark, texel, SURFACE_INDEX);
    float most = max(max(cover.x, cover.y), max(cover.z, cover.w));
    if (!(most > 0.0)) {
        discard;
    }
    o_sum = vec4(dark.x * u_share.x, dot(dark, u_share.yyyy), 0.0, most);
}
