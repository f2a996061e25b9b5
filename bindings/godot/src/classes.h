/* Classes as tables of properties, methods and signals: register.c registers them, serve.c handles the engine's calls.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_CLASSES_H
#define KNURL_GODOT_CLASSES_H

#include "api.h"

enum { GD_MOST_ARGUMENTS = 5 };

typedef struct gd_class gd_class;

/* First member of every instance's own struct. */
typedef struct gd_instance {
    const gd_class *of;
    GDExtensionObjectPtr object;
} gd_instance;

/* Values are passed by the engine's ptrcall convention: a pointer to a bool, int64, double, float[2] or [3],
 * String, object pointer, packed array; a result is initialised. */
typedef void (*gd_function)(void *self, const void *const *arguments, void *result);

typedef struct gd_argument {
    const char *name;
    GDExtensionVariantType type;
    const char *class_name; /* an object's class, or an int's enum; or null */
} gd_argument;

/* A row with only a name starts a group in the inspector. A property is stored at `offset` in the instance (a String as
 * malloc'ed UTF-8) unless it has a `get`. With `get` and no `set` it is read-only. Numbers must be finite and, if
 * `most` is above `least`, within that range; `hints` with or_greater allows more than `most`. */
typedef struct gd_property {
    const char *name;
    GDExtensionVariantType type;
    size_t offset;
    double least, most, step;
    const char *hints; /* follows the range in the hint string; the whole hint string if there is no range; or null */
    uint32_t hint;     /* PROPERTY_HINT_ of a property without a range */
    void (*get)(void *self, void *value);
    void (*set)(void *self, const void *value);
    void (*changed)(void *self); /* or null */
} gd_property;

typedef struct gd_method_row {
    const char *name;
    GDExtensionVariantType result; /* NIL: void */
    const char *result_class;      /* as of an argument */
    gd_function call;
    uint32_t argument_count;
    gd_argument arguments[GD_MOST_ARGUMENTS];
} gd_method_row;

typedef struct gd_signal_row {
    const char *name;
    uint32_t argument_count;
    gd_argument arguments[2];
} gd_signal_row;

/* A named number; those of an enum are consecutive. */
typedef struct gd_constant_row {
    const char *of, *name;
    int64_t value;
} gd_constant_row;

/* A method of the engine's base class that the engine calls, on any thread. */
typedef struct gd_virtual_row {
    const char *name;
    GDExtensionClassCallVirtual call;
} gd_virtual_row;

struct gd_class {
    const char *name, *base;
    size_t size;             /* of an instance, which is zeroed before init() */
    int (*init)(void *self); /* 0: no memory */
    void (*finish)(void *self);
    void (*notify)(void *self, int32_t what); /* or null */
    gd_function warnings;                     /* _get_configuration_warnings(), or null */
    const gd_property *properties;
    uint32_t property_count;
    const gd_method_row *methods;
    uint32_t method_count;
    const gd_signal_row *signals;
    uint32_t signal_count;
    const gd_constant_row *constants;
    uint32_t constant_count;
    const gd_virtual_row *virtuals;
    uint32_t virtual_count;
    uint32_t is_hidden; /* 1: scripts and the class reference do not see it */
};

enum {
    GD_HINT_NONE = 0,
    GD_HINT_RANGE = 1,
    GD_HINT_ENUM = 2,
    GD_HINT_SUGGESTIONS = 3, /* of texts */
    GD_HINT_FLAGS = 6,
    GD_HINT_FILE = 13,
    GD_HINT_RESOURCE_TYPE = 17
};

enum {
    GD_PREDELETE = 1,
    GD_ENTER_TREE = 10,
    GD_EXIT_TREE = 11,
    GD_PAUSED = 14,
    GD_UNPAUSED = 15,
    GD_INTERNAL_PROCESS = 25,
    GD_DISABLED = 28, /* of process modes */
    GD_ENABLED = 29,
    GD_TRANSFORM_CHANGED = 2000
};

#endif
