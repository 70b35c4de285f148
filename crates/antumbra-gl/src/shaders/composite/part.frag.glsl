// One part of a shadow on the receiver.
//
// PAINT: its grey, over the host's pixels. COVER: how much of the pixel it covers, or that times its darkness, into
// the component's channel, blended by maximum. Otherwise the visibility of its light, blended into the light's
// channel by minimum: the minimum of hard visibilities is their union's.

uniform vec4 u_receiver[5];         // view space: its plane, then its sides, positive inside; (0, 1) for none
uniform highp uint u_receiver_id;   // 0: none
#ifdef COVER
uniform float u_darkness;           // 0 for what is covered, 1 for that times the darkness
#endif

flat in vec4 v_blocker[BLOCKER_TEXELS];
flat in vec4 v_channel;
flat in highp uint v_id;            // of the vertex stage, unused

layout(location = 0) out vec4 o_result;

// Whether the receiver is what is seen.
bool on_receiver(SurfacePoint s) {
    vec3 p = s.position;
    float inside = min(min(plane_distance(u_receiver[1], p), plane_distance(u_receiver[2], p)),
                       min(plane_distance(u_receiver[3], p), plane_distance(u_receiver[4], p)));
    bool in_plane = s.has_id && u_receiver_id != 0u ? s.id == u_receiver_id
                                                    : abs(plane_distance(u_receiver[0], p)) <= s.tolerance;
    return s.receives && in_plane && inside >= -s.tolerance;
}

void main() {
    SurfacePoint s;
    if (!surface_point(s) || !on_receiver(s)) {
        discard;
    }
    // The receiver's own normal: every pixel of it has the same.
    vec3 step = vec3(u_pixel_step.xy * u_pixel_step.w, u_pixel_step.z);
    Footprint footprint = screen_footprint(s.position, u_receiver[0].xyz, step);
    vec4 kind = v_blocker[3];
    float coverage = part_coverage(v_blocker[0], v_blocker[1], v_blocker[2], kind, footprint);
    if (!(coverage > 0.0)) {
        discard;
    }
#if defined(COVER)
    o_result = v_channel * (coverage * mix(1.0, 1.0 - kind.x, u_darkness));
#elif defined(PAINT)
    o_result = vec4(kind.xxx, coverage);
#else
    o_result = vec4(1.0) - v_channel * coverage;
#endif
}
