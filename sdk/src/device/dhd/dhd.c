/* Force Dimension's omega, delta, sigma and lambda, and a Falcon under its maker's DHD library: an I/O thread sets a
 * force and reads a position. Read exchange() first. SPDX-License-Identifier: MIT */
#include "device/dhd/dhd.h"

#include "base/number.h"
#include "device/dhd/rights.h"
#include "device/driver.h"
#include "device/dynlib.h"
#include "device/link.h"
#include "device/quaternion.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define NATIVE_RATE   1000.0 /* Hz; the library allows more, up to 4000 */
#define STATUS_CYCLES 10u    /* exchanges per status query: too few for a hand to press a button twice */

/* Properties by model: joints with an encoder, N, N/m, m, the peaks of torque (N m) and gripper (N). CHAI3D's
 * cDeltaDevices; lambdas and the other sigmas: as a sigma.7. Continuous ones are not published: a third of the peak. */
static const struct {
    int type;
    uint32_t joints;
    double max_force, max_stiffness, radius, max_torque, max_grip;
} models[] = {
    {DHD_OMEGA, 3, 12.0, 5000.0, 0.075, 0.0, 0.0},      {DHD_OMEGA3, 3, 12.0, 5000.0, 0.075, 0.0, 0.0},
    {DHD_OMEGA6, 6, 12.0, 5000.0, 0.075, 0.0, 0.0},     {DHD_OMEGA6_LEFT, 6, 12.0, 5000.0, 0.075, 0.0, 0.0},
    {DHD_OMEGA7, 7, 12.0, 5000.0, 0.075, 0.0, 8.0},     {DHD_OMEGA7_LEFT, 7, 12.0, 5000.0, 0.075, 0.0, 8.0},
    {DHD_DELTA3, 3, 20.0, 5000.0, 0.15, 0.0, 0.0},      {DHD_DELTA6, 6, 20.0, 5000.0, 0.15, 0.0, 0.0},
    {DHD_SIGMA3, 3, 12.0, 4000.0, 0.09, 0.0, 0.0},      {DHD_SIGMA6, 6, 12.0, 4000.0, 0.09, 0.2, 0.0},
    {DHD_SIGMA6_LEFT, 6, 12.0, 4000.0, 0.09, 0.2, 0.0}, {DHD_SIGMA7, 7, 12.0, 4000.0, 0.09, 0.2, 8.0},
    {DHD_SIGMA7_LEFT, 7, 12.0, 4000.0, 0.09, 0.2, 8.0}, {DHD_LAMBDA3, 3, 12.0, 4000.0, 0.09, 0.0, 0.0},
    {DHD_LAMBDA6, 6, 12.0, 4000.0, 0.09, 0.2, 0.0},     {DHD_LAMBDA6_LEFT, 6, 12.0, 4000.0, 0.09, 0.2, 0.0},
    {DHD_LAMBDA7, 7, 12.0, 4000.0, 0.09, 0.2, 8.0},     {DHD_LAMBDA7_LEFT, 7, 12.0, 4000.0, 0.09, 0.2, 8.0},
    {DHD_FALCON, 3, 8.0, 3000.0, 0.04, 0.0, 0.0}, /* also the weakest: used if the type is unknown */
};

#define MODEL_COUNT (sizeof models / sizeof *models)

typedef struct dhd {
    knurl_device base;
    knurl_link link;
    char index; /* among the connected devices */
    char id;    /* the library's ID of the open device */
    uint32_t is_open;
    size_t model; /* index into models[] */
    char name[64];
    double opens;          /* 1, or -1: the sign of angles and forces that open the gripper */
    uint32_t sets_gravity; /* 1: the URI switches its gravity compensation */
    uint32_t gravity;      /* 1: on, 0: off */
    uint32_t until_status; /* exchanges; of the I/O thread */
} dhd;

static dhd_api api;

static dhd *of(knurl_device *device) {
    return (dhd *)(void *)device; /* first member */
}

