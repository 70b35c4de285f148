// A flat convex polygon between a point and a light: half-spaces. Twin:
// antumbra_math::blocking::polygon_coverage.

struct PolygonBlocker {
    vec4 base;  // the polygon's plane, positive behind it
    vec4 edges[4];
};

float polygon_coverage(PolygonBlocker b, Footprint footprint, float tolerance) {
    float coverage = edge_coverage(dot(b.base.xyz, footprint.point) + b.base.w - tolerance, b.base.xyz, footprint);
    for (int i = 0; i < 4; i++) {
        vec4 plane = b.edges[i];
        coverage = min(coverage, edge_coverage(dot(plane.xyz, footprint.point) + plane.w, plane.xyz, footprint));
    }
    return coverage;
}

float blocker_coverage(Footprint footprint, SurfacePoint surface) {
    // Constant indices: Mesa's llvmpipe 22.3 reads zeros where a loop counts through a flat input.
    PolygonBlocker b = PolygonBlocker(
        BLOCKER_DATA[0], vec4[4](BLOCKER_DATA[1], BLOCKER_DATA[2], BLOCKER_DATA[3], BLOCKER_DATA[4]));
    return polygon_coverage(b, footprint, surface.tolerance);
}
