// The visibilities of a batch's lights at a pixel, from the masks that hold them.

#define BATCH_LIGHTS 8

uniform highp SURFACE_SAMPLER u_visibility_0;
uniform highp SURFACE_SAMPLER u_visibility_1;

// Whether any light is less than whole there.
bool any_shadow(ivec2 texel, out float visibility[BATCH_LIGHTS]) {
    vec4 v0 = texelFetch(u_visibility_0, texel, SURFACE_INDEX);
    vec4 v1 = texelFetch(u_visibility_1, texel, SURFACE_INDEX);
    visibility = float[BATCH_LIGHTS](v0.x, v0.y, v0.z, v0.w, v1.x, v1.y, v1.z, v1.w);
    return v0 != vec4(1.0) || v1 != vec4(1.0);
}
