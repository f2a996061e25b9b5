/* The data that a surface takes from its nodes. SPDX-License-Identifier: MIT */
#include "surface_node.h"

#include "geometry.h"

#include <string.h>

GDExtensionObjectPtr surface_parent(const surface *s) {
    GDExtensionObjectPtr parent = NULL;
    gd_call(gd_method.Node_get_parent, s->base.object, NULL, &parent);
    return parent;
}

int surface_is_on_layer_of(const surface *s, const device *d) {
    return (s->layers & d->layers) != 0;
}

void node_transform(GDExtensionObjectPtr node, gd_transform *transform) {
    gd_call(gd_method.Node3D_get_global_transform, node, NULL, transform);
}

int transform_pose(const gd_transform *transform, knurl_session_pose *pose) {
    double matrix[12];
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            matrix[4 * i + j] = (double)transform->basis[i][j];
        }
        matrix[4 * i + 3] = (double)transform->origin[i];
    }
    return (int)knurl_session_split_pose(matrix, pose);
}

int node_pose(GDExtensionObjectPtr node, knurl_session_pose *pose) {
    gd_transform transform;
    node_transform(node, &transform);
    return transform_pose(&transform, pose);
}

static knurl_result add_or_replace(knurl_scene *scene, const knurl_surface_desc *desc, knurl_surface_id *id) {
    return *id ? knurl_scene_replace_surface(scene, *id, desc) : knurl_scene_add_surface(scene, desc, id);
}

/* The axis is in the mesh's axes: scaled like the mesh. */
static void describe_shape(const surface *s, const knurl_session_pose *at, knurl_surface_desc *desc) {
    desc->coordinates = s->box_coordinates ? KNURL_COORDINATES_BOX : KNURL_COORDINATES_AUTO;
    desc->smooth = (int32_t)s->smooth;
    for (int i = 0; i < 3; i++) {
        float axis = 0.0F;
        for (int j = 0; j < 3; j++) {
            axis += (float)at->rest[3 * i + j] * s->axis[j];
        }
        desc->axis[i] = (double)axis;
    }
}

static knurl_result read_and_put(surface *s, knurl_scene *scene, const knurl_session_pose *at, knurl_surface_desc *desc,
                                 knurl_surface_id *id) {
    mesh_data data;
    knurl_mesh_desc mesh;
    describe_shape(s, at, desc);
    desc->mesh = &mesh;
    const int fits = geometry_read(surface_parent(s), at->rest, &data);
    knurl_result result = fits ? KNURL_OK : knurl_fail(KNURL_ERROR_MEMORY, "no memory to read its mesh with");
    if (fits && data.index_count == 0) {
        result = knurl_fail(KNURL_ERROR_STATE, "its mesh has no triangles");
    }
    mesh_describe(&data, &mesh);
    result = result ? result : add_or_replace(scene, desc, id);
    desc->mesh = NULL;
    mesh_end(&data);
    return result;
}

knurl_result surface_put(surface *s, knurl_scene *scene, const knurl_session_pose *at, knurl_surface_id shape_of,
                         knurl_surface_id *id) {
    char name[128];
    knurl_surface_desc desc;
    knurl_material_desc material;
    gd_node_name(surface_parent(s), name, sizeof name);
    knurl_surface_desc_init(&desc, sizeof desc);
    grating_describe(s->grating, &material);
    desc.name = name;
    desc.material = &material;
    desc.double_sided = s->double_sided;
    desc.shape_of = shape_of;
    memcpy(desc.position, at->position, sizeof desc.position);
    memcpy(desc.rotation, at->quaternion, sizeof desc.rotation);
    return shape_of ? add_or_replace(scene, &desc, id) : read_and_put(s, scene, at, &desc, id);
}
