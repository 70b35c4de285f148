// The eye's ray against one exact shape, lit without shadows.
#define PLANE 0
#define RECTANGLE 1
#define DISC 2
#define TRIANGLE 3
#define SPHERE 4
#define CONE 5

uniform mat4 u_to_view;
uniform vec3 u_eye;          // in the primitive's space
uniform mat3 u_from_view;    // directions, to the primitive's space
uniform float u_near;        // window depth = near / distance
uniform int u_shape;
uniform vec4 u_size;
uniform vec3 u_triangle[3];

// Distance along `d`, and the normal; false for a miss.
bool cast_flat(vec3 o, vec3 d, out float t, out vec3 normal) {
    t = -o.y / d.y;
    normal = vec3(0.0, 1.0, 0.0);
    return d.y != 0.0 && t > 0.0;
}

bool cast_sphere(vec3 o, vec3 d, out float t, out vec3 normal) {
    float r = u_size.x;
    vec3 miss = cross(o, d);
    float reach = r * r - dot(miss, miss);
    if (reach < 0.0) {
        return false;
    }
    float half_chord = sqrt(reach);
    float middle = -dot(o, d);
    t = middle - half_chord > 0.0 ? middle - half_chord : middle + half_chord;
    normal = (o + d * t) / r;
    return t > 0.0;
}

// Apex at +h/2, base at -h/2. In the frame of the apex the surface is r^2 y^2 = h^2 (x^2 + z^2).
bool cast_cone(vec3 o, vec3 d, out float t, out vec3 normal) {
    float r = u_size.x;
    float h = u_size.y;
    t = 1e30;
    float base = (-0.5 * h - o.y) / d.y;
    vec2 hit = o.xz + d.xz * base;
    if (d.y != 0.0 && base > 0.0 && dot(hit, hit) <= r * r) {
        t = base;
        normal = vec3(0.0, -1.0, 0.0);
    }
    // Start from the point of the ray nearest to the middle of the cone: small numbers.
    float shift = -dot(o, d);
    vec3 p = o + d * shift;
    p.y -= 0.5 * h;
    float k = r * r / (h * h);
    float a = dot(d.xz, d.xz) - k * d.y * d.y;
    float b = dot(p.xz, d.xz) - k * p.y * d.y;
    float c = dot(p.xz, p.xz) - k * p.y * p.y;
    float q = b * b - a * c;
    if (q >= 0.0) {
        float root = -b - (b < 0.0 ? -sqrt(q) : sqrt(q));
        for (int i = 0; i < 2; i++) {
            float s = i == 0 ? root / a : c / root;
            float y = p.y + d.y * s;
            if (s + shift > 0.0 && s + shift < t && y <= 0.0 && y >= -h) {
                t = s + shift;
                vec3 at = p + d * s;
                normal = normalize(vec3(at.x * h, r * length(at.xz), at.z * h));
            }
        }
    }
    return t < 1e30;
}

bool inside_triangle(vec3 p) {
    vec3 n = cross(u_triangle[1] - u_triangle[0], u_triangle[2] - u_triangle[0]);
    for (int i = 0; i < 3; i++) {
        vec3 edge = u_triangle[(i + 1) % 3] - u_triangle[i];
        if (dot(cross(edge, p - u_triangle[i]), n) < 0.0) {
            return false;
        }
    }
    return true;
}

bool cast_triangle(vec3 o, vec3 d, out float t, out vec3 normal) {
    normal = normalize(cross(u_triangle[1] - u_triangle[0], u_triangle[2] - u_triangle[0]));
    t = dot(u_triangle[0] - o, normal) / dot(d, normal);
    return t > 0.0 && inside_triangle(o + d * t);
}

void main() {
    vec3 sight = line_of_sight();
    vec3 d = normalize(u_from_view * sight);
    float t;
    vec3 normal;
    bool hit;
    if (u_shape == SPHERE) {
        hit = cast_sphere(u_eye, d, t, normal);
    } else if (u_shape == CONE) {
        hit = cast_cone(u_eye, d, t, normal);
    } else if (u_shape == TRIANGLE) {
        hit = cast_triangle(u_eye, d, t, normal);
    } else {
        hit = cast_flat(u_eye, d, t, normal);
        vec3 p = u_eye + d * t;
        if (u_shape == RECTANGLE) {
            hit = hit && abs(p.x) <= u_size.x && abs(p.z) <= u_size.y;
        } else if (u_shape == DISC) {
            hit = hit && dot(p.xz, p.xz) <= u_size.x * u_size.x;
        }
    }
    if (!hit) {
        discard;
    }
    vec3 position = normalize(sight) * t;
    normal = mat3(u_to_view) * (dot(normal, d) > 0.0 ? -normal : normal);
    float depth = u_near / -position.z;
    if (depth > 1.0) {
        discard;  // nearer than the near plane
    }
    gl_FragDepth = max(depth, 1e-37);  // the far end is still something, not the background
    write_surface(position, normal);
}
