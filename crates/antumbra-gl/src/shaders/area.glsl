// Lights with an area, as a point sees them: a flat patch, lined with strips. Twins: antumbra_math::soft.

#define ANTUMBRA_NODES 8
// The same number, given one that is not below 0, in a form that compilers do not unroll loops for: eight copies of a body
// take drivers seconds.
#define ANTUMBRA_NODE_COUNT(positive) (ANTUMBRA_NODES + min(int(min(positive, 1.0)), 0))
#define ANTUMBRA_FAR_AWAY 1e30

// Gauss's nodes and weights: for integrands that end like square roots, as round lights do, and for any.
const vec2 ANTUMBRA_CHEBYSHEV[ANTUMBRA_NODES] = vec2[ANTUMBRA_NODES](
    vec2(0.939692620786, 0.119387552184), vec2(0.766044443119, 0.224375203601),
    vec2(0.500000000000, 0.302299894039), vec2(0.173648177667, 0.343762755785),
    vec2(-0.173648177667, 0.343762755785), vec2(-0.500000000000, 0.302299894039),
    vec2(-0.766044443119, 0.224375203601), vec2(-0.939692620786, 0.119387552184));

const vec2 ANTUMBRA_LEGENDRE[ANTUMBRA_NODES] = vec2[ANTUMBRA_NODES](
    vec2(0.960289856498, 0.101228536290), vec2(0.796666477414, 0.222381034453),
    vec2(0.525532409916, 0.313706645878), vec2(0.183434642496, 0.362683783378),
    vec2(-0.183434642496, 0.362683783378), vec2(-0.525532409916, 0.313706645878),
    vec2(-0.796666477414, 0.222381034453), vec2(-0.960289856498, 0.101228536290));

vec2 antumbra_nodes_of(bool round, int i) {
    return round ? ANTUMBRA_CHEBYSHEV[i] : ANTUMBRA_LEGENDRE[i];
}

// Directions origin + x right + y up, over the unit disc or the square |x|, |y| < 1.
struct AntumbraPatch {
    vec3 origin;  // unit
    vec3 right;
    vec3 up;
    bool round;
    float reach;  // distance of the light's centre
    float tangent_2;  // square of the tangents' length to a ball, of the distance to a flat light's centre
    float radius_2;   // square of a ball's radius; 0 of a flat light
    bool faces;   // whether it sends anything to the point
};

vec3 antumbra_level_axis(vec3 axis, vec3 normal) {
    vec3 across = cross(normal, axis);
    vec3 other = cross(axis, abs(axis.x) < 0.6 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0));
    return normalize(dot(across, across) > 1e-12 ? across : other);
}

AntumbraPatch antumbra_patch_of_sphere(vec3 center, float radius, vec3 point, vec3 normal) {
    vec3 to_light = center - point;
    float square = dot(to_light, to_light);
    float outside = square - radius * radius;
    float reach = sqrt(square);
    vec3 origin = to_light / reach;
    float tangent = radius * inversesqrt(max(outside, 1e-30));
    vec3 right = antumbra_level_axis(origin, normal);
    return AntumbraPatch(origin, right * tangent, cross(origin, right) * tangent, true, reach, outside, radius * radius,
                         outside > 0.0);
}

AntumbraPatch antumbra_patch_of_flat(vec3 center, vec3 direction, vec3 half_right, vec3 half_up, bool round, vec3 point) {
    vec3 to_light = center - point;
    float reach = length(to_light);
    float scale = 1.0 / reach;
    return AntumbraPatch(to_light * scale, half_right * scale, half_up * scale, round, reach, reach * reach, 0.0,
                         dot(to_light, direction) < 0.0);
}

AntumbraPatch antumbra_patch_of_disc(vec3 center, vec3 direction, float radius, vec3 point, vec3 normal) {
    vec3 right = antumbra_level_axis(direction, normal);
    return antumbra_patch_of_flat(center, direction, right * radius, cross(direction, right) * radius, true, point);
}

// The function one + x x + y y on a patch, as (one, x, y).
vec3 antumbra_patch_line(AntumbraPatch p, vec3 weight) {
    return vec3(dot(weight, p.origin), dot(weight, p.right), dot(weight, p.up));
}

