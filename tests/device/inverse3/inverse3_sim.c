/* The simulated Haply Inverse Service. SPDX-License-Identifier: MIT */
#include "device/inverse3/inverse3_sim.h"

#include "base/vec3.h"

#include <stdio.h>
#include <string.h>

#define STEP  0.0005 /* s */
#define ID    "049D"
#define OTHER "0A11"

/* From the base to the workspace's middle, m, in the service's axes: as a documented position has it. */
static const double middle[3] = {0.0, -0.12, 0.15};

void inverse3_sim_init(inverse3_sim *sim, double seconds, int strokes) {
    const knurl_plant_config config = {.mass = 0.2,
                                       .viscous = 0.5,
                                       .coulomb = 0.3,
                                       .hand_stiffness = 700.0,
                                       .hand_damping = 5.0,
                                       .resolution = 0.00001,
                                       .max_force = 100.0, /* a driver that plays too much is to be seen */
                                       .half_workspace = {0.1, 0.1, 0.1},
                                       .exact = 1};
    knurl_stroke_desc stroke;
    memset(sim, 0, sizeof *sim);
    knurl_stroke_desc_init(&stroke, sizeof stroke);
    (void)knurl_stroke_check(&stroke); /* the default is right; this resolves its speed */
    knurl_hand_init(&sim->hand, &stroke, 0.0, 1);
    sim->strokes = strokes;
    if (strokes) {
        knurl_hand_target(&sim->hand, 0.0, STEP, sim->target);
    }
    knurl_plant_init(&sim->plant, &config, sim->target);
    sim->begun_at = sim->moved_to = sim->limp_since = seconds;
}

static void move(inverse3_sim *sim, double seconds) {
    const double push[3] = {sim->force[0], sim->force[2], -sim->force[1]};
    sim->moved_to = seconds - sim->moved_to > 0.05 ? seconds - 0.05 : sim->moved_to;
    for (; sim->moved_to + STEP <= seconds; sim->moved_to += STEP) {
        double velocity[3] = {0.0, 0.0, 0.0};
        if (sim->strokes) {
            const double before[3] = {sim->target[0], sim->target[1], sim->target[2]};
            knurl_hand_target(&sim->hand, sim->moved_to + STEP - sim->begun_at, STEP, sim->target);
            for (int axis = 0; axis < 3; axis++) {
                velocity[axis] = (sim->target[axis] - before[axis]) / STEP;
            }
        }
        knurl_plant_write(&sim->plant, push);
        knurl_plant_step(&sim->plant, STEP, sim->target, velocity);
    }
}

static void play(inverse3_sim *sim, double seconds, const double force[3]) {
    const double rise = vec3_length(force) - vec3_length(sim->force);
    sim->greatest_rise = fmax(sim->greatest_rise, rise);
    const int is_limp = force[0] == 0.0 && force[1] == 0.0 && force[2] == 0.0;
    sim->limp_since = !is_limp ? -1.0 : sim->limp_since >= 0.0 ? sim->limp_since : seconds;
    memcpy(sim->force, force, sizeof sim->force);
}

static const char config[] =
    "\"config\":{\"type\":\"%s\",\"port\":\"COM12\",\"device_info\":{\"major_version\":7,\"minor_version\":4,"
    "\"id\":\"049D\",\"device_type\":4,\"uuid\":\"0\"},\"gravity_compensation\":{\"enabled\":true,"
    "\"scaling_factor\":1.0},\"handedness\":\"right\",\"streaming_mode\":\"USB\",\"torque_scaling\":{\"enabled\":true},"
    "%s\"basis\":{\"permutation\":\"XYZ\"},\"mount\":{\"position\":{\"x\":0,\"y\":0,\"z\":0},\"rotation\":{\"w\":1,"
    "\"x\":0,\"y\":0,\"z\":0},\"scale\":{\"x\":1,\"y\":1,\"z\":1}},\"filters\":{\"force_gate\":{\"gain\":0.3},"
    "\"damping\":{\"scalar\":%g}}},";

