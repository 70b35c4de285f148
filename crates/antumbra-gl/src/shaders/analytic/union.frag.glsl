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

#define UNION_NODES 24
// Intervals of a strip that do not touch each other. More than these on one strip are taken together.
#define SLOTS 6

#if LIGHT_TEXELS != 1
// Gauss's nodes and weights for rectangles.
const vec2 LEGENDRE_24[UNION_NODES] = vec2[UNION_NODES](
    vec2(0.995187219997, 0.012341229800), vec2(0.974728555971, 0.028531388629),
    vec2(0.938274552003, 0.044277438817), vec2(0.886415527004, 0.059298584915),
    vec2(0.820001985974, 0.073346481411), vec2(0.740124191579, 0.086190161532),
    vec2(0.648093651937, 0.097618652104), vec2(0.545421471389, 0.107444270116),
    vec2(0.433793507626, 0.115505668054), vec2(0.315042679696, 0.121670472928),
    vec2(0.191118867474, 0.125837456347), vec2(0.064056892863, 0.127938195347),
    vec2(-0.064056892863, 0.127938195347), vec2(-0.191118867474, 0.125837456347),
    vec2(-0.315042679696, 0.121670472928), vec2(-0.433793507626, 0.115505668054),
    vec2(-0.545421471389, 0.107444270116), vec2(-0.648093651937, 0.097618652104),
    vec2(-0.740124191579, 0.086190161532), vec2(-0.820001985974, 0.073346481411),
    vec2(-0.886415527004, 0.059298584915), vec2(-0.938274552003, 0.044277438817),
    vec2(-0.974728555971, 0.028531388629), vec2(-0.995187219997, 0.012341229800));
#endif

vec2 union_node(bool round, int i) {
    float angle = float(i + 1) * (3.141592653589793 / float(UNION_NODES + 1));
    vec2 node = vec2(cos(angle), sin(angle) * (3.141592653589793 / float(UNION_NODES + 1)));
#if LIGHT_TEXELS == 1
    return node;
#else
    return round ? node : LEGENDRE_24[i];
#endif
}

vec4 texel(int i) {
    int width = textureSize(u_blockers, 0).x;
    return texelFetch(u_blockers, ivec2(i % width, i / width), 0);
}

// Makes slots[0 .. SLOTS) hold `interval` too. What it touches becomes one with it; the rest stays apart.
void join(inout vec2 slots[SLOTS], vec2 interval) {
    bool placed = !(interval.x < interval.y);
    for (int i = 0; i < SLOTS; i++) {
        bool touches = !placed && slots[i].x <= interval.y && interval.x <= slots[i].y;
        interval = touches ? vec2(min(interval.x, slots[i].x), max(interval.y, slots[i].y)) : interval;
        slots[i] = touches ? EMPTY : slots[i];
    }
    for (int i = 0; i < SLOTS; i++) {
        bool free = !(slots[i].x < slots[i].y);
        bool here = !placed && (free || i == SLOTS - 1);
        slots[i] = here ? interval_hull(interval, slots[i]) : slots[i];
        placed = placed || here;
    }
}

struct Tile {
    int entries;
    int ends[5];  // where each kind's entries end
};

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

Conic ball_hidden(int shape, SurfacePoint s, LightPatch p) {
    vec4 ball = texel(shape);
    return sphere_conic(ball.xyz - s.position, ball.w, p);
}

bool disc_hides(int shape, SurfacePoint s, out float apart) {
    vec3 center = texel(shape).xyz - s.position;
    apart = length(center);
    return abs(dot(center, texel(shape + 1).xyz)) > s.tolerance;
}

Conic disc_hidden(int shape, SurfacePoint s, LightPatch p) {
    vec4 disc = texel(shape);
    return disc_conic(disc.xyz - s.position, texel(shape + 1).xyz, disc.w, p);
}

bool corners_hide(int shape, SurfacePoint s, out float apart) {
    vec3 a = texel(shape).xyz - s.position;
    vec3 b = texel(shape + 1).xyz - s.position;
    vec3 c = texel(shape + 2).xyz - s.position;
    apart = length(a + c) * 0.5;
    return abs(dot(normalize(cross(b - a, c - a)), a)) > s.tolerance;
}

