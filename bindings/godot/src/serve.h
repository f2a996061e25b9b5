/* Handles the engine's calls of class instances. SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_SERVE_H
#define KNURL_GODOT_SERVE_H

#include "classes.h"

/* The instance of that class behind an object, or null; found by the class's name, so that this file depends on no
 * class. */
void *gd_instance_of(GDExtensionObjectPtr object, const gd_class *class);
void *gd_instance_named(GDExtensionObjectPtr object, const char *class_name);

/* Callbacks of an instance; class_userdata is the gd_class. */
GDExtensionObjectPtr gd_create(void *class_userdata);
void gd_free(void *class_userdata, GDExtensionClassInstancePtr instance);
void gd_notify(GDExtensionClassInstancePtr instance, int32_t what, GDExtensionBool reversed);
GDExtensionClassCallVirtual gd_find_virtual(void *class_userdata, GDExtensionConstStringNamePtr name);

void gd_property_get(void *self, const gd_property *property, void *result);
void gd_property_set(void *self, const gd_property *property, const void *value);

/* Callbacks of a method, with Variants and with pointers; `row` is a gd_method_row or a gd_property. */
#define GD_CALL(name)                                                                                                  \
    void name(void *row, GDExtensionClassInstancePtr self, const GDExtensionConstVariantPtr *arguments,                \
              GDExtensionInt count, GDExtensionVariantPtr result, GDExtensionCallError *error)
#define GD_PTRCALL(name)                                                                                               \
    void name(void *row, GDExtensionClassInstancePtr self, const GDExtensionConstTypePtr *arguments,                   \
              GDExtensionTypePtr result)

GD_CALL(gd_method_call);
GD_CALL(gd_getter_call);
GD_CALL(gd_setter_call);
GD_PTRCALL(gd_method_ptrcall);
GD_PTRCALL(gd_getter_ptrcall);
GD_PTRCALL(gd_setter_ptrcall);

#endif
