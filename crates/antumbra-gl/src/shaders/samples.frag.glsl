// Sums over some of the points that stand for a light.
//
// TAKEN: of what shadows take, into red. Otherwise: of what all points send, into green.

uniform vec3 u_points[BATCH_LIGHTS];  // view space
uniform int u_point_count;
uniform vec3 u_center;
uniform vec4 u_emitter;

layout(location = 0) out vec4 o_sum;

void main() {
#ifdef TAKEN
    float visibility[BATCH_LIGHTS];
    if (!any_shadow(ivec2(gl_FragCoord.xy), visibility)) {
        discard;
    }
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
