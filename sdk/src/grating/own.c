/* Methods of the caller's own: registered for the whole process, and held within what they stated.
 * SPDX-License-Identifier: MIT */
#include "base/atomic.h"
#include "base/base.h"
#include "base/rule.h"
#include "grating/follow.h"
#include "grating/method.h"

#include <string.h>

#define LONGEST_NAME 31
#define CREST_MAX    10.0

typedef struct own_method {
    char name[LONGEST_NAME + 1];
    knurl_method_function function;
    void *user;
    double crest;
    uint64_t faults; /* atomic: several haptic threads count */
} own_method;

static own_method own[KNURL_OWN_METHODS];

/* The memory of an own method is in the event, which S2 fills in before it plays one, and no other method uses. */
typedef double own_memory[4];
typedef char memory_fits[sizeof(knurl_vibration_event) == sizeof(own_memory) ? 1 : -1];

static knurl_height own_height;

static double own_height(const knurl_grating *grating, knurl_grating_state *state, knurl_along position,
                         knurl_along velocity, double period, int32_t has_position, knurl_grating_output *output) {
    own_method *of = &own[grating->method - KNURL_BUILT_IN_METHODS];
    const double *fs = grating->spatial_frequency;
    const knurl_along at = knurl_follow(state, position, velocity, period, has_position);
    const knurl_method_input input = {
        {fs[0] * at.x, fs[1] * at.y}, {velocity.x, velocity.y}, {fs[0], fs[1]}, output->temporal_frequency, period};
    own_memory memory = {0.0};
    if (state->next_tick == -grating->method) { /* else a contact begins, or another method used it */
        memcpy(memory, &state->event, sizeof memory);
    }
    double height = of->function(&input, memory, of->user);
    memcpy(&state->event, memory, sizeof memory);
    state->next_tick = -grating->method;
    if (KNURL_UNLIKELY(!knurl_is_within(height, -of->crest, of->crest))) {
        __atomic_fetch_add(&of->faults, 1, __ATOMIC_RELAXED);
        height = !knurl_is_finite(height) ? 0.0 : height > 0.0 ? of->crest : -of->crest;
    }
    return grating->amplitude * height;
}

static knurl_result check_name(const char *name) {
    static const char allowed[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
    const size_t length = strlen(name);
    if (length == 0 || length > LONGEST_NAME || strspn(name, allowed) != length) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "name: expected 1 to %d letters, digits, '_' and '-', found '%s'",
                          LONGEST_NAME, name);
    }
    for (int32_t i = 1; knurl_method_name(i); i++) {
        if (strcmp(name, knurl_method_name(i)) == 0) {
            return knurl_fail(KNURL_ERROR_ARGUMENT, "name: expected one that no method has, found '%s'", name);
        }
    }
    return KNURL_OK;
}

knurl_result knurl_method_add(const char *name, double crest, knurl_method_function height, void *user,
                              int32_t *method) {
    KNURL_RULE(GAME, NULL);
    if (KNURL_IS_NULL(name) || KNURL_IS_NULL(method)) {
        return KNURL_ERROR_ARGUMENT;
    }
    if (!height) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "height: expected a function, found null");
    }
    if (!(knurl_is_within(crest, 0.0, CREST_MAX) && crest > 0.0)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "crest: expected above 0 and up to %g (A), found %g", CREST_MAX, crest);
    }
    const knurl_result result = check_name(name);
    if (result) {
        return result;
    }
    const int32_t number = knurl_method_count;
    if (number == KNURL_BUILT_IN_METHODS + KNURL_OWN_METHODS) {
        return knurl_fail(KNURL_ERROR_FULL, "method: expected at most %d own methods, found another, '%s'",
                          KNURL_OWN_METHODS, name);
    }
    own_method *made = &own[number - KNURL_BUILT_IN_METHODS];
    memcpy(made->name, name, strlen(name) + 1);
    made->function = height;
    made->user = user;
    made->crest = crest;
    knurl_methods[number] = (knurl_method){made->name, own_height, crest, 2.0 * crest, 1, 0};
    knurl_store_release(&knurl_method_count, number + 1);
    *method = number;
    return KNURL_OK;
}

uint64_t knurl_method_get_faults(int32_t method) {
    const int is_own = method >= KNURL_BUILT_IN_METHODS && method < knurl_load_acquire(&knurl_method_count);
    return is_own ? knurl_load_relaxed(&own[method - KNURL_BUILT_IN_METHODS].faults) : 0;
}
