/* The triangles of a node. SPDX-License-Identifier: MIT */
#include "geometry.h"

#include "primitive.h"

#include <stdio.h>
#include <string.h>

#define NODES "a MeshInstance3D, MultiMeshInstance3D, CSGShape3D, GridMap, or CollisionShape3D"

GDExtensionObjectPtr geometry_mesh(GDExtensionObjectPtr node, gd_variant *held) {
    GDExtensionObjectPtr mesh = NULL;
    if (gd_cast(node, "MeshInstance3D")) {
        *held = gd_call_variant(gd_method.MeshInstance3D_get_mesh, node, -1);
        gd_types[GDEXTENSION_VARIANT_TYPE_OBJECT].from_variant(&mesh, held);
    } else {
        gd.variant_new_nil(held);
    }
    return mesh;
}

static GDExtensionObjectPtr object_in(const gd_variant *variant) {
    GDExtensionObjectPtr object = NULL;
    if (gd.variant_get_type(variant) == GDEXTENSION_VARIANT_TYPE_OBJECT) {
        gd_types[GDEXTENSION_VARIANT_TYPE_OBJECT].from_variant(&object, gd_unconst(variant));
    }
    return object;
}

static int64_t whole(GDExtensionObjectPtr object, const char *method) {
    int64_t number = 0;
    gd_variant found = gd_call_named(object, method, NULL, 0);
    gd_types[GDEXTENSION_VARIANT_TYPE_INT].from_variant(&number, &found);
    gd.variant_destroy(&found);
    return number;
}

static void class_of(GDExtensionObjectPtr object, char *text, size_t size) {
    gd_string string;
    gd_variant name = gd_call_named(object, "get_class", NULL, 0);
    gd.variant_stringify(&name, &string);
    const int64_t length = gd.string_to_utf8_chars(&string, text, (GDExtensionInt)size - 1);
    text[length < (int64_t)size ? length : (int64_t)size - 1] = '\0';
    gd_types[GDEXTENSION_VARIANT_TYPE_STRING].end(&string);
    gd.variant_destroy(&name);
}

/* baked * a Transform3D in a Variant. */
static mesh_place place_at(const double baked[9], GDExtensionConstVariantPtr variant) {
    mesh_place place;
    gd_transform t;
    gd_types[GDEXTENSION_VARIANT_TYPE_TRANSFORM3D].from_variant(&t, gd_unconst(variant));
    for (int row = 0; row < 3; row++) {
        place.offset[row] = 0.0;
        for (int column = 0; column < 3; column++) {
            place.matrix[3 * row + column] = 0.0;
            for (int k = 0; k < 3; k++) {
                place.matrix[3 * row + column] += baked[3 * row + k] * (double)t.basis[k][column];
            }
            place.offset[row] += baked[3 * row + column] * (double)t.origin[column];
        }
    }
    return place;
}

int geometry_is_made_later(GDExtensionObjectPtr node) {
    return gd_cast(node, "CSGShape3D") || gd_cast(node, "GridMap");
}

/* CSGShape3D and GridMap: get_meshes() alternates between a Transform3D and a Mesh. */
static int read_pairs(GDExtensionObjectPtr node, const double baked[9], mesh_data *data) {
    uint64_t array;
    int64_t size = 0;
    int fits = 1;
    gd_variant held = gd_call_named(node, "get_meshes", NULL, 0);
    gd_types[GDEXTENSION_VARIANT_TYPE_ARRAY].from_variant(&array, &held);
    gd_builtin.ARRAY_size(&array, NULL, &size, 0);
    for (int64_t i = 0; i + 1 < size && fits; i += 2) {
        const GDExtensionObjectPtr mesh = object_in(gd.array_operator_index_const(&array, i + 1));
        if (mesh) {
            const mesh_place place = place_at(baked, gd.array_operator_index_const(&array, i));
            fits = mesh_add(mesh, &place, data);
        }
    }
    gd_types[GDEXTENSION_VARIANT_TYPE_ARRAY].end(&array);
    gd.variant_destroy(&held);
    return fits;
}

static int read_instances(GDExtensionObjectPtr many, const double baked[9], mesh_data *data) {
    int64_t count = whole(many, "get_visible_instance_count");
    int fits = 1;
    count = count < 0 ? whole(many, "get_instance_count") : count;
    gd_variant held = gd_call_named(many, "get_mesh", NULL, 0);
    const GDExtensionObjectPtr mesh = object_in(&held);
    for (int64_t i = 0; i < count && mesh && fits; i++) {
        gd_variant index = gd_wrap(GDEXTENSION_VARIANT_TYPE_INT, &i);
        gd_variant at = gd_call_named(many, "get_instance_transform", &index, 1);
        const mesh_place place = place_at(baked, &at);
        fits = mesh_add(mesh, &place, data);
        gd.variant_destroy(&at);
    }
    gd.variant_destroy(&held);
    return fits;
}

