// A caster's triangles, flattened onto a receiver's plane as its shadow.

layout(location = 0) in vec3 a_position;

uniform mat4 u_to_clip;  // from the mesh's space, by way of the plane
uniform vec4 u_cut[2];   // from the mesh's space: height over the plane; weight, 1 - height / the light's height

#ifdef MULTISAMPLE
out float gl_ClipDistance[2];  // a fragment's samples may lie on either side: clipping knows each
#else
out vec2 v_cut;                // OpenGL ES has no clip distances
#endif

void main() {
    vec4 position = vec4(a_position, 1.0);
    gl_Position = u_to_clip * position;
    gl_Position.z = 0.0;  // what is seen was decided when the receiver was marked
    vec2 cut = vec2(dot(u_cut[0], position), dot(u_cut[1], position));
#ifdef MULTISAMPLE
    gl_ClipDistance[0] = cut.x;
    gl_ClipDistance[1] = cut.y;
#else
    v_cut = cut;
#endif
}
