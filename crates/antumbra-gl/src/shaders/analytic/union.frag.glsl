// The visibility of one light with an area past all occluders that reach a tile of the screen: the union of what they
// hide, not the product. Twin: antumbra_math::soft::visibility.
//
// u_blockers holds, at the tile's first texel: texel of the light, first entry, number of balls, of discs; number of
// triangles and rectangles, of cones, of planes. Entries: texel of the shape, its id in two halves. A triangle has a
// fourth corner in the middle of a side.

flat in vec4 v_blocker[BLOCKER_TEXELS];
flat in vec4 v_channel;
flat in highp uint v_id;

uniform highp sampler2D u_blockers;

layout(location = 0) out vec4 o_visibility;

vec4 texel(int i) {
    int width = textureSize(u_blockers, 0).x;
    return texelFetch(u_blockers, ivec2(i % width, i / width), 0);
}

// An entry's shape, unless it is the surface's own.
bool entry_shape(int entry, SurfacePoint s, out int shape) {
    vec4 e = texel(entry);
    shape = int(e.x);
    uint id = uint(e.y) + (uint(e.z) << 16u);
    return !is_own(s, id);
}

// Of each kind: whether it hides anything, how far it is, what it hides. Points inside a solid are told by `solid`.
bool ball_hides(int shape, SurfacePoint s, out float apart, inout bool solid) {
    vec4 ball = texel(shape);
    vec3 center = ball.xyz - s.position;
    bool inside = ball_holds(center, ball.w, s);
    solid = solid || (inside && s.has_id);
    apart = length(center);
    return !inside;
}

Cap ball_hidden(int shape, SurfacePoint s, AntumbraPatch p, vec4 light, vec3 direction, out Conic kept, out int cuts) {
    vec4 ball = texel(shape);
    vec4 circle = texel(shape + 1);
    vec3 center = ball.xyz - s.position;
    Cap hidden = cap_of(conic_of_sphere(center, ball.w, p));
    bool keeps = false;
    for (int k = 0; k < int(circle.z); k++) {
#if LIGHT_TEXELS == 1
        vec3 toward = normalize(ball.xyz - light.xyz);
#else
        vec3 toward = -direction;
#endif
        hidden = hidden_crossing(center, vec3(ball.w, circle.xy), toward, p, kept, keeps);
    }
    cuts = keeps ? 1 : 0;
    return hidden;
}

bool disc_hides(int shape, SurfacePoint s, out float apart) {
    vec3 center = texel(shape).xyz - s.position;
    apart = length(center);
    return abs(dot(center, texel(shape + 1).xyz)) > s.tolerance;
}

Conic disc_hidden(int shape, SurfacePoint s, AntumbraPatch p) {
    vec4 disc = texel(shape);
    vec4 axis = texel(shape + 1);
    return conic_of_disc(disc.xyz - s.position, axis.xyz, disc.w, axis.w, p);
}

bool corners_hide(int shape, SurfacePoint s, out float apart) {
    vec3 a = texel(shape).xyz - s.position;
    vec3 b = texel(shape + 1).xyz - s.position;
    vec3 c = texel(shape + 2).xyz - s.position;
    apart = length(a + c) * 0.5;
    return abs(dot(normalize(cross(b - a, c - a)), a)) > s.tolerance;
}

Polygon corners_hidden(int shape, SurfacePoint s, AntumbraPatch p, out vec3 normal) {
    vec3 corners[CORNERS];
    for (int i = 0; i < CORNERS; i++) {
        corners[i] = texel(shape + i).xyz - s.position;
    }
    normal = corners_normal(corners);
    return polygon_of(corners, texel(shape).w, p);
}

bool cone_hides(int shape, SurfacePoint s, out float apart, inout bool solid) {
    vec4 base = texel(shape);
    vec4 axis = texel(shape + 1);
    vec3 center = base.xyz - s.position;
    bool inside = cone_holds(center, axis.xyz, base.w, axis.w, s);
    solid = solid || (inside && s.has_id);
    apart = length(center + axis.xyz * (0.5 * axis.w));
    return !inside;
}

