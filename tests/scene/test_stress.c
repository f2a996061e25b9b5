/* Two HIPs tick as fast as they can while two threads edit what they touch, a thousand times a second each. Each tick
 * must see one complete edit, never older than the previous tick's or than the last edit completed before the tick.
 * KNURL_STRESS_SECONDS: duration. SPDX-License-Identifier: MIT */
#include "support/ledger.h"
#include "support/poses.h"

#include "base/atomic.h"
#include "base/system.h"

#include <pthread.h>
#include <stdlib.h>

enum { HIPS = 2, PRESSED = 12 };

/* Four planes, 1 m apart in x. */
enum {
    FELT,  /* its material is replaced, or all of it: stiffness and amplitude name the same number */
    MOVED, /* it jumps: its height and its turn name the same number */
    COMES, /* it is taken out, and another comes: the stiffness names which */
    GLIDES /* it always moves */
};

#define CYCLE   1000000 /* numbers that MOVED can distinguish */
#define BOTTOM  0.001   /* m: depth of a HIP below 0 */
#define TALLEST 0.002   /* m: the highest position of GLIDES */

/* State shared by editors and HIPs. */
typedef struct stage {
    knurl_scene *scene;
    knurl_surface_id ids[4];
    uint64_t done[4]; /* atomic: the number of the last complete edit */
    uint64_t gone;    /* atomic: of COMES, the last one that was removed */
    uint32_t over;    /* atomic */
} stage;

/* Results of one HIP; threads cannot fail a test themselves. */
typedef struct observer {
    stage *stage;
    uint32_t hip;
    uint64_t ticks;
    uint64_t last[4]; /* numbers felt */
    uint64_t news[4]; /* how often that was another than before */
    uint64_t failures;
    const char *what; /* of the first failure, with its numbers */
    double found;
    double expected;
} observer;

static double stiffness_of(uint64_t number) {
    return 100.0 + 0.001 * (double)number;
}

static uint64_t number_of(double stiffness) {
    return (uint64_t)((stiffness - 100.0) * 1000.0 + 0.5);
}

static surface_parts numbered(int which, uint64_t number) {
    surface_parts parts = surface_plane();
    parts.desc.position[0] = which;
    parts.material.stiffness = stiffness_of(number);
    if (which == FELT) {
        set_grating(&parts, KNURL_METHOD_S1, 100.0, 0.0, 1e-6 * stiffness_of(number)); /* a crest at its middle */
    }
    return parts;
}

static pose moved_pose(uint64_t number) {
    static const double z[3] = {0.0, 0.0, 1.0};
    pose p = {{MOVED, 0.0, 1e-9 * (double)(number % CYCLE)}, {0.0, 0.0, 0.0, 1.0}};
    turn_about(z, 1e-6 * (double)(number % CYCLE) - 0.5, p.quaternion);
    return p;
}

/* --- HIPs --- */

static void expect(observer *w, int holds, const char *what, double found, double expected) {
    if (!holds && w->failures++ == 0) {
        w->what = what;
        w->found = found;
        w->expected = expected;
    }
}

/* A number felt: not from before `done`, which was complete when the tick began, and not older than the last. */
static void expect_number(observer *w, int which, uint64_t number, uint64_t done) {
    expect(w, number >= done, "an edit older than one that was complete", (double)number, (double)done);
    expect(w, number >= w->last[which], "an edit older than one felt before", (double)number, (double)w->last[which]);
    w->news[which] += number != w->last[which];
    w->last[which] = number;
}

static void look_at_felt(observer *w, const knurl_tick_output *out, uint64_t done) {
    expect(w, out->contacts == 1, "FELT is not in contact", out->contacts, 1.0);
    const double stiffness = out->force[2] / (out->height + out->depth);
    expect(w, fabs(out->height - 1e-6 * stiffness) < 1e-12, "half a material", out->height, 1e-6 * stiffness);
    expect_number(w, FELT, number_of(stiffness), done);
}

static void look_at_moved(observer *w, const knurl_tick_output *out, uint64_t done) {
    expect(w, out->contacts <= 1, "too many contacts", out->contacts, 1.0);
    if (out->contacts == 0) {
        return;
    }
    const double by_height = 1e9 * (out->depth - BOTTOM);
    const double by_turn = 1e6 * (atan2(-out->surface_velocity[1], out->surface_velocity[0]) + 0.5);
    expect(w, fabs(by_height - by_turn) < 0.01, "half a move", by_height, by_turn);
    const uint64_t shown = (uint64_t)(by_height + 0.5);
    expect_number(w, MOVED, done + (shown + CYCLE - done % CYCLE + CYCLE / 2) % CYCLE - CYCLE / 2, done);
}

static void look_at_comes(observer *w, const knurl_tick_output *out, uint64_t gone) {
    expect(w, out->contacts <= 1, "too many contacts", out->contacts, 1.0);
    if (out->contacts == 0) {
        expect(w, out->force[2] == 0.0 && out->surface == 0, "a force without contact", out->force[2], 0.0);
        return;
    }
    const uint64_t number = number_of(out->force[2] / out->depth);
    expect(w, number > gone, "a surface that was taken out", (double)number, (double)gone);
    expect(w, out->surface != 0, "contact with no surface", 0.0, 0.0);
    expect_number(w, COMES, number, gone + 1);
}

