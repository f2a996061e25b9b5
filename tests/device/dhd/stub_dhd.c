/* A library with the functions of Force Dimension's DHD that the driver needs, over a simulated omega.3. Its rules are
 * those of the public header and of the reference of its maker's Python counterpart (forcedimension_core): the
 * controller is in its FORCE mode once forces were enabled, until its button, its velocity threshold, its watchdog or
 * another call puts it into BRAKE mode; then it accepts commands, returns 0 and plays no force. The cause is of the
 * last time that forces were switched off, and is kept. Unspecified behaviour is the worst for a driver: a force is
 * held until the next one, unless the cable is pulled (a cause "USBDISCN"). SPDX-License-Identifier: MIT */
#include "stub_dhd.h"

#include "base/system.h"
#include "device/dhd/dhd.h"
#include "device/fake/hand.h"
#include "device/fake/plant.h"
#include "support/double.h"

#include <math.h>
#include <string.h>

#define EXPORT  __attribute__((visibility("default")))
#define STEP    0.0005   /* s */
#define HANG_NS 20000000 /* a call blocks for so long */

#define PROTOTYPE(field, result, symbol, arguments) EXPORT result DHD_CALL symbol arguments;
DHD_FUNCTIONS(PROTOTYPE)
EXPORT void stub_dhd_reset(const stub_dhd_time *time, int strokes);
EXPORT void stub_dhd_inject(int fault);
EXPORT void stub_dhd_ask(double force[3], double others[3]);
EXPORT int64_t stub_dhd_limp_since(void);
EXPORT int stub_dhd_opens(void);
EXPORT void stub_dhd_set(int setting, int value);
EXPORT void stub_dhd_tell_torque(stub_dhd_torque *told);

static struct {
    knurl_mutex mutex;
    stub_dhd_time time;
    int is_ready;
    int strokes;
    int fault;
    int opens;
    int error;
    int is_on; /* forces are enabled */
    int settings[STUB_DHD_SETTINGS];
    int cause;       /* of the last time that they were switched off */
    double force[3]; /* that its motors play */
    double others[3];
    stub_dhd_torque torque;
    int64_t limp_since;
    knurl_plant plant;
    knurl_hand hand;
    double target[3];
    double begun_at, moved_to; /* s */
} stub;

static double seconds(void) {
    return 1e-9 * (double)stub.time.now_ns();
}

void stub_dhd_reset(const stub_dhd_time *time, int strokes) {
    const knurl_plant_config config = {.mass = 0.25,
                                       .viscous = 0.5,
                                       .coulomb = 0.3,
                                       .hand_stiffness = 700.0,
                                       .hand_damping = 5.0,
                                       .resolution = 0.00001,
                                       .max_force = 100.0, /* so that a too large force is detected */
                                       .half_workspace = {0.075, 0.075, 0.075},
                                       .exact = 1};
    static const double middle[3] = {0.0, 0.0, 0.0};
    knurl_stroke_desc stroke;
    memset(&stub, 0, sizeof stub);
    knurl_system_mutex_init(&stub.mutex);
    stub.time = *time;
    stub.strokes = strokes;
    stub.is_ready = 1;
    stub.torque.gravity = -1;
    knurl_stroke_desc_init(&stroke, sizeof stroke);
    (void)knurl_stroke_check(&stroke);
    knurl_hand_init(&stub.hand, &stroke, 0.0, 1);
    if (strokes) {
        knurl_hand_target(&stub.hand, 0.0, STEP, stub.target);
    }
    knurl_plant_init(&stub.plant, &config, strokes ? stub.target : middle);
    stub.begun_at = stub.moved_to = seconds();
    stub.limp_since = stub.time.now_ns();
}

/* Other programs have no test that sets it up. */
static void lock(void) {
    static const stub_dhd_time systems = {knurl_system_now_ns, knurl_system_sleep_until_ns};
    if (!stub.is_ready) {
        stub_dhd_reset(&systems, 1);
    }
    knurl_system_mutex_lock(&stub.mutex);
}

static int end(int error) {
    stub.error = error ? error : stub.error;
    knurl_system_mutex_unlock(&stub.mutex);
    return error ? -1 : 0;
}

static int setting(int which) {
    lock();
    const int value = stub.settings[which];
    (void)end(0);
    return value;
}

/* The present error of a call; 0: no error. */
static int trouble(void) {
    return stub.fault == DOUBLE_UNPLUG ? DHD_ERROR_COM : 0;
}

