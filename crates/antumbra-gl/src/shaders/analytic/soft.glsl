// What occluders hide of a light's patch: insides of conics and of convex polygons. Twins: antumbra_math::soft.
//
// One of CONIC (a ball or a disc), CORNERS n (a polygon), CONE and PLANE says what hides.

#if defined(CONE) && !defined(CORNERS)
#define CORNERS 3
#endif

#define EMPTY vec2(ANTUMBRA_FAR_AWAY, -ANTUMBRA_FAR_AWAY)

vec2 interval_hull(vec2 a, vec2 b) {
    bool no_a = !(a.x < a.y);
    bool no_b = !(b.x < b.y);
    vec2 both = vec2(min(a.x, b.x), max(a.y, b.y));
    return no_a ? b : no_b ? a : both;
}

// Inside is x.x x² + 2 (x.y + x.z y) x + one.x + 2 one.y y + one.z y² < 0.
struct Conic {
    vec3 x;       // xx, x1, xy
    vec3 one;     // one, y1, yy
    vec3 ahead;   // lines
    vec3 before;
};

// A distance for infinity: all of the light is on one side of a plane.
#define ALL_OVER 1e20

// Positive where the plane of a flat occluder is before the light, whose centre is `over` it along the unit normal, which
// points away from the point.
vec3 patch_before(AntumbraPatch p, vec3 normal, float over) {
    return vec3(over * p.reach - p.radius_2 * dot(normal, p.origin), p.tangent_2 * dot(normal, p.right),
                p.tangent_2 * dot(normal, p.up));
}

Conic conic_of_sphere(vec3 center, float radius, AntumbraPatch p) {
    vec3 kx = cross(center, p.right);
    vec3 k1 = cross(center, p.origin);
    vec3 ky = cross(center, p.up);
    float square = radius * radius;
    vec3 x = vec3(dot(kx, kx), dot(kx, k1), dot(kx, ky))
           - square * vec3(dot(p.right, p.right), dot(p.right, p.origin), dot(p.right, p.up));
    vec3 one = vec3(dot(k1, k1), dot(k1, ky), dot(ky, ky))
             - square * vec3(dot(p.origin, p.origin), dot(p.origin, p.up), dot(p.up, p.up));
    float nearer = p.tangent_2 - (dot(center, center) - square);
    return Conic(x, one, antumbra_patch_line(p, center), vec3(nearer, 0.0, 0.0));
}

Conic conic_of_disc(vec3 center, vec3 normal, float radius, float over, AntumbraPatch p) {
    float side = dot(center, normal) < 0.0 ? -1.0 : 1.0;
    normal *= side;
    vec3 ex = cross(normal, cross(p.right, center));
    vec3 e1 = cross(normal, cross(p.origin, center));
    vec3 ey = cross(normal, cross(p.up, center));
    vec3 ahead = antumbra_patch_line(p, normal);  // of origin, right, up
    float square = radius * radius;
    vec3 x = vec3(dot(ex, ex), dot(ex, e1), dot(ex, ey)) - square * ahead.y * vec3(ahead.y, ahead.x, ahead.z);
    vec3 one = vec3(dot(e1, e1), dot(e1, ey), dot(ey, ey))
             - square * vec3(ahead.x * ahead.x, ahead.x * ahead.z, ahead.z * ahead.z);
    return Conic(x, one, ahead, patch_before(p, normal, over * side));
}

// The disc in which a plane cuts a ball of light, as seen against it: what it covers is this side of the plane. False
// where the plane passes by.
bool conic_of_cut(vec3 normal, float over, AntumbraPatch p, out Conic cut) {
    float square = p.radius_2 - over * over;
    vec3 center = p.origin * p.reach - normal * over;
    float radius = sqrt(max(square, 0.0));
    cut = conic_of_disc(center, normal, radius, dot(center, normal) < 0.0 ? -ALL_OVER : ALL_OVER, p);
    return square > 0.0;
}

