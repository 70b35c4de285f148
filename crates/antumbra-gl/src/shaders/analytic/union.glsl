// The strips of a union, and the intervals that are hidden of one. Twins: antumbra_math::soft::Nodes, and its `visibility` for
// up to SLOTS intervals. LIGHT_TEXELS is 1 for balls, 4 for anything flat.

#define UNION_NODES 24
// Intervals of a strip that do not touch each other. Of more than these on one strip the nearest are taken together, the
// gap between them with them.
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

// Makes slots[0 .. SLOTS) hold `interval` too. What it touches becomes one with it; the rest stays apart.
void join(inout vec2 slots[SLOTS], vec2 interval) {
    bool placed = !(interval.x < interval.y);
    for (int i = 0; i < SLOTS; i++) {
        bool touches = !placed && slots[i].x <= interval.y && interval.x <= slots[i].y;
        interval = touches ? vec2(min(interval.x, slots[i].x), max(interval.y, slots[i].y)) : interval;
        slots[i] = touches ? EMPTY : slots[i];
    }
    float nearest = ANTUMBRA_FAR_AWAY;
    int at = -1;
    for (int i = 0; i < SLOTS; i++) {
        bool free = !(slots[i].x < slots[i].y);
        float gap = free ? -1.0 : max(slots[i].x - interval.y, interval.x - slots[i].y);
        at = gap < nearest ? i : at;
        nearest = min(gap, nearest);
    }
    for (int i = 0; i < SLOTS; i++) {
        bool here = !placed && i == at;
        slots[i] = here ? interval_hull(interval, slots[i]) : slots[i];
    }
}

// The same for an interval without what is inside of another. Loops, because both sides of a branch cost.
void join_but(inout vec2 slots[SLOTS], vec2 hidden, vec2 kept) {
    kept = antumbra_interval_and(hidden, kept);
    int parts = kept.x < kept.y ? 1 : 0;
    for (int k = 0; k < parts; k++) {
        join(slots, vec2(hidden.x, kept.x));
        hidden.x = kept.y;
    }
    join(slots, hidden);
}

// Of the strip at `y`, what is before a plane that cuts a ball of light: see conic_of_cut.
vec2 flat_kept(vec3 normal, float over, AntumbraPatch p, float y) {
    vec2 kept = EMPTY;
    int cuts = p.radius_2 > over * over ? 1 : 0;
    for (int k = 0; k < cuts; k++) {
        Conic cut;
        conic_of_cut(normal, over, p, cut);
        kept = conic_interval(cut, y);
    }
    return kept;
}