static void look_at_glides(observer *w, const knurl_tick_output *out) {
    expect(w, out->contacts == 1, "GLIDES is not in contact", out->contacts, 1.0);
    expect(w, out->depth >= BOTTOM - 1e-12 && out->depth <= BOTTOM + TALLEST + 1e-12, "a place that is not on its way",
           out->depth, BOTTOM);
    w->news[GLIDES]++;
}

/* Down on each surface in turn, a while there, and up again. */
static void *hip_thread(void *user) {
    observer *w = user;
    stage *s = w->stage;
    while (!knurl_load_acquire(&s->over)) {
        for (int which = 0; which < 4; which++) {
            for (int k = 0; k <= PRESSED; k++) {
                knurl_tick_input input = {{which, 0.0, k == 0 ? 0.02 : -BOTTOM}, {0.0, 0.0, 0.0}, 1, 0, 0.0, 0, {0}};
                knurl_tick_output out;
                input.velocity[0] = which == MOVED ? 0.5 : 0.0;
                const uint64_t done = knurl_load_acquire(&s->done[which]);
                const uint64_t gone = knurl_load_acquire(&s->gone);
                const knurl_result result = knurl_scene_tick(s->scene, w->hip, &input, &out);
                expect(w, result == KNURL_OK, "a tick's result", result, KNURL_OK);
                expect(w, length3(out.force) < 1e3, "a force beyond all bounds", length3(out.force), 0.0);
                w->ticks++;
                if (k == 0) {
                    expect(w, out.contacts == 0, "contact high above", out.contacts, 0.0);
                } else if (which == FELT) {
                    look_at_felt(w, &out, done);
                } else if (which == MOVED) {
                    look_at_moved(w, &out, done);
                } else if (which == COMES) {
                    look_at_comes(w, &out, gone);
                } else {
                    look_at_glides(w, &out);
                }
            }
        }
    }
    return NULL;
}

/* --- editors --- */

static void replace_material(stage *s) {
    const uint64_t number = s->done[FELT] + 1;
    surface_parts parts = numbered(FELT, number);
    const knurl_result result = number % 2 == 0
                                    ? knurl_scene_set_material(s->scene, s->ids[FELT], &parts.material)
                                    : knurl_scene_replace_surface(s->scene, s->ids[FELT], surface_ready(&parts));
    if (result == KNURL_OK) {
        knurl_store_release(&s->done[FELT], number);
    }
}

static void jump(stage *s) {
    const uint64_t number = s->done[MOVED] + 1;
    const pose p = moved_pose(number);
    if (knurl_scene_set_transform(s->scene, s->ids[MOVED], p.position, p.quaternion, 0.0) == KNURL_OK) {
        knurl_store_release(&s->done[MOVED], number);
    }
}

static void replace_surface(stage *s) {
    const uint64_t number = s->done[COMES] + 1;
    surface_parts parts = numbered(COMES, number);
    if (knurl_scene_remove_surface(s->scene, s->ids[COMES]) == KNURL_OK) {
        knurl_store_release(&s->gone, s->done[COMES]);
    }
    if (knurl_scene_add_surface(s->scene, surface_ready(&parts), &s->ids[COMES]) == KNURL_OK) {
        knurl_store_release(&s->done[COMES], number);
    }
}

static void glide(stage *s, uint64_t *seed) {
    const pose p = {{GLIDES, 0.0, random_between(seed, 0.0, TALLEST)}, {0.0, 0.0, 0.0, 1.0}};
    if (knurl_scene_set_transform(s->scene, s->ids[GLIDES], p.position, p.quaternion,
                                  random_between(seed, 0.001, 0.02)) == KNURL_OK) {
        knurl_store_release(&s->done[GLIDES], s->done[GLIDES] + 1);
    }
}

static void rest(void) {
    knurl_system_sleep_until_ns(knurl_system_now_ns() + 1000000);
}

static void *first_editor(void *user) {
    stage *s = user;
    while (!knurl_load_acquire(&s->over)) {
        replace_material(s);
        jump(s);
        rest();
    }
    return NULL;
}

static void *second_editor(void *user) {
    stage *s = user;
    uint64_t seed = 7;
    while (!knurl_load_acquire(&s->over)) {
        replace_surface(s);
        glide(s, &seed);
        if (random_integer(&seed, 0, 99) == 0) {
            knurl_scene_collect(s->scene);
        }
        rest();
    }
    return NULL;
}

/* --- the test --- */

static void set_stage(stage *s, ledger *books) {
    memset(s, 0, sizeof *s);
    s->scene = scene_with(books);
    for (uint32_t hip = 0; hip < HIPS; hip++) {
        configure_plainly(s->scene, hip);
    }
    for (int which = 0; which < 4; which++) {
        surface_parts parts = numbered(which, 1);
        const pose p = moved_pose(1);
        if (which == MOVED) {
            place(&parts, &p);
        }
        s->ids[which] = add_surface(s->scene, &parts);
        s->done[which] = 1;
    }
    assert_int_equal(knurl_scene_commit(s->scene), KNURL_OK);
}

