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
Footprint screen_footprint(vec3 point, vec3 normal, vec3 pixel_step) {
    vec3 sight = pixel_step.z > 0.5 ? point : vec3(0.0, 0.0, -1.0);
    vec2 size = pixel_step.xy * (pixel_step.z > 0.5 ? -point.z : 1.0);
    // A surface seen edge-on has no finite footprint: limit the slope.
    float limit = length(sight) * 1e-3;
    float facing = dot(sight, normal);
    facing = facing < 0.0 ? min(facing, -limit) : max(facing, limit);
    vec3 slope = sight / facing;
    return Footprint(point, vec3(size.x, 0.0, 0.0) - slope * (normal.x * size.x),
                     vec3(0.0, size.y, 0.0) - slope * (normal.y * size.y));
}

// The area of the unit pixel in which value + u slope_x + v slope_y > 0.
float half_plane_coverage(float value, float slope_x, float slope_y) {
    float major = max(abs(slope_x), abs(slope_y));
    float minor = min(abs(slope_x), abs(slope_y));
    float reach = (major + minor) * 0.5;
    float distance = abs(value);
    float small;
    if (distance >= reach) {
        small = 0.0;
    } else if (distance >= (major - minor) * 0.5) {
        float rest = reach - distance;
        small = rest * rest / (2.0 * major * minor);
    } else {
        small = 0.5 - distance / major;
    }
    return value > 0.0 ? 1.0 - small : small;
}

float edge_coverage(float value, vec3 gradient, Footprint footprint) {
    return half_plane_coverage(value, dot(gradient, footprint.dx), dot(gradient, footprint.dy));
}
