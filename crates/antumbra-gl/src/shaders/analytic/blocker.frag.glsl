// The visibility of one light past one blocker, blended into the light's channel by minimum: the
// minimum of hard visibilities is their union's.

flat in highp uint v_id;
flat in vec4 v_channel;

layout(location = 0) out vec4 o_visibility;

void main() {
    SurfacePoint s;
    if (!surface_point(s) || !s.receives || is_own(s, v_id)) {
        discard;
    }
    float coverage = blocker_coverage(surface_footprint(s), s);
    if (!(coverage > 0.0)) {
        discard;
    }
    o_visibility = vec4(1.0) - v_channel * coverage;
}
