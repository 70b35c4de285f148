// The visibility of a light from the sums over its points.

uniform highp SURFACE_SAMPLER u_sums;  // red: what shadows take; green: what all points send

layout(location = 0) out vec4 o_visibility;

void main() {
    vec4 sums = texelFetch(u_sums, ivec2(gl_FragCoord.xy), SURFACE_INDEX);
    // Also where no point is above the surface's horizon: there is nothing to take.
    if (!(sums.x > 0.0)) {
        discard;
    }
    o_visibility = vec4(1.0 - min(sums.x / sums.y, 1.0));
}
