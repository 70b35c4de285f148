// A flat disc between a point and a light. Twin: antumbra_math::blocking::disc_coverage.

struct DiscBlocker {
    vec3 center;
    float radius;
    vec3 normal;     // on the light's side
    float nearness;  // one over the light's height above the disc's plane
    vec3 toward;     // towards the light, toward . normal = 1
};

// `tolerance`: points nearer to the disc's plane than this lie on the disc.
float disc_coverage(DiscBlocker b, Footprint footprint, float tolerance) {
    vec3 from_center = footprint.point - b.center;
    float height = dot(b.normal, from_center);
    vec3 behind = edge_of(-height - tolerance, -b.normal, footprint);
    if (!(behind.x > 0.0)) {
        return 0.0;
    }
    height = min(height, 0.0);
    float scale = 1.0 / (1.0 - b.nearness * height);
    vec3 hit = (from_center - b.toward * height) * scale;
    float miss = length(hit);
    vec3 outward = hit * (1.0 / max(miss, 1e-30));
    float slant = dot(outward, b.toward - hit * b.nearness);
    vec3 gradient = (b.normal * slant - outward) * scale;
    return corner_coverage(behind, edge_of(b.radius - miss, gradient, footprint));
}

float blocker_coverage(Footprint footprint, SurfacePoint surface) {
    DiscBlocker b = DiscBlocker(BLOCKER_DATA[0].xyz, BLOCKER_DATA[0].w, BLOCKER_DATA[1].xyz, BLOCKER_DATA[1].w,
                                BLOCKER_DATA[2].xyz);
    return disc_coverage(b, footprint, surface.tolerance);
}
