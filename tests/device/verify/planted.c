/* Planted defects. SPDX-License-Identifier: MIT */
#include "device/verify/planted.h"

#include "base/system.h"
#include "support/close.h"

#define STICKS 0.6  /* N */
#define NOISE  6e-4 /* m from the lowest to the highest */
#define LATE   3    /* ticks more than Knurl knows */

const char *const planted_names[DEFECTS] = {"clean",        "swapped axis",  "half gain", "three ticks late",
                                            "sticky joint", "noisy encoder", "wrong sign"};

static struct {
    verify_hand hand; /* first: verify.hand is its address */
    const device_double *device;
    planted_defect defect;
    uint64_t lateness;  /* ticks */
    double late[24][3]; /* N: a ring */
    double friction[3]; /* N: the force that a sticky joint lets through */
    uint64_t random;
    double strongest, strongest_weighing; /* N: of all forces that verify sent, in a hand and loose */
    uint64_t pushes;
} p;

static volatile sig_atomic_t interrupted;
uint64_t planted_interrupts_at;
int planted_without_mass;

static int ask(verify *v, verify_wish wish, const char *sentence) {
    const int refused = verify_hand_person.ask(v, wish, sentence);
    p.hand.weight = planted_without_mass ? 0.0 : p.hand.weight;
    if (!p.device || (wish == VERIFY_STOP && !(p.device->faults & 1u << DOUBLE_OFF))) {
        return refused;
    }
    p.device->hold(wish != VERIFY_LET_GO && wish != VERIFY_HANG);
    if (wish == VERIFY_PULL || wish == VERIFY_STOP) {
        p.device->inject(wish == VERIFY_PULL ? DOUBLE_UNPLUG : DOUBLE_OFF);
    } else if (wish == VERIFY_PLUG || wish == VERIFY_GO) {
        p.device->inject(DOUBLE_WELL);
    }
    return 0;
}

static void move(verify *v, knurl_device_sample *sample) {
    double *at = sample->position;
    verify_hand_person.move(v, sample);
    if (p.defect == SWAPPED_AXIS) {
        const double x = at[0];
        at[0] = at[2];
        at[2] = x;
    }
    for (int axis = 0; axis < 3 && p.defect == NOISY_ENCODER; axis++) {
        at[axis] += NOISE * ((double)(random_bits(&p.random) >> 40) / 16777216.0 - 0.5);
    }
}

static void push(verify *v, double force[3]) {
    double *late = p.late[p.hand.ticks % p.lateness];
    double *strongest = p.hand.is_loose ? &p.strongest_weighing : &p.strongest;
    *strongest = fmax(*strongest, verify_length(force));
    for (int axis = 0; axis < 3; axis++) {
        const double wanted = force[axis];
        p.friction[axis] = fmax(wanted - STICKS, fmin(wanted + STICKS, p.friction[axis]));
        force[axis] = p.defect == HALF_GAIN                 ? 0.5 * wanted
                      : p.defect == THREE_LATE              ? late[axis]
                      : p.defect == STICKY_JOINT            ? p.friction[axis]
                      : p.defect == WRONG_SIGN && axis == 1 ? -wanted
                                                            : wanted;
        late[axis] = wanted;
    }
    interrupted = interrupted || ++p.pushes == planted_interrupts_at ? 2 : 0;
    verify_hand_person.push(v, force);
}

static double seconds(void) {
    return 1e-9 * (double)knurl_system_now_ns();
}

void planted_run(verify *v, const char *uri, const device_double *device, planted_defect defect, const char *only,
                 const char *skip, double mass) {
    static const verify_person person = {ask, move, push};
    memset(&p, 0, sizeof p);
    memset(v, 0, sizeof *v);
    p.hand.uri = uri;
    p.device = device;
    p.defect = defect;
    p.random = 88172645463325252u;
    interrupted = 0;
    v->interrupted = &interrupted;
    v->person = &person;
    v->hand = &p;
    v->simulated = device == NULL;
    v->seconds = device ? seconds : NULL;
    v->mass = mass;
    v->only = only;
    v->skip = skip;
    v->device = device ? device->open() : NULL;
    if ((uri && verify_open(uri, &v->device)) || !v->device) {
        fail_msg("%s: %s", device ? device->name : "fake", knurl_error_message());
        return;
    }
    knurl_device_info_init(&v->info, sizeof v->info);
    assert_int_equal(knurl_device_get_info(v->device, &v->info), KNURL_OK);
    p.lateness = LATE + (device ? (uint64_t)v->info.delay
                                : 0); /* doubles have less delay than their devices, some have no delay */
    assert_int_equal(verify_run(v), 0);
    if (device) {
        device->close(v->device);
    } else {
        knurl_device_close(v->device);
    }
}

double planted_strongest(int is_weighing) {
    return is_weighing ? p.strongest_weighing : p.strongest;
}
