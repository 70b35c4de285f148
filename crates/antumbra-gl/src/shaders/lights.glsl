// What arrives from a light without occluders. Twin: ShaderLight::irradiance.
//
// ANTUMBRA_BALL_LIGHTS: some lights are balls. ANTUMBRA_FLAT_LIGHTS: some are discs or rectangles. ANTUMBRA_FALLOFF: some
// have a range, a least divisor or an exponent. Needs area.glsl.

#ifdef ANTUMBRA_FLAT_LIGHTS
#define ANTUMBRA_BALL_LIGHTS
#endif

struct AntumbraLight {
    vec4 place;        // position, 1   or  direction towards the light, 0
    vec4 color;        // times intensity; w the radius of a ball or disc
    vec4 cone;         // axis of the spot's cone, scale of the angular attenuation; of a flat light where it shines, 0
    vec4 attenuation;  // constant, linear, quadratic; offset of the angular attenuation
    vec4 reach;        // least divisor, exponent or 0, 1 / range or 0, 1 if the window is squared
    vec4 right;        // half side of a rectangle; w 1 for a disc, 2 for a rectangle
    vec4 up;           // the other
};

// How the light weakens with the distance.
float antumbra_falloff(vec4 attenuation, vec4 reach, float distance, float square) {
    float divisor = attenuation.x + attenuation.y * distance + attenuation.z * square;
#ifdef ANTUMBRA_FALLOFF
    divisor += reach.y > 0.0 ? pow(distance, reach.y) : 0.0;
    float share = square * (reach.z * reach.z);
    float window = clamp(1.0 - share * share, 0.0, 1.0);
    return (reach.w > 0.5 ? window * window : window) / max(divisor, max(reach.x, 1e-30));
#else
    return 1.0 / divisor;
#endif
}

#ifdef ANTUMBRA_BALL_LIGHTS
// The cosine at the receiver, averaged over a ball as its irradiance is; of a point for a radius of 0. From inside a ball its
// glow fills the half of all directions around its centre.
float antumbra_ball_cosine(float radius, float square, float cosine) {
    float sine = radius * inversesqrt(square);
    float ball = antumbra_cap_irradiance(min(sine, 1.0), cosine) / max(sine * sine, 1e-30);
    return radius > 0.0 ? ball : max(cosine, 0.0);
}
#endif

#ifdef ANTUMBRA_FLAT_LIGHTS
// The same over a disc or rectangle.
float antumbra_flat_cosine(AntumbraLight light, vec3 position, vec3 normal) {
    vec3 direction = light.cone.xyz;
    bool round = light.right.w < 1.5;
    vec3 across = antumbra_level_axis(direction, normal) * light.color.w;
    AntumbraPatch p = antumbra_patch_of_flat(light.place.xyz, direction, round ? across : light.right.xyz,
                                          round ? cross(direction, across) : light.up.xyz, round, position);
    float whole = antumbra_strips_whole(antumbra_strips_of(p, normal)) * -dot(direction, p.origin);
    return p.faces ? whole / (round ? 3.141592653589793 : 4.0) : 0.0;
}
#endif

// Irradiance, linear RGB, on a surface with a unit normal; 0 where it faces away. All in one space.
vec3 antumbra_irradiance(AntumbraLight light, vec3 position, vec3 normal) {
    vec3 to_light = light.place.xyz - position * light.place.w;
    float square = max(dot(to_light, to_light), 1e-30);
    float distance = sqrt(square);
    vec3 direction = to_light / distance;
    float cosine = dot(normal, direction);
#ifdef ANTUMBRA_BALL_LIGHTS
    float ball = antumbra_ball_cosine(light.color.w, square, cosine);
#ifdef ANTUMBRA_FLAT_LIGHTS
    float flat_light = antumbra_flat_cosine(light, position, normal);
    cosine = light.right.w > 0.5 ? flat_light : ball;
#else
    cosine = ball;
#endif
#else
    cosine = max(cosine, 0.0);
#endif
    // The cone's scale and offset are 0 and 1 for lights without a cone.
    float angular = clamp(dot(-direction, light.cone.xyz) * light.cone.w + light.attenuation.w, 0.0, 1.0);
    float falloff = antumbra_falloff(light.attenuation, light.reach, distance, square);
    falloff = light.place.w > 0.5 ? falloff : 1.0;
    return light.color.rgb * (cosine * angular * angular * falloff);
}
