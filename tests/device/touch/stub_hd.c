/* A libHD of our own: a scheduler thread, three devices (each a plant in a hand), errors and faults on command, and a
 * count of calls that violate the API's reference. Unspecified behaviour is the worst for a driver: a force is held
 * until the next frame's, even of a device that is disabled, a device that is unscheduled may still be in its callback,
 * errors go on one stack and the current device is one for all threads. SPDX-License-Identifier: MIT */
#include "stub_state.h"

stub_state hd = {
    .time = {knurl_system_now_ns, knurl_system_sleep_until_ns, knurl_system_start_thread, knurl_system_join_thread},
    .current = NONE,
    .rate = 1000.0,
    .random = 88172645463325252u};

__attribute__((constructor)) static void prepare(void) {
    knurl_system_mutex_init(&hd.mutex);
}

static uint64_t random_bits(void) {
    hd.random ^= hd.random << 13;
    hd.random ^= hd.random >> 7;
    hd.random ^= hd.random << 17;
    return hd.random;
}

/* Any double at all, or one of everyday's. */
static double random_double(void) {
    const uint64_t bits = random_bits();
    double value;
    memcpy(&value, &bits, sizeof value);
    return random_bits() % 2 ? value : (double)(int64_t)(bits % 401) - 200.0;
}

/* The device with that handle, in use; null: misuse. */
static simulated *used(hd_device handle) {
    if (handle < STUB_DEVICES && hd.devices[handle].answers[STUB_INITIALISED] > 0.0) {
        return &hd.devices[handle];
    }
    misuse(0x0104);
    return NULL;
}

static simulated *current(void) {
    return used(hd.current == NONE ? HD_NO_DEVICE : (hd_device)hd.current);
}

/* As known from other drivers: the device offers several styles, and a call calibrates by one of them. */
static hd_enum styles_of(const simulated *d) {
    const hd_enum set = (hd_enum)d->settings[STUB_STYLES];
    return set ? set : HD_STYLE_AUTO | HD_STYLE_INKWELL;
}

/* --- devices --- */

/* For programs: KNURL_STUB_HD=absent, or fail_at=500 (frames; it is plugged in again at the next attempt), or hang (in
 * hdInitDevice()), or garbage (absent, and as STUB_GARBAGE). */
static void read_environment(simulated *d) {
    static int failed;
    const char *wish = getenv("KNURL_STUB_HD");
    if (wish && (strcmp(wish, "absent") == 0 || strcmp(wish, "garbage") == 0)) {
        d->settings[STUB_ABSENT] = 1.0;
    } else if (wish && strncmp(wish, "fail_at=", 8) == 0) {
        d->settings[STUB_FAIL_AT] = failed ? 0.0 : strtod(wish + 8, NULL);
        d->settings[STUB_ABSENT] = 0.0;
        failed = 1;
    }
}

static void put_in_hand(simulated *d) {
    const knurl_plant_config config = {.mass = 0.045,
                                       .viscous = 0.5,
                                       .coulomb = 0.26,
                                       .hand_stiffness = 700.0,
                                       .hand_damping = 5.0,
                                       .resolution = 0.055e-3,
                                       .max_force = 1e3, /* so that a too large force is detected */
                                       .half_workspace = {0.080, 0.060, 0.035},
                                       .delay = 1};
    knurl_stroke_desc stroke;
    knurl_stroke_desc_init(&stroke, sizeof stroke);
    stroke.stroke = d->settings[STUB_STROKE] > 0.0 ? (int32_t)d->settings[STUB_STROKE] : KNURL_STROKE_LINE;
    (void)knurl_stroke_check(&stroke);
    knurl_hand_init(&d->hand, &stroke, 0.00002, 1);
    knurl_hand_target(&d->hand, 0.0, 1e-3, d->target);
    knurl_plant_init(&d->plant, &config, d->target);
    d->time = 0.0;
    d->limp_since = now_ns();
}

static stub_told *mirror;

void stub_mirror(stub_told *to) {
    lock();
    mirror = to;
    unlock();
}

