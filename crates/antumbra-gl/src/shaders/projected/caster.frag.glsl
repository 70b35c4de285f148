// What of a flattened caster is shadow: the part between the plane and the light.

uniform vec4 u_shade;

#ifndef MULTISAMPLE
in vec2 v_cut;
#endif

layout(location = 0) out vec4 o_shade;

void main() {
#ifndef MULTISAMPLE
    if (!(min(v_cut.x, v_cut.y) > 0.0)) {
        discard;
    }
#endif
    o_shade = u_shade;
}
