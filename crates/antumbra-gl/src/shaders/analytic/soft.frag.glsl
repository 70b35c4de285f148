// The visibility of one light with an area past one occluder, multiplied into the light's channel.
//
// LIGHT_TEXELS texels tell of the light (1: a ball; 4: anything flat), the rest of the occluder, which is one of
// SPHERE, DISC, TRIANGLE, RECTANGLE, CONE and PLANE.

flat in highp uint v_id;
flat in vec4 v_channel;

layout(location = 0) out vec4 o_visibility;

#define SHAPE(k) BLOCKER_DATA[LIGHT_TEXELS + (k)]

void main() {
    SurfacePoint s;
    if (!surface_point(s) || !s.receives || is_own(s, v_id)) {
        discard;
    }
    vec3 normal = surface_normal(s);
    Footprint footprint = surface_footprint(s);
    vec3 light = BLOCKER_DATA[0].xyz;
#if LIGHT_TEXELS == 1
    AntumbraPatch p = antumbra_patch_of_sphere(light, BLOCKER_DATA[0].w, s.position, normal);
#else
    vec3 direction = BLOCKER_DATA[1].xyz;
    bool round = BLOCKER_DATA[1].w > 0.5;
    vec3 across = antumbra_level_axis(direction, normal) * BLOCKER_DATA[0].w;
    AntumbraPatch p = antumbra_patch_of_flat(light, direction, round ? across : BLOCKER_DATA[2].xyz,
                              round ? cross(direction, across) : BLOCKER_DATA[3].xyz, round, s.position);
#endif
    bool solid = false;     // whether the point is inside
    bool hides = p.faces;
    Conic kept;             // with `keeps`, what of the inside is not hidden
    bool keeps = false;
    float over;             // the light's centre over a flat shape's plane
#if defined(SPHERE)
    vec3 center = SHAPE(0).xyz - s.position;
    float radius = SHAPE(0).w;
    bool inside = ball_holds(center, radius, s);
    solid = inside && s.has_id;
    hides = hides && !inside;
    p = antialiased(p, footprint, length(center));
    Hidden hidden = cap_of(conic_of_sphere(center, radius, p));
    vec4 circle = SHAPE(1);
    for (int k = 0; k < int(circle.z); k++) {
#if LIGHT_TEXELS == 1
        vec3 toward = normalize(SHAPE(0).xyz - light);
#else
        vec3 toward = -direction;
#endif
        hidden = hidden_crossing(center, vec3(radius, circle.xy), toward, p, kept, keeps);
    }
#elif defined(DISC)
    vec3 center = SHAPE(0).xyz - s.position;
    vec3 axis = SHAPE(1).xyz;
    p = antialiased(p, footprint, length(center));
    hides = hides && abs(dot(center, axis)) > s.tolerance;
    over = SHAPE(1).w;
    Hidden hidden = conic_of_disc(center, axis, SHAPE(0).w, over, p);
    keeps = conic_of_cut(dot(center, axis) < 0.0 ? -axis : axis, dot(center, axis) < 0.0 ? -over : over, p, kept);
#elif defined(CONE)
    vec3 center = SHAPE(0).xyz - s.position;
    vec3 axis = SHAPE(1).xyz;
    float radius = SHAPE(0).w;
    float height = SHAPE(1).w;
    bool inside = cone_holds(center, axis, radius, height, s);
    solid = inside && s.has_id;
    hides = hides && !inside;
    p = antialiased(p, footprint, length(center + axis * (0.5 * height)));
    vec3 corners[3];
    bool has_triangle = cone_triangle(center, axis, radius, height, corners);
    over = dot(corners_normal(corners), light - s.position - corners[0]);
    Hidden hidden = Hidden(conic_of_disc(center, axis, radius, SHAPE(2).x, p), polygon_of(corners, over, p),
                           abs(dot(center, axis)) > s.tolerance, has_triangle);
#elif defined(PLANE)
    vec3 axis = SHAPE(0).xyz;
    float height = dot(axis, s.position) - SHAPE(0).w;
    hides = hides && abs(height) > s.tolerance;
    axis = height < 0.0 ? axis : -axis;
    over = height < 0.0 ? SHAPE(1).x : -SHAPE(1).x;
    Hidden hidden = patch_before(p, axis, over);
    keeps = conic_of_cut(axis, over, p, kept);
#else
    // Not in a loop: llvmpipe reads zeros where a flat input is indexed by a variable.
    vec3 corners[CORNERS];
    corners[0] = SHAPE(0).xyz - s.position;
    corners[1] = SHAPE(1).xyz - s.position;
    corners[2] = SHAPE(2).xyz - s.position;
    vec3 middle = corners[0] + corners[1] + corners[2];
#if CORNERS == 4
    corners[3] = SHAPE(3).xyz - s.position;
    middle += corners[3];
#endif
    vec3 axis = corners_normal(corners);
    hides = hides && abs(dot(axis, corners[0])) > s.tolerance;
    p = antialiased(p, footprint, length(middle) / float(CORNERS));
    over = SHAPE(0).w;
    Hidden hidden = polygon_of(corners, over, p);
    bool away = dot(axis, corners[0]) < 0.0;
    keeps = conic_of_cut(away ? -axis : axis, away ? -over : over, p, kept);
#endif
    AntumbraStrips strips = antumbra_strips_of(p, normal);
    float taken = hidden_taken(hidden, strips, kept, keeps ? 1 : 0);
    float whole = light_whole(p, strips, normal);
    float dark = solid ? 1.0 : hides ? clamp(taken / max(whole, 1e-30), 0.0, 1.0) : 0.0;
    if (!(dark > 0.0)) {
        discard;
    }
    o_visibility = vec4(1.0) - v_channel * dark;
}
