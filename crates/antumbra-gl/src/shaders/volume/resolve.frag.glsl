// Where the count is not zero, the light does not arrive: the stencil test lets these pixels through.

layout(location = 0) out vec4 o_visibility;

void main() {
    o_visibility = vec4(0.0);
}
