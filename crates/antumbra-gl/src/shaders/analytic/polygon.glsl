// A flat convex polygon between a point and a light: half-spaces. Twin:
// antumbra_math::blocking::polygon_coverage.
//
// SEAMS: it touches other things along its edges, which may continue it.

struct PolygonBlocker {
    vec4 base;  // the polygon's plane, positive behind it
    vec4 edges[4];
};

// The two edges that cut off most of the pixel; the others hardly touch it.
void nearest_edges(inout vec3 first, inout vec3 second, vec3 edge) {
    vec3 later = edge.x < first.x ? first : edge;
    first = edge.x < first.x ? edge : first;
    second = later.x < second.x ? later : second;
}

// The part of a footprint that does not cross a plane, which its point is so far `behind`: where a receiver runs into what is
// seen there, what is beyond their contact is not.
Footprint contact_footprint(Footprint footprint, vec3 normal, float behind) {
    float across = abs(dot(normal, footprint.dx)) + abs(dot(normal, footprint.dy));
    float share = clamp(behind / max(across, 1e-30), 0.0, 1.0);
    return Footprint(footprint.point, footprint.dx * share, footprint.dy * share);
}

// How far behind a plane a point has to lie to be behind it. What lies in it, to the rounding of depth, is not; but a receiver
// that runs into what is seen there is on the eye's side of it.
float contact_tolerance(vec4 base, Footprint footprint, float tolerance, bool perspective) {
    float eye = perspective ? base.w : base.z;
    float across = max(abs(dot(base.xyz, footprint.dx)), abs(dot(base.xyz, footprint.dy)));
    float size = sqrt(max(dot(footprint.dx, footprint.dx), dot(footprint.dy, footprint.dy)));
    return eye > 0.0 && across > 0.05 * size ? -tolerance : tolerance;
}

#define POLYGON_EDGE(plane, f) edge_of(dot((plane).xyz, (f).point) + (plane).w, (plane).xyz, f)

// An edge that another polygon continues, on the light's other side of it: what lies beyond the edge is dark too, up to the
// other's `far` edge, for points `behind` the other's plane.
vec3 seam_edge(vec3 edge, vec3 far, float behind) {
    return behind > 0.0 && edge.x > 0.0 ? far : edge;
}

float polygon_coverage(PolygonBlocker b, Footprint footprint, float tolerance) {
    float behind = dot(b.base.xyz, footprint.point) + b.base.w - tolerance;
    vec3 first = edge_of(behind, b.base.xyz, footprint);
    vec3 second = vec3(1.0, 0.0, 0.0);
    for (int i = 0; i < 4; i++) {
        nearest_edges(first, second, POLYGON_EDGE(b.edges[i], footprint));
    }
    return corner_coverage(first, second);
}

#ifdef SEAMS
flat in highp uint v_first;  // the blocker's first texel
uniform highp sampler2D u_blockers;

vec4 blocker_texel(int i) {
    int width = textureSize(u_blockers, 0).x;
    return texelFetch(u_blockers, ivec2(i % width, i / width), 0);
}

// The same with four texels for each edge, from `at` on: the plane of what continues it, which no point is behind where nothing
// does, its far edge, and those at the ends of the seam.
float seamed_coverage(PolygonBlocker b, Footprint footprint, float tolerance, int at) {
    float behind = dot(b.base.xyz, footprint.point) + b.base.w - tolerance;
    Footprint near = contact_footprint(footprint, b.base.xyz, behind);
    vec3 first = vec3(behind > 0.0 ? 1.0 : 0.0, 0.0, 0.0);
    vec3 second = vec3(1.0, 0.0, 0.0);
    for (int i = 0; i < 4; i++) {
        vec4 other = blocker_texel(at + 4 * i);
        float touches = dot(other.xyz, other.xyz) > 0.5 ? 1.0 : 0.0;
        Footprint patch_ = Footprint(footprint.point, mix(footprint.dx, near.dx, touches), mix(footprint.dy, near.dy, touches));
        vec3 edge = POLYGON_EDGE(b.edges[i], patch_);
        float beyond = dot(other.xyz, footprint.point) + other.w - tolerance;
        // What continues it is seen too, and nothing of the receiver beyond.
        Footprint corner = contact_footprint(patch_, other.xyz, touches > 0.5 ? abs(beyond) : 1.0);
        // Where the pixel is whole inside the edge, what comes after it is of no matter; without a seam the edge itself counts.
        int count = edge.x < 1.0 ? (edge.x > 0.0 && beyond > 0.0 ? 4 : 2) : 1;
        for (int k = 1; k < count; k++) {
            vec4 end = blocker_texel(at + 4 * i + k);
            vec3 after = POLYGON_EDGE(end, corner);
            after = seam_edge(edge, after, beyond);
            nearest_edges(first, second, after);
        }
    }
    return corner_coverage(first, second);
}
#endif

float blocker_coverage(Footprint footprint, SurfacePoint surface) {
    // Constant indices: Mesa's llvmpipe 22.3 reads zeros where a loop counts through a flat input.
    PolygonBlocker b = PolygonBlocker(
        BLOCKER_DATA[0], vec4[4](BLOCKER_DATA[1], BLOCKER_DATA[2], BLOCKER_DATA[3], BLOCKER_DATA[4]));
#ifdef SEAMS
    float tolerance = contact_tolerance(b.base, footprint, surface.tolerance, u_pixel_step.z > 0.5);
    return seamed_coverage(b, footprint, tolerance, int(v_first) + 5);
#else
    return polygon_coverage(b, footprint, surface.tolerance);
#endif
}