Hidden cone_hidden(int shape, SurfacePoint s, AntumbraPatch p) {
    vec4 base = texel(shape);
    vec4 axis = texel(shape + 1);
    vec3 center = base.xyz - s.position;
    vec3 tips[3];
    bool has_triangle = cone_triangle(center, axis.xyz, base.w, axis.w, tips);
    vec3 corners[CORNERS];
    corners[0] = tips[0];
    corners[1] = tips[1];
    corners[2] = tips[2];
    corners[3] = (tips[2] + tips[0]) * 0.5;
    float over = dot(corners_normal(corners), p.origin * p.reach - corners[0]);
    return Hidden(conic_of_disc(center, axis.xyz, base.w, texel(shape + 2).x, p), polygon_of(corners, over, p),
                  abs(dot(center, axis.xyz)) > s.tolerance, has_triangle);
}

vec3 plane_hidden(int shape, SurfacePoint s, AntumbraPatch p, out bool hides) {
    vec4 plane = texel(shape);
    float height = dot(plane.xyz, s.position) - plane.w;
    hides = abs(height) > s.tolerance;
    float side = height < 0.0 ? 1.0 : -1.0;
    return patch_before(p, plane.xyz * side, texel(shape + 1).x * side);
}

void main() {
    SurfacePoint s;
    if (!surface_point(s) || !s.receives) {
        discard;
    }
    vec3 normal = surface_normal(s);
    Footprint footprint = surface_footprint(s);
    int light_at = int(v_blocker[0].x);
    vec4 light = texel(light_at);
#if LIGHT_TEXELS == 1
    vec4 direction = vec4(0.0);
    AntumbraPatch p = antumbra_patch_of_sphere(light.xyz, light.w, s.position, normal);
#else
    vec4 direction = texel(light_at + 1);
    bool round = direction.w > 0.5;
    vec3 across = antumbra_level_axis(direction.xyz, normal) * light.w;
    AntumbraPatch p = antumbra_patch_of_flat(light.xyz, direction.xyz, round ? across : texel(light_at + 2).xyz,
                              round ? cross(direction.xyz, across) : texel(light_at + 3).xyz, round, s.position);
#endif
    if (!p.faces) {
        discard;
    }
    int first = int(v_blocker[0].y);
    int balls = first + int(v_blocker[0].z);
    int discs = balls + int(v_blocker[0].w);
    int polygons = discs + int(v_blocker[1].x);
    int cones = polygons + int(v_blocker[1].y);
    int planes = cones + int(v_blocker[1].z);

    // The nearest that hides anything says how narrow a penumbra may be.
    float nearest = ANTUMBRA_FAR_AWAY;
    float apart;
    int shape;
    bool solid = false;
    Conic kept;   // what of the inside is not hidden, if `cuts` is 1
    int cuts;
    vec3 facing;  // a polygon's normal
    for (int e = first; e < balls; e++) {
        bool hides = entry_shape(e, s, shape) && ball_hides(shape, s, apart, solid);
        nearest = hides ? min(nearest, apart) : nearest;
    }
    for (int e = balls; e < discs; e++) {
        bool hides = entry_shape(e, s, shape) && disc_hides(shape, s, apart);
        nearest = hides ? min(nearest, apart) : nearest;
    }
    for (int e = discs; e < polygons; e++) {
        bool hides = entry_shape(e, s, shape) && corners_hide(shape, s, apart);
        nearest = hides ? min(nearest, apart) : nearest;
    }
    for (int e = polygons; e < cones; e++) {
        bool hides = entry_shape(e, s, shape) && cone_hides(shape, s, apart, solid);
        nearest = hides ? min(nearest, apart) : nearest;
    }
    p = antialiased(p, footprint, min(nearest, p.reach));
    AntumbraStrips strips = antumbra_strips_of(p, normal);

    // The strips that any of them can reach.
    vec2 rows = cones < planes ? vec2(-ANTUMBRA_FAR_AWAY, ANTUMBRA_FAR_AWAY) : EMPTY;
    for (int e = first; e < balls; e++) {
        bool hides = entry_shape(e, s, shape) && ball_hides(shape, s, apart, solid);
        rows = hides ? interval_hull(rows, cap_rows(ball_hidden(shape, s, p, light, direction.xyz, kept, cuts))) : rows;
    }
    for (int e = balls; e < discs; e++) {
        bool hides = entry_shape(e, s, shape) && disc_hides(shape, s, apart);
        rows = hides ? interval_hull(rows, conic_rows(disc_hidden(shape, s, p))) : rows;
    }
    for (int e = discs; e < polygons; e++) {
        bool hides = entry_shape(e, s, shape) && corners_hide(shape, s, apart);
        rows = hides ? interval_hull(rows, corners_hidden(shape, s, p, facing).rows) : rows;
    }
    for (int e = polygons; e < cones; e++) {
        bool hides = entry_shape(e, s, shape) && cone_hides(shape, s, apart, solid);
        rows = hides ? interval_hull(rows, hidden_rows(cone_hidden(shape, s, p))) : rows;
    }
    rows = antumbra_interval_and(rows, antumbra_strips_rows(strips));
    if (!(rows.x < rows.y) && !solid) {
        discard;
    }

    float half_rows = max((rows.y - rows.x) * 0.5, 0.0);
    float middle = (rows.x + rows.y) * 0.5;
    float taken = 0.0;
    for (int i = 0; i < UNION_NODES + min(int(gl_FragCoord.y), 0); i++) {
        vec2 node = union_node(strips.round, i);
        float y = middle + half_rows * node.x;
        vec2 seen = antumbra_strips_seen(strips, y);
        vec2 slots[SLOTS];
        for (int k = 0; k < SLOTS; k++) {
            slots[k] = EMPTY;
        }
        for (int e = first; e < balls; e++) {
            bool hides = entry_shape(e, s, shape) && ball_hides(shape, s, apart, solid);
            vec2 hidden = cap_interval(ball_hidden(shape, s, p, light, direction.xyz, kept, cuts), y);
            vec2 but = EMPTY;
            for (int k = 0; k < cuts; k++) {
                but = conic_interval(kept, y);
            }
            join_but(slots, hides ? antumbra_interval_and(hidden, seen) : EMPTY, but);
        }
        for (int e = balls; e < discs; e++) {
            bool hides = entry_shape(e, s, shape) && disc_hides(shape, s, apart);
            vec2 hidden = conic_interval(disc_hidden(shape, s, p), y);
            vec4 axis = texel(shape + 1);
            float side = dot(axis.xyz, texel(shape).xyz - s.position) < 0.0 ? -1.0 : 1.0;
            vec2 but = flat_kept(axis.xyz * side, axis.w * side, p, y);
            join_but(slots, hides ? antumbra_interval_and(hidden, seen) : EMPTY, but);
        }
        for (int e = discs; e < polygons; e++) {
            bool hides = entry_shape(e, s, shape) && corners_hide(shape, s, apart);
            vec2 hidden = polygon_interval(corners_hidden(shape, s, p, facing), y);
            vec4 corner = texel(shape);
            float side = dot(facing, corner.xyz - s.position) < 0.0 ? -1.0 : 1.0;
            vec2 but = flat_kept(facing * side, corner.w * side, p, y);
            join_but(slots, hides ? antumbra_interval_and(hidden, seen) : EMPTY, but);
        }
        for (int e = polygons; e < cones; e++) {
            bool hides = entry_shape(e, s, shape) && cone_hides(shape, s, apart, solid);
            vec2 hidden = hidden_interval(cone_hidden(shape, s, p), y);
            join(slots, hides ? antumbra_interval_and(hidden, seen) : EMPTY);
        }
        for (int e = cones; e < planes; e++) {
            bool hides;
            bool other = entry_shape(e, s, shape);
            vec3 beyond = plane_hidden(shape, s, p, hides);
            vec2 hidden = other && hides ? antumbra_interval_and(antumbra_line_positive(beyond, y), seen) : EMPTY;
            vec4 plane = texel(shape);
            float side = plane.w - dot(plane.xyz, s.position) < 0.0 ? -1.0 : 1.0;
            join_but(slots, hidden, flat_kept(plane.xyz * side, texel(shape + 1).x * side, p, y));
        }
        float sum = 0.0;
        for (int k = 0; k < SLOTS; k++) {
            sum += antumbra_strips_irradiance(strips, y, slots[k]);
        }
        taken += node.y * sum;
    }
    taken *= half_rows;
    float whole = light_whole(p, strips, normal);
    float dark = solid ? 1.0 : clamp(taken / max(whole, 1e-30), 0.0, 1.0);
    if (!(dark > 0.0)) {
        discard;
    }
    o_visibility = vec4(1.0) - v_channel * dark;
}
