// A caster's triangles, flattened onto a receiver's plane as its shadow.

layout(location = 0) in vec3 a_position;

uniform mat4 u_to_clip;  // from the mesh's space, by way of the plane
uniform vec4 u_height;   // from the mesh's space: height over the plane

#ifdef MULTISAMPLE
out float gl_ClipDistance[1];  // a fragment's samples may lie on either side: clipping knows each
#else
out float v_height;            // OpenGL ES has no clip distances
#endif

void main() {
    vec4 position = vec4(a_position, 1.0);
    gl_Position = u_to_clip * position;
    gl_Position.z = 0.0;  // what is seen was decided when the receiver was marked
    float height = dot(u_height, position);
#ifdef MULTISAMPLE
    gl_ClipDistance[0] = height;
#else
    v_height = height;
#endif
}