static void move(void) {
    const double now = seconds();
    stub.moved_to = now - stub.moved_to > 0.05 ? now - 0.05 : stub.moved_to;
    for (; stub.moved_to + STEP <= now; stub.moved_to += STEP) {
        double velocity[3] = {0.0, 0.0, 0.0};
        if (stub.strokes) {
            const double before[3] = {stub.target[0], stub.target[1], stub.target[2]};
            knurl_hand_target(&stub.hand, stub.moved_to + STEP - stub.begun_at, STEP, stub.target);
            for (int axis = 0; axis < 3; axis++) {
                velocity[axis] = (stub.target[axis] - before[axis]) / STEP;
            }
        }
        knurl_plant_write(&stub.plant, stub.force);
        knurl_plant_step(&stub.plant, STEP, stub.target, velocity);
    }
}

static void play(double x, double y, double z) {
    const double before =
        sqrt(stub.force[0] * stub.force[0] + stub.force[1] * stub.force[1] + stub.force[2] * stub.force[2]);
    stub.others[2] = fmax(stub.others[2], sqrt(x * x + y * y + z * z) - before);
    stub.force[0] = y; /* right */
    stub.force[1] = z; /* up */
    stub.force[2] = x; /* towards the user */
    const int is_limp = x == 0.0 && y == 0.0 && z == 0.0;
    stub.limp_since = !is_limp ? 0 : stub.limp_since ? stub.limp_since : stub.time.now_ns();
}

static void turn(const double torque[3], double grip) {
    stub_dhd_torque *t = &stub.torque;
    const double most = sqrt(torque[0] * torque[0] + torque[1] * torque[1] + torque[2] * torque[2]);
    memcpy(t->torque, torque, sizeof t->torque);
    t->grip = grip;
    t->most_torque = most <= t->most_torque ? t->most_torque : most; /* NaN stays to be seen */
    t->most_grip = fabs(grip) <= t->most_grip ? t->most_grip : fabs(grip);
    const int is_limp = stub.force[0] == 0.0 && stub.force[1] == 0.0 && stub.force[2] == 0.0;
    t->alone += is_limp && (most != 0.0 || grip != 0.0);
}

static void switch_off(int cause) {
    static const double none[3];
    play(0.0, 0.0, 0.0);
    turn(none, 0.0);
    stub.is_on = 0;
    stub.cause = cause;
}

int DHD_CALL dhdGetDeviceCount(void) {
    lock();
    const int count = stub.fault != DOUBLE_UNPLUG;
    (void)end(0);
    return count;
}

int DHD_CALL dhdOpenID(char index) {
    lock();
    const int error = index == 0 ? trouble() : DHD_ERROR_NO_DEVICE;
    stub.opens += !error;
    return end(error) ? -1 : 5; /* its id from now on */
}

int DHD_CALL dhdClose(char id) {
    lock();
    stub.opens--;
    switch_off(4);
    return end(id == 5 ? 0 : DHD_ERROR_NO_DEVICE);
}

int DHD_CALL dhdEnableForce(unsigned char on, char id) {
    lock();
    if (!on && stub.is_on) {
        switch_off(4);
    }
    stub.is_on = on && stub.fault != DOUBLE_OFF;
    return end(id == 5 ? trouble() : DHD_ERROR_NO_DEVICE);
}

int DHD_CALL dhdGetSystemType(char id) {
    (void)id;
    const int type = setting(STUB_DHD_TYPE);
    return type ? type : DHD_OMEGA3;
}

const char *DHD_CALL dhdGetSystemName(char id) {
    (void)id;
    return "omega.3";
}

int DHD_CALL dhdGetStatus(int *status, char id) {
    lock();
    (void)id;
    memset(status, 0, 16 * sizeof *status);
    status[0] = 1; /* POWER */
    status[DHD_STATUS_CONNECTED] = 1;
    status[2] = 1; /* STARTED */
    status[DHD_STATUS_RESET] = stub.fault != DOUBLE_UNHOMED;
    status[5] = stub.is_on;  /* FORCE */
    status[6] = !stub.is_on; /* BRAKE */
    status[14] = stub.cause; /* FORCEOFFCAUSE */
    return end(trouble());
}

unsigned DHD_CALL dhdGetButtonMask(char id) {
    (void)id;
    return seconds() - stub.begun_at > 1.0;
}

