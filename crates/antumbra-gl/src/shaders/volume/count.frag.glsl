// Counts a polygon of a shadow volume, in the stencil buffer, for the points on one side of it.

flat in vec4 v_plane;
flat in vec2 v_lift;        // tolerances to add: on any surface, on the caster's own
flat in highp uint v_id;    // the caster's; plus 2^31: it shadows itself

void main() {
    SurfacePoint s;
    if (!surface_point(s) || !s.receives || (s.has_id && s.id == v_id)) {
        discard;
    }
    // Rasterisers snap corners to a grid: beside an edge of the caster, the host may have drawn the one face there,
    // and what is drawn here may be what belongs to the other.
    bool own = !s.has_id || s.id == (v_id & 0x7fffffffu);
    float snap = SNAP * u_pixel_step.x * (u_pixel_step.z > 0.5 ? abs(s.position.z) : 1.0);
    float tolerance = own ? v_lift.y * (s.tolerance + snap) : v_lift.x * s.tolerance;
    if (!(dot(v_plane.xyz, s.position) + v_plane.w + tolerance >= 0.0)) {
        discard;
    }
}
