/* The table of studies. SPDX-License-Identifier: MIT */
#include "study.h"

const study studies[] = {
    {"signals", "figure 2: T1, T2 and T3 at even, odd, 400 Hz and other periods", study_signals},
    {"coverage", "figure 3: the frequencies that can be reached, and the gaps", study_coverage},
    {"temporal", "figure 4: dominant component, net force and correlation, 2 to 35 ms", study_temporal},
    {"device", "figure 11: the same through a simulated Touch", study_device},
    {"gratings", "figure 6, section III: S1 and S2 over direction, speed and depth", study_gratings},
    {"preferences", "figure 8: what subjects preferred, beside these metrics", study_preferences},
    {"tradeoff", "cost against accuracy, each method at each rate", study_tradeoff},
    {"velocity", "what each velocity estimator gets wrong, and how late it is", study_velocity},
    {"tracking", "what moves a position on that comes in counts, and other ways", study_tracking},
    {"even", "the gains with which ridges are equally strong at all speeds, and how even they become", study_even},
    {"half_cycles", "the impulse of every half cycle, whatever the speed and the tessellation", study_half_cycles},
    {"transitions", "what becomes of an event when hand, surface or material change in it", study_transitions},
    {"smooth", "a low-poly ring felt as its triangles and as it looks, and what that costs", study_smooth},
    {"creases", "the force in a crease of two walls, however they are cut into surfaces", study_creases},
    {"failures", "the catalogue of failures: each method, each way it fails, as a number and a trace", study_failures},
    {"stability", "where walls and gratings run away or buzz: checks against theory, and maps", study_stability},
    {NULL, NULL, NULL}};