static int read_faces(GDExtensionObjectPtr shape, const mesh_place *place, mesh_data *data) {
    gd_value corners;
    gd_variant held = gd_call_named(shape, "get_faces", NULL, 0);
    gd_types[GDEXTENSION_VARIANT_TYPE_PACKED_VECTOR3_ARRAY].from_variant(&corners, &held);
    const int fits = mesh_add_faces(&corners, place, data);
    gd_types[GDEXTENSION_VARIANT_TYPE_PACKED_VECTOR3_ARRAY].end(&corners);
    gd.variant_destroy(&held);
    return fits;
}

static int read_shape(GDExtensionObjectPtr shape, const mesh_place *place, mesh_data *data) {
    gd_variant held;
    int fits = 1;
    if (gd_cast(shape, "ConcavePolygonShape3D")) {
        fits = read_faces(shape, place, data);
    } else if (primitive_is_known(shape)) {
        fits = mesh_add(primitive_mesh(shape, &held), place, data);
        gd.variant_destroy(&held);
    }
    return fits;
}

/* A node's shape or multimesh, in a Variant that holds it: to be destroyed. */
static GDExtensionObjectPtr resource_of(GDExtensionObjectPtr node, const char *getter, gd_variant *held) {
    *held = gd_call_named(node, getter, NULL, 0);
    return object_in(held);
}

int geometry_read(GDExtensionObjectPtr node, const double baked[9], mesh_data *data) {
    mesh_place place = {{0.0}, {0.0, 0.0, 0.0}};
    gd_variant held;
    int fits = 1;
    memcpy(place.matrix, baked, sizeof place.matrix);
    mesh_begin(data);
    const GDExtensionObjectPtr mesh = geometry_mesh(node, &held);
    if (mesh) {
        fits = mesh_add(mesh, &place, data);
    } else if (gd_cast(node, "MultiMeshInstance3D")) {
        const GDExtensionObjectPtr many = resource_of(node, "get_multimesh", &held);
        fits = many ? read_instances(many, baked, data) : 1;
    } else if (geometry_is_made_later(node)) {
        fits = read_pairs(node, baked, data);
    } else if (gd_cast(node, "CollisionShape3D")) {
        const GDExtensionObjectPtr shape = resource_of(node, "get_shape", &held);
        fits = read_shape(shape, &place, data);
    }
    gd.variant_destroy(&held);
    return fits;
}

static void refuse_shape(GDExtensionObjectPtr node, char *text, size_t size) {
    char name[64] = "no shape";
    gd_variant held;
    const GDExtensionObjectPtr shape = resource_of(node, "get_shape", &held);
    if (shape) {
        class_of(shape, name, sizeof name);
    }
    if (!gd_cast(shape, "ConcavePolygonShape3D") && !primitive_is_known(shape)) {
        (void)snprintf(text, size,
                       "Its parent is a CollisionShape3D with %s: expected a box, sphere, capsule, cylinder or "
                       "ConcavePolygonShape3D, which have triangles to feel; put it below a MeshInstance3D of that "
                       "shape.",
                       name);
    }
    gd.variant_destroy(&held);
}

static void refuse_resource(GDExtensionObjectPtr node, const char *getter, const char *what, char *text, size_t size) {
    gd_variant held;
    if (!resource_of(node, getter, &held)) {
        (void)snprintf(text, size, "Its parent has no %s.", what);
    }
    gd.variant_destroy(&held);
}

void geometry_refuse(GDExtensionObjectPtr node, char *text, size_t size) {
    char name[64];
    text[0] = '\0';
    if (!node) {
        (void)snprintf(text, size, "It has no parent to feel: put it below " NODES ".");
    } else if (gd_cast(node, "MeshInstance3D")) {
        refuse_resource(node, "get_mesh", "mesh", text, size);
    } else if (gd_cast(node, "MultiMeshInstance3D")) {
        refuse_resource(node, "get_multimesh", "multimesh", text, size);
    } else if (gd_cast(node, "CollisionShape3D")) {
        refuse_shape(node, text, size);
    } else if (!geometry_is_made_later(node)) {
        class_of(node, name, sizeof name);
        (void)snprintf(text, size, "Its parent is a %s, which has no shape to feel: expected " NODES ".", name);
    }
}