static void tell_motors(simulated *d, const double force[3]) {
    const double length = sqrt(force[0] * force[0] + force[1] * force[1] + force[2] * force[2]);
    if (!isfinite(length)) {
        d->answers[STUB_TOLD_BAD]++;
        return;
    }
    d->answers[STUB_GAPS] += d->answers[STUB_TOLD] > 0.0 && !(length > 0.0);
    d->answers[STUB_TOLD] = length;
    d->answers[STUB_TOLD_MOST] = fmax(length, d->answers[STUB_TOLD_MOST]);
    d->limp_since = length > 0.0 ? 0 : d->limp_since ? d->limp_since : now_ns();
    if (mirror && d == &hd.devices[STUB_DEFAULT]) {
        mirror->newton = length;
        __atomic_store_n(&mirror->limp_since, d->limp_since, __ATOMIC_RELEASE);
    }
    knurl_plant_write(&d->plant, force);
}

void stub_move(simulated *d, double dt) {
    double before[3];
    double velocity[3];
    memcpy(before, d->target, sizeof before);
    d->time += dt;
    knurl_hand_target(&d->hand, d->time, dt, d->target);
    for (int axis = 0; axis < 3; axis++) {
        velocity[axis] = (d->target[axis] - before[axis]) / dt;
    }
    knurl_plant_step(&d->plant, dt, d->target, velocity);
}

hd_device HD_CALL hdInitDevice(const char *name) {
    static const char *const names[] = {"Default Device", "Left Device", "Right Device"};
    hd_device made = HD_NO_DEVICE;
    const char *wish = getenv("KNURL_STUB_HD");
    while (wish && strcmp(wish, "hang") == 0) {
        nap(1000000000);
    }
    lock();
    if (hd.runs) { /* SOFA stops the scheduler first */
        misuse(0x0102);
    }
    if (hd.has_failed && (hd.settings[STUB_GARBAGE] > 0.0 || (wish && strcmp(wish, "garbage") == 0))) {
        hd.has_failed = 0;
        unlock();
        return 70707;
    }
    for (int i = 0; i < STUB_DEVICES; i++) {
        simulated *d = &hd.devices[i];
        if (strcmp(name ? name : names[STUB_DEFAULT], names[i]) != 0) {
            continue;
        }
        read_environment(d);
        if (d->answers[STUB_INITIALISED] > 0.0) {
            push(0x0301, NONE);
            unlock();
            return HD_NO_DEVICE;
        }
        if (d->settings[STUB_ABSENT] > 0.0) {
            break;
        }
        if (d->settings[STUB_INIT_ERROR] > 0.0) {
            push((uint32_t)d->settings[STUB_INIT_ERROR], NONE);
        }
        made = (hd_device)i;
        d->answers[STUB_INITIALISED] = 1.0;
        d->force_output = 0;
        d->in_frame = 0;
        put_in_hand(d);
        hd.current = i;
        break;
    }
    hd.has_failed = made == HD_NO_DEVICE;
    if (hd.has_failed) {
        push(0x0302, NONE);
    }
    unlock();
    return made;
}

void HD_CALL hdDisableDevice(hd_device device) {
    lock();
    simulated *d = used(device);
    if (d) {
        if (d->in_frame) {
            misuse(0x0102);
        }
        d->answers[STUB_INITIALISED] = 0.0;
        hd.current = hd.current == (int)device ? NONE : hd.current;
    }
    unlock();
}

void HD_CALL hdMakeCurrentDevice(hd_device device) {
    lock();
    if (used(device)) {
        hd.current = (int)device;
    }
    const int dawdles = hd.settings[STUB_DAWDLES] > 0.0 && hd.runs && knurl_system_thread_id() != hd.thread_id;
    unlock();
    if (dawdles) {
        nap(5000000);
    }
}

static void drift(void) {
    for (int i = 0; i < STUB_DEVICES && hd.settings[STUB_DRIFTS] > 0.0; i++) {
        if (i != hd.current && hd.devices[i].answers[STUB_INITIALISED] > 0.0) {
            hd.current = i;
            break;
        }
    }
}

