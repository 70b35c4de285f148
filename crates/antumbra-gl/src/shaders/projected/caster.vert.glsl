// A caster's triangles, flattened onto a receiver's plane as its shadow.

#if defined(MULTISAMPLE) && defined(GL_ARB_gpu_shader5)
#extension GL_ARB_gpu_shader5 : enable
#define EACH_SAMPLE sample
#else
#define EACH_SAMPLE
#endif

layout(location = 0) in vec3 a_position;

uniform mat4 u_to_clip;  // from the mesh's space, by way of the plane
uniform vec4 u_cut[2];   // from the mesh's space: height over the plane; weight, 1 - height / the light's height

EACH_SAMPLE out vec2 v_cut;

void main() {
    vec4 position = vec4(a_position, 1.0);
    gl_Position = u_to_clip * position;
    gl_Position.z = 0.0;  // what is seen was decided when the receiver was marked
    v_cut = vec2(dot(u_cut[0], position), dot(u_cut[1], position));
}
