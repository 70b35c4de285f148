// An infinite plane in the map: its depth is affine in the texel.

uniform vec3 u_slope;   // depth of a texel to the right, of one up, and at the middle
uniform vec2 u_middle;  // of the face, in texels

void main() {
    float depth = dot(u_slope.xy, gl_FragCoord.xy - u_middle) + u_slope.z;
    if (!(depth > 0.0)) {
        discard;  // behind the light, or beyond the map
    }
    gl_FragDepth = min(depth, 1.0);
}