int DHD_CALL dhdGetPosition(double *x, double *y, double *z, char id) {
    double p[3];
    lock();
    (void)id;
    move();
    knurl_plant_measure(&stub.plant, p);
    const int fault = stub.fault;
    const int error = trouble() ? trouble() : fault == DOUBLE_MUTE || fault == DOUBLE_HANG ? 7 : 0; /* timeout */
    if (!error) {
        *y = fault == DOUBLE_NAN ? (double)NAN : p[0] + (fault == DOUBLE_JUMP ? 0.05 : 0.0);
        *z = p[1];
        *x = p[2];
    }
    (void)end(error);
    stub.time.sleep_until_ns(stub.time.now_ns() + (fault == DOUBLE_HANG ? HANG_NS : 250000)); /* of the USB's */
    return error ? -1 : 1;
}

/* Turned by 90 degrees about z, upwards: its x to the right, its y away from the user. */
int DHD_CALL dhdGetOrientationFrame(double *rows, char id) {
    static const double turned[9] = {0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0};
    (void)id;
    memcpy(rows, turned, sizeof turned);
    return 0;
}

int DHD_CALL dhdSetForceAndTorqueAndGripperForce(double fx, double fy, double fz, double tx, double ty, double tz,
                                                 double grip, char id) {
    lock();
    (void)id;
    move();
    const int error = stub.settings[STUB_DHD_REFUSES] ? 7 : trouble(); /* 7: timeout */
    if (!error && stub.is_on) {
        const double torque[3] = {tx, ty, tz};
        play(fx, fy, fz);
        turn(torque, grip);
    }
    stub.others[0] = fabs(tx) + fabs(ty) + fabs(tz) + fabs(grip);
    stub.others[1] += !stub.is_on && (fx != 0.0 || fy != 0.0 || fz != 0.0 || stub.others[0] != 0.0);
    return end(error) ? -1 : 2; /* a motor is at its limit */
}

int DHD_CALL dhdGetGripperAngleRad(double *angle, char id) {
    (void)id;
    *angle = setting(STUB_DHD_LEFT) ? -0.2 : 0.2;
    return 0;
}

/* As many as its type has; the others stay as they are. */
int DHD_CALL dhdGetJointAngles(double *angles, char id) {
    const int count = dhdGetSystemType(id) == DHD_SIGMA7 ? 7 : 3;
    for (int i = 0; i < count; i++) {
        angles[i] = 0.1 * (i + 1);
    }
    return 0;
}

unsigned char DHD_CALL dhdIsLeftHanded(char id) {
    (void)id;
    return setting(STUB_DHD_LEFT) != 0;
}

int DHD_CALL dhdSetGravityCompensation(int on, char id) {
    (void)id;
    lock();
    stub.torque.gravity = on;
    return end(0);
}

void stub_dhd_tell_torque(stub_dhd_torque *told) {
    lock();
    *told = stub.torque;
    stub.torque.alone = 0;
    stub.torque.most_grip = stub.torque.most_torque = 0.0;
    (void)end(0);
}

int DHD_CALL dhdErrorGetLast(void) {
    lock();
    const int error = stub.error;
    (void)end(0);
    return error;
}

const char *DHD_CALL dhdErrorGetLastStr(void) {
    return dhdErrorGetLast() == DHD_ERROR_COM ? "communication error" : "some error";
}

void stub_dhd_inject(int fault) {
    lock();
    if (fault == DOUBLE_UNPLUG) {
        play(0.0, 0.0, 0.0);
    } else if (fault == DOUBLE_OFF) {
        switch_off(stub.settings[STUB_DHD_CAUSE] ? stub.settings[STUB_DHD_CAUSE] : 1);
    } else if (stub.fault == DOUBLE_OFF) { /* its button is pressed again */
        stub.is_on = 1;
    }
    stub.fault = fault;
    memset(stub.others, 0, sizeof stub.others);
    (void)end(0);
}

void stub_dhd_ask(double force[3], double others[3]) {
    lock();
    memcpy(force, stub.force, sizeof stub.force);
    memcpy(others, stub.others, sizeof stub.others);
    (void)end(0);
}

int64_t stub_dhd_limp_since(void) {
    lock();
    const int64_t since = stub.limp_since;
    (void)end(0);
    return since;
}

void stub_dhd_set(int setting, int value) {
    lock();
    stub.settings[setting] = value;
    if (setting == STUB_DHD_LOOSE) {
        double_hold(&stub.plant, !value);
    }
    (void)end(0);
}

int stub_dhd_opens(void) {
    return stub.opens;
}