// The x of the strip at y where a line is positive, as (low, high).
vec2 antumbra_line_positive(vec3 line, float y) {
    bool rising = line.y > 0.0;
    float slope = rising ? max(line.y, 1e-30) : min(line.y, -1e-30);
    float zero = -((line.x + line.z * y) / slope);
    return rising ? vec2(zero, ANTUMBRA_FAR_AWAY) : vec2(-ANTUMBRA_FAR_AWAY, zero);
}

vec2 antumbra_interval_and(vec2 a, vec2 b) {
    return vec2(max(a.x, b.x), min(a.y, b.y));
}

struct AntumbraStrips {
    vec3 level;    // the line of the cosine at the receiver
    float square;
    float shift;
    vec3 apart;    // squared distance from the point, in units of x: 1, 2 y, y squared
    bool round;
};

AntumbraStrips antumbra_strips_of(AntumbraPatch p, vec3 normal) {
    float square = dot(p.right, p.right);
    vec3 k0 = cross(p.origin, p.right);
    vec3 k1 = cross(p.up, p.right);
    float scale = 1.0 / square;
    vec3 apart = vec3(dot(k0, k0), dot(k0, k1), dot(k1, k1)) * scale * scale;
    return AntumbraStrips(antumbra_patch_line(p, normal), square, dot(p.origin, p.right) * scale, apart, p.round);
}

vec2 antumbra_strips_rows(AntumbraStrips s) {
    return antumbra_interval_and(antumbra_line_positive(vec3(s.level.x + abs(s.level.y), s.level.z, 0.0), 0.0), vec2(-1.0, 1.0));
}

vec2 antumbra_strips_seen(AntumbraStrips s, float y) {
    float width = s.round ? sqrt(max(1.0 - y * y, 0.0)) : 1.0;
    return antumbra_interval_and(antumbra_line_positive(s.level, y), vec2(-width, width));
}

// The angle of (x, y), y not negative: what is needed of atan(y, x), which drivers are slow with.
float antumbra_upper_angle(float y, float x) {
    return atan(y, x);
}

float antumbra_strips_irradiance(AntumbraStrips s, float y, vec2 interval) {
    float apart_2 = max(s.apart.x + y * (2.0 * s.apart.y + s.apart.z * y), 1e-30);
    float apart = sqrt(apart_2);
    float level = s.level.x + s.level.z * y - s.level.y * s.shift;
    vec2 ends = interval + s.shift;
    float width = max(ends.y - ends.x, 0.0);
    float product = ends.x * ends.y;
    float turn = antumbra_upper_angle(width * apart, apart_2 + product) / apart;
    vec2 squares = ends * ends + apart_2;
    float both = 1.0 / (squares.x * squares.y);
    float even = (width * (apart_2 - product) * both + turn) / (2.0 * apart_2);
    float odd = width * (ends.x + ends.y) * 0.5 * both;
    return width > 0.0 ? (level * even + s.level.y * odd) / (s.square * s.square) : 0.0;
}

// The irradiance of the whole patch, in the units of strips_irradiance.
float antumbra_strips_whole(AntumbraStrips s) {
    vec2 rows = antumbra_strips_rows(s);
    float half_rows = max((rows.y - rows.x) * 0.5, 0.0);
    float middle = (rows.x + rows.y) * 0.5;
    float sum = 0.0;
    for (int i = 0; i < ANTUMBRA_NODE_COUNT(s.square); i++) {
        vec2 node = antumbra_nodes_of(s.round, i);
        float y = middle + half_rows * node.x;
        sum += node.y * antumbra_strips_irradiance(s, y, antumbra_strips_seen(s, y));
    }
    return sum * half_rows;
}

// The cosine-weighted solid angle of a ball's cap over pi: its irradiance for a radiance of 1 / pi. `sine` is that of
// the cap's half-angle, `cosine` that of the angle between its axis and the receiver's normal.
// S. Lagarde, C. de Rousiers: Moving Frostbite to PBR, 2014, after J. Snyder.
float antumbra_cap_irradiance(float sine, float cosine) {
    float sine_2 = sine * sine;
    float x = sqrt(max(1.0 / max(sine_2, 1e-30) - 1.0, 0.0));
    float across = sqrt(max(1.0 - cosine * cosine, 1e-12));
    float y = clamp(-x * cosine / across, -1.0, 1.0);
    float z = across * sqrt(1.0 - y * y);
    float cut = ((cosine * acos(y) - x * z) * sine_2 + atan(z, max(x, 1e-30))) * 0.3183098861837907;
    return cosine > sine ? cosine * sine_2 : cosine < -sine ? 0.0 : max(cut, 0.0);
}
