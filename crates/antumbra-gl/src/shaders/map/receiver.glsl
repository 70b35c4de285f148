// A point of a receiver in a shadow map. Twin: antumbra_gl::technique::map::receiver.
//
// Light space: axes of the world, the light at the origin (a directional light has it among the casters).

// The face of a cube that a direction leaves through: +X, -X, +Y, -Y, +Z, -Z.
int map_face(vec3 p) {
    vec3 a = abs(p);
    if (a.x >= a.y && a.x >= a.z) {
        return p.x > 0.0 ? 0 : 1;
    }
    if (a.y >= a.z) {
        return p.y > 0.0 ? 2 : 3;
    }
    return p.z > 0.0 ? 4 : 5;
}

// Tangent of the steepest receiver that is followed: 88.2 degrees. Beyond, light only grazes, and acne stays; to follow
// it there too (256) lets light through where receivers meet.
#define STEEPEST 32.0

// The normal of the plane that texels are compared with: turned from the light's direction (share 0) to the
// receiver's (share 1), and no steeper than STEEPEST. Unit vectors in, any length out.
vec3 compared_normal(vec3 normal, vec3 to_light, float share) {
    float cosine = dot(normal, to_light);
    vec3 across = (normal - to_light * cosine) * share;
    return across + to_light * max(cosine, length(across) / STEEPEST);
}

// Moves a point off its surface by so many texels, the more the more the light grazes.
vec3 offset_point(vec3 position, vec3 normal, vec3 to_light, float offset) {
    float cosine = dot(normal, to_light);
    return position + normal * (offset * sqrt(max(1.0 - cosine * cosine, 0.0)));
}

// A point on a plane, as a face of the map sees the two.
struct MapPoint {
    vec2 texel;   // in texels of the map
    float depth;  // larger is nearer to the light
    vec2 slope;   // how depth changes on the plane from texel to texel
    float w;      // distance along the face's axis, or 1; not above 0 behind the light
};

// `face` takes light space to the texel and the depth, times w; `planes`, its inverse transposed, takes planes.
// `normal` is a normal of the plane, of any length, not at right angles to the way to the light.
MapPoint map_point(mat4 face, mat4 planes, vec3 position, vec3 normal) {
    vec4 p = face * vec4(position, 1.0);
    vec4 plane = planes * vec4(normal, -dot(normal, position));
    float w = p.w > 0.0 ? p.w : 1.0;
    return MapPoint(p.xy / w, p.z / w, plane.xy / -plane.z, p.w);
}

// How much of a texel, from its index to the next, is within `radius` of `middle`: 0 to 1.
float box_weight(float middle, float radius, float texel) {
    return clamp(min(middle + radius, texel + 1.0) - max(middle - radius, texel), 0.0, 1.0);
}
