/* Registers the classes of the tables with the engine. SPDX-License-Identifier: MIT */
#include "register.h"

#include "serve.h"

#include <stdio.h>
#include <string.h>

enum { USAGE_DEFAULT = 6, USAGE_SHOWN_ONLY = 4 | 268435456 /* EDITOR, READ_ONLY */, USAGE_IS_ENUM = 65536 };

/* A property's description and the values that it points to. */
typedef struct description {
    gd_name name, class_name;
    gd_string hint;
    GDExtensionPropertyInfo info;
} description;

static void describe(description *d, const gd_argument *argument, uint32_t hint, const char *hint_text,
                     uint32_t usage) {
    d->name = gd_name_new(argument->name);
    d->class_name = gd_name_new(argument->class_name ? argument->class_name : "");
    gd.string_new_with_utf8_chars(&d->hint, hint_text);
    d->info.type = argument->type;
    d->info.name = &d->name;
    d->info.class_name = &d->class_name;
    d->info.hint = hint;
    d->info.hint_string = &d->hint;
    d->info.usage = argument->type == GDEXTENSION_VARIANT_TYPE_INT && argument->class_name
                        ? usage | (uint32_t)USAGE_IS_ENUM
                        : usage;
}

static void end_description(description *d) {
    gd_name_end(&d->name);
    gd_name_end(&d->class_name);
    gd_types[GDEXTENSION_VARIANT_TYPE_STRING].end(&d->hint);
}

typedef struct method_entry {
    const char *name;
    void *row;
    GDExtensionClassMethodCall call;
    GDExtensionClassMethodPtrCall ptrcall;
    gd_argument result;
    const gd_argument *arguments;
    uint32_t argument_count;
    int is_const;
} method_entry;

static void register_method(const gd_class *class, const method_entry *entry) {
    description result;
    description arguments[GD_MOST_ARGUMENTS];
    GDExtensionPropertyInfo infos[GD_MOST_ARGUMENTS];
    GDExtensionClassMethodArgumentMetadata metadata[GD_MOST_ARGUMENTS];
    GDExtensionClassMethodInfo info;
    gd_name class_name = gd_name_new(class->name);
    gd_name name = gd_name_new(entry->name);
    memset(&info, 0, sizeof info);
    memset(metadata, 0, sizeof metadata);
    describe(&result, &entry->result, GD_HINT_NONE, "", USAGE_DEFAULT);
    for (uint32_t i = 0; i < entry->argument_count; i++) {
        describe(&arguments[i], &entry->arguments[i], GD_HINT_NONE, "", USAGE_DEFAULT);
        infos[i] = arguments[i].info;
    }
    info.name = &name;
    info.method_userdata = entry->row;
    info.call_func = entry->call;
    info.ptrcall_func = entry->ptrcall;
    info.method_flags =
        (uint32_t)GDEXTENSION_METHOD_FLAGS_DEFAULT | (entry->is_const ? (uint32_t)GDEXTENSION_METHOD_FLAG_CONST : 0u);
    info.has_return_value = entry->result.type != GDEXTENSION_VARIANT_TYPE_NIL;
    info.return_value_info = &result.info;
    info.argument_count = entry->argument_count;
    info.arguments_info = infos;
    info.arguments_metadata = metadata;
    gd.classdb_register_extension_class_method(gd_library, &class_name, &info);
    for (uint32_t i = 0; i < entry->argument_count; i++) {
        end_description(&arguments[i]);
    }
    end_description(&result);
    gd_name_end(&name);
    gd_name_end(&class_name);
}

/* The class of a property's value: the object class in its hint, or the class's enum with the property's name. text:
 * the enum's name, at least 64 bytes. */
static const char *class_of(const gd_class *class, const gd_property *property, char *text) {
    if (property->hint == GD_HINT_RESOURCE_TYPE) {
        return property->hints;
    }
    for (uint32_t i = 0; i < class->constant_count; i++) {
        const char *of = class->constants[i].of;
        if ((of[0] | 0x20) == property->name[0] && strcmp(of + 1, property->name + 1) == 0) {
            (void)snprintf(text, 64, "%s.%s", class->name, of);
            return text;
        }
    }
    return NULL;
}

static void register_group(const gd_class *class, const char *text) {
    gd_string name;
    gd_string prefix;
    gd_name class_name = gd_name_new(class->name);
    gd.string_new_with_utf8_chars(&name, text);
    gd.string_new_with_utf8_chars(&prefix, "");
    gd.classdb_register_extension_class_property_group(gd_library, &class_name, &name, &prefix);
    gd_types[GDEXTENSION_VARIANT_TYPE_STRING].end(&prefix);
    gd_types[GDEXTENSION_VARIANT_TYPE_STRING].end(&name);
    gd_name_end(&class_name);
}

static void register_accessors(const gd_class *class, const gd_property *property, const char *getter,
                               const char *setter) {
    char enum_name[64];
    const gd_argument value = {"value", property->type, class_of(class, property, enum_name)};
    const gd_argument nothing = {"", GDEXTENSION_VARIANT_TYPE_NIL, NULL};
    void *row = gd_unconst(property);
    const method_entry get = {getter, row, gd_getter_call, gd_getter_ptrcall, value, NULL, 0, 1};
    const method_entry set = {setter, row, gd_setter_call, gd_setter_ptrcall, nothing, &value, 1, 0};
    register_method(class, &get);
    if (setter[0]) {
        register_method(class, &set);
    }
}