static int load_functions(const char *path, char *why, size_t why_size) {
#if defined(_WIN64)
    static const char *const usual[] = {"dhd64.dll"};
#elif defined(_WIN32)
    static const char *const usual[] = {"dhd.dll"};
#elif defined(__APPLE__)
    static const char *const usual[] = {"libdhd.dylib", "libdrd.dylib"};
#else
    static const char *const usual[] = {"libdhd.so", "libdhd.so.3", "libdrd.so", "libdrd.so.3"};
#endif
#define FUNCTION(field, result, symbol, arguments) {#symbol, &api.field},
    static const knurl_dynlib_function functions[] = {DHD_FUNCTIONS(FUNCTION)};
#undef FUNCTION
    const char *named = path[0] ? path : knurl_system_environment("KNURL_DHD_LIBRARY");
    const int is_named = named && named[0];
    static uint32_t state;
    return knurl_dynlib_load(&state, is_named ? &named : usual, is_named ? 1 : sizeof usual / sizeof *usual, functions,
                             sizeof functions / sizeof *functions, why, why_size);
}

#define NO_LIBRARY                                                                                                     \
    "Force Dimension's DHD library cannot be loaded: %s; install its SDK, and name the library by ?library=PATH or "   \
    "KNURL_DHD_LIBRARY if it is elsewhere"

/* --- the exchange --- */

static int is_gone(void) {
    const int error = api.error();
    return error == DHD_ERROR_COM || error == DHD_ERROR_NO_DEVICE || error == DHD_ERROR_NOT_AVAILABLE;
}

/* KNURL_FAULT_ why it plays no forces, and the cause if it is KNURL_FAULT_FORCE_OFF; 0 if it plays them. */
static int32_t find_trouble(const int *status, int32_t *cause) {
    *cause = 0;
    if (!status[DHD_STATUS_RESET]) {
        return KNURL_FAULT_UNCALIBRATED;
    }
    if (status[DHD_STATUS_FORCE]) {
        return 0;
    }
    const int told = status[DHD_STATUS_FORCE_OFF_CAUSE];
    const int is_known = told >= KNURL_FORCE_OFF_BUTTON && told <= KNURL_FORCE_OFF_DEADMAN;
    *cause = !status[DHD_STATUS_POWER] ? KNURL_FORCE_OFF_POWER : is_known ? told : KNURL_FORCE_OFF_UNTOLD;
    return KNURL_FAULT_FORCE_OFF;
}

/* KNURL_LINK_POSITION if the device plays forces. */
static int look_at_status(dhd *d) {
    int status[DHD_STATUS_ROOM] = {0};
    int32_t cause = 0;
    if (d->until_status > 0) {
        d->until_status--;
        return d->link.trouble ? KNURL_LINK_OFF : KNURL_LINK_POSITION;
    }
    d->until_status = STATUS_CYCLES - 1;
    if (api.status(status, d->id) < 0) {
        return is_gone() ? KNURL_LINK_LOST : KNURL_LINK_NOTHING;
    }
    if (!status[DHD_STATUS_CONNECTED]) {
        return KNURL_LINK_LOST;
    }
    const int32_t trouble = find_trouble(status, &cause);
    return knurl_link_take_trouble(&d->link, trouble, cause);
}

/* Converts from the library's axes. The rows form a matrix whose columns are the stylus' axes x, y, z. */
static void tell_orientation(dhd *d, double q[4]) {
    double rows[9] = {0.0};
    if (api.get_orientation(rows, d->id) < 0) {
        return;
    }
    double columns[3][3];
    for (int axis = 0; axis < 3; axis++) {
        columns[axis][0] = rows[3 + axis];
        columns[axis][1] = rows[6 + axis];
        columns[axis][2] = rows[axis];
    }
    quaternion_from_axes(columns[1], columns[2], columns[0], q);
}

/* The gripper's angle, and the joints'; both stay 0 if the library refuses them. */
static void tell_angles(dhd *d, knurl_device_sample *sample) {
    double angles[DHD_ANGLES] = {0.0};
    if (d->base.max_grip > 0.0 && api.get_grip(&sample->grip, d->id) >= 0) {
        sample->grip *= d->opens;
    }
    if (api.get_joints(angles, d->id) >= 0) {
        sample->joint_count = models[d->model].joints;
        memcpy(sample->joints, angles, sample->joint_count * sizeof *angles);
    }
}

