/* A simulated person for knurl verify, who does as asked. SPDX-License-Identifier: MIT */
#include "verify.h"

#include <math.h>
#include <stdio.h>

#define PI      3.141592653589793
#define GRAVITY 9.80665
#define MOVE_S  1.0 /* to both ends and back */
#define BEFORE  0.1 /* s of rest before a motion */

/* A fake device's grip is let go, or taken again, by opening it anew. */
static int hold(verify *v, verify_hand *h, int is_loose) {
    char uri[1024];
    (void)snprintf(uri, sizeof uri, "%s%s", h->uri, is_loose ? "&hand_stiffness=0&hand_damping=0" : "");
    h->is_loose = is_loose;
    knurl_device_close(v->device);
    v->device = NULL;
    return verify_open(uri, &v->device) != KNURL_OK;
}

static int ask(verify *v, verify_wish wish, const char *sentence) {
    verify_hand *h = v->hand;
    const int is_loose = wish == VERIFY_HANG || wish == VERIFY_LET_GO;
    (void)sentence;
    h->weight = wish == VERIFY_HANG ? GRAVITY * v->mass : 0.0;
    h->wish = wish;
    h->ticks = 0;
    return h->uri && h->is_loose != is_loose ? hold(v, h, is_loose) : wish == VERIFY_STOP;
}

/* To one end of the workspace, to the other, and back, in whole counts of the encoders. */
static void move_along(const verify *v, int axis, double t, double position[3]) {
    const double size = v->info.workspace_max[axis] - v->info.workspace_min[axis];
    const double quantum = fmax(v->info.resolution, 1e-7);
    const double part = fmin(fmax(t - BEFORE, 0.0) / MOVE_S, 1.0);
    const double way = 0.5 * (size > 0.0 ? size : 0.1) * sin(2.0 * PI * part);
    position[axis] += quantum * floor(way / quantum + 0.5);
}

/* To the left by 60 degrees, and back. */
static void turn(double t, double q[4]) {
    const double half = PI / 6.0 * sin(PI * fmin(t / MOVE_S, 1.0));
    const double s = sin(half);
    const double c = cos(half);
    const double old[4] = {q[0], q[1], q[2], q[3]};
    q[0] = c * old[0] + s * old[2];
    q[1] = c * old[1] + s * old[3];
    q[2] = c * old[2] - s * old[0];
    q[3] = c * old[3] - s * old[1];
}

static void move(verify *v, knurl_device_sample *sample) {
    verify_hand *h = v->hand;
    const double t = (double)h->ticks++ / VERIFY_RATE;
    if (h->wish >= VERIFY_RIGHT && h->wish <= VERIFY_TOWARDS) {
        move_along(v, (int)(h->wish - VERIFY_RIGHT), t, sample->position);
    } else if (h->wish == VERIFY_PRESS) {
        sample->buttons ^= t > 0.2 && t < 0.4 ? 1u : 0u;
    } else if (h->wish == VERIFY_TURN) {
        turn(t, sample->orientation);
    }
}

static void push(verify *v, double force[3]) {
    force[1] -= ((const verify_hand *)v->hand)->weight;
}

const verify_person verify_hand_person = {ask, move, push};
