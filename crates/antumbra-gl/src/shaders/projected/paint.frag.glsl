// The painted shadows of all lights, over the host's pixels.

uniform highp SURFACE_SAMPLER u_painted;  // the factor on the displayed picture
uniform ivec2 u_painted_offset;           // from this target's pixel to its texel
uniform float u_exponent;                 // the host's pixels are displayed values to this power

layout(location = 0) out vec4 o_factor;

void main() {
    float factor = texelFetch(u_painted, ivec2(gl_FragCoord.xy) + u_painted_offset, SURFACE_INDEX).r;
    if (factor == 1.0) {
        discard;
    }
    o_factor = vec4(vec3(pow(factor, u_exponent)), 1.0);
}
