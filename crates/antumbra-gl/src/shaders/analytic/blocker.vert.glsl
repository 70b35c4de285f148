// Bounding polygons of shadows on the screen, each with its blocker's numbers.

layout(location = 0) in vec2 a_position_cs;
layout(location = 1) in uvec2 a_blocker;  // x: channel + 4 * first texel; y: id of the occluder

uniform highp sampler2D u_blockers;

flat out vec4 v_blocker[BLOCKER_TEXELS];
flat out vec4 v_channel;
#ifdef SEAMS
flat out highp uint v_first;
#endif
flat out highp uint v_id;

void main() {
    uint first = a_blocker.x >> 2u;
#ifdef SEAMS
    v_first = first;
#endif
    int width = textureSize(u_blockers, 0).x;
    for (int i = 0; i < BLOCKER_TEXELS; i++) {
        int texel = int(first) + i;
        v_blocker[i] = texelFetch(u_blockers, ivec2(texel % width, texel / width), 0);
    }
    uint channel = a_blocker.x & 3u;
    v_channel = vec4(channel == 0u, channel == 1u, channel == 2u, channel == 3u);
    v_id = a_blocker.y;
    gl_Position = vec4(a_position_cs, 0.0, 1.0);
}