vec2 conic_rows(Conic c) {
    float p = c.x.z * c.x.z - c.x.x * c.one.z;
    float q = c.x.y * c.x.z - c.x.x * c.one.y;
    float r = c.x.y * c.x.y - c.x.x * c.one.x;
    float discriminant = q * q - p * r;
    float root = sqrt(max(discriminant, 0.0));
    float sum = -(q + (q < 0.0 ? -root : root));
    float s = sum / p;
    float t = r / sum;
    vec2 all = vec2(-ANTUMBRA_FAR_AWAY, ANTUMBRA_FAR_AWAY);
    vec2 between = vec2(min(s, t), max(s, t));
    vec2 branch = c.ahead.z * c.x.x > c.ahead.y * c.x.z ? vec2(between.y, ANTUMBRA_FAR_AWAY) : vec2(-ANTUMBRA_FAR_AWAY, between.x);
    vec2 open_rows = c.x.x > 0.0 ? branch : all;
    vec2 rows = p < 0.0 ? between : open_rows;
    return discriminant > 0.0 ? rows : p < 0.0 ? EMPTY : all;
}

vec2 conic_interval(Conic c, float y) {
    float middle = c.x.y + c.x.z * y;
    float rest = c.one.x + y * (2.0 * c.one.y + c.one.z * y);
    float discriminant = middle * middle - c.x.x * rest;
    float root = sqrt(max(discriminant, 0.0));
    float sum = -(middle + (middle < 0.0 ? -root : root));
    float p = sum / c.x.x;
    float q = rest / sum;
    float low = min(p, q);
    float high = max(p, q);
    bool ahead = c.ahead.x + c.ahead.z * y + c.ahead.y * (low + high) * 0.5 > 0.0;
    vec2 bounded = ahead ? vec2(low, high) : EMPTY;
    vec2 unbounded = c.ahead.y > 0.0 ? vec2(high, ANTUMBRA_FAR_AWAY) : vec2(-ANTUMBRA_FAR_AWAY, low);
    vec2 inside = c.x.x > 0.0 ? bounded : unbounded;
    return antumbra_interval_and(discriminant > 0.0 ? inside : EMPTY, antumbra_line_positive(c.before, y));
}

#ifdef CORNERS
struct Polygon {
    vec3 edges[CORNERS];
    vec3 before;
    vec2 rows;
};

vec3 corners_normal(vec3 corners[CORNERS]) {
    vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
    return normal * inversesqrt(max(dot(normal, normal), 1e-37));
}

Polygon polygon_of(vec3 corners[CORNERS], float over, AntumbraPatch p) {
    vec3 normal = corners_normal(corners);
    float side = dot(normal, corners[0]) < 0.0 ? -1.0 : 1.0;
    Polygon polygon;
    vec3 forward = cross(p.right, p.up);
    float volume = 1.0 / dot(p.origin, forward);
    forward *= volume;
    vec3 upward = cross(p.origin, p.right) * volume;
    vec2 rows = EMPTY;
    bool in_front = true;
    for (int i = 0; i < CORNERS; i++) {
        vec3 corner = corners[i];
        polygon.edges[i] = antumbra_patch_line(p, cross(corner, corners[(i + 1) % CORNERS]) * side);
        float weight = dot(corner, forward);
        in_front = in_front && weight > 0.0;
        float y = dot(corner, upward) / weight;
        rows = vec2(min(rows.x, y), max(rows.y, y));
    }
    polygon.before = patch_before(p, normal * side, over * side);
    polygon.rows = in_front ? rows : vec2(-ANTUMBRA_FAR_AWAY, ANTUMBRA_FAR_AWAY);
    return polygon;
}

vec2 polygon_interval(Polygon polygon, float y) {
    vec2 inside = antumbra_line_positive(polygon.before, y);
    for (int i = 0; i < CORNERS; i++) {
        inside = antumbra_interval_and(inside, antumbra_line_positive(polygon.edges[i], y));
    }
    return inside;
}
#endif

