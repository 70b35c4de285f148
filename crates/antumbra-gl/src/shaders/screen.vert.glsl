// The tiles of the viewport that shadows touch.

layout(location = 0) in vec2 a_position_cs;

void main() {
    gl_Position = vec4(a_position_cs, 0.0, 1.0);
}
