// One picture, two beside each other, or where they differ.
in vec2 v_at;
out vec4 o_color;

uniform sampler2D u_left;
uniform sampler2D u_right;
uniform sampler2D u_colors; // of errors from 0 to 1
uniform int u_layout;       // 0 single, 1 split, 2 difference
uniform float u_divider;
uniform float u_exposure;
uniform float u_scale;      // the error that has the last colour
uniform float u_dither;     // from the least to the most of the noise
uniform vec2 u_dim;         // factors on the two pictures

vec3 srgb(vec3 linear) {
    vec3 x = clamp(linear, 0.0, 1.0);
    return mix(12.92 * x, 1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, x));
}

// Interleaved gradient noise, 0 to 1 (J. Jimenez, Next Generation Post Processing in Call of Duty, 2014).
float noise(vec2 at) {
    return fract(52.9829189 * fract(dot(at, vec2(0.06711056, 0.00583715))));
}

void main() {
    vec3 left = texture(u_left, v_at).rgb * u_exposure;
    vec3 right = texture(u_right, v_at).rgb * u_exposure;
    if (u_layout == 2) {
        // What the eye sees of it: the difference of the encoded colours.
        vec3 apart = abs(srgb(left) - srgb(right));
        float error = max(apart.r, max(apart.g, apart.b)) / u_scale;
        vec2 size = vec2(textureSize(u_colors, 0));
        float x = (clamp(error, 0.0, 1.0) * (size.x - 1.0) + 0.5) / size.x;
        o_color = vec4(texture(u_colors, vec2(x, 0.5)).rgb, 1.0);
        return;
    }
    bool is_right = u_layout == 1 && v_at.x > u_divider;
    vec3 color = srgb(is_right ? right * u_dim.y : left * u_dim.x);
    o_color = vec4(color + (noise(gl_FragCoord.xy) - 0.5) * u_dither, 1.0);
}