/* Keys in the order of the documentation's example. */
static const char state[] =
    "\"state\":{\"cursor_position\":{\"x\":%s,\"y\":%.17g,\"z\":%.17g},\"cursor_velocity\":{\"x\":0.0,\"y\":0.0,"
    "\"z\":0.0},\"angular_position\":{\"a0\":-30.927332,\"a1\":53.878685,\"a2\":-6.642623},\"body_orientation\":{"
    "\"w\":1.0,\"x\":0.0,\"y\":0.0,\"z\":0.0},\"current_cursor_force\":{\"x\":0,\"y\":0,\"z\":0},"
    "\"control_domain\":\"cartesian\",\"control_mode\":\"idle\",\"transform\":{\"position\":{\"x\":0,\"y\":0,\"z\":0},"
    "\"rotation\":{\"w\":1,\"x\":0,\"y\":0,\"z\":0},\"scale\":{\"x\":1,\"y\":1,\"z\":1}}},\"status\":{"
    "\"calibrated\":%s,\"in_use\":false,\"power_supply\":%s,\"ready\":%s,\"started\":true}}";

/* The handle is turned by 90 degrees to the left from its rest pose, about z, which points up. Its button a is
 * pressed from the first second on. A custom one has its maker's buttons and data as well. */
#define TURNED "\"orientation\":{\"w\":0.7071067811865476,\"x\":0.0,\"y\":0.0,\"z\":0.7071067811865476}"

static const char *const grips[] = {
    [INVERSE3_SIM_WIRELESS] =
        "\"wireless_verse_grip\":[{\"device_id\":\"61576\",\"state\":{" TURNED ",\"buttons\":{\"a\":%s,\"b\":false,"
        "\"c\":false},\"hall\":1,\"battery_level\":%g},\"status\":{\"awake\":true,\"connected\":true,\"ready\":true}}]",
    [INVERSE3_SIM_WIRED] =
        "\"verse_grip\":[{\"device_id\":\"61576\",\"state\":{\"button\":%s,\"hall\":1," TURNED "},\"status\":{}}]",
    [INVERSE3_SIM_CUSTOM] =
        "\"verse_grip\":[],\"wireless_verse_grip\":[],\"custom_verse_grip\":[{\"device_id\":\"1402\",\"state\":{"
        "\"battery_voltage\":4.075,\"battery_level\":0.79,\"buttons\":{\"a\":%s,\"b\":false,\"c\":false},\"hall\":15," TURNED
        ",\"transform\":{},\"transform_velocity\":{},\"extension_data\":[0,3,65,30,5,6,7,8,9,10,11,12]},\"status\":{"
        "\"connected\":true,\"awake\":true,\"ready\":true}}]",
    [INVERSE3_SIM_NO_GRIP] = "\"verse_grip\":[]",
};

static const char *truth(int is_true) {
    return is_true ? "true" : "false";
}

static int put_device(const inverse3_sim *sim, const char *id, const double position[3], int is_first,
                      char text[INVERSE3_SIM_ROOM / 2]) {
    char x[32] = "1e999";
    int length = snprintf(text, INVERSE3_SIM_ROOM / 2, "{\"device_id\":\"%s\",", id);
    if (!sim->is_endless) {
        (void)snprintf(x, sizeof x, "%.17g", position[0]);
    }
    if (is_first) {
        length +=
            snprintf(text + length, INVERSE3_SIM_ROOM / 2 - (size_t)length, config, sim->type ? sim->type : "inverse3",
                     sim->is_old ? "" : "\"preset\":\"defaults\",", sim->damping);
    }
    return length + snprintf(text + length, INVERSE3_SIM_ROOM / 2 - (size_t)length, state, x, position[1], position[2],
                             truth(!sim->is_unhomed), truth(!sim->is_unpowered),
                             truth(!sim->is_not_ready && !sim->is_unpowered && !sim->is_unhomed));
}