/* Spontaneous errors of a frame. */
static void make_errors(simulated *d, int index) {
    if (d->settings[STUB_FAIL_AT] > 0.0) {
        d->settings[STUB_FAIL_AT]--;
        d->settings[STUB_ABSENT] = d->settings[STUB_FAIL_AT] == 0.0;
    }
    if (d->settings[STUB_ABSENT] > 0.0) {
        push(0x0302, index);
    }
    if (d->settings[STUB_ERROR] > 0.0) {
        push((uint32_t)d->settings[STUB_ERROR], index);
        for (int i = 1; i < (int)d->settings[STUB_ERRORS]; i++) {
            push((uint32_t)d->settings[STUB_ERROR], index);
        }
        hd.endless = d->settings[STUB_ERRORS] < 0.0;
    }
    if (d->settings[STUB_RANDOM] > 0.0) {
        for (uint64_t i = random_bits() % 4; i > 0; i--) {
            const uint64_t code = random_bits() % 0x700;
            push(knurl_hd_error_is_loss((uint32_t)code) ? 0x0100 : (uint32_t)code, index);
        }
    }
}

hd_device HD_CALL hdGetCurrentDevice(void) {
    lock();
    const hd_device device = hd.current == NONE ? HD_NO_DEVICE : (hd_device)hd.current;
    unlock();
    return device;
}

void HD_CALL hdBeginFrame(hd_device device) {
    lock();
    simulated *d = used(device);
    if (d) {
        if (d->in_frame) {
            misuse(0x0402);
        }
        d->in_frame = 1;
        memset(d->force, 0, sizeof d->force);
        drift();
    }
    unlock();
}

void HD_CALL hdEndFrame(hd_device device) {
    static const double none[3] = {0.0, 0.0, 0.0};
    lock();
    simulated *d = used(device);
    if (d) {
        if (!d->in_frame) {
            misuse(0x0401);
        }
        d->in_frame = 0;
        d->answers[STUB_FRAMES]++;
        tell_motors(d, d->force_output && d->settings[STUB_ABSENT] == 0.0 ? d->force : none);
        make_errors(d, (int)device);
        if (d->answers[STUB_TOLD] > OVERLOAD * 3.3) {
            push(0x0201, (int)device);
        }
    }
    unlock();
}

static void switch_output(hd_enum what, int on) {
    static const double none[3] = {0.0, 0.0, 0.0};
    lock();
    simulated *d = current();
    if (d && what == HD_FORCE_OUTPUT) {
        d->force_output = on;
        if (!on) {
            tell_motors(d, none);
        }
    } else if (d) {
        misuse(0x0100);
    }
    unlock();
}

void HD_CALL hdEnable(hd_enum what) {
    switch_output(what, 1);
}

void HD_CALL hdDisable(hd_enum what) {
    switch_output(what, 0);
}

void HD_CALL hdGetIntegerv(hd_enum what, int32_t *values) {
    lock();
    const simulated *d = current();
    if (d && what == HD_CALIBRATION_STYLE) {
        *values = (int32_t)styles_of(d);
    } else if (what != HD_BUTTONS) {
        misuse(0x0100);
    } else if (d) {
        *values = d->settings[STUB_RANDOM] > 0.0 ? (int32_t)(uint32_t)random_bits() : d->time > 1.0;
    }
    unlock();
}

static void tell_position(const simulated *d, double mm[3]) {
    knurl_plant_measure(&d->plant, mm);
    mm[0] += d->settings[STUB_JUMP];
    for (int axis = 0; axis < 3; axis++) {
        mm[axis] = d->settings[STUB_NAN] > 0.0      ? NAN
                   : d->settings[STUB_RANDOM] > 0.0 ? random_double()
                                                    : 1000.0 * mm[axis];
    }
}

