/* Handles the engine's calls of instances, properties and methods of the tables; see register.c for their registration.
 * SPDX-License-Identifier: MIT */
#include "serve.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const GDExtensionInstanceBindingCallbacks no_callbacks = {NULL, NULL, NULL};

GDExtensionObjectPtr gd_create(void *class_userdata) {
    const gd_class *class = class_userdata;
    gd_instance *made = calloc(1, class->size);
    if (!made) {
        gd_error(class->name, "%s: could not get %u bytes", class->name, (unsigned)class->size);
        return NULL;
    }
    gd_name base = gd_name_new(class->base);
    gd_name name = gd_name_new(class->name);
    made->of = class;
    made->object = gd.classdb_construct_object(&base);
    gd.object_set_instance(made->object, &name, made);
    gd.object_set_instance_binding(made->object, gd_library, made, &no_callbacks);
    gd_name_end(&name);
    gd_name_end(&base);
    if (!class->init(made)) {
        gd_error(class->name, "%s: no memory for its properties", class->name);
    }
    return made->object;
}

void gd_free(void *class_userdata, GDExtensionClassInstancePtr instance) {
    const gd_class *class = class_userdata;
    class->finish(instance);
    free(instance);
}

void gd_notify(GDExtensionClassInstancePtr instance, int32_t what, GDExtensionBool reversed) {
    const gd_class *class = ((gd_instance *)instance)->of;
    (void)reversed;
    if (class->notify) {
        class->notify(instance, what);
    }
}

static void call_warnings(GDExtensionClassInstancePtr instance, const GDExtensionConstTypePtr *arguments,
                          GDExtensionTypePtr result) {
    ((gd_instance *)instance)->of->warnings(instance, arguments, result);
}

static int is_name(const void *name, const char *text) {
    gd_name known = gd_name_new(text);
    const int same = ((const gd_name *)name)->opaque == known.opaque; /* names are unique */
    gd_name_end(&known);
    return same;
}

GDExtensionClassCallVirtual gd_find_virtual(void *class_userdata, GDExtensionConstStringNamePtr name) {
    const gd_class *class = class_userdata;
    for (uint32_t i = 0; i < class->virtual_count; i++) {
        if (is_name(name, class->virtuals[i].name)) {
            return class->virtuals[i].call;
        }
    }
    return class->warnings && is_name(name, "_get_configuration_warnings") ? call_warnings : NULL;
}

static gd_instance *instance_behind(GDExtensionObjectPtr object) {
    return object ? gd.object_get_instance_binding(object, gd_library, NULL) : NULL;
}

void *gd_instance_of(GDExtensionObjectPtr object, const gd_class *class) {
    gd_instance *found = instance_behind(object);
    return found && found->of == class ? found : NULL;
}

void *gd_instance_named(GDExtensionObjectPtr object, const char *class_name) {
    gd_instance *found = instance_behind(object);
    return found && strcmp(found->of->name, class_name) == 0 ? found : NULL;
}

static size_t size_of(GDExtensionVariantType type) {
    switch (type) {
    case GDEXTENSION_VARIANT_TYPE_BOOL:
        return sizeof(uint8_t);
    case GDEXTENSION_VARIANT_TYPE_VECTOR2:
        return 2 * sizeof(float);
    case GDEXTENSION_VARIANT_TYPE_VECTOR3:
        return 3 * sizeof(float);
    case GDEXTENSION_VARIANT_TYPE_QUATERNION:
        return 4 * sizeof(float);
    default:
        return 8;
    }
}

void gd_property_get(void *self, const gd_property *property, void *result) {
    const char *field = (const char *)self + property->offset;
    if (property->get) {
        property->get(self, result);
    } else if (property->type == GDEXTENSION_VARIANT_TYPE_STRING) {
        const char *text;
        memcpy(&text, field, sizeof text);
        gd_string_set(result, text ? text : "");
    } else {
        memcpy(result, field, size_of(property->type));
    }
}

/* Component `index` of a numeric value. Returns 1 if it exists. */
static int number_at(const gd_property *property, const void *value, int index, double *number) {
    const int vector = property->type == GDEXTENSION_VARIANT_TYPE_VECTOR3   ? 3
                       : property->type == GDEXTENSION_VARIANT_TYPE_VECTOR2 ? 2
                                                                            : 0;
    if (vector > 0) {
        *number = index < vector ? (double)((const float *)value)[index] : 0.0;
        return index < vector;
    }
    if (property->type == GDEXTENSION_VARIANT_TYPE_FLOAT) {
        memcpy(number, value, sizeof *number);
    } else if (property->type == GDEXTENSION_VARIANT_TYPE_INT) {
        int64_t whole;
        memcpy(&whole, value, sizeof whole);
        *number = (double)whole;
    } else {
        return 0;
    }
    return index == 0;
}

static int is_allowed(const void *self, const gd_property *property, const void *value) {
    const char *class_name = ((const gd_instance *)self)->of->name;
    double number;
    for (int i = 0; number_at(property, value, i, &number); i++) {
        const int has_range = property->most > property->least;
        const int open = property->hints && strstr(property->hints, "or_greater") != NULL;
        if (!isfinite(number) || (has_range && (number < property->least || (!open && number > property->most)))) {
            if (has_range) {
                gd_error(class_name, "%s.%s: expected %g %s %g, found %g", class_name, property->name, property->least,
                         open ? "or more, commonly up to" : "to", property->most, number);
            } else {
                gd_error(class_name, "%s.%s: expected finite numbers, found %g", class_name, property->name, number);
            }
            return 0;
        }
    }
    return 1;
}

