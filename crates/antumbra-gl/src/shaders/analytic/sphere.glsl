// A ball between a point and a light. Twin: antumbra_math::blocking::sphere_coverage.

struct SphereBlocker {
    vec3 center;
    float radius;
    vec3 light;     // position, or direction towards the light
    float light_w;  // 1 for a position, 0 for a direction
};

// `solid`: points inside the ball are dark. Without object ids a visible point inside the ball, or
// nearer to it than `tolerance`, is taken for the host's mesh of this very ball, which does not
// shadow itself.
float sphere_coverage(SphereBlocker b, Footprint footprint, bool solid, float tolerance) {
    vec3 to_center = b.center - footprint.point;
    float reach = b.radius + tolerance;
    if (dot(to_center, to_center) < reach * reach) {
        return solid ? 1.0 : 0.0;
    }
    vec3 to_light = b.light - footprint.point * b.light_w;
    float inverse_distance = inversesqrt(dot(to_light, to_light));
    vec3 direction = to_light * inverse_distance;
    float along = dot(to_center, direction);
    float share = b.light_w * along * inverse_distance;  // of the way to the light
    if (!(along > 0.0 && share < 1.0)) {
        return 0.0;
    }
    // The distance of the line from the centre as a vector product: the discriminant cancels.
    float miss = length(cross(direction, to_center));
    vec3 nearest = to_center - direction * along;
    vec3 gradient = nearest * ((1.0 - share) / max(miss, 1e-30));
    return edge_of(b.radius - miss, gradient, footprint).x;
}

float blocker_coverage(Footprint footprint, SurfacePoint surface) {
    SphereBlocker b = SphereBlocker(BLOCKER_DATA[0].xyz, BLOCKER_DATA[0].w, BLOCKER_DATA[1].xyz, BLOCKER_DATA[1].w);
    return sphere_coverage(b, footprint, surface.has_id, surface.has_id ? 0.0 : surface.tolerance);
}
