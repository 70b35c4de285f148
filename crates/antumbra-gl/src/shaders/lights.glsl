// What arrives from a light without occluders. Twin: antumbra_gl::irradiance.

#define BATCH_LIGHTS 8

// view space; four vectors a light:
//   0: position, 1   or  direction towards the light, 0
//   1: color * intensity, unused
//   2: axis of the spot's cone, scale of the angular attenuation
//   3: attenuation constant, linear, quadratic; offset of the angular attenuation
uniform vec4 u_lights[BATCH_LIGHTS * 4];
uniform int u_light_count;

vec3 irradiance(vec4 place, vec3 color, vec4 cone, vec4 attenuation, vec3 position, vec3 normal) {
    vec3 to_light = place.xyz - position * place.w;
    float square = max(dot(to_light, to_light), 1e-30);
    float distance = sqrt(square);
    vec3 direction = to_light / distance;
    float cosine = max(dot(normal, direction), 0.0);
    // The cone's scale and offset are 0 and 1 for lights without a cone.
    float angular = clamp(dot(-direction, cone.xyz) * cone.w + attenuation.w, 0.0, 1.0);
    float falloff = place.w > 0.5 ? 1.0 / (attenuation.x + attenuation.y * distance + attenuation.z * square) : 1.0;
    return color * (cosine * angular * angular * falloff);
}
