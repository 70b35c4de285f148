// A flat convex polygon between a point and a light: half-spaces. Twin:
// antumbra_math::blocking::polygon_coverage.

struct PolygonBlocker {
    vec4 base;  // the polygon's plane, positive behind it
    vec4 edges[4];
};

// The two edges that cut off most of the pixel; the others hardly touch it.
void nearest_edges(inout vec3 first, inout vec3 second, vec3 edge) {
    vec3 later = edge.x < first.x ? first : edge;
    first = edge.x < first.x ? edge : first;
    second = later.x < second.x ? later : second;
}

float polygon_coverage(PolygonBlocker b, Footprint footprint, float tolerance) {
    vec3 first = vec3(1.0, 0.0, 0.0);
    vec3 second = first;
    nearest_edges(first, second,
                  edge_of(dot(b.base.xyz, footprint.point) + b.base.w - tolerance, b.base.xyz, footprint));
    for (int i = 0; i < 4; i++) {
        vec4 plane = b.edges[i];
        nearest_edges(first, second,
                      edge_of(dot(plane.xyz, footprint.point) + plane.w, plane.xyz, footprint));
    }
    return corner_coverage(first, second);
}

float blocker_coverage(Footprint footprint, SurfacePoint surface) {
    // Constant indices: Mesa's llvmpipe 22.3 reads zeros where a loop counts through a flat input.
    PolygonBlocker b = PolygonBlocker(
        BLOCKER_DATA[0], vec4[4](BLOCKER_DATA[1], BLOCKER_DATA[2], BLOCKER_DATA[3], BLOCKER_DATA[4]));
    return polygon_coverage(b, footprint, surface.tolerance);
}
