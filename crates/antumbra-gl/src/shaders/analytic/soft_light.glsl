// What the programs of area lights share beside what hides: the pixel's width, the whole light, and whether the point is
// inside of what hides. LIGHT_TEXELS is 1 for balls, 4 for anything flat.

// Half the width, in pixels, that a penumbra has at least.
#define HALF_WIDTH 0.75

// Edges of penumbrae that are narrower than a pixel would be jagged: the light is taken for wide enough. `apart` is the
// occluder's distance: a pixel's patch of the receiver sees its edge move on the light by `shift`.
AntumbraPatch antialiased(AntumbraPatch p, Footprint f, float apart) {
    vec3 a = cross(p.origin, f.dx);
    vec3 b = cross(p.origin, f.dy);
    float pixel = sqrt(0.5 * (dot(a, a) + dot(b, b))) * HALF_WIDTH;
    float shift = pixel * max(1.0 / max(apart, 1e-6 * p.reach) - 1.0 / p.reach, 0.0);
    float square = max(dot(p.right, p.right), 1e-30);
    float widen = max(1.0, shift * inversesqrt(square));
    p.right *= widen;
    p.up *= widen;
    return p;
}

// The irradiance of the whole light, in the units of strips_irradiance.
float light_whole(AntumbraPatch p, AntumbraStrips strips, vec3 normal) {
#if LIGHT_TEXELS == 1
    float tangent_2 = dot(p.right, p.right);
    return antumbra_cap_irradiance(sqrt(tangent_2 / (1.0 + tangent_2)), dot(normal, p.origin)) * 3.141592653589793 / tangent_2;
#else
    return antumbra_strips_whole(strips);
#endif
}

// Whether a ball holds the point, which sees its middle at `center`. Without ids a point on the ball counts as inside.
bool ball_holds(vec3 center, float radius, SurfacePoint s) {
    float reach = radius + (s.has_id ? 0.0 : s.tolerance);
    return dot(center, center) < reach * reach;
}

// The same of a cone, seen with the middle of its base at `center`; the unit vector `axis` leads to its tip.
bool cone_holds(vec3 center, vec3 axis, float radius, float height, SurfacePoint s) {
    float up = -dot(center, axis);
    float width = radius * (1.0 - up / height);
    // How far inside of the cone's side, in metres.
    float side = (width - length(center + axis * up)) * height * inversesqrt(height * height + radius * radius);
    return min(min(up, side), height - up) > (s.has_id ? 0.0 : -s.tolerance);
}
