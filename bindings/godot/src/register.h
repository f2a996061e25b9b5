/* Registers classes with the engine. SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_REGISTER_H
#define KNURL_GODOT_REGISTER_H

#include "classes.h"

void gd_register(const gd_class *class);
void gd_unregister(const gd_class *class);

#endif
