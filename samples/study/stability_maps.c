/* The laboratory's maps. SPDX-License-Identifier: MIT */
#include "stability.h"

#include <math.h>
#include <string.h>

const stability_method stability_methods[] = {{"flat", KNURL_METHOD_DEFAULT, 0},
                                              {"S1", KNURL_METHOD_S1, 1},
                                              {"S2", KNURL_METHOD_S2, 1},
                                              {"bandlimited", KNURL_METHOD_BANDLIMITED, 1},
                                              {NULL, 0, 0}};

#define TEXTURE_A 0.0002 /* m: in the maps of stiffness */
#define FREEZE                                                                                                         \
    2.25 /* s: S2 has ended its event from near rest, at KNURL_S2_DEADBAND on 2 mm at worst; and                       \
            motion stopped by a protection has decayed */
#define SPEEDS 8
#define LEVELS 11

/* The figure of bounds: a flat wall against theory. */
static const struct {
    const char *name, *device;
} bounds[] = {{"damping", "&viscous=%s"}, {"wall damping", "%s"}, {"delay", "&delay=%s"}, {"rate", "%s"}};

static const struct {
    const char *device, *label;
    uint32_t without;
} plants[] = {{"preset=touch&coulomb=0", "Touch without dry friction", KNURL_PROTECT_ALL},
              {"preset=touch&coulomb=0", "Touch without dry friction", 0},
              {"preset=touch", "Touch", KNURL_PROTECT_ALL},
              {"preset=touch", "Touch", 0}};

static const char *const devices[][2] = {{"preset=touch", "Touch"}, {"preset=falcon", "Falcon"}};
static const char *const grips[] = {"loose", "light", "firm"};
static const uint32_t guards[] = {KNURL_PROTECT_ALL, 0};

/* The figure of effects. */
static const int32_t effects[] = {KNURL_EFFECT_SPRING, KNURL_EFFECT_DETENT};
static const char *const hands[] = {"loose", "light", "medium", "firm"};

#define NOTCHES 0.01 /* m: the hand comes from the crest between two */

#define COUNT(array) (sizeof(array) / sizeof *(array))

static int bounds_at(size_t index, stability_map *map) {
    static char device[64];
    if (index >= COUNT(bounds) * COUNT(plants)) {
        return 0;
    }
    const size_t axis = index % COUNT(bounds);
    const size_t plant = index / COUNT(bounds);
    (void)snprintf(device, sizeof device, "%s%s", plants[plant].device, bounds[axis].device);
    map->figure = "stability";
    map->name = bounds[axis].name;
    map->device = device;
    map->label = plants[plant].label;
    map->grip = "loose";
    map->method = 0;
    map->without = plants[plant].without;
    return 1;
}

static int effects_at(size_t index, stability_map *map) {
    if (index >= COUNT(effects) * COUNT(devices) * COUNT(hands) * COUNT(guards)) {
        return 0;
    }
    map->figure = "stability_effects";
    map->name = "wall damping";
    map->without = guards[index % COUNT(guards)];
    map->grip = hands[index / COUNT(guards) % COUNT(hands)];
    map->device = devices[index / (COUNT(guards) * COUNT(hands)) % COUNT(devices)][0];
    map->label = devices[index / (COUNT(guards) * COUNT(hands)) % COUNT(devices)][1];
    map->effect = effects[index / (COUNT(guards) * COUNT(hands) * COUNT(devices))];
    return 1;
}

/* Methods of this library; rows of others are left out. */
static int32_t available(size_t index) {
    for (int32_t i = 0; stability_methods[i].name; i++) {
        knurl_grating g = {.spatial_frequency = {1000.0, 0.0},
                           .amplitude = 1e-4,
                           .update_rate_hz = 1000.0,
                           .method = stability_methods[i].method};
        if (stability_methods[i].texture && knurl_grating_check(&g) != KNURL_OK) {
            continue;
        }
        if (index-- == 0) {
            return i;
        }
    }
    return -1;
}

/* Flat against curved walls, in the grips that have most runaways: all but the firm one. */
static int walls_at(size_t index, stability_map *map) {
    static const int32_t methods[] = {0, 2, 3}; /* flat, S2, bandlimited */
    const size_t walls = 3, grips_here = 2;
    const size_t rows = COUNT(devices) * grips_here * COUNT(guards) * walls;
    if (index >= rows * COUNT(methods)) {
        return 0;
    }
    map->figure = "stability_walls";
    map->name = "speed";
    map->wall = (int32_t)(index % walls);
    map->without = guards[index / walls % COUNT(guards)];
    map->grip = grips[index / (walls * COUNT(guards)) % grips_here];
    map->device = devices[index / (walls * COUNT(guards) * grips_here) % COUNT(devices)][0];
    map->label = devices[index / (walls * COUNT(guards) * grips_here) % COUNT(devices)][1];
    map->method = methods[index / rows];
    return 1;
}