/* While forces are off, sends zeros: when they are switched on again, the device at once plays the last force sent. */
static int exchange(knurl_device *device, const double force[KNURL_FORCES], knurl_device_sample *sample) {
    dhd *d = of(device);
    double f[KNURL_FORCES];
    double x = NAN;
    double y = NAN;
    double z = NAN;
    const int outcome = look_at_status(d);
    for (int i = 0; i < KNURL_FORCES; i++) {
        f[i] = outcome == KNURL_LINK_POSITION ? force[i] : 0.0;
    }
    const int is_told = api.set_force(f[2], f[0], f[1], f[5], f[3], f[4], d->opens * f[6], d->id) >= 0;
    if (!is_told && is_gone()) {
        return KNURL_LINK_LOST;
    }
    if (outcome != KNURL_LINK_POSITION) {
        return is_told ? outcome : KNURL_LINK_NOTHING;
    }
    if (api.get_position(&x, &y, &z, d->id) < 0) {
        return is_gone() ? KNURL_LINK_LOST : KNURL_LINK_NOTHING;
    }
    sample->position[0] = y;
    sample->position[1] = z;
    sample->position[2] = x;
    sample->buttons = api.buttons(d->id);
    tell_orientation(d, sample->orientation);
    tell_angles(d, sample);
    return is_told ? KNURL_LINK_POSITION : KNURL_LINK_NOTHING;
}

/* --- opening --- */

static knurl_result refuse(const dhd *d, const char *doing) {
    return knurl_fail(is_gone() ? KNURL_ERROR_DEVICE_LOST : KNURL_ERROR_SYSTEM, "device 'dhd:%d': it cannot %s: %s",
                      d->index, doing, api.error_text());
}

static void disconnect(dhd *d) {
    knurl_link_close(&d->link); /* its last exchanges carry no force */
    if (d->is_open) {
        (void)api.enable_force(0, d->id);
        (void)api.close(d->id);
        d->is_open = 0;
    }
}

static size_t find_model(const dhd *d) {
    const int type = api.type(d->id);
    size_t model = 0;
    while (model + 1 < MODEL_COUNT && models[model].type != type) {
        model++;
    }
    return model;
}

/* At the first open. Other threads may read the model and the name later, and the force limit is the model's: another
 * model in its place is not this device. */
static knurl_result identify(dhd *d) {
    const size_t model = find_model(d);
    if (d->name[0]) {
        return model == d->model
                   ? KNURL_OK
                   : knurl_fail(KNURL_ERROR_DEVICE_LOST, "device 'dhd:%d': expected the %s again, found another model",
                                d->index, d->name);
    }
    const char *name = api.name(d->id);
    d->model = model;
    d->opens = api.is_left(d->id) ? -1.0 : 1.0;
    d->base.max_torque = models[model].max_torque / 3.0;
    d->base.max_grip = models[model].max_grip / 3.0;
    (void)snprintf(d->name, sizeof d->name, "Force Dimension %.40s", name ? name : "device");
    return KNURL_OK;
}

static knurl_result connect(dhd *d) {
    char why[256];
    const int count = api.count();
    if (d->index >= count && knurl_usb_is_denied(DHD_USB_VENDOR, why, sizeof why)) {
        return knurl_fail(KNURL_ERROR_SYSTEM, "device 'dhd:%d': %s", d->index, why);
    }
    if (d->index >= count) {
        return knurl_fail(KNURL_ERROR_DEVICE_LOST,
                          "device 'dhd:%d': found %d Force Dimension devices; plug it in, and its power supply as well",
                          d->index, count > 0 ? count : 0);
    }
    const int id = api.open(d->index);
    if (id < 0) {
        return refuse(d, "be opened");
    }
    d->id = (char)id;
    d->is_open = 1;
    d->until_status = 0;
    knurl_result result = identify(d);
    const int is_refused = !result && d->sets_gravity && api.set_gravity((int)d->gravity, d->id) < 0;
    result = is_refused ? refuse(d, "switch its gravity compensation") : result;
    result = result ? result : api.enable_force(1, d->id) < 0 ? refuse(d, "play forces") : KNURL_OK;
    result = result ? result : knurl_link_open(&d->link, &d->base, exchange, NATIVE_RATE);
    if (result) {
        disconnect(d);
    }
    return result;
}

