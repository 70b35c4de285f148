// What every fragment does: find its line of sight, light its point without shadows, write it.
uniform vec4 u_window;       // xy: scale, zw: offset from window position to the ray's x and y at z = -1
uniform vec3 u_albedo;       // over pi
uniform vec3 u_ambient;      // irradiance
uniform highp uint u_id;
uniform int u_light_count;

layout(std140) uniform Lights {
    vec4 lights[MAX_LIGHTS * 7];
};

layout(location = 0) out vec4 o_color;
layout(location = 1) out vec4 o_normal;
layout(location = 2) out highp uint o_id;

// The point at distance 1 along the view that this sample sees, view space.
vec3 line_of_sight() {
#ifdef MULTISAMPLE
    vec2 window = floor(gl_FragCoord.xy) + gl_SamplePosition;
#else
    vec2 window = gl_FragCoord.xy;
#endif
    return vec3(window * u_window.xy + u_window.zw, -1.0);
}

#ifdef ANY_LIGHTS
vec3 light_up(int i, vec3 position, vec3 normal) {
    AntumbraLight light = AntumbraLight(lights[i], lights[i + 1], lights[i + 2], lights[i + 3], lights[i + 4],
                                        lights[i + 5], lights[i + 6]);
    return antumbra_irradiance(light, position, normal);
}
#else
// Lights without an area, in physical units.
vec3 light_up(int i, vec3 position, vec3 normal) {
    vec4 place = lights[i];
    vec4 cone = lights[i + 2];
    vec3 to_light = place.xyz - position * place.w;
    float square = max(dot(to_light, to_light), 1e-30);
    float distance = sqrt(square);
    vec3 direction = to_light / distance;
    float angular = clamp(dot(-direction, cone.xyz) * cone.w + lights[i + 3].w, 0.0, 1.0);
    float falloff = place.w > 0.5 ? 1.0 / square : 1.0;
    return lights[i + 1].rgb * (max(dot(normal, direction), 0.0) * angular * angular * falloff);
}
#endif

void write_surface(vec3 position, vec3 normal) {
    vec3 e = u_ambient;
    for (int i = 0; i < u_light_count; i++) {
        e += light_up(i * 7, position, normal);
    }
    o_color = vec4(u_albedo * e, 1.0);
    o_normal = vec4(normal, -position.z);
    o_id = u_id;
}
