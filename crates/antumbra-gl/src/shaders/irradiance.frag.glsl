// What this batch's lights send to the surface, and how much of it the shadows take.
//
// OVERLAY: the factor on the host's pixels, when one batch holds all lights.
// TAKEN:   what shadows take, to be added up over the batches.
// ALL:     what the lights send, to be added up over the batches, where shadows take anything.

#define LIGHT_VECTORS 7

uniform vec4 u_lights[BATCH_LIGHTS * LIGHT_VECTORS];  // view space
uniform int u_light_count;

AntumbraLight light_at(int i) {
    int at = i * LIGHT_VECTORS;
    return AntumbraLight(u_lights[at], u_lights[at + 1], u_lights[at + 2], u_lights[at + 3], u_lights[at + 4],
                         u_lights[at + 5], u_lights[at + 6]);
}

#ifdef ALL
uniform highp SURFACE_SAMPLER u_taken;
#endif
uniform ivec2 u_visibility_offset;  // from this target's pixel to the visibility textures' texel
uniform vec3 u_ambient;
uniform float u_gamma;              // the host's pixels are radiance^(1/gamma)

layout(location = 0) out vec4 o_result;

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy) + u_visibility_offset;
#ifdef ALL
    if (texelFetch(u_taken, texel, SURFACE_INDEX).rgb == vec3(0.0)) {
        discard;
    }
    float visibility[BATCH_LIGHTS] = float[BATCH_LIGHTS](1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0);
#else
    float visibility[BATCH_LIGHTS];
    if (!any_shadow(texel, visibility)) {
        discard;
    }
#endif
    SurfacePoint s;
    if (!surface_point(s)) {
        discard;
    }
    vec3 normal = surface_normal(s);
    vec3 all = vec3(0.0);
    vec3 taken = vec3(0.0);
    for (int i = 0; i < BATCH_LIGHTS; i++) {
        if (i >= u_light_count) {
            break;
        }
        vec3 e = antumbra_irradiance(light_at(i), s.position, normal);
        all += e;
        taken += e * (1.0 - visibility[i]);
    }
#ifdef OVERLAY
    vec3 ratio = 1.0 - taken / max(all + u_ambient, vec3(1e-30));
    o_result = vec4(host_factor(ratio, u_gamma), 1.0);
#elif defined(TAKEN)
    o_result = vec4(taken, 1.0);
#else
    o_result = vec4(all, 1.0);
#endif
}