static int say(inverse3_sim *sim, double seconds, int is_first, char text[INVERSE3_SIM_ROOM]) {
    static const double elsewhere[3] = {0.05, 0.05, 0.05};
    char other[INVERSE3_SIM_ROOM / 2] = "";
    char device[INVERSE3_SIM_ROOM / 2] = "";
    double p[3];
    int length = 0;
    move(sim, seconds);
    knurl_plant_measure(&sim->plant, p);
    const double position[3] = {p[0] + sim->jump + (sim->is_centered ? 0.0 : middle[0]),
                                -p[2] + (sim->is_centered ? 0.0 : middle[1]),
                                p[1] + (sim->is_centered ? 0.0 : middle[2])};
    if (sim->has_second) {
        (void)put_device(sim, OTHER, elsewhere, is_first, other);
    }
    const int is_there = !sim->is_gone && sim->is_left_out == 0;
    sim->is_left_out -= sim->is_left_out > 0;
    if (is_there) {
        (void)put_device(sim, ID, position, is_first, device);
    }
    length = snprintf(text, INVERSE3_SIM_ROOM, "{\"session_id\":7,\"inverse3\":[%s%s%s],", other,
                      other[0] && device[0] ? "," : "", device);
    length += snprintf(text + length, INVERSE3_SIM_ROOM - (size_t)length, grips[sim->grip],
                       truth(seconds - sim->begun_at > 1.0), 1.0 - sim->discharged);
    return length + snprintf(text + length, INVERSE3_SIM_ROOM - (size_t)length, "}");
}

int inverse3_sim_greet(inverse3_sim *sim, double seconds, char text[INVERSE3_SIM_ROOM]) {
    sim->is_centered = 0; /* a connection is a session with a configuration of its own */
    sim->damping = 2.0;   /* the Hub's setting for sessions that do not set it */
    return say(sim, seconds, 1, text);
}

int inverse3_sim_hear(inverse3_sim *sim, double seconds, const char *message, char text[INVERSE3_SIM_ROOM]) {
    double f[3];
    const char *set = strstr(message, "{\"vector\":{");
    const int is_force =
        set && strstr(message, "\"set_cursor_force\":{\"vector\":") &&
        /* NOLINTNEXTLINE(bugprone-unchecked-string-to-number-conversion,cert-err34-c): tests' locale */
        sscanf(set, "{\"vector\":{\"x\":%lf,\"y\":%lf,\"z\":%lf}}", &f[0], &f[1], &f[2]) == 3;
    move(sim, seconds);
    const char *configure = sim->is_old ? NULL : strstr(message, "\"configure\":{");
    if (configure && strstr(configure, "\"preset\":{\"preset\":\"arm_front_centered\"}")) {
        sim->is_centered = 1;
    }
    if (configure && strstr(configure, "\"gravity_compensation\":{\"enabled\":")) {
        sim->gravity = strstr(configure, "\"enabled\":true") ? 1 : -1;
    }
    if (configure && strstr(configure, "\"damping\":{\"scalar\":0}")) {
        sim->damping = 0.0;
    }
    if (is_force && strstr(message, "\"device_id\":\"" ID "\"")) {
        sim->told_while_off += (sim->is_unpowered || sim->is_not_ready) && (f[0] != 0.0 || f[1] != 0.0 || f[2] != 0.0);
        memcpy(sim->told, f, sizeof f);
        memset(f, 0, sim->is_gone || sim->is_unpowered || sim->is_not_ready ? sizeof f : 0); /* its motors cannot */
        play(sim, seconds, f);
    } else if (is_force && strstr(message, "\"device_id\":\"" OTHER "\"")) {
        memcpy(sim->force_of_second, f, sizeof f);
    }
    return say(sim, seconds, 0, text);
}

void inverse3_sim_unplug(inverse3_sim *sim, double seconds) {
    static const double none[3] = {0.0, 0.0, 0.0};
    sim->is_gone = 1;
    play(sim, seconds, none);
}

void inverse3_sim_power(inverse3_sim *sim, double seconds, int is_on) {
    static const double none[3] = {0.0, 0.0, 0.0};
    sim->is_unpowered = !is_on;
    if (!is_on) {
        play(sim, seconds, none);
    }
}
