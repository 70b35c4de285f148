// What of a flattened caster is shadow: the part over the plane. What is beyond the light has a negative weight
// there, and OpenGL has clipped it, or lands behind the eye, where no marked pixel sees it.

uniform vec4 u_shade;

#ifndef MULTISAMPLE
in float v_height;
#endif

layout(location = 0) out vec4 o_shade;

void main() {
#ifndef MULTISAMPLE
    if (!(v_height > 0.0)) {
        discard;
    }
#endif
    o_shade = u_shade;
}
