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
        fputs("t,x,y,z,vx,vy,surface,depth,fs,ft,height,fx,fy,fz\n", r->file.stream);
    } else {
        tick_ring_destroy(&r->ring);
    }
    return code;
}

static void print_row(FILE *f, const recorder *r, const knurl_tick_output *o) {
    const double before[] = {(double)o->tick / r->rate, o->hip[0], o->hip[1], o->hip[2], o->surface_velocity[0],
                             o->surface_velocity[1]};
    const double after[] = {o->depth,    o->spatial_frequency, o->temporal_frequency, o->height, o->force[0],
                            o->force[1], o->force[2]};
    const char *name = "none";
    for (size_t i = 0; i < sizeof before / sizeof *before; i++) {
        out_number(f, before[i]);
        fputc(',', f);
    }
    if (o->surface) {
        (void)knurl_scene_get_surface_name(r->scene, o->surface, &name);
    }
    tool_print_cell(f, name);
    for (size_t i = 0; i < sizeof after / sizeof *after; i++) {
        fputc(',', f);
        out_number(f, after[i]);
    }
    fputc('\n', f);
}

void recorder_drain(recorder *r) {
    const knurl_tick_output *tick;
    while ((tick = tick_ring_first(&r->ring)) != NULL) {
        print_row(r->file.stream, r, tick);
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
            fprintf(stderr, "knurl: note: %llu rows could not be written in time and are missing from the CSV\n",
                    (unsigned long long)r->ring.lost);
        }
    } else {
        out_discard(&r->file);
    }
    tick_ring_destroy(&r->ring);
    return code;
}
