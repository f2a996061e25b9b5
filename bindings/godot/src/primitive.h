/* The triangles of collision shapes that are boxes, spheres, capsules and cylinders: the engine's meshes of the same
 * name and size. SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_PRIMITIVE_H
#define KNURL_GODOT_PRIMITIVE_H

#include "api.h"

/* 1: the shape (or null) is one of these. */
int primitive_is_known(GDExtensionObjectPtr shape);

/* A new mesh of a known shape, in a Variant that holds it: to be destroyed. */
GDExtensionObjectPtr primitive_mesh(GDExtensionObjectPtr shape, gd_variant *held);

#endif
