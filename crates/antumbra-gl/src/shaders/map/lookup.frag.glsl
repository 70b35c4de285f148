// The visibility of one light by its shadow map, blended into the light's channel by minimum.
//
// NONE: the nearest texel. PCF: a box of texels. PCSS: a box as wide as the penumbra.

uniform highp sampler2D u_map;
uniform mat4 u_to_light;     // view space to light space
uniform mat4 u_faces[6];     // see map_point; light space to texels of the map
uniform mat4 u_planes[6];
uniform vec4 u_tiles[6];     // first and last texel of a face; none if nothing is in it
uniform vec4 u_texels[6];    // size of a texel in depth: x plus y * depth; in metres: z plus w * w
uniform bool u_cube;         // six faces, or the first alone
// Infinite planes beyond the border of a directional light's map: depth for a texel to the right, for one up, and at
// the first texel's corner.
uniform vec3 u_beyond[4];
uniform int u_beyond_count;
uniform vec4 u_place;        // light space: (0, 0, 0, 1), or the direction to the light and 0
uniform vec4 u_bias;         // constant, slope, normal offset, radius of the filter: texels, but for the slope
uniform vec4 u_channel;
#ifdef PCSS
uniform vec4 u_light_right;  // light space: half the light's size; w: 1 for a square, 0 for a disc
uniform vec4 u_light_up;     // w: radius of a ball, whose disc faces the receiver; or 0
uniform vec2 u_range;        // depth times w; distance of the nearest blocker from the light
// The first search, and the filter, take what is beside the cone to the light by less than twice its radius: less
// shows as outlines where a near blocker and a far one meet, more as shadows that are not there.
#define FIRST_SLACK 2.0
// Points of the light. The second search looks a little beside the cone to the light: of SEARCH_TAPS points a third
// lie in that ring, near enough to each other that a straight edge is found before the filter meets it. Otherwise the
// outline of the penumbra shows. More FILTER_TAPS make finer bands in wide penumbrae, and cost as much more.
#define FIRST_TAPS 32
#define SEARCH_TAPS 32
#define FILTER_TAPS 64
#define RING 1.25
#endif

layout(location = 0) out vec4 o_visibility;

int face_of(vec3 position) {
    return u_cube ? map_face(position) : 0;
}

float texel_depth(int face, float depth) {
    return u_texels[face].x + u_texels[face].y * depth;
}

float texel_metres(int face, float w) {
    return u_texels[face].z + u_texels[face].w * w;
}

// The depth kept in a texel; 0, the farthest, outside the face.
float kept_depth(int face, vec2 texel) {
    vec4 tile = u_tiles[face];
    bool inside = all(greaterThanEqual(texel, tile.xy)) && all(lessThanEqual(texel, tile.zw));
    return inside ? texelFetch(u_map, ivec2(texel), 0).x : 0.0;
}

// Whether a texel keeps something nearer to the light than `depth`. One with nothing in it has 0: it blocks nothing,
// not even beyond the map's far end.
bool texel_blocks(int face, vec2 texel, float depth) {
    bool blocks = kept_depth(face, texel) > max(depth, 0.0);
    vec4 tile = u_tiles[face];
    bool inside = all(greaterThanEqual(texel, tile.xy)) && all(lessThanEqual(texel, tile.zw));
    int beyond = inside ? 0 : u_beyond_count;
    for (int i = 0; i < beyond; i++) {
        blocks = blocks || dot(u_beyond[i].xy, texel + 0.5) + u_beyond[i].z > depth;
    }
    return blocks;
}

// Whether the light reaches the plane of the receiver where the texel's middle sees it.
float texel_is_lit(int face, MapPoint at, float bias, vec2 texel) {
    float depth = at.depth + dot(at.slope, texel + 0.5 - at.texel) + bias;
    return texel_blocks(face, texel, depth) ? 0.0 : 1.0;
}

// The mean over a square of texels around a point, partial texels by their share.
float box_filter(int face, MapPoint at, float bias, float radius) {
    vec2 first = floor(at.texel - radius);
    int count = int(ceil(2.0 * radius)) + 1;
    float sum = 0.0;
    for (int y = 0; y < count; y++) {
        float row = first.y + float(y);
        float row_weight = box_weight(at.texel.y, radius, row);
        for (int x = 0; x < count; x++) {
            vec2 texel = vec2(first.x + float(x), row);
            float weight = row_weight * box_weight(at.texel.x, radius, texel.x);
            sum += weight * texel_is_lit(face, at, bias, texel);
        }
    }
    return sum / (4.0 * radius * radius);
}

#ifdef PCSS
// A receiver under a light with an area, light space.
struct SoftReceiver {
    vec3 position;
    vec3 normal;      // of the plane that texels are compared with
    vec3 right;       // half the light's size
    vec3 up;
    vec3 ahead;       // the way the light looks
    bool square;
    float narrowest;  // penumbra_scale of the box of plain PCF
};

