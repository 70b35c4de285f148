// Depth as the map keeps it, whatever range the host's depth has: larger is nearer to the light.

in float v_depth;

void main() {
    gl_FragDepth = v_depth * gl_FragCoord.w;
}