Polygon corners_hidden(int shape, SurfacePoint s, LightPatch p) {
    vec3 corners[CORNERS];
    for (int i = 0; i < CORNERS; i++) {
        corners[i] = texel(shape + i).xyz - s.position;
    }
    return polygon_of(corners, p);
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

Hidden cone_hidden(int shape, SurfacePoint s, LightPatch p) {
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
    return Hidden(disc_conic(center, axis.xyz, base.w, p), polygon_of(corners, p),
                  abs(dot(center, axis.xyz)) > s.tolerance, has_triangle);
}

vec3 plane_hidden(int shape, SurfacePoint s, LightPatch p, out bool hides) {
    vec4 plane = texel(shape);
    float height = dot(plane.xyz, s.position) - plane.w;
    hides = abs(height) > s.tolerance;
    return patch_line(p, (height < 0.0 ? plane.xyz : -plane.xyz) * p.reach) - vec3(abs(height), 0.0, 0.0);
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
    LightPatch p = sphere_patch(light.xyz, light.w, s.position, normal);
#else
    vec4 direction = texel(light_at + 1);
    bool round = direction.w > 0.5;
    vec3 across = level_axis(direction.xyz, normal) * light.w;
    LightPatch p = flat_patch(light.xyz, direction.xyz, round ? across : texel(light_at + 2).xyz,
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
    float nearest = FAR_AWAY;
    float apart;
    int shape;
    bool solid = false;
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
    Strips strips = strips_of(p, normal);

    // The strips that any of them can reach.
    vec2 rows = cones < planes ? vec2(-FAR_AWAY, FAR_AWAY) : EMPTY;
    for (int e = first; e < balls; e++) {
        bool hides = entry_shape(e, s, shape) && ball_hides(shape, s, apart, solid);
        rows = hides ? interval_hull(rows, conic_rows(ball_hidden(shape, s, p))) : rows;
    }
    for (int e = balls; e < discs; e++) {
        bool hides = entry_shape(e, s, shape) && disc_hides(shape, s, apart);
        rows = hides ? interval_hull(rows, conic_rows(disc_hidden(shape, s, p))) : rows;
    }
    for (int e = discs; e < polygons; e++) {
        bool hides = entry_shape(e, s, shape) && corners_hide(shape, s, apart);
        rows = hides ? interval_hull(rows, corners_hidden(shape, s, p).rows) : rows;
    }
    for (int e = polygons; e < cones; e++) {
        bool hides = entry_shape(e, s, shape) && cone_hides(shape, s, apart, solid);
        rows = hides ? interval_hull(rows, hidden_rows(cone_hidden(shape, s, p))) : rows;
    }
    rows = interval_and(rows, strips_rows(strips));
    if (!(rows.x < rows.y) && !solid) {
        discard;
    }

    float half_rows = max((rows.y - rows.x) * 0.5, 0.0);
    float middle = (rows.x + rows.y) * 0.5;
    float taken = 0.0;
    for (int i = 0; i < UNION_NODES + min(int(gl_FragCoord.y), 0); i++) {
        vec2 node = union_node(strips.round, i);
        float y = middle + half_rows * node.x;
        vec2 seen = strips_seen(strips, y);
        vec2 slots[SLOTS];
        for (int k = 0; k < SLOTS; k++) {
            slots[k] = EMPTY;
        }
        for (int e = first; e < balls; e++) {
            bool hides = entry_shape(e, s, shape) && ball_hides(shape, s, apart, solid);
            vec2 hidden = conic_interval(ball_hidden(shape, s, p), y);
            join(slots, hides ? interval_and(hidden, seen) : EMPTY);
        }
        for (int e = balls; e < discs; e++) {
            bool hides = entry_shape(e, s, shape) && disc_hides(shape, s, apart);
            vec2 hidden = conic_interval(disc_hidden(shape, s, p), y);
            join(slots, hides ? interval_and(hidden, seen) : EMPTY);
        }
        for (int e = discs; e < polygons; e++) {
            bool hides = entry_shape(e, s, shape) && corners_hide(shape, s, apart);
            vec2 hidden = polygon_interval(corners_hidden(shape, s, p), y);
            join(slots, hides ? interval_and(hidden, seen) : EMPTY);
        }
        for (int e = polygons; e < cones; e++) {
            bool hides = entry_shape(e, s, shape) && cone_hides(shape, s, apart, solid);
            vec2 hidden = hidden_interval(cone_hidden(shape, s, p), y);
            join(slots, hides ? interval_and(hidden, seen) : EMPTY);
        }
        for (int e = cones; e < planes; e++) {
            bool hides;
            bool other = entry_shape(e, s, shape);
            vec3 beyond = plane_hidden(shape, s, p, hides);
            join(slots, other && hides ? interval_and(line_positive(beyond, y), seen) : EMPTY);
        }
        float sum = 0.0;
        for (int k = 0; k < SLOTS; k++) {
            sum += strips_irradiance(strips, y, slots[k]);
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
