/* What a loop reports to a HIP between ticks: forces sent, heat. SPDX-License-Identifier: MIT */
#include "scene/scene.h"

void knurl_scene_publish_force(knurl_scene *scene, uint32_t hip, const double force[3], const double device_force[3]) {
    knurl_hip *h = &scene->hips[hip];
    knurl_snapshot latest;
    knurl_snapshot_read(&h->published, &latest); /* the only writer */
    knurl_guard_note_sent(&h->guard, force);
    h->counts.heat = h->guard.heat.theta;
    vec3_copy(force, latest.output.force);
    vec3_copy(device_force, latest.output.device_force);
    knurl_snapshot_publish(&h->published, &latest.output, &h->counts);
}

void knurl_scene_set_heat(knurl_scene *scene, uint32_t hip, double square) {
    knurl_heat_set(&scene->hips[hip].guard.heat, square);
}

void knurl_scene_hold_force(knurl_scene *scene, uint32_t hip, double force2, double ticks) {
    knurl_heat_hold(&scene->hips[hip].guard.heat, force2, ticks);
}
