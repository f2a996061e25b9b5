/* Poses and boxes of a surface near a HIP. SPDX-License-Identifier: MIT */
#include "proxy/candidate.h"

#include <string.h>

static void pose_at(const knurl_motion *motion, double time, knurl_pose *pose) {
    if (knurl_motion_is_over(motion, time)) {
        *pose = motion->end;
    } else {
        knurl_motion_at(motion, time, pose);
    }
}

void knurl_candidate_place_anew(knurl_candidate *candidate, const knurl_motion *motion, const knurl_hip_clock *clock,
                                const knurl_pose **now, const knurl_pose **before) {
    const int is_over = knurl_motion_is_over(motion, clock->time);
    const int was_seen = candidate->placed + 1 == clock->tick;
    const int stands = is_over && candidate->settled == motion && candidate->settled_start == motion->start_time;
    if (stands && candidate->settled_tick < clock->tick && (was_seen || candidate->placed == clock->tick)) {
        candidate->placed = clock->tick;
        *now = *before = &motion->end;
        return;
    }
    if (candidate->placed != clock->tick) { /* first call in this tick */
        if (!was_seen) {
            pose_at(motion, clock->previous_time, &candidate->poses[candidate->latest]);
        }
        candidate->latest ^= 1;
        pose_at(motion, clock->time, &candidate->poses[candidate->latest]);
        if (was_seen && candidate->placed_jumps != motion->jumps) { /* a jump does not sweep */
            candidate->poses[candidate->latest ^ 1] = candidate->poses[candidate->latest];
        }
        candidate->placed_jumps = motion->jumps;
        candidate->placed = clock->tick;
        candidate->settled = is_over ? motion : NULL;
        candidate->settled_start = motion->start_time;
        candidate->settled_tick = clock->tick;
    }
    *now = &candidate->poses[candidate->latest];
    *before = &candidate->poses[candidate->latest ^ 1];
}

static inline int is_near(const float box[6], const knurl_hip_path *path, double margin) {
    for (int i = 0; i < 3; i++) {
        if (path->high[i] < (double)box[i] - margin || path->low[i] > (double)box[3 + i] + margin) {
            return 0;
        }
    }
    return 1;
}

int knurl_candidate_is_near(const knurl_candidate *candidate, const knurl_hip_path *path, double margin) {
    return is_near(candidate->box, path, margin);
}

int knurl_candidate_is_swept_near(knurl_candidate *candidate, const knurl_surface_data *surface,
                                  const knurl_hip_clock *clock, const knurl_hip_path *path, double margin) {
    const knurl_record *record = __atomic_load_n(&surface->record, __ATOMIC_SEQ_CST);
    const double wide = margin + surface->shape.seam;
    const int was_seen = candidate->swept_tick + 1 == clock->tick;
    int near = !was_seen || is_near(candidate->swept, path, wide); /* last tick's box */
    if (!was_seen || candidate->swept_edits != record->edits) {
        memcpy(candidate->swept, knurl_record_box(record, clock->previous_time), sizeof candidate->swept);
        candidate->swept_edits = record->edits;
        near = near || is_near(candidate->swept, path, wide);
    }
    candidate->swept_tick = clock->tick;
    return near;
}

void knurl_candidate_set_grating(knurl_candidate *candidate, const knurl_record *record, const knurl_hip_facts *facts) {
    const knurl_material_desc *m = &record->material;
    candidate->plays_edits = record->edits;
    candidate->plays = (knurl_grating){.method = m->method,
                                       .spatial_frequency = {m->spatial_frequency[0], m->spatial_frequency[1]},
                                       .update_rate_hz = facts->rate,
                                       .resolution = facts->resolution};
}

void knurl_candidate_end_contact(knurl_candidate *candidate) {
    candidate->in_contact = 0;
    memset(&candidate->contact, 0, sizeof candidate->contact);
    knurl_wall_end(&candidate->wall);
}

void knurl_candidate_note_change(knurl_candidate *candidate, const knurl_surface_data *surface) {
    if (!surface || candidate->in_contact) {
        knurl_candidate_end_contact(candidate);
    }
    candidate->generation = surface ? surface->generation : candidate->generation;
    candidate->has_previous = 0;
    candidate->settled = NULL;
    candidate->plays_edits = 0; /* another surface may have been edited as often */
}