#if defined(SPHERE) || defined(UNION)
// A ball, or the part of one that is before a light.
struct Cap {
    Conic ball;
    Conic ring;   // the circle in which the ball meets the light
    int has_ring; // 1 if it does, otherwise 0
};

Cap cap_of(Conic ball) {
    return Cap(ball, ball, 0);
}

// What a ball hides of a light that it crosses, as Standing::Circle has it: `sizes` are its radius, and the circle's
// distance before its centre and radius, along the unit vector `toward`. `kept` is what of the inside is not hidden.
Cap hidden_crossing(vec3 center, vec3 sizes, vec3 toward, AntumbraPatch p, out Conic kept, out bool keeps) {
    vec3 middle = center - toward * sizes.y;
    float height = dot(toward, middle);
    float over = dot(toward, p.origin * p.reach - middle);
    bool cut = conic_of_cut(toward, over, p, kept);
    keeps = cut && height > 0.0;
    // From the light's side: what is beyond the circle's plane, within an outline about that of the light itself.
    float wide = sqrt(p.radius_2 + 0.1 * p.tangent_2);
    Conic whole = conic_of_sphere(p.origin * p.reach, wide, p);
    whole.before = patch_before(p, toward, over);
    float side = height < 0.0 ? -1.0 : 1.0;
    Conic ball = conic_of_sphere(center, sizes.x, p);
    float tangent_2 = dot(center, center) - sizes.x * sizes.x;
    ball.before = antumbra_patch_line(p, (center * height - toward * tangent_2) * side);
    Conic ring = conic_of_disc(middle, toward, sizes.z, ALL_OVER * side, p);
    bool beyond = keeps;
    return Cap(Conic(beyond ? whole.x : ball.x, beyond ? whole.one : ball.one, beyond ? whole.ahead : ball.ahead,
                        beyond ? whole.before : ball.before), ring, beyond ? 0 : 1);
}

vec2 cap_rows(Cap h) {
    vec2 rows = conic_rows(h.ball);
    for (int k = 0; k < h.has_ring; k++) {
        rows = interval_hull(rows, conic_rows(h.ring));
    }
    return rows;
}

vec2 cap_interval(Cap h, float y) {
    vec2 inside = conic_interval(h.ball, y);
    for (int k = 0; k < h.has_ring; k++) {
        inside = interval_hull(inside, conic_interval(h.ring, y));
    }
    return inside;
}
#endif

// Apex and tangent points of a cone seen from the origin; false where its base alone is its outline.
bool cone_triangle(vec3 base, vec3 axis, float radius, float height, out vec3 corners[3]) {
    float along = -dot(axis, base);
    vec3 toward = (base + axis * along) * height;
    float size = length(toward);
    float cosine = radius * (along - height) / size;
    vec3 unit = toward / size;
    float sine = sqrt(max(1.0 - cosine * cosine, 0.0));
    vec3 middle = base + unit * (radius * cosine);
    vec3 side = cross(axis, unit) * (radius * sine);
    corners[0] = base + axis * height;
    corners[1] = middle + side;
    corners[2] = middle - side;
    return abs(cosine) < 1.0;
}

#if defined(CONE)
struct Hidden {
    Conic base;
    Polygon triangle;
    bool has_base;
    bool has_triangle;
};

vec2 hidden_rows(Hidden h) {
    return interval_hull(h.has_base ? conic_rows(h.base) : EMPTY, h.has_triangle ? h.triangle.rows : EMPTY);
}

vec2 hidden_interval(Hidden h, float y) {
    return interval_hull(h.has_base ? conic_interval(h.base, y) : EMPTY,
                         h.has_triangle ? polygon_interval(h.triangle, y) : EMPTY);
}
#elif defined(CORNERS)
#define Hidden Polygon

vec2 hidden_rows(Hidden h) {
    return h.rows;
}

vec2 hidden_interval(Hidden h, float y) {
    return polygon_interval(h, y);
}
#elif defined(PLANE)
#define Hidden vec3

