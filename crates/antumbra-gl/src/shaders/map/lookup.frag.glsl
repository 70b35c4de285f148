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
uniform vec3 u_beyond[4];    // infinite planes beyond the border of a directional light's map: depth for a texel to the
uniform int u_beyond_count;  // right, for one up, and at the first texel's corner
uniform vec4 u_place;        // light space: (0, 0, 0, 1), or the direction to the light and 0
uniform vec4 u_bias;         // constant, slope, normal offset, radius of the filter: texels, but for the slope
uniform vec4 u_channel;
#ifdef PCSS
uniform vec4 u_light_right;  // light space: half the light's size; w: 1 for a square, 0 for a disc
uniform vec4 u_light_up;     // w: radius of a ball, whose disc faces the receiver; or 0
uniform vec2 u_range;        // depth times w; distance of the nearest blocker from the light
#define SEARCH_TAPS 32
#define FILTER_TAPS 48
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

// Whether a texel keeps something nearer to the light than `depth`. One with nothing in it has 0: it blocks nothing, not
// even beyond the map's far end.
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
float soft_visibility(vec3 position, vec3 normal, float texel) {
    bool square = u_light_right.w > 0.5;
    vec3 right = u_light_right.xyz;
    vec3 up = u_light_up.xyz;
    if (u_light_up.w > 0.0) {
        vec3 sight = normalize(position);
        vec3 other = abs(sight.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
        right = normalize(cross(sight, other)) * u_light_up.w;
        up = cross(sight, right);
    }
    float size = max(length(right), length(up));
    float far = dot(position, position);
    float distance = sqrt(far);
    // No narrower than the box of plain PCF, and within 45 degrees of the way to the light.
    float narrowest = u_bias.w * texel / size;
    float widest = clamp(penumbra_scale(u_range.y / distance), narrowest, max(distance / size, narrowest));
    float blockers = 0.0;
    float shares = 0.0;
    for (int i = 0; i < SEARCH_TAPS; i++) {
        // Denser towards the middle, where nearer blockers are to be found.
        vec2 point = light_point(i, SEARCH_TAPS, square) * sqrt((float(i) + 0.5) / float(SEARCH_TAPS));
        vec3 x = position + (right * point.x + up * point.y) * widest;
        int face = face_of(x);
        vec4 p = u_faces[face] * vec4(x, 1.0);
        vec4 plane = u_planes[face] * vec4(normal, -dot(normal, position));
        if (p.w > 0.0) {
            vec2 texel = floor(p.xy / p.w);
            float depth = max((dot(plane.xy, texel + 0.5) + plane.w) / -plane.z, 0.0);
            float kept = kept_depth(face, texel);
            if (kept > depth + u_bias.x * texel_depth(face, depth)) {
                float share = dot(x, position) * (u_range.x / (kept * p.w)) / far;
                // A blocker beside the cone from the receiver to the light blocks nothing of it.
                if (max(penumbra_scale(share), narrowest) >= light_reach(point, square) * widest) {
                    blockers += 1.0;
                    shares += share;
                }
            }
        }
    }
    // A loop without a turn is skipped even where both sides of a branch would run.
    int taps = blockers > 0.0 ? FILTER_TAPS : 0;
    float scale = clamp(penumbra_scale(shares / max(blockers, 1.0)), narrowest, widest);
    float lit = 0.0;
    for (int i = 0; i < taps; i++) {
        vec2 point = light_point(i, FILTER_TAPS, square);
        vec3 x = position + (right * point.x + up * point.y) * scale;
        int face = face_of(x);
        vec4 p = u_faces[face] * vec4(x, 1.0);
        vec4 plane = u_planes[face] * vec4(normal, -dot(normal, position));
        if (p.w > 0.0) {
            vec2 at = p.xy / p.w;
            MapPoint tap = MapPoint(at, (dot(plane.xy, at) + plane.w) / -plane.z, plane.xy / -plane.z, p.w);
            lit += box_filter(face, tap, u_bias.x * texel_depth(face, max(tap.depth, 0.0)), 0.5);
        } else {
            lit += 1.0;
        }
    }
    return taps > 0 ? lit / float(FILTER_TAPS) : 1.0;
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
    float visibility = soft_visibility(position, normal, texel);
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
