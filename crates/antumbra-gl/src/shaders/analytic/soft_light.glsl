// What the programs of area lights share beside what hides: the pixel's width, and the whole light. LIGHT_TEXELS is 1 for
// balls, 4 for anything flat.

// Half the width, in pixels, that a penumbra has at least.
#define HALF_WIDTH 0.75

// Edges of penumbrae that are narrower than a pixel would be jagged: the light is taken for wide enough. `apart` is the
// occluder's distance: a pixel's patch of the receiver sees its edge move on the light by `shift`.
LightPatch antialiased(LightPatch p, Footprint f, float apart) {
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
float light_whole(LightPatch p, Strips strips, vec3 normal) {
#if LIGHT_TEXELS == 1
    float tangent_2 = dot(p.right, p.right);
    return cap_irradiance(sqrt(tangent_2 / (1.0 + tangent_2)), dot(normal, p.origin)) * 3.141592653589793 / tangent_2;
#else
    return strips_whole(strips);
#endif
}
