// Sums over some of the points that stand for a light.
//
// TAKEN: of what shadows take, into red. Otherwise: of what all points send, into green.

#define BATCH_LIGHTS 8

uniform vec3 u_points[BATCH_LIGHTS];  // view space
uniform int u_point_count;
uniform vec3 u_center;
uniform vec4 u_emitter;
#ifdef TAKEN
uniform highp SURFACE_SAMPLER u_visibility_0;
uniform highp SURFACE_SAMPLER u_visibility_1;
#endif

layout(location = 0) out vec4 o_sum;

void main() {
#ifdef TAKEN
    ivec2 texel = ivec2(gl_FragCoord.xy);
    vec4 v0 = texelFetch(u_visibility_0, texel, SURFACE_INDEX);
    vec4 v1 = texelFetch(u_visibility_1, texel, SURFACE_INDEX);
    if (v0 == vec4(1.0) && v1 == vec4(1.0)) {
        discard;
    }
    float visibility[BATCH_LIGHTS] = float[BATCH_LIGHTS](v0.x, v0.y, v0.z, v0.w, v1.x, v1.y, v1.z, v1.w);
#endif
    SurfacePoint s;
    if (!surface_point(s)) {
        discard;
    }
    vec3 normal = surface_normal(s);
    float sum = 0.0;
    for (int i = 0; i < BATCH_LIGHTS; i++) {
        if (i >= u_point_count) {
            break;
        }
        float weight = sample_weight(u_points[i], u_center, u_emitter, s.position, normal);
#ifdef TAKEN
        sum += weight * (1.0 - visibility[i]);
#else
        sum += weight;
#endif
    }
#ifdef TAKEN
    o_sum = vec4(sum, 0.0, 0.0, 0.0);
#else
    o_sum = vec4(0.0, sum, 0.0, 0.0);
#endif
}
