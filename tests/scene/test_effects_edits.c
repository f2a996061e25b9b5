/* Edits of effects: their continuity, refusals and memory. SPDX-License-Identifier: MIT */
#include "effects.h"
#include "scene/ask.h"
#include "support/ledger.h"

TEST(effects_stay_when_their_hip_is_configured_anew_and_end_with_a_count_of_0) {
    SCOPED_SCENE *scene = free_scene();
    knurl_effect effect = effect_of(KNURL_EFFECT_FORCE);
    set(scene, &effect, 1, 0.0);
    configure_plainly(scene, 0);
    CHECK_CLOSE(tick_at(scene, 0.0, 0.0, 0.0).force[1], 2.0, AS_ONE);
    set(scene, NULL, 0, 0.0);
    CHECK_SAME(tick_at(scene, 0.0, 0.0, 0.0).force[1], 0.0);
}

TEST(each_hip_has_its_own_effects) {
    SCOPED_SCENE *scene = empty_scene(2);
    configure_plainly(scene, 0);
    configure_plainly(scene, 1);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    knurl_effect effect = effect_of(KNURL_EFFECT_FORCE);
    assert_int_equal(knurl_scene_set_effects(scene, 1, &effect, 1, 0.0), KNURL_OK);
    CHECK_SAME(tick_at(scene, 0.0, 0.0, 0.0).force[1], 0.0);
    const knurl_tick_input input = {.has_velocity = 1};
    knurl_tick_output out;
    assert_int_equal(knurl_scene_tick(scene, 1, &input, &out), KNURL_OK);
    CHECK_CLOSE(out.force[1], 2.0, AS_ONE);
}

/* --- refusals --- */

typedef struct wrong {
    size_t offset;
    double number;
    const char *sentence;
} wrong;

#define AT(field) offsetof(knurl_effect, field)

TEST(an_effect_that_is_wrong_is_refused_by_number_and_field_and_the_old_ones_stay) {
    static const wrong all[] = {
        {AT(anchor[1]), NAN, "effects[1].anchor: expected numbers from -1e+09 to 1e+09 m, found [0, nan, 0]"},
        {AT(anchor[2]), 2e9, "effects[1].anchor: expected numbers from"},
        {AT(axis[0]), INFINITY, "effects[1].axis: expected numbers from"},
        {AT(axis[1]), 0.0, "effects[1].axis: expected a vector with a length, found one of length 0"},
        {AT(stiffness), 0.5, "effects[1].stiffness: expected 0 or 1 to 1000000000 N/m, found 0.5"},
        {AT(stiffness), NAN, "effects[1].stiffness: expected"},
        {AT(damping), -1.0, "effects[1].damping: expected 0 to 1000 N s/m, found -1"},
        {AT(damping), 1000.1, "effects[1].damping: expected"},
        {AT(spacing), 0.0, "effects[1].spacing: expected 1e-06 to 1000000000 m, found 0"},
        {AT(max_force), 1001.0, "effects[1].max_force: expected 0.01 to 1000 N, found 1001"},
        {AT(max_force), -INFINITY, "effects[1].max_force: expected 0.01 to 1000 N, found -inf"},
        {AT(reserved[0]), 1.0, "effects[1].reserved: expected zeros"},
        {AT(reserved[1]), 1.0, "effects[1].reserved: expected zeros"},
        {AT(reserved[2]), 1.0, "effects[1].reserved: expected zeros"},
        {AT(reserved[3]), 1.0, "effects[1].reserved: expected zeros"},
    };
    SCOPED_SCENE *scene = free_scene();
    const knurl_effect force = effect_of(KNURL_EFFECT_FORCE);
    set(scene, &force, 1, 0.0);
    for (size_t i = 0; i < COUNT_OF(all); i++) {
        knurl_effect effects[2] = {force, effect_of(KNURL_EFFECT_DETENT)};
        memcpy((char *)&effects[1] + all[i].offset, &all[i].number, sizeof all[i].number);
        assert_int_equal(knurl_scene_set_effects(scene, 0, effects, 2, 0.0), KNURL_ERROR_ARGUMENT);
        check_message(all[i].sentence);
        CHECK_CLOSE(tick_at(scene, 0.0, 0.0, 0.0).force[1], 2.0, AS_ONE);
    }
}

TEST(calls_that_are_wrong_are_refused) {
    SCOPED_SCENE *scene = free_scene();
    knurl_effect effects[KNURL_EFFECTS_MAX + 1];
    for (int i = 0; i <= KNURL_EFFECTS_MAX; i++) {
        effects[i] = effect_of(KNURL_EFFECT_SPRING);
    }
    assert_int_equal(knurl_scene_set_effects(scene, 0, effects, KNURL_EFFECTS_MAX + 1, 0.0), KNURL_ERROR_ARGUMENT);
    check_message("count: expected 0 to 8 effects, found 9");
    assert_int_equal(knurl_scene_set_effects(scene, 1, effects, 1, 0.0), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_scene_set_effects(scene, 0, NULL, 1, 0.0), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_scene_set_effects(NULL, 0, effects, 1, 0.0), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_scene_set_effects(scene, 0, effects, 1, NAN), KNURL_ERROR_ARGUMENT);
    check_message("seconds: expected 0 to 10, found nan");
    effects[0].kind = 0;
    assert_int_equal(knurl_scene_set_effects(scene, 0, effects, 1, 0.0), KNURL_ERROR_ARGUMENT);
    check_message("effects[0].kind: expected 1 to 6 (KNURL_EFFECT_), found 0");
    effects[0].kind = KINDS + 1;
    assert_int_equal(knurl_scene_set_effects(scene, 0, effects, 1, 0.0), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_effect_prepare(KINDS + 1, effects), KNURL_ERROR_ARGUMENT);
    check_message("kind: expected 1 to 6 (KNURL_EFFECT_), found 7");
    assert_int_equal(knurl_effect_prepare(KNURL_EFFECT_SPRING, NULL), KNURL_ERROR_ARGUMENT);
}

/* --- memory --- */

TEST(replaced_effects_are_freed_and_every_byte_is_counted) {
    ledger books = {0, 0, 0, 0};
    knurl_scene *scene = scene_with(&books);
    (void)commit_plainly(scene);
    const uint64_t before = books.bytes;
    const knurl_effect effect = effect_of(KNURL_EFFECT_SPRING);
    for (int i = 0; i < 100; i++) {
        set(scene, &effect, 1, 0.01);
        (void)tick_at(scene, 0.0, 0.0, 0.0);
        assert_true(knurl_scene_get_bytes(scene) == books.bytes);
    }
    set(scene, NULL, 0, 0.0);
    assert_true(books.bytes == before); /* no tick runs: freed at once */
    set(scene, &effect, 1, 0.0);
    knurl_scene_destroy(scene);
    assert_true(books.bytes == 0 && books.blocks == 0);
}

TEST(without_memory_the_old_effects_stay) {
    ledger books = {0, 0, 0, 0};
    knurl_scene *scene = scene_with(&books);
    (void)commit_plainly(scene);
    knurl_effect effect = effect_of(KNURL_EFFECT_FORCE);
    set(scene, &effect, 1, 0.0);
    books.refused = books.requests + 1;
    effect.max_force = 1.0;
    assert_int_equal(knurl_scene_set_effects(scene, 0, &effect, 1, 0.0), KNURL_ERROR_MEMORY);
    CHECK_CLOSE(tick_at(scene, 0.0, 0.0, 0.0).force[1], 2.0, AS_ONE);
    knurl_scene_destroy(scene);
    assert_true(books.bytes == 0);
}
