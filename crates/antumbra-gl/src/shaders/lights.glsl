// What arrives from a light without occluders. Twin: antumbra_gl::irradiance.
//
// BALL_LIGHTS: some lights are balls. FLAT_LIGHTS: some are discs or rectangles. Needs area.glsl.

#ifdef FLAT_LIGHTS
#define BALL_LIGHTS
#endif

//   place: position, 1   or  direction towards the light, 0
//   color: times intensity; w the radius of a ball or disc
//   cone: axis of the spot's cone, scale of the angular attenuation; of a flat light where it shines, 0
//   attenuation: constant, linear, quadratic; offset of the angular attenuation
//   right, up: half sides of a rectangle; w of right: 1 for a disc, 2 for a rectangle

#ifdef BALL_LIGHTS
// The cosine at the receiver, averaged over a ball as its irradiance is; of a point for a radius of 0.
float ball_cosine(float radius, float square, float cosine) {
    float sine = radius * inversesqrt(square);
    float ball = cap_irradiance(min(sine, 1.0), cosine) / max(sine * sine, 1e-30);
    return radius > 0.0 && sine < 1.0 ? ball : max(cosine, 0.0);
}
#endif

#ifdef FLAT_LIGHTS
// The same over a disc or rectangle.
float flat_cosine(vec3 center, float radius, vec3 direction, vec4 right, vec3 up, vec3 position, vec3 normal) {
    bool round = right.w < 1.5;
    vec3 across = level_axis(direction, normal) * radius;
    LightPatch p = flat_patch(center, direction, round ? across : right.xyz, round ? cross(direction, across) : up,
                              round, position);
    float whole = strips_whole(strips_of(p, normal)) * -dot(direction, p.origin);
    return p.faces ? whole / (round ? 3.141592653589793 : 4.0) : 0.0;
}
#endif

vec3 irradiance(vec4 place, vec4 color, vec4 cone, vec4 attenuation,
#ifdef FLAT_LIGHTS
                vec4 right, vec4 up,
#endif
                vec3 position, vec3 normal) {
    vec3 to_light = place.xyz - position * place.w;
    float square = max(dot(to_light, to_light), 1e-30);
    float distance = sqrt(square);
    vec3 direction = to_light / distance;
    float cosine = dot(normal, direction);
#ifdef BALL_LIGHTS
    float ball = ball_cosine(color.w, square, cosine);
#ifdef FLAT_LIGHTS
    float flat_light = flat_cosine(place.xyz, color.w, cone.xyz, right, up.xyz, position, normal);
    cosine = right.w > 0.5 ? flat_light : ball;
#else
    cosine = ball;
#endif
#else
    cosine = max(cosine, 0.0);
#endif
    // The cone's scale and offset are 0 and 1 for lights without a cone.
    float angular = clamp(dot(-direction, cone.xyz) * cone.w + attenuation.w, 0.0, 1.0);
    float falloff = place.w > 0.5 ? 1.0 / (attenuation.x + attenuation.y * distance + attenuation.z * square) : 1.0;
    return color.rgb * (cosine * angular * angular * falloff);
}
