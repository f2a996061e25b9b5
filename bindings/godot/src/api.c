/* The engine's functions and values, see api.h. SPDX-License-Identifier: MIT */
#include "api.h"

#include <knurl/base.h>

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

gd_interface gd;
gd_methods gd_method;
gd_builtins gd_builtin;
gd_type gd_types[GDEXTENSION_VARIANT_TYPE_VARIANT_MAX];
GDExtensionClassLibraryPtr gd_library;
GDExtensionObjectPtr gd_engine;

int gd_load(GDExtensionInterfaceGetProcAddress get, GDExtensionClassLibraryPtr library) {
    static const struct {
        const char *name;
        size_t offset;
    } functions[] = {
#define GD_ROW(type, name) {#name, offsetof(gd_interface, name)},
        GD_FUNCTIONS(GD_ROW)
#undef GD_ROW
    };
    gd_library = library;
    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++) {
        const GDExtensionInterfaceFunctionPtr found = get(functions[i].name);
        if (!found) {
            (void)fprintf(stderr, "ERROR: Knurl: the engine has no %s(); Godot 4.3 or newer is needed\n",
                          functions[i].name);
            return 0;
        }
        memcpy((char *)&gd + functions[i].offset, &found, sizeof found);
    }
    return 1;
}

static int load_methods(void) {
    static const struct {
        const char *of, *name;
        int64_t hash;
        size_t offset;
    } methods[] = {
#define GD_ROW(class, method, hash) {#class, #method, hash, offsetof(gd_methods, class##_##method)},
        GD_METHODS(GD_ROW)
#undef GD_ROW
    };
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        gd_name of = gd_name_new(methods[i].of);
        gd_name name = gd_name_new(methods[i].name);
        const GDExtensionMethodBindPtr found = gd.classdb_get_method_bind(&of, &name, methods[i].hash);
        gd_name_end(&of);
        gd_name_end(&name);
        if (!found) {
            gd_error("knurl_godot_init", "Knurl: this engine's %s.%s() is another one than Godot 4.3's", methods[i].of,
                     methods[i].name);
            return 0;
        }
        memcpy((char *)&gd_method + methods[i].offset, &found, sizeof found);
    }
    return 1;
}

static int load_builtins(void) {
    static const struct {
        GDExtensionVariantType of;
        const char *name;
        int64_t hash;
        size_t offset;
    } methods[] = {
#define GD_ROW(type, method, hash)                                                                                     \
    {GDEXTENSION_VARIANT_TYPE_##type, #method, hash, offsetof(gd_builtins, type##_##method)},
        GD_BUILTINS(GD_ROW)
#undef GD_ROW
    };
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        gd_name name = gd_name_new(methods[i].name);
        const GDExtensionPtrBuiltInMethod found =
            gd.variant_get_ptr_builtin_method(methods[i].of, &name, methods[i].hash);
        gd_name_end(&name);
        if (!found) {
            gd_error("knurl_godot_init", "Knurl: this engine's built-in method %s() is another one than Godot 4.3's",
                     methods[i].name);
            return 0;
        }
        memcpy((char *)&gd_builtin + methods[i].offset, &found, sizeof found);
    }
    return 1;
}

static void load_types(void) {
    for (int i = GDEXTENSION_VARIANT_TYPE_BOOL; i < GDEXTENSION_VARIANT_TYPE_VARIANT_MAX; i++) {
        const GDExtensionVariantType type = (GDExtensionVariantType)i;
        gd_types[i].make = gd.variant_get_ptr_constructor(type, 0);
        gd_types[i].end = gd.variant_get_ptr_destructor(type);
        gd_types[i].to_variant = gd.get_variant_from_type_constructor(type);
        gd_types[i].from_variant = gd.get_variant_to_type_constructor(type);
    }
}

/* Vectors of a double-precision build are twice as long, and so are the types that contain them. */
static int is_single_precision(void) {
    unsigned char variant[64];
    unsigned char vector[64];
    memset(vector, 0, sizeof vector);
    gd_types[GDEXTENSION_VARIANT_TYPE_VECTOR3].to_variant(variant, vector);
    memset(vector, 0xa5, sizeof vector);
    gd_types[GDEXTENSION_VARIANT_TYPE_VECTOR3].from_variant(vector, variant);
    if (vector[3 * sizeof(float)] == 0xa5) {
        return 1;
    }
    gd_error("knurl_godot_init", "Knurl: expected an engine with single-precision vectors, found double precision");
    return 0;
}

int gd_load_classes(void) {
    load_types();
    gd_name engine = gd_name_new("Engine");
    gd_engine = gd.global_get_singleton(&engine);
    gd_name_end(&engine);
    return is_single_precision() && load_methods() && load_builtins();
}

void gd_error(const char *where, const char *format, ...) {
    char text[1280];
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    (void)knurl_text_line(text, sizeof text, text);
    gd.print_error_with_message("Knurl", text, where, "knurl", 0, 1);
}

void gd_warning(const char *where, const char *format, ...) {
    char text[1280];
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    (void)knurl_text_line(text, sizeof text, text);
    gd.print_warning_with_message("Knurl", text, where, "knurl", 0, 1);
}

gd_name gd_name_new(const char *text) {
    gd_name name;
    gd.string_name_new_with_utf8_chars(&name, text);
    return name;
}

void gd_name_end(gd_name *name) {
    gd_types[GDEXTENSION_VARIANT_TYPE_STRING_NAME].end(name);
}

void gd_string_set(void *string, const char *text) {
    gd_types[GDEXTENSION_VARIANT_TYPE_STRING].end(string);
    gd.string_new_with_utf8_chars(string, text);
}