void HD_CALL hdGetDoublev(hd_enum what, double *values) {
    static const double workspace[6] = {-80.0, -60.0, -35.0, 80.0, 60.0, 35.0};
    static const double joints[6] = {0.1, 0.2, -0.3, 1.1, -0.7, 3.0};
    static const double transform[16] = {[1] = 1.0, [6] = 1.0, [8] = 1.0, [15] = 1.0}; /* x to y, y to z, z to x */
    lock();
    const simulated *d = current();
    if (d && what == HD_POSITION) {
        tell_position(d, values);
    } else if (d && what == HD_TRANSFORM && d->settings[STUB_RANDOM] == 0.0) {
        memcpy(values, transform, sizeof transform);
    } else if (d && d->settings[STUB_TELLS_NOTHING] > 0.0) {
        push(0x0100, hd.current);
    } else if (d && d->settings[STUB_RANDOM] > 0.0) {
        for (int i = 0; i < (what == HD_USABLE_WORKSPACE              ? 6
                             : what == HD_TRANSFORM                   ? 16
                             : what == HD_JOINTS || what == HD_GIMBAL ? 3
                                                                      : 1);
             i++) {
            values[i] = random_double();
        }
    } else if (d) {
        switch (what) {
        case HD_USABLE_WORKSPACE:
            memcpy(values, workspace, sizeof workspace);
            break;
        case HD_JOINTS:
        case HD_GIMBAL:
            memcpy(values, joints + (what == HD_JOINTS ? 0 : 3), 3 * sizeof *joints);
            break;
        case HD_MAX_FORCE:
            *values = 3.3;
            break;
        case HD_CONTINUOUS_FORCE:
            *values = 0.9;
            break;
        case HD_MAX_STIFFNESS:
            *values = 1.1;
            break;
        case HD_MAX_DAMPING:
            *values = 0.003;
            break;
        default:
            misuse(0x0100);
            break;
        }
    }
    unlock();
}

void HD_CALL hdSetDoublev(hd_enum what, const double *values) {
    lock();
    const int dawdles = hd.settings[STUB_DAWDLES] > 0.0 && knurl_system_thread_id() == hd.thread_id;
    unlock();
    if (dawdles) {
        nap(300000);
    }
    lock();
    simulated *d = current();
    if (what != HD_FORCE) {
        misuse(0x0100);
    } else if (d && !d->in_frame && dawdles) { /* another thread has made it the current one: not the caller's fault */
        push(0x0102, hd.current);
    } else if (d && !d->in_frame) {
        misuse(0x0102);
    } else if (d) {
        memcpy(d->force, values, sizeof d->force);
    }
    unlock();
}

const char *HD_CALL hdGetString(hd_enum what) {
    const char *text = "";
    lock();
    const simulated *d = current();
    if (d && d->settings[STUB_TELLS_NOTHING] > 0.0) {
        text = NULL;
        push(0x0100, hd.current);
    } else if (d) {
        text = what == HD_MODEL ? "Touch of straw" : what == HD_VERSION ? "3.4.0" : "2023.11";
    }
    unlock();
    return text;
}

hd_error HD_CALL hdGetError(void) {
    hd_error error = {0, 0, HD_NO_DEVICE};
    lock();
    hd.errors_taken++;
    drift();
    if (hd.error_count > 0) {
        error = hd.errors[hd.error_count - 1];
        hd.error_count -= !hd.endless;
    }
    unlock();
    return error;
}

#if !defined(STUB_LACKS_CALIBRATION)
hd_enum HD_CALL hdCheckCalibration(void) {
    lock();
    const simulated *d = current();
    const double told = d ? d->settings[STUB_CALIBRATION] : 0.0;
    const hd_enum state = told > 0.0 ? (hd_enum)told : HD_CALIBRATED;
    unlock();
    return state;
}
#endif

void HD_CALL hdUpdateCalibration(hd_enum style) {
    lock();
    simulated *d = current();
    if (d) {
        const int is_one = style == HD_STYLE_ENCODER || style == HD_STYLE_AUTO || style == HD_STYLE_INKWELL;
        if (d->in_frame) {
            misuse(0x0102);
        }
        d->answers[STUB_UPDATES]++;
        d->answers[STUB_LAST_STYLE] = style;
        if (!is_one || !(style & styles_of(d))) {
            push(0x0101, hd.current);
        } else if (d->settings[STUB_MENDS] > 0.0) {
            d->settings[STUB_CALIBRATION] = 0.0;
        }
    }
    unlock();
}