int stability_map_at(const char *figure, size_t index, stability_map *map) {
    const int amplitudes = strcmp(figure, "stability_amplitudes") == 0;
    memset(map, 0, sizeof *map);
    if (strcmp(figure, "stability") == 0) {
        return bounds_at(index, map);
    }
    if (strcmp(figure, "stability_effects") == 0) {
        return effects_at(index, map);
    }
    if (strcmp(figure, "stability_walls") == 0) {
        return walls_at(index, map);
    }
    const size_t rows = COUNT(devices) * COUNT(grips) * COUNT(guards);
    const int32_t method = available(index / rows + (amplitudes ? 1 : 0)); /* a flat wall has no amplitude */
    if (method < 0) {
        return 0;
    }
    const size_t row = index % rows;
    map->figure = figure;
    map->name = "speed";
    map->device = devices[row / (COUNT(grips) * COUNT(guards))][0];
    map->label = devices[row / (COUNT(grips) * COUNT(guards))][1];
    map->grip = grips[row / COUNT(guards) % COUNT(grips)];
    map->without = guards[row % COUNT(guards)];
    map->method = method;
    return 1;
}

static double geometric(double from, double to, size_t i, size_t count) {
    return from * pow(to / from, (double)i / (double)(count - 1));
}

/* Sets the varied quantities: x along the map's axis, y the stiffness or the amplitude. device: room for the URI. */
static void place(const stability_map *map, const knurl_device_info *limits, size_t column, size_t row,
                  char device[160], lab_case *c, stability_cell *cell) {
    const stability_method *method = &stability_methods[map->method];
    char value[32] = "";
    lab_case_init(c);
    c->settle = FREEZE;
    cell->y = geometric(100.0, 10000.0, row, STABILITY_ROWS);
    if (strcmp(map->name, "damping") == 0) {
        cell->x = geometric(0.05, 20.0, column, STABILITY_COLUMNS);
        (void)snprintf(value, sizeof value, "%.15g", cell->x);
    } else if (strcmp(map->name, "wall damping") == 0) {
        cell->x = c->damping = geometric(0.1, 20.0, column, STABILITY_COLUMNS);
    } else if (strcmp(map->name, "delay") == 0) {
        cell->x = (double)column;
        (void)snprintf(value, sizeof value, "%d", (int)column);
    } else if (strcmp(map->name, "rate") == 0) {
        cell->x = c->rate = floor(geometric(250.0, 10000.0, column, STABILITY_COLUMNS) + 0.5);
    } else {
        cell->x = c->speed = geometric(0.01, 0.25, column, SPEEDS);
        cell->y = geometric(100.0, 2.0 * limits->max_stiffness, row, LEVELS);
    }
    (void)snprintf(device, 160, map->device, value);
    c->device = device;
    c->grip = lab_grip_named(map->grip);
    c->without = map->without;
    c->method = method->method;
    c->effect = map->effect;
    if (map->effect == KNURL_EFFECT_DETENT) {
        c->period = NOTCHES;
        c->press = 0.0;
    }
    c->wall = map->wall;
    c->amplitude = method->texture ? TEXTURE_A : 0.0;
    if (strcmp(map->figure, "stability_amplitudes") == 0) {
        c->stiffness = 0.5 * limits->max_stiffness;
        cell->y = c->amplitude = geometric(2e-5, limits->max_force / c->stiffness, row, LEVELS);
    } else {
        c->stiffness = cell->y;
    }
}

size_t stability_map_run(const stability_map *map, lab_signals *signals,
                         stability_cell cells[STABILITY_COLUMNS * STABILITY_ROWS]) {
    const int speeds = strcmp(map->name, "speed") == 0;
    const size_t columns = speeds ? SPEEDS : STABILITY_COLUMNS;
    const size_t rows = speeds ? LEVELS : STABILITY_ROWS;
    knurl_device_info limits;
    knurl_device *device;
    char uri[64];
    knurl_device_info_init(&limits, sizeof limits);
    (void)snprintf(uri, sizeof uri, "fake:?%s", strncmp(map->device, "preset=falcon", 13) == 0 ? "preset=falcon" : "");
    if (knurl_device_open(uri, &device)) {
        return 0;
    }
    (void)knurl_device_get_info(device, &limits);
    knurl_device_close(device);
    for (size_t i = 0; i < columns * rows; i++) {
        char room[160];
        lab_case c;
        place(map, &limits, i % columns, i / columns, room, &c, &cells[i]);
        if (lab_run(&c, signals, &cells[i].result)) {
            return 0;
        }
    }
    return columns * rows;
}
