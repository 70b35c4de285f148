// One blocker's numbers, the same for every pixel of its polygon.
flat in vec4 v_blocker[BLOCKER_TEXELS];
#define BLOCKER_DATA v_blocker