SoftReceiver soft_receiver(vec3 position, vec3 normal, float texel) {
    vec3 right = u_light_right.xyz;
    vec3 up = u_light_up.xyz;
    if (u_light_up.w > 0.0) {
        vec3 sight = normalize(position);
        vec3 other = abs(sight.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
        right = normalize(cross(sight, other)) * u_light_up.w;
        up = cross(sight, right);
    }
    float size = max(length(right), length(up));
    return SoftReceiver(position, normal, right, up, cross(right, up), u_light_right.w > 0.5, u_bias.w * texel / size);
}

// Where in the map the receiver sees a point of the light, with the light's size so many times as large.
struct Tap {
    int face;
    vec2 at;       // in texels
    vec4 plane;    // of the receiver
    float away;    // share of the way from the light to the receiver, for a depth of 1
    float beside;  // how far from the middle, in sizes of the light
    bool in_front; // of the light
};

Tap light_tap(SoftReceiver r, vec2 point, float scale) {
    vec3 x = r.position + (r.right * point.x + r.up * point.y) * scale;
    int face = face_of(x);
    vec4 p = u_faces[face] * vec4(x, 1.0);
    vec4 plane = u_planes[face] * vec4(r.normal, -dot(r.normal, r.position));
    float w = p.w > 0.0 ? p.w : 1.0;
    float away = dot(x, r.ahead) / dot(r.position, r.ahead) * (u_range.x / w);
    return Tap(face, p.xy / w, plane, away, light_reach(point, r.square) * scale, p.w > 0.0);
}

// What a texel keeps from the receiver: x the weight, nothing for what is beside the cone from the receiver to the
// light by more than `slack` times its radius; y the blocker's share of the way; z its penumbra_scale.
vec3 blocker_in(SoftReceiver r, Tap tap, vec2 texel, float slack) {
    float depth = max((dot(tap.plane.xy, texel + 0.5) + tap.plane.w) / -tap.plane.z, 0.0);
    float kept = kept_depth(tap.face, texel);
    bool blocks = tap.in_front && kept > depth + u_bias.x * texel_depth(tap.face, depth);
    float share = tap.away / max(kept, 1e-30);
    float scale = max(penumbra_scale(share), r.narrowest);
    return blocks ? vec3(blocker_weight(tap.beside / scale, slack), share, scale) : vec3(0.0);
}

// The blockers seen through `taps` points of the light: their weight, the sum of their shares by weight, and the largest
// penumbra_scale of any.
vec3 find_blockers(SoftReceiver r, float scale, float slack, int taps, bool dense) {
    vec3 found = vec3(0.0);
    for (int i = 0; i < taps; i++) {
        vec2 point = light_point(i, taps, r.square);
        if (dense) {
            // Denser towards the middle, where blockers near the receiver are to be found.
            point *= sqrt((float(i) + 0.5) / float(taps));
        }
        Tap tap = light_tap(r, point, scale);
        vec3 blocker = blocker_in(r, tap, floor(tap.at), slack);
        found.xy += vec2(1.0, blocker.y) * blocker.x;
        found.z = blocker.x > 0.0 ? max(found.z, blocker.z) : found.z;
    }
    return found;
}

float soft_visibility(SoftReceiver r) {
    float distance = length(r.position);
    float size = max(length(r.right), length(r.up));
    // Within 45 degrees of the way to the light.
    float limit = max(distance / size, r.narrowest);
    // First as wide as the nearest caster of all may ask for; then as wide as those that were found do.
    float widest = clamp(penumbra_scale(u_range.y / distance), r.narrowest, limit);
    vec3 first = find_blockers(r, widest * RING, FIRST_SLACK, FIRST_TAPS, true);
    // A loop without a turn is skipped even where both sides of a branch would run.
    vec3 found = find_blockers(r, min(first.z, limit) * RING, RING, first.x > 0.0 ? SEARCH_TAPS : 0, false);
    int taps = found.x > 0.0 ? FILTER_TAPS : 0;
    float scale = clamp(penumbra_scale(found.y / max(found.x, 1e-6)), r.narrowest, limit);
    float blocked = 0.0;
    for (int i = 0; i < taps; i++) {
        Tap tap = light_tap(r, light_point(i, FILTER_TAPS, r.square), scale);
        vec2 corner = floor(tap.at - 0.5);
        for (int k = 0; k < 4; k++) {
            vec2 texel = corner + vec2(k & 1, k >> 1);
            float share = box_weight(tap.at.x, 0.5, texel.x) * box_weight(tap.at.y, 0.5, texel.y);
            blocked += share * blocker_in(r, tap, texel, FIRST_SLACK).x;
        }
    }
    return 1.0 - blocked / float(FILTER_TAPS);
}
#endif

void main() {
    SurfacePoint s;
    if (!surface_point(s) || !s.receives) {
        discard;
    }
    vec3 position = (u_to_light * vec4(s.position, 1.0)).xyz;
    vec3 normal = mat3(u_to_light) * surface_normal(s);
    vec3 to_light = u_place.xyz - position * u_place.w;
    to_light *= inversesqrt(max(dot(to_light, to_light), 1e-30));
    if (!(dot(normal, to_light) > 0.0)) {
        discard;  // the host's own n . l is 0
    }
    int face = face_of(position);
    float texel = texel_metres(face, (u_faces[face] * vec4(position, 1.0)).w);
    position = offset_point(position, normal, to_light, u_bias.z * texel);
    normal = compared_normal(normal, to_light, u_bias.y);
    face = face_of(position);
    MapPoint at = map_point(u_faces[face], u_planes[face], position, normal);
    if (!(at.w > 0.0)) {
        discard;  // behind the light
    }
    float bias = u_bias.x * texel_depth(face, at.depth);
#if defined(PCSS)
    float visibility = soft_visibility(soft_receiver(position, normal, texel));
#elif defined(PCF)
    float visibility = box_filter(face, at, bias, u_bias.w);
#else
    float visibility = texel_is_lit(face, at, bias, floor(at.texel));
#endif
    if (visibility >= 1.0) {
        discard;
    }
    o_visibility = vec4(1.0) - u_channel * (1.0 - visibility);
}
