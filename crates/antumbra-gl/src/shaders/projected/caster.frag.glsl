// What of a flattened caster is shadow: the part between the plane and the light.

#if defined(MULTISAMPLE) && defined(GL_ARB_gpu_shader5)
#extension GL_ARB_gpu_shader5 : enable
#define EACH_SAMPLE sample
#else
#define EACH_SAMPLE
#endif

uniform vec4 u_shade;

EACH_SAMPLE in vec2 v_cut;

layout(location = 0) out vec4 o_shade;

void main() {
    if (!(min(v_cut.x, v_cut.y) > 0.0)) {
        discard;
    }
    o_shade = u_shade;
}
