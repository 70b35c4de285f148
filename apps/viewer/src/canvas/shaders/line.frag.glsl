// A smooth line, pale where something is in front of it.
in float v_inverse;
in vec4 v_color;
in vec3 v_edge;
out vec4 o_color;

#ifdef SAMPLES
uniform highp sampler2DMS u_depth;
#else
uniform highp sampler2D u_depth;
#endif
uniform float u_near;      // depth is u_near / distance
uniform vec2 u_origin;     // of the picture in the window, pixels
uniform vec2 u_texels;     // texels for a pixel

const float TOLERANCE = 4e-3; // of the distance: a line on a surface is in front of it

void main() {
    ivec2 at = ivec2((gl_FragCoord.xy - u_origin) * u_texels);
    float scene = texelFetch(u_depth, at, 0).r / u_near;
    float hidden = step(v_inverse * (1.0 + TOLERANCE), scene);
    float cover = clamp(v_edge.y - abs(v_edge.x) + 0.5, 0.0, 1.0);
    // Hidden parts are dashed.
    float dash = step(0.5, fract(v_edge.z / 8.0));
    float alpha = v_color.a * cover * mix(1.0, 0.45 * dash, hidden);
    o_color = vec4(v_color.rgb * alpha, alpha);
}
