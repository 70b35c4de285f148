// A triangle's corner, and what its fragments need of the whole triangle.
uniform mat4 u_projection;
uniform mat4 u_to_view;    // from the triangles' space

layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;   // of the surface that the triangles stand for
layout(location = 2) in vec3 a_facet;    // unit normal of the triangle
layout(location = 3) in vec4 a_around;   // a sphere round the triangle: centre, radius

out vec3 v_normal;
flat out vec4 v_plane;   // view space: unit normal, offset
flat out vec2 v_range;   // of the triangle's distances from the eye's plane

void main() {
    vec4 position = u_to_view * vec4(a_position, 1.0);
    vec4 center = u_to_view * vec4(a_around.xyz, 1.0);
    vec3 facet = mat3(u_to_view) * a_facet;
    v_normal = mat3(u_to_view) * a_normal;
    v_plane = vec4(facet, dot(facet, position.xyz));
    v_range = vec2(-center.z - a_around.w, -center.z + a_around.w);
    gl_Position = u_projection * position;
}
