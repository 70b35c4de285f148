// How much of a pixel of the receiver lies in a part of a shadow. Twin:
// antumbra_math::composite::part_coverage.

// `power`: radius squared less the centre's distance from the eye squared. With it the distance inwards
// is known to the rounding of the point, not of a radius that may be a million times as large.
float disc_part_coverage(vec3 center, float radius, float power, Footprint footprint) {
    vec3 outward = footprint.point - center;
    float distance = length(outward);
    float inside = (power + dot(footprint.point, center * 2.0 - footprint.point)) / (radius + distance);
    vec3 gradient = outward * (-1.0 / max(distance, 1e-30));
    return edge_of(inside, gradient, footprint).x;
}

float plane_distance(vec4 plane, vec3 point) {
    return dot(plane.xyz, point) + plane.w;
}

vec3 part_edge(vec4 plane, Footprint footprint) {
    return edge_of(plane_distance(plane, footprint.point), plane.xyz, footprint);
}

// Inside the two edges that cut off most of the pixel.
float triangle_part_coverage(vec4 first, vec4 second, vec4 third, Footprint footprint) {
    vec3 a = part_edge(first, footprint);
    vec3 b = part_edge(second, footprint);
    vec3 c = part_edge(third, footprint);
    vec3 low = a.x < b.x ? a : b;
    vec3 high = a.x < b.x ? b : a;
    return corner_coverage(low, c.x < high.x ? c : high);
}

// Four texels: three edges and (shade, 0), or centre and radius, (power, ..), unused and (shade, 1).
float part_coverage(vec4 a, vec4 b, vec4 c, vec4 kind, Footprint footprint) {
    return kind.y > 0.5 ? disc_part_coverage(a.xyz, a.w, b.x, footprint)
                        : triangle_part_coverage(a, b, c, footprint);
}