static knurl_result parse(const char *options, dhd *d) {
    char index[KNURL_URI_ROOM];
    char library[KNURL_URI_ROOM];
    char why[512];
    double number = 0.0;
    char gravity[KNURL_URI_ROOM];
    const knurl_uri_key keys[] = {{"library", library}, {"gravity", gravity}};
    knurl_result result = knurl_uri_parse("dhd", options, index, keys, 2);
    result = result ? result : knurl_uri_flag("dhd", "gravity", gravity, &d->gravity);
    if (result) {
        return result;
    }
    d->sets_gravity = gravity[0] != '\0';
    if (index[0] && !(knurl_number(index, strlen(index), &number) && knurl_is_within(number, 0.0, 15.0) &&
                      number == floor(number))) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "device 'dhd': expected dhd or dhd:0 to dhd:15, found 'dhd:%.100s'",
                          index);
    }
    d->index = (char)number;
    return load_functions(library, why, sizeof why)
               ? KNURL_OK
               : knurl_fail(KNURL_ERROR_UNSUPPORTED, "device 'dhd': " NO_LIBRARY, why);
}

static knurl_result dhd_open(const char *options, knurl_device **device) {
    dhd *made = knurl_device_allocate(&knurl_dhd_driver, sizeof *made);
    if (!made) {
        return KNURL_ERROR_MEMORY;
    }
    knurl_result result = parse(options, made);
    result = result ? result : connect(made);
    made->base.max_force = models[made->model].max_force;
    return knurl_device_finish_open(&made->base, result, device);
}

static knurl_result dhd_reopen(knurl_device *device) {
    disconnect(of(device)); /* the thread has already ended */
    return connect(of(device));
}

static void dhd_close(knurl_device *device) {
    disconnect(of(device));
    knurl_device_free(device);
}

static void dhd_list(knurl_listings *listings) {
    static const char name[] = "Force Dimension omega, delta, sigma or lambda";
    char why[512];
    char uri[16];
    if (!load_functions("", why, sizeof why)) {
        knurl_listings_add(listings, "dhd", name, NO_LIBRARY, why);
        return;
    }
    const int count = api.count();
    for (int i = 0; i < count; i++) {
        (void)snprintf(uri, sizeof uri, "dhd:%d", i);
        knurl_listings_add(listings, uri, name, "%s", "");
    }
    if (count <= 0) {
        const int is_denied = knurl_usb_is_denied(DHD_USB_VENDOR, why, sizeof why);
        knurl_listings_add(listings, "dhd", name, "%s",
                           is_denied ? why : "not connected: plug it in, and its power supply as well");
    }
}

static void dhd_info(const knurl_device *device, knurl_device_info *info) {
    const dhd *d = (const dhd *)(const void *)device;
    (void)snprintf(info->name, sizeof info->name, "%s", d->name);
    knurl_device_info_sphere(info, models[d->model].radius);
    info->resolution = 0.00001; /* assumed */
    info->max_force = device->max_force;
    info->max_stiffness = models[d->model].max_stiffness;
    info->continuous_force = device->max_force / 3.0; /* assumed */
    info->heat_time = 60.0;                           /* assumed */
    info->mass = 0.25;                                /* assumed */
    info->viscous = 0.5;                              /* assumed */
    info->coulomb = 0.3;                              /* assumed */
    info->delay = 1.0;                                /* assumed */
    info->native_rate = NATIVE_RATE;
    info->max_torque = device->max_torque;
    info->max_grip = device->max_grip;
}

const knurl_driver knurl_dhd_driver = {
    .uri = "dhd",
    .keeps_heat = 1,
    .list = dhd_list,
    .open = dhd_open,
    .close = dhd_close,
    .get_info = dhd_info,
    .reopen = dhd_reopen,
};