static void register_property(const gd_class *class, const gd_property *property) {
    const int is_boolean = property->type == GDEXTENSION_VARIANT_TYPE_BOOL;
    const int has_range = property->most > property->least && property->hint == GD_HINT_NONE;
    const int is_read_only = property->get && !property->set;
    /* State of a running device is shown only in games (remote inspector), not in the editor. */
    const uint32_t told = gd_is_in_editor() ? 0 : (uint32_t)USAGE_SHOWN_ONLY;
    char enum_name[64];
    const gd_argument argument = {property->name, property->type, class_of(class, property, enum_name)};
    char getter[64];
    char setter[64] = "";
    char hint[160];
    description d;
    (void)snprintf(getter, sizeof getter, "%s_%s", is_boolean ? "is" : "get", property->name);
    if (!is_read_only) {
        (void)snprintf(setter, sizeof setter, "set_%s", property->name);
    }
    if (has_range) {
        (void)snprintf(hint, sizeof hint, "%g,%g,%g%s%s", property->least, property->most, property->step,
                       property->hints ? "," : "", property->hints ? property->hints : "");
    } else {
        (void)snprintf(hint, sizeof hint, "%s", property->hints ? property->hints : "");
    }
    register_accessors(class, property, getter, setter);
    describe(&d, &argument, has_range ? (uint32_t)GD_HINT_RANGE : property->hint, hint,
             is_read_only ? told : (uint32_t)USAGE_DEFAULT);
    gd_name class_name = gd_name_new(class->name);
    gd_name get = gd_name_new(getter);
    gd_name set = gd_name_new(setter);
    gd.classdb_register_extension_class_property(gd_library, &class_name, &d.info, &set, &get);
    gd_name_end(&set);
    gd_name_end(&get);
    gd_name_end(&class_name);
    end_description(&d);
}

static void register_signal(const gd_class *class, const gd_signal_row *signal) {
    description arguments[2];
    GDExtensionPropertyInfo infos[2];
    gd_name class_name = gd_name_new(class->name);
    gd_name name = gd_name_new(signal->name);
    for (uint32_t i = 0; i < signal->argument_count; i++) {
        describe(&arguments[i], &signal->arguments[i], GD_HINT_NONE, "", USAGE_DEFAULT);
        infos[i] = arguments[i].info;
    }
    gd.classdb_register_extension_class_signal(gd_library, &class_name, &name, infos, signal->argument_count);
    for (uint32_t i = 0; i < signal->argument_count; i++) {
        end_description(&arguments[i]);
    }
    gd_name_end(&name);
    gd_name_end(&class_name);
}

static void register_constant(const gd_class *class, const gd_constant_row *constant) {
    gd_name class_name = gd_name_new(class->name);
    gd_name of = gd_name_new(constant->of);
    gd_name name = gd_name_new(constant->name);
    gd.classdb_register_extension_class_integer_constant(gd_library, &class_name, &of, &name, constant->value, 0);
    gd_name_end(&name);
    gd_name_end(&of);
    gd_name_end(&class_name);
}

void gd_register(const gd_class *class) {
    GDExtensionClassCreationInfo3 info;
    gd_name name = gd_name_new(class->name);
    gd_name base = gd_name_new(class->base);
    memset(&info, 0, sizeof info);
    info.is_exposed = !class->is_hidden;
    info.create_instance_func = gd_create;
    info.free_instance_func = gd_free;
    info.notification_func = gd_notify;
    info.get_virtual_func = gd_find_virtual;
    info.class_userdata = gd_unconst(class);
    gd.classdb_register_extension_class3(gd_library, &name, &base, &info);
    for (uint32_t i = 0; i < class->property_count; i++) {
        if (class->properties[i].type == GDEXTENSION_VARIANT_TYPE_NIL) {
            register_group(class, class->properties[i].name);
        } else {
            register_property(class, &class->properties[i]);
        }
    }
    for (uint32_t i = 0; i < class->method_count; i++) {
        const gd_method_row *m = &class->methods[i];
        const method_entry entry = {m->name,
                                    gd_unconst(m),
                                    gd_method_call,
                                    gd_method_ptrcall,
                                    {"", m->result, m->result_class},
                                    m->arguments,
                                    m->argument_count,
                                    0};
        register_method(class, &entry);
    }
    for (uint32_t i = 0; i < class->signal_count; i++) {
        register_signal(class, &class->signals[i]);
    }
    for (uint32_t i = 0; i < class->constant_count; i++) {
        register_constant(class, &class->constants[i]);
    }
    gd_name_end(&base);
    gd_name_end(&name);
}

void gd_unregister(const gd_class *class) {
    gd_name name = gd_name_new(class->name);
    gd.classdb_unregister_extension_class(gd_library, &name);
    gd_name_end(&name);
}
