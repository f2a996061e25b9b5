/* Publishes forces that a loop sends between ticks. SPDX-License-Identifier: MIT */
#include "scene/scene.h"

void knurl_scene_publish_force(knurl_scene *scene, uint32_t hip, const double force[3], const double device_force[3]) {
    knurl_hip *h = &scene->hips[hip];
    knurl_snapshot latest;
    knurl_snapshot_read(&h->published, &latest); /* this thread is the only writer */
    knurl_last_stage_note(&h->last, device_force);
    h->counts.heat = knurl_heat_theta(&h->last.heat);
    vec3_copy(force, latest.output.force);
    vec3_copy(device_force, latest.output.device_force);
    knurl_snapshot_publish(&h->published, &latest.output, &h->counts);
}