/* A game's thread meanwhile: snapshots that are whole, for as long as it is to last. */
static uint64_t watch(const stage *s, double seconds) {
    const int64_t end = knurl_system_now_ns() + (int64_t)(1e9 * seconds);
    uint64_t halves = 0;
    while (knurl_system_now_ns() < end) {
        for (uint32_t hip = 0; hip < HIPS; hip++) {
            knurl_tick_output out;
            if (knurl_scene_get_tick(s->scene, hip, &out, NULL) == KNURL_OK && out.height > 0.0) {
                halves += fabs(out.height - 1e-6 * out.force[2] / (out.height + out.depth)) > 1e-12;
            }
        }
        rest();
    }
    return halves;
}

/* After the end the newest edits are felt. */
static void check_newest(stage *s, uint32_t hip) {
    for (int which = 0; which < 4; which++) {
        knurl_tick_output out;
        knurl_tick_input input = {{which, 0.0, 0.02}, {which == MOVED ? 0.5 : 0.0, 0.0, 0.0}, 1, 0, 0.0, 0, {0}};
        assert_int_equal(knurl_scene_tick(s->scene, hip, &input, &out), KNURL_OK);
        input.position[2] = -BOTTOM;
        assert_int_equal(knurl_scene_tick(s->scene, hip, &input, &out), KNURL_OK);
        assert_int_equal(out.contacts, 1);
        assert_true(out.surface == s->ids[which]);
        if (which == FELT) {
            CHECK_CLOSE(out.height, 1e-6 * stiffness_of(s->done[FELT]), 1e-15L);
        } else if (which == MOVED) {
            CHECK_CLOSE(out.depth, BOTTOM + moved_pose(s->done[MOVED]).position[2], 1e-15L);
        } else if (which == COMES) {
            CHECK_CLOSE(out.force[2], BOTTOM * stiffness_of(s->done[COMES]), 1e-12L);
        }
    }
}

static double stress_seconds(void) {
    const char *given = getenv("KNURL_STRESS_SECONDS");
    return given ? strtod(given, NULL) : 1.0;
}

static void check_observer(const observer *w, const stage *s) {
    if (w->failures > 0) {
        print_error("HIP %u: %llu failures in %llu ticks; the first: %s: found %.9g, expected %.9g\n", (unsigned)w->hip,
                    (unsigned long long)w->failures, (unsigned long long)w->ticks, w->what, w->found, w->expected);
    }
    assert_true(w->failures == 0);
    for (int which = 0; which < 4; which++) { /* the edits were felt, not only made */
        assert_true(s->done[which] > 10 && w->news[which] > 5);
    }
}

TEST(edits_under_two_ticking_hips_are_seen_whole_and_in_order) {
    ledger books = {0, 0, 0, 0};
    stage s;
    observer w[HIPS];
    pthread_t threads[HIPS + 2];
    uint64_t seed = 9;
    set_stage(&s, &books);
    for (int i = 0; i < 200; i++) { /* tables grow to their final size */
        replace_material(&s);
        jump(&s);
        replace_surface(&s);
        glide(&s, &seed);
    }
    knurl_scene_collect(s.scene);
    const uint64_t before = knurl_scene_get_bytes(s.scene);
    memset(w, 0, sizeof w);
    for (uint32_t i = 0; i < HIPS; i++) {
        w[i].stage = &s;
        w[i].hip = i;
        assert_int_equal(pthread_create(&threads[i], NULL, hip_thread, &w[i]), 0);
    }
    assert_int_equal(pthread_create(&threads[HIPS], NULL, first_editor, &s), 0);
    assert_int_equal(pthread_create(&threads[HIPS + 1], NULL, second_editor, &s), 0);
    const uint64_t halves = watch(&s, stress_seconds());
    knurl_store_release(&s.over, 1);
    for (size_t i = 0; i < COUNT_OF(threads); i++) {
        assert_int_equal(pthread_join(threads[i], NULL), 0);
    }
    print_message("%llu + %llu ticks; %llu materials, %llu jumps, %llu surfaces, %llu ways\n",
                  (unsigned long long)w[0].ticks, (unsigned long long)w[1].ticks, (unsigned long long)s.done[FELT],
                  (unsigned long long)s.done[MOVED], (unsigned long long)s.done[COMES],
                  (unsigned long long)s.done[GLIDES]);
    for (uint32_t i = 0; i < HIPS; i++) {
        check_observer(&w[i], &s);
        check_newest(&s, i);
    }
    assert_true(halves == 0);
    knurl_scene_collect(s.scene);
    assert_true(knurl_scene_get_bytes(s.scene) == books.bytes);
    assert_true(books.bytes <= before + 1024); /* tables may differ; hundreds of records would be far more */
    knurl_scene_destroy(s.scene);
    assert_int_equal(books.blocks, 0);
    assert_true(books.bytes == 0);
}
