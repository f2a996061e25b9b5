/* Connects the signals of a MeshInstance3D and its mesh that report another or a changed mesh. SPDX-License-Identifier:
 * MIT */
#include "watch.h"

#include "geometry.h"
#include "surface_node.h"

void unwatch_mesh(surface *s) {
    GDExtensionObjectPtr mesh = NULL;
    if (gd.variant_get_type(&s->watched) == GDEXTENSION_VARIANT_TYPE_OBJECT) {
        gd_types[GDEXTENSION_VARIANT_TYPE_OBJECT].from_variant(&mesh, &s->watched);
        gd_disconnect(mesh, "changed", s->base.object, "update_mesh");
        gd.variant_destroy(&s->watched);
        gd.variant_new_nil(&s->watched);
    }
    if (s->watched_parent) {
        gd_disconnect(s->watched_parent, "property_list_changed", s->base.object, "update_mesh");
        s->watched_parent = NULL;
    }
}

void watch_mesh(surface *s) {
    gd_variant held;
    const GDExtensionObjectPtr parent = surface_parent(s);
    if (s->watched_parent || !gd_cast(parent, "MeshInstance3D")) {
        return;
    }
    const GDExtensionObjectPtr mesh = geometry_mesh(parent, &held);
    s->watched_parent = parent;
    gd_connect(parent, "property_list_changed", s->base.object, "update_mesh");
    if (mesh) {
        s->watched = held;
        gd_connect(mesh, "changed", s->base.object, "update_mesh");
    } else {
        gd.variant_destroy(&held);
    }
}
