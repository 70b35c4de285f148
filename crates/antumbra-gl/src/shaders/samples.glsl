// What a point of a light sends to the surface. Twin: twins::samples.

// In units of what a point at the light's centre sends straight down. `emitter`: the normal of the side of a flat
// light that shines, and 1; w is 0 for a ball, whose points shine to all sides alike.
float sample_weight(vec3 point, vec3 center, vec4 emitter, vec3 position, vec3 normal) {
    vec3 to_point = point - position;
    float square = max(dot(to_point, to_point), 1e-30);
    vec3 direction = to_point / sqrt(square);
    float received = max(dot(normal, direction), 0.0);
    float sent = emitter.w > 0.5 ? max(dot(-direction, emitter.xyz), 0.0) : 1.0;
    vec3 to_center = center - position;
    return received * sent * (dot(to_center, to_center) / square);
}
