/* A session when memory runs out, and its allocations in a frame. Linked with --wrap for the allocating functions
 * (CMakeLists.txt). SPDX-License-Identifier: MIT */
#include "session_rig.h"

static int64_t requests, held, refused; /* refused: the allocation that fails; 0: no allocation */

static int is_refused(void) {
    return __atomic_add_fetch(&requests, 1, __ATOMIC_RELAXED) == refused;
}

static void *count(void *memory) {
    (void)__atomic_add_fetch(&held, memory != NULL, __ATOMIC_RELAXED);
    return memory;
}

void *__real_malloc(size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_malloc(size_t size) {
    return is_refused() ? NULL : count(__real_malloc(size));
}

void *__real_calloc(size_t number, size_t size);
void *__wrap_calloc(size_t number, size_t size);
void *__wrap_calloc(size_t number, size_t size) {
    return is_refused() ? NULL : count(__real_calloc(number, size));
}

void __real_free(void *memory);
void __wrap_free(void *memory);
void __wrap_free(void *memory) {
    (void)__atomic_sub_fetch(&held, memory != NULL, __ATOMIC_RELAXED);
    __real_free(memory);
}

/* All of a life; KNURL_OK, or the first failure, with everything given back. */
static knurl_result live(const char *device, int plays) {
    static const double rows[8] = {0.0, 0.0, 0.0, 0.005, 0.01, 0.0, 0.0, -0.001};
    const knurl_session_desc desc = describe(device, plays ? "" : "line");
    char warning[64] = "as was";
    double forces[60] = {7.0};
    uint64_t played = 7;
    knurl_session *s = NULL;
    knurl_result result = knurl_session_create(&s);
    if (result) {
        assert_null(s);
        return result;
    }
    surface_parts parts = surface_plane();
    knurl_surface_id plate = 0;
    result = knurl_scene_add_surface(knurl_session_get_scene(s), surface_ready(&parts), &plate);
    result = result ? result : knurl_session_open(s, &desc);
    if (!result && plays) {
        result = knurl_session_play(s, rows, 2, 20, forces, &played);
        assert_true(!result || (forces[0] == 7.0 && played == 7));
    } else if (!result) {
        result = knurl_session_start(s, warning, sizeof warning);
        assert_true(!result || strcmp(warning, "as was") == 0);
    }
    knurl_session_destroy(s);
    return result;
}

static void check_failures(const char *device, int plays) {
    refused = 0;
    assert_int_equal(live(device, plays), KNURL_OK); /* allocations made once per process */
    (void)knurl_fail(KNURL_ERROR_STATE, "this thread's room for a message");
    const int64_t before = held;
    int failures = 0;
    for (int64_t i = 1;; i++) {
        requests = 0;
        refused = i;
        (void)knurl_fail(KNURL_ERROR_STATE, "stale message");
        const knurl_result result = live(device, plays);
        const int was_reached = requests >= i;
        refused = 0;
        assert_true(held == before);
        if (!was_reached) {
            break;
        }
        if (result) { /* some allocations are optional, such as a list of objects to free early */
            failures++;
            assert_true(result == KNURL_ERROR_MEMORY || result == KNURL_ERROR_SYSTEM); /* no memory, or no thread */
            assert_string_not_equal(knurl_error_message(), "stale message");
        }
    }
    assert_true(failures >= 4); /* session, scene, device, loop */
}

TEST(memory_that_is_refused_anywhere_in_a_life_is_an_error_and_leaks_nothing) {
    check_failures("fake", 0);
    check_failures("mouse", 0);
}

TEST(and_so_it_is_anywhere_in_a_play) {
    check_failures("fake", 1);
}

TEST(a_frame_asks_for_no_memory) {
    knurl_session_event event;
    char text[256];
    float rows[64];
    int told = 0;
    SCOPED_SESSION *s = make_session();
    (void)add_plate(s, 0.0, 0.0, 0.0);
    (void)add_plate(s, 0.2, 0.0, 0.0);
    begin_with(s, "fake:?lose_at=0.3&press_at=0.1", "");
    for (int frame = 0; frame < 40; frame++) {
        press(s, frame % 2 ? 0.2 : 0.0, 0.0);
        requests = 0;
        knurl_session_update(s);
        while (knurl_session_next_event(s, &event)) {
            knurl_session_fault_text(event.code, event.value, text, sizeof text);
            told++;
        }
        (void)state_of(s);
        (void)knurl_session_get_history(s, 32, rows);
        assert_true(requests == 0);
    }
    assert_true(told > 40);
}
