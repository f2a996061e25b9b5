/* Calls of the scene in any order, with good and bad arguments. SPDX-License-Identifier: MIT */
#include "fuzz.h"

#define IDS 8

typedef struct game {
    knurl_scene *scene;
    knurl_surface_id ids[IDS];
} game;

static void fill_material(supply *s, knurl_material_desc *m) {
    knurl_material_desc_init(m, sizeof *m);
    m->method = take_byte(s) % 6;
    m->stiffness = take_byte(s) % 16 ? 400.0 : take_number(s);
    m->amplitude = take_byte(s) % 16 ? 2e-4 : take_number(s);
    m->spatial_frequency[0] = 700.0;
    m->spatial_frequency[1] = take_byte(s) % 4 ? 0.0 : fabs(take_number(s)) * 1e4;
    m->damping = take_byte(s) % 8 ? 0.0 : take_number(s);
    m->friction = take_byte(s) % 4 ? 0.0 : take_number(s);
    m->orientation = take_byte(s) % 4 ? 0.0 : take_number(s);
}

static void fill_surface(supply *s, game *g, knurl_surface_desc *d, knurl_plane_desc *plane, knurl_mesh_desc *mesh) {
    static const float bent[] = {0, 0, 0, 0.1F, 0, 0, 0.1F, 0.1F, 0.02F, 0, 0.1F, 0};
    static const uint32_t corners[] = {0, 1, 2, 0, 2, 3};
    knurl_surface_desc_init(d, sizeof *d);
    knurl_plane_desc_init(plane, sizeof *plane);
    knurl_mesh_desc_init(mesh, sizeof *mesh);
    mesh->vertex_count = 4;
    mesh->positions = bent;
    mesh->indices = corners;
    mesh->index_count = 6;
    d->name = "surface";
    d->double_sided = take_byte(s) & 1u;
    const uint8_t kind = take_byte(s) % 8;
    d->plane = kind < 3 ? plane : NULL;
    d->mesh = kind == 2 || kind == 3 || kind == 4 ? mesh : NULL;
    d->shape_of = kind >= 5 ? g->ids[take_byte(s) % IDS] : 0;
    d->axis[0] = kind < 5 ? 1.0 : 0.0;
    for (int i = 0; i < 3; i++) {
        d->position[i] = take_number(s);
    }
}

static void add_or_replace(game *g, supply *s, int replace, knurl_surface_id *id) {
    knurl_material_desc material;
    knurl_surface_desc surface;
    knurl_plane_desc plane;
    knurl_mesh_desc mesh;
    fill_material(s, &material);
    fill_surface(s, g, &surface, &plane, &mesh);
    surface.material = &material;
    if (replace) {
        (void)knurl_scene_replace_surface(g->scene, *id, &surface);
    } else {
        (void)knurl_scene_add_surface(g->scene, &surface, id);
    }
}

static void ask(game *g, supply *s, knurl_surface_id id) {
    knurl_surface_info info;
    knurl_surface_check check;
    knurl_surface_info_init(&info, sizeof info);
    knurl_surface_check_init(&check, sizeof check);
    (void)knurl_scene_get_surface_info(g->scene, id, &info);
    (void)knurl_scene_check_surface(g->scene, take_byte(s) % 2, id, &check);
}

static void act(game *g, supply *s) {
    static const double upright[4] = {0.0, 0.0, 0.0, 1.0};
    knurl_material_desc material;
    double position[3];
    const uint8_t what = take_byte(s) % 12;
    knurl_surface_id *id = &g->ids[take_byte(s) % IDS];
    switch (what) {
    case 0:
    case 1:
    case 2:
        add_or_replace(g, s, what == 2, id);
        break;
    case 3:
        (void)knurl_scene_remove_surface(g->scene, *id);
        break;
    case 4:
        for (int i = 0; i < 3; i++) {
            position[i] = take_number(s);
        }
        (void)knurl_scene_set_transform(g->scene, *id, position, upright, take_byte(s) % 4 ? 0.004 : take_number(s));
        break;
    case 5:
        fill_material(s, &material);
        (void)knurl_scene_set_material(g->scene, *id, &material);
        break;
    case 6:
        (void)knurl_scene_commit(g->scene);
        break;
    case 7:
        knurl_scene_collect(g->scene);
        break;
    case 8:
        ask(g, s, *id);
        break;
    default:
        expect_good_ticks(g->scene, s, 4);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    supply s = {data, size};
    game g;
    knurl_scene_desc desc;
    memset(&g, 0, sizeof g);
    knurl_scene_desc_init(&desc, sizeof desc);
    desc.max_surfaces = 6;
    EXPECT(knurl_scene_create(&desc, &g.scene) == KNURL_OK);
    for (int i = 0; i < 200 && s.left > 0; i++) {
        act(&g, &s);
    }
    knurl_scene_destroy(g.scene);
    return 0;
}