vec2 hidden_rows(Hidden h) {
    return vec2(-ANTUMBRA_FAR_AWAY, ANTUMBRA_FAR_AWAY);
}

vec2 hidden_interval(Hidden h, float y) {
    return antumbra_line_positive(h, y);
}
#elif defined(SPHERE)
#define Hidden Cap

vec2 hidden_rows(Hidden h) {
    return cap_rows(h);
}

vec2 hidden_interval(Hidden h, float y) {
    return cap_interval(h, y);
}
#else
#define Hidden Conic

vec2 hidden_rows(Hidden h) {
    return conic_rows(h);
}

vec2 hidden_interval(Hidden h, float y) {
    return conic_interval(h, y);
}
#endif

// The width of what is hidden of the light on a strip: concave, negative where the two pass by each other.
float hidden_width(Hidden h, AntumbraStrips strips, float y) {
    vec2 hidden = antumbra_interval_and(hidden_interval(h, y), antumbra_strips_seen(strips, y));
    return hidden.y - hidden.x;
}

// Where the chord from a strip inside (x, its width y) to one outside (z, w) is zero, and from there once more.
float crossing(Hidden h, AntumbraStrips strips, vec4 ends) {
    float first = ends.x + (ends.z - ends.x) * (ends.y / (ends.y - ends.w));
    float width = hidden_width(h, strips, first);
    float second = first + (ends.z - first) * (width / (width - ends.w));
    return width > 0.0 ? second : first;
}

// The strips on which anything is hidden.
vec2 nodes_support(Hidden h, AntumbraStrips strips) {
    vec2 rows = antumbra_interval_and(hidden_rows(h), antumbra_strips_rows(strips));
    float half_rows = max((rows.y - rows.x) * 0.5, 0.0);
    float middle = (rows.x + rows.y) * 0.5;
    bool found = false;
    vec2 last = vec2(rows.y, 0.0);
    vec4 above = vec4(0.0);  // a strip inside and its width, the next one outside, and its
    vec4 below = vec4(0.0);
    for (int i = 0; i < ANTUMBRA_NODE_COUNT(strips.square); i++) {
        vec2 node = antumbra_nodes_of(strips.round, i);
        float y = middle + half_rows * node.x;
        float width = hidden_width(h, strips, y);
        bool inside = width > 0.0;
        bool begins = inside && !found;
        bool ends = !inside && last.y > 0.0;
        above = begins ? vec4(y, width, last) : above;
        below = ends ? vec4(last, y, width) : below;
        found = found || inside;
        last = vec2(y, width);
    }
    float high = above.w < 0.0 ? crossing(h, strips, above) : rows.y;
    float low = below.w < 0.0 ? crossing(h, strips, below) : rows.x;
    return found && rows.x < rows.y ? vec2(low, high) : EMPTY;
}

// The irradiance that is hidden, in the units of strips_irradiance. `cuts` is 1 where what is inside of `kept` is not hidden,
// otherwise 0: a loop, because both sides of a branch cost.
float hidden_taken(Hidden h, AntumbraStrips strips, Conic kept, int cuts) {
    vec2 rows = nodes_support(h, strips);
    float half_rows = max((rows.y - rows.x) * 0.5, 0.0);
    float middle = (rows.x + rows.y) * 0.5;
    float sum = 0.0;
    for (int i = 0; i < ANTUMBRA_NODE_COUNT(strips.square); i++) {
        vec2 node = antumbra_nodes_of(strips.round, i);
        float y = middle + half_rows * node.x;
        vec2 hidden = antumbra_interval_and(hidden_interval(h, y), antumbra_strips_seen(strips, y));
        sum += node.y * antumbra_strips_irradiance(strips, y, hidden);
        for (int k = 0; k < cuts; k++) {
            vec2 seen = antumbra_interval_and(hidden, conic_interval(kept, y));
            sum -= node.y * antumbra_strips_irradiance(strips, y, seen);
        }
    }
    return half_rows > 0.0 ? sum * half_rows : 0.0;
}
