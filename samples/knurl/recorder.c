/* The CSV rows of a run. SPDX-License-Identifier: MIT */
#include "recorder.h"

#include <string.h>

int recorder_open(recorder *r, const char *path, const knurl_scene *scene, double rate) {
    memset(r, 0, sizeof *r);
    r->scene = scene;
    r->rate = rate;
    if (tick_ring_create(&r->ring)) {
        return tool_error(TOOL_FAILURE, "run: no memory to record with");
    }
    const int code = out_open(&r->file, path);
    if (code == TOOL_OK) {
        csv_start(&r->csv, r->file.stream, "t,x,y,z,vx,vy,surface,depth,fs,ft,height,fx,fy,fz");
    } else {
        tick_ring_destroy(&r->ring);
    }
    return code;
}

static void print_row(recorder *r, const knurl_tick_output *o) {
    const double before[] = {(double)o->tick / r->rate, o->hip[0], o->hip[1], o->hip[2], o->surface_velocity[0],
                             o->surface_velocity[1]};
    const double after[] = {o->depth,    o->spatial_frequency, o->temporal_frequency, o->height, o->force[0],
                            o->force[1], o->force[2]};
    char name[KNURL_NAME_SIZE] = "";
    for (size_t i = 0; i < sizeof before / sizeof *before; i++) {
        csv_number(&r->csv, before[i]);
    }
    if (o->surface) {
        (void)knurl_scene_get_surface_name(r->scene, o->surface, name);
        csv_name(&r->csv, name);
    } else {
        csv_word(&r->csv, "none");
    }
    for (size_t i = 0; i < sizeof after / sizeof *after; i++) {
        csv_number(&r->csv, after[i]);
    }
    csv_end_row(&r->csv);
}

void recorder_drain(recorder *r) {
    const knurl_tick_output *tick;
    while ((tick = tick_ring_first(&r->ring)) != NULL) {
        print_row(r, tick);
        tick_ring_drop(&r->ring);
    }
}

int recorder_close(recorder *r, int keep) {
    int code = TOOL_OK;
    if (!r->ring.rows) {
        return code;
    }
    recorder_drain(r);
    if (keep) {
        code = out_keep(&r->file);
        if (r->ring.lost > 0) {
            tool_tell("note", "%llu rows could not be written in time and are missing from the CSV",
                      (unsigned long long)r->ring.lost);
        }
    } else {
        out_discard(&r->file);
    }
    tick_ring_destroy(&r->ring);
    return code;
}
