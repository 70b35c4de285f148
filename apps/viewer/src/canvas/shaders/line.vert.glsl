// Corners of thin quads, made on the CPU.
layout(location = 0) in vec2 a_position;  // normalized device coordinates
layout(location = 1) in float a_inverse;  // 1 / distance along the line of sight
layout(location = 2) in vec4 a_color;
layout(location = 3) in vec3 a_edge;      // pixels: across from the middle, half the width, along

out float v_inverse;
out vec4 v_color;
out vec3 v_edge;

void main() {
    v_inverse = a_inverse;
    v_color = a_color;
    v_edge = a_edge;
    gl_Position = vec4(a_position, 0.0, 1.0); // w is 1: all varyings are linear on the screen, as 1 / distance is
}