void gd_property_set(void *self, const gd_property *property, const void *value) {
    char *field = (char *)self + property->offset;
    if (!is_allowed(self, property, value)) {
        return;
    }
    if (property->set) {
        property->set(self, value);
    } else if (property->type == GDEXTENSION_VARIANT_TYPE_STRING) {
        char *text = gd_string_copy(value);
        char *old;
        memcpy(&old, field, sizeof old);
        free(old);
        memcpy(field, &text, sizeof text);
    } else {
        memcpy(field, value, size_of(property->type));
    }
    if (property->changed) {
        property->changed(self);
    }
}

static int take_arguments(const gd_argument *expected, uint32_t count, const GDExtensionConstVariantPtr *given,
                          GDExtensionInt given_count, gd_value *values, GDExtensionCallError *error) {
    error->error = GDEXTENSION_CALL_OK;
    if (given_count != (GDExtensionInt)count) {
        error->error = given_count < (GDExtensionInt)count ? GDEXTENSION_CALL_ERROR_TOO_FEW_ARGUMENTS
                                                           : GDEXTENSION_CALL_ERROR_TOO_MANY_ARGUMENTS;
        error->expected = (int32_t)count;
        return 0;
    }
    for (uint32_t i = 0; i < count; i++) {
        if (!gd.variant_can_convert_strict(gd.variant_get_type(given[i]), expected[i].type)) {
            error->error = GDEXTENSION_CALL_ERROR_INVALID_ARGUMENT;
            error->argument = (int32_t)i;
            error->expected = (int32_t)expected[i].type;
            return 0;
        }
    }
    for (uint32_t i = 0; i < count; i++) {
        gd_types[expected[i].type].from_variant(&values[i], gd_unconst(given[i]));
    }
    return 1;
}

static void end_value(GDExtensionVariantType type, gd_value *value) {
    if (type != GDEXTENSION_VARIANT_TYPE_NIL && gd_types[type].end) {
        gd_types[type].end(value);
    }
}

/* Moves a result into a new Variant. An object is returned with a reference. */
static void give_result(GDExtensionVariantType type, gd_value *value, GDExtensionVariantPtr to) {
    if (type == GDEXTENSION_VARIANT_TYPE_NIL) {
        gd.variant_new_nil(to);
        return;
    }
    gd_types[type].to_variant(to, value);
    if (type == GDEXTENSION_VARIANT_TYPE_OBJECT && gd_cast(value->object, "RefCounted")) {
        uint8_t was_last;
        gd_call(gd_method.RefCounted_unreference, value->object, NULL,
                &was_last); /* the Variant holds a reference now */
    }
    end_value(type, value);
}

static void begin_value(GDExtensionVariantType type, gd_value *value) {
    memset(value, 0, sizeof *value);
    if (type != GDEXTENSION_VARIANT_TYPE_NIL && type != GDEXTENSION_VARIANT_TYPE_OBJECT && gd_types[type].end) {
        gd_types[type].make(value, NULL);
    }
}

void gd_method_call(void *row, GDExtensionClassInstancePtr self, const GDExtensionConstVariantPtr *arguments,
                    GDExtensionInt count, GDExtensionVariantPtr result, GDExtensionCallError *error) {
    const gd_method_row *method = row;
    gd_value values[GD_MOST_ARGUMENTS];
    gd_value made;
    const void *pointers[GD_MOST_ARGUMENTS];
    for (int i = 0; i < GD_MOST_ARGUMENTS; i++) {
        pointers[i] = &values[i];
    }
    if (take_arguments(method->arguments, method->argument_count, arguments, count, values, error)) {
        begin_value(method->result, &made);
        method->call(self, pointers, &made);
        give_result(method->result, &made, result);
        for (uint32_t i = 0; i < method->argument_count; i++) {
            end_value(method->arguments[i].type, &values[i]);
        }
    }
}

void gd_method_ptrcall(void *row, GDExtensionClassInstancePtr self, const GDExtensionConstTypePtr *arguments,
                       GDExtensionTypePtr result) {
    ((const gd_method_row *)row)->call(self, arguments, result);
}

void gd_getter_call(void *row, GDExtensionClassInstancePtr self, const GDExtensionConstVariantPtr *arguments,
                    GDExtensionInt count, GDExtensionVariantPtr result, GDExtensionCallError *error) {
    const gd_property *property = row;
    gd_value made;
    if (take_arguments(NULL, 0, arguments, count, NULL, error)) {
        begin_value(property->type, &made);
        gd_property_get(self, property, &made);
        give_result(property->type, &made, result);
    }
}

void gd_getter_ptrcall(void *row, GDExtensionClassInstancePtr self, const GDExtensionConstTypePtr *arguments,
                       GDExtensionTypePtr result) {
    (void)arguments;
    gd_property_get(self, row, result);
}

void gd_setter_call(void *row, GDExtensionClassInstancePtr self, const GDExtensionConstVariantPtr *arguments,
                    GDExtensionInt count, GDExtensionVariantPtr result, GDExtensionCallError *error) {
    const gd_property *property = row;
    const gd_argument expected = {"value", property->type, NULL};
    gd_value value;
    if (take_arguments(&expected, 1, arguments, count, &value, error)) {
        gd_property_set(self, property, &value);
        end_value(property->type, &value);
        gd.variant_new_nil(result);
    }
}

void gd_setter_ptrcall(void *row, GDExtensionClassInstancePtr self, const GDExtensionConstTypePtr *arguments,
                       GDExtensionTypePtr result) {
    (void)result;
    gd_property_set(self, row, arguments[0]);
}
