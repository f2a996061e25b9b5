/* By how much textures and vibrations may change the force in a tick. SPDX-License-Identifier: MIT */
#include "judge.h"

#include <math.h>

void judge_forget_contacts(judge *j) {
    j->deepest = 0;
    for (int i = 0; i < JUDGE_SURFACES; i++) {
        j->surfaces[i].touched = 0;
    }
}

judge_surface *judge_find_surface(judge *j, knurl_surface_id id) {
    for (int i = 0; i < JUDGE_SURFACES; i++) {
        if (j->surfaces[i].id == id) {
            return &j->surfaces[i];
        }
    }
    return NULL;
}

/* N: the texture's step of one contact. The deepest contact's height is reported; others are within their crests. */
static double texture_step(judge *j, const knurl_hip_contact *contact, const knurl_tick_output *output) {
    const judge_surface *s = judge_find_surface(j, contact->surface);
    if (!s) {
        return 0.0;
    }
    const double before = s->touched ? s->crest : 0.0;
    if (contact->surface != output->surface) {
        return s->stiffness * (s->crest + before);
    }
    if (s->touched && j->deepest == s->id) {
        const double step = fabs(output->height - j->height);
        return s->stiffness * (j->edited ? fmax(step, fabs(output->height)) : step);
    }
    return s->stiffness * (fabs(output->height) + before);
}

double judge_texture_steps(judge *j, const knurl_tick_output *output, const knurl_hip_contact *contacts,
                           uint32_t count) {
    double steps = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        steps += texture_step(j, &contacts[i], output);
    }
    judge_forget_contacts(j);
    for (uint32_t i = 0; i < count; i++) {
        judge_surface *s = judge_find_surface(j, contacts[i].surface);
        if (s) {
            s->touched = 1;
        }
    }
    j->deepest = output->surface;
    j->height = output->height;
    return steps;
}

double judge_wave_step(judge *j) {
    const double value = j->wave_tick < j->wave_ticks ? knurl_wave_value(&j->wave, j->wave_tick++) : 0.0;
    const double step = fabs(value - j->wave_value);
    j->wave_value = value;
    return step;
}
