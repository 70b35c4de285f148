// The host's surface behind a pixel: position, normal and object, in view space.

#ifdef MULTISAMPLE
#define SURFACE_SAMPLER sampler2DMS
#define SURFACE_USAMPLER usampler2DMS
#define SURFACE_INDEX gl_SampleID
#define PIXEL_POSITION (floor(gl_FragCoord.xy) + gl_SamplePosition)
#else
#define SURFACE_SAMPLER sampler2D
#define SURFACE_USAMPLER usampler2D
#define SURFACE_INDEX 0
#define PIXEL_POSITION gl_FragCoord.xy
#endif

uniform highp SURFACE_SAMPLER u_depth;
#ifdef NORMALS
uniform highp SURFACE_SAMPLER u_normals;
uniform mat3 u_normal_to_view;
uniform vec2 u_normal_decode;     // x scale, y offset
#endif
#ifdef IDS
uniform highp SURFACE_USAMPLER u_ids;
#endif
uniform mat4 u_unproject;         // window (x, y, depth - background depth, 1) to view space
uniform vec4 u_pixel_step;        // see screen_footprint; w: size of a footprint in pixels
uniform vec3 u_background_depth;  // x: depth where nothing was drawn; step of the buffer: y, plus z * depth
uniform ivec2 u_surface_offset;   // from this target's pixel to the surface textures' texel
uniform ivec4 u_surface_range;    // the first and the last texel of the viewport

struct SurfacePoint {
    ivec2 texel;
    vec3 position;
    uint id;           // 0: nothing that casts a shadow
    bool has_id;
    bool receives;
    float tolerance;   // distances below this are rounding of the depth buffer and of float32
};

// Whether the surface is the occluder of that id. What the host does not draw, 0, is nobody's.
bool is_own(SurfacePoint s, uint id) {
    return s.has_id && id != 0u && s.id == id;
}

float surface_depth(ivec2 texel) {
    return texelFetch(u_depth, clamp(texel, u_surface_range.xy, u_surface_range.zw), SURFACE_INDEX).x;
}

// View space, homogeneous. The far end of the depth buffer is its dense end: counted from there,
// float32 keeps every digit.
vec4 unproject(vec2 window, float depth) {
    return u_unproject * vec4(window + vec2(u_surface_offset), depth - u_background_depth.x, 1.0);
}

// False where the host drew nothing.
bool surface_point(out SurfacePoint s) {
    s.texel = ivec2(gl_FragCoord.xy) + u_surface_offset;
    float depth = surface_depth(s.texel);
    if (depth == u_background_depth.x) {
        return false;
    }
    vec4 p = unproject(PIXEL_POSITION, depth);
    s.position = p.xyz / p.w;
#ifdef IDS
    uint id = texelFetch(u_ids, s.texel, SURFACE_INDEX).x;
    s.has_id = true;
    s.id = id & 0x7fffffffu;
    s.receives = (id >> 31u) == 0u;
#else
    s.has_id = false;
    s.id = 0u;
    s.receives = true;
#endif
    // How far the point moves for a step of the depth buffer either way, and 64 roundings of float32
    // on the way through the matrix: what lies nearer to a plane than that lies in it.
    vec3 slope = (u_unproject[2].xyz - s.position * u_unproject[2].w) / p.w;
    float step = u_background_depth.y + u_background_depth.z * depth;
    s.tolerance = 2.0 * length(slope) * step + length(s.position) * 4e-6;
    return true;
}

#ifdef NORMALS
// Of about unit length, to either side.
vec3 raw_normal(SurfacePoint s) {
    return u_normal_to_view * (texelFetch(u_normals, s.texel, SURFACE_INDEX).xyz * u_normal_decode.x + u_normal_decode.y);
}
#else
// The neighbour's point on the side on which the depth, which is affine across a plane, is
// straighter: normals stay right up to creases and silhouettes.
vec3 straighter_step(SurfacePoint s, ivec2 step) {
    float here = surface_depth(s.texel);
    float back = surface_depth(s.texel - step);
    float ahead = surface_depth(s.texel + step);
    float bend_back = abs(2.0 * back - surface_depth(s.texel - 2 * step) - here);
    float bend_ahead = abs(2.0 * ahead - surface_depth(s.texel + 2 * step) - here);
    // A neighbour outside the viewport is no neighbour.
    bool is_first = any(lessThan(s.texel - step, u_surface_range.xy));
    bool is_last = any(greaterThan(s.texel + step, u_surface_range.zw));
    float side = is_last || (bend_back < bend_ahead && !is_first) ? -1.0 : 1.0;
    vec4 p = unproject(PIXEL_POSITION + side * vec2(step), side > 0.0 ? ahead : back);
    return (p.xyz / p.w - s.position) * side;
}

vec3 raw_normal(SurfacePoint s) {
    vec3 n = cross(straighter_step(s, ivec2(1, 0)), straighter_step(s, ivec2(0, 1)));
    float square = dot(n, n);
    // A viewport one pixel wide tells nothing of the slope: take the surface as facing the eye.
    return square > 0.0 ? n * inversesqrt(square) : normalize(-s.position);
}
#endif

// Unit, towards the eye.
vec3 surface_normal(SurfacePoint s) {
    vec3 n = raw_normal(s);
    n *= inversesqrt(max(dot(n, n), 1e-30));
    vec3 sight = u_pixel_step.z > 0.5 ? s.position : vec3(0.0, 0.0, -1.0);
    return dot(n, sight) > 0.0 ? -n : n;
}

Footprint surface_footprint(SurfacePoint s) {
    return screen_footprint(s.position, raw_normal(s), vec3(u_pixel_step.xy * u_pixel_step.w, u_pixel_step.z));
}

// The factor on the host's pixels, which are radiance^(1/gamma).
vec3 host_factor(vec3 ratio, float gamma) {
    ratio = clamp(ratio, 0.0, 1.0);
    return gamma == 1.0 ? ratio : pow(ratio, vec3(1.0 / gamma));
}
