/* A collision shape's own mesh. SPDX-License-Identifier: MIT */
#include "primitive.h"

typedef struct dimension {
    const char *from, *to; /* properties of the shape and of the mesh */
    double factor;
} dimension;

/* Shapes that the engine has a mesh for, and the mesh's properties. */
static const struct {
    const char *shape, *mesh;
    dimension dimensions[3];
} primitives[] = {
    {"BoxShape3D", "BoxMesh", {{"size", "size", 0.0}}},
    {"SphereShape3D", "SphereMesh", {{"radius", "radius", 1.0}, {"radius", "height", 2.0}}},
    {"CapsuleShape3D", "CapsuleMesh", {{"radius", "radius", 1.0}, {"height", "height", 1.0}}},
    {"CylinderShape3D",
     "CylinderMesh",
     {{"radius", "top_radius", 1.0}, {"radius", "bottom_radius", 1.0}, {"height", "height", 1.0}}},
};

enum { PRIMITIVES = sizeof primitives / sizeof *primitives };

static int primitive_of(GDExtensionObjectPtr shape) {
    int found = PRIMITIVES;
    for (int i = 0; i < PRIMITIVES && found == PRIMITIVES; i++) {
        found = gd_cast(shape, primitives[i].shape) ? i : found;
    }
    return found;
}

int primitive_is_known(GDExtensionObjectPtr shape) {
    return shape && primitive_of(shape) < PRIMITIVES;
}

static gd_variant wrap_text(const char *text) {
    gd_string string;
    gd.string_new_with_utf8_chars(&string, text);
    const gd_variant made = gd_wrap(GDEXTENSION_VARIANT_TYPE_STRING, &string);
    gd_types[GDEXTENSION_VARIANT_TYPE_STRING].end(&string);
    return made;
}

/* factor 0: copies a value of any type unchanged. */
static void copy_dimension(GDExtensionObjectPtr shape, GDExtensionObjectPtr mesh, const dimension *d) {
    gd_variant from = wrap_text(d->from);
    gd_variant arguments[2] = {wrap_text(d->to), gd_call_named(shape, "get", &from, 1)};
    if (d->factor != 0.0) {
        double number = 0.0;
        gd_types[GDEXTENSION_VARIANT_TYPE_FLOAT].from_variant(&number, &arguments[1]);
        gd.variant_destroy(&arguments[1]);
        number *= d->factor;
        arguments[1] = gd_wrap(GDEXTENSION_VARIANT_TYPE_FLOAT, &number);
    }
    gd_variant nothing = gd_call_named(mesh, "set", arguments, 2);
    gd.variant_destroy(&nothing);
    gd.variant_destroy(&arguments[0]);
    gd.variant_destroy(&arguments[1]);
    gd.variant_destroy(&from);
}

GDExtensionObjectPtr primitive_mesh(GDExtensionObjectPtr shape, gd_variant *held) {
    const int index = primitive_of(shape);
    gd_name name = gd_name_new(primitives[index].mesh);
    GDExtensionObjectPtr mesh = gd.classdb_construct_object(&name);
    gd_name_end(&name);
    *held = gd_wrap(GDEXTENSION_VARIANT_TYPE_OBJECT, &mesh);
    for (int i = 0; i < 3 && primitives[index].dimensions[i].from; i++) {
        copy_dimension(shape, mesh, &primitives[index].dimensions[i]);
    }
    return mesh;
}
