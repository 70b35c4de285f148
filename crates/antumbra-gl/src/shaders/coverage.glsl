// How much of a pixel lies on one side of an edge. Twins: antumbra_math::blocking.

// A pixel's patch of the receiver: the point seen through its centre, and how it moves on the
// tangent plane from one pixel to the next. View space.
struct Footprint {
    vec3 point;
    vec3 dx;
    vec3 dy;
};

// `pixel_step`: xy the size of a pixel at distance one (perspective) or in metres (orthographic),
// z 1 for perspective and 0 for orthographic.
// Length and sign of the normal do not matter, except for the limit.
Footprint screen_footprint(vec3 point, vec3 normal, vec3 pixel_step) {
    bool perspective = pixel_step.z > 0.5;
    vec3 sight = perspective ? point : vec3(0.0, 0.0, -1.0);
    float distance = perspective ? -point.z : 1.0;
    vec2 size = pixel_step.xy * distance;
    // A surface seen edge-on has no finite footprint: limit the slope.
    float limit = max(distance * 1e-3, 1e-30);
    float facing = dot(sight, normal);
    facing = facing < 0.0 ? min(facing, -limit) : max(facing, limit);
    vec3 slope = sight * (1.0 / facing);
    return Footprint(point, vec3(size.x, 0.0, 0.0) - slope * (normal.x * size.x),
                     vec3(0.0, size.y, 0.0) - slope * (normal.y * size.y));
}

// The area of the unit pixel in which value + u slope_x + v slope_y > 0.
float half_plane_coverage(float value, float slope_x, float slope_y) {
    float major = max(abs(slope_x), abs(slope_y));
    float minor = min(abs(slope_x), abs(slope_y));
    float reach = (major + minor) * 0.5;
    float distance = abs(value);
    float rest = max(reach - distance, 0.0);
    bool corner = distance >= (major - minor) * 0.5;
    float above = corner ? rest * rest : major * 0.5 - distance;
    // The product of two small slopes may underflow.
    float below = corner ? max(2.0 * major * minor, 1e-37) : major;
    float small = rest > 0.0 ? above / below : 0.0;
    return value > 0.0 ? 1.0 - small : small;
}

// An edge across a pixel: x the area on its inner side, yz the change of the distance inwards for
// one pixel to the right and one up.
vec3 edge_of(float value, vec3 gradient, Footprint footprint) {
    vec2 slope = vec2(dot(gradient, footprint.dx), dot(gradient, footprint.dy));
    return vec3(half_plane_coverage(value, slope.x, slope.y), slope);
}

// The area inside both of two edges: the smaller one if they face the same way, the sum less one
// if they face each other, the product at right angles, and by the cosine between those.
float corner_coverage(vec3 a, vec3 b) {
    float lengths = dot(a.yz, a.yz) * dot(b.yz, b.yz);
    float cosine = dot(a.yz, b.yz) / sqrt(max(lengths, 1e-37));
    float extreme = cosine > 0.0 ? min(a.x, b.x) : max(a.x + b.x - 1.0, 0.0);
    return mix(a.x * b.x, extreme, min(abs(cosine), 1.0));
}
