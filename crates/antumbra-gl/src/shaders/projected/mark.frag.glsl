// Passes where a receiver is seen, for the stencil buffer to mark.

uniform vec4 u_plane;              // the receiver's, view space: normal towards the eye, minus its offset
uniform vec4 u_sides[2];           // -1 and 1 at a rectangle's opposite sides; 0 for a plane
uniform highp uint u_receiver;     // its id
uniform bool u_beyond;             // instead: where the plane is not hidden, as a depth test would find

layout(location = 0) out vec4 o_nothing;

void main() {
    SurfacePoint s;
    bool seen = surface_point(s);
    vec4 p = vec4(s.position, 1.0);
    float height = dot(u_plane, p);
    bool marked = seen && s.receives && abs(height) <= s.tolerance;
    for (int i = 0; i < 2; i++) {
        marked = marked && abs(dot(u_sides[i], p)) <= 1.0 + s.tolerance * length(u_sides[i].xyz);
    }
#ifdef IDS
    marked = marked && s.id == u_receiver;
#endif
    if (u_beyond) {
        marked = !seen || height <= s.tolerance;
    }
    if (!marked) {
        discard;
    }
    o_nothing = vec4(1.0);  // the colour mask is off
}