char *gd_string_copy(const void *string) {
    const int64_t length = gd.string_to_utf8_chars(string, NULL, 0);
    char *text = malloc((size_t)length + 1);
    if (text) {
        (void)gd.string_to_utf8_chars(string, text, length);
        text[length] = '\0';
    }
    return text;
}

gd_variant gd_wrap(GDExtensionVariantType type, const void *value) {
    gd_variant variant;
    gd_types[type].to_variant(&variant, gd_unconst(value));
    return variant;
}

void gd_call(GDExtensionMethodBindPtr method, GDExtensionObjectPtr object, const void *argument, void *result) {
    gd.object_method_bind_ptrcall(method, object, &argument, result);
}

gd_variant gd_call_variant(GDExtensionMethodBindPtr method, GDExtensionObjectPtr object, int64_t index) {
    gd_variant result;
    gd_variant argument = gd_wrap(GDEXTENSION_VARIANT_TYPE_INT, &index);
    GDExtensionConstVariantPtr arguments[1] = {&argument};
    GDExtensionCallError error;
    gd.object_method_bind_call(method, object, arguments, index < 0 ? 0 : 1, &result, &error);
    return result;
}

/* A vararg method whose first argument is a name. */
static gd_variant call_with_name(GDExtensionMethodBindPtr method, GDExtensionObjectPtr object, const char *name,
                                 const gd_variant *arguments, uint32_t count) {
    gd_variant result;
    gd_name first = gd_name_new(name);
    gd_variant wrapped = gd_wrap(GDEXTENSION_VARIANT_TYPE_STRING_NAME, &first);
    GDExtensionConstVariantPtr all[4] = {&wrapped};
    GDExtensionCallError error;
    for (uint32_t i = 0; i < count; i++) {
        all[i + 1] = &arguments[i];
    }
    gd.object_method_bind_call(method, object, all, 1 + (GDExtensionInt)count, &result, &error);
    gd.variant_destroy(&wrapped);
    gd_name_end(&first);
    return result;
}

gd_variant gd_call_named(GDExtensionObjectPtr object, const char *method, const gd_variant *arguments, uint32_t count) {
    return call_with_name(gd_method.Object_call, object, method, arguments, count);
}

static void tie(const char *how, GDExtensionObjectPtr from, const char *signal, GDExtensionObjectPtr to,
                const char *method) {
    gd_value callable;
    gd_name names[2] = {gd_name_new(signal), gd_name_new(method)};
    const void *parts[2] = {&to, &names[1]};
    gd.variant_get_ptr_constructor(GDEXTENSION_VARIANT_TYPE_CALLABLE, 2)(&callable, parts);
    gd_variant arguments[2] = {gd_wrap(GDEXTENSION_VARIANT_TYPE_STRING_NAME, &names[0]),
                               gd_wrap(GDEXTENSION_VARIANT_TYPE_CALLABLE, &callable)};
    gd_variant result = gd_call_named(from, how, arguments, 2);
    gd.variant_destroy(&result);
    gd.variant_destroy(&arguments[0]);
    gd.variant_destroy(&arguments[1]);
    gd_types[GDEXTENSION_VARIANT_TYPE_CALLABLE].end(&callable);
    gd_name_end(&names[0]);
    gd_name_end(&names[1]);
}

void gd_connect(GDExtensionObjectPtr from, const char *signal, GDExtensionObjectPtr to, const char *method) {
    tie("connect", from, signal, to, method);
}

void gd_disconnect(GDExtensionObjectPtr from, const char *signal, GDExtensionObjectPtr to, const char *method) {
    tie("disconnect", from, signal, to, method);
}

void gd_emit(GDExtensionObjectPtr object, const char *signal, const gd_variant *arguments, uint32_t count) {
    gd_variant result = call_with_name(gd_method.Object_emit_signal, object, signal, arguments, count);
    gd.variant_destroy(&result);
}

GDExtensionObjectPtr gd_cast(GDExtensionObjectPtr object, const char *class_name) {
    gd_name name = gd_name_new(class_name);
    const GDExtensionObjectPtr found = object ? gd.object_cast_to(object, gd.classdb_get_class_tag(&name)) : NULL;
    gd_name_end(&name);
    return found;
}

int gd_is_in_editor(void) {
    uint8_t hint = 0;
    gd_call(gd_method.Engine_is_editor_hint, gd_engine, NULL, &hint);
    return hint;
}

void gd_node_name(GDExtensionObjectPtr node, char *text, size_t size) {
    gd_variant name = gd_call_variant(gd_method.Node_get_name, node, -1);
    gd_string string;
    gd.variant_stringify(&name, &string);
    const int64_t length = gd.string_to_utf8_chars(&string, text, (GDExtensionInt)size - 1);
    text[length < (int64_t)size ? length : (int64_t)size - 1] = '\0';
    gd_types[GDEXTENSION_VARIANT_TYPE_STRING].end(&string);
    gd.variant_destroy(&name);
}

void gd_dictionary_set(void *dictionary, const char *key, GDExtensionVariantType type, const void *value) {
    gd_string string;
    gd.string_new_with_utf8_chars(&string, key);
    gd_variant wrapped = gd_wrap(GDEXTENSION_VARIANT_TYPE_STRING, &string);
    GDExtensionVariantPtr to = gd.dictionary_operator_index(dictionary, &wrapped);
    gd.variant_destroy(to);
    gd_types[type].to_variant(to, gd_unconst(value));
    gd.variant_destroy(&wrapped);
    gd_types[GDEXTENSION_VARIANT_TYPE_STRING].end(&string);
}
