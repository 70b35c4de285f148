// Percentage-closer soft shadows. Twin: antumbra_gl::technique::map::soft.

#define GOLDEN_ANGLE 2.399963229728653

// The points of a light of size one: a disc filled by Vogel's spiral, or a square by the R2 sequence.
vec2 light_point(int index, int count, bool square) {
    float i = float(index) + 0.5;
    if (square) {
        return fract(vec2(0.7548776662466927, 0.5698402909980532) * i) * 2.0 - 1.0;
    }
    float angle = i * GOLDEN_ANGLE;
    return vec2(cos(angle), sin(angle)) * sqrt(i / float(count));
}

// How far from the middle such a point is, in sizes of the light.
float light_reach(vec2 point, bool square) {
    return square ? max(abs(point.x), abs(point.y)) : length(point);
}

// How much of the light's size the way to a blocker spreads to, seen from the light: the blocker is at `share` of the
// way from the light to the receiver. Nothing at the receiver, without end at the light.
float penumbra_scale(float share) {
    return 1.0 / max(share, 1e-6) - 1.0;
}

// How much a blocker counts, seen at so many radii of the cone from the receiver to the light from its middle: whole
// inside, nothing from `slack` on.
float blocker_weight(float beside, float slack) {
    return clamp((slack - beside) / (slack - 1.0), 0.0, 1.0);
}
