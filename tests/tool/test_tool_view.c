/* `knurl run --view`: access, a viewer's data, and no delays of ticks by viewers.
 * SPDX-License-Identifier: MIT */
#include "view_rig.h"

TEST_WITH(a_viewer_gets_the_surfaces_and_then_each_tick, serve, end) {
    watcher w = {0};
    watch(&w);
    SERVE_UNTIL(&w, w.hello[0]);
    assert_non_null(strstr(w.hello, "\"file\": \"scene.glb\""));
    assert_non_null(strstr(w.hello, "\"name\": \"a \\\"plate\\\"\", \"feel\": [700, 0, 0.0002, 400, 0, 1]"));
    take_ticks(0, 1500);
    SERVE_UNTIL(&w, w.rows == 1500);
    CHECK_SAME(w.first[16], 0.0);
    CHECK_SAME(w.last[1], 0.5 * 1499.0);
    CHECK_SAME(w.last[14], 1.0);
    CHECK_SAME(w.last[15], 0.0);
    CHECK_CLOSE(w.last[16], 1.499, 1e-12);
    leave(&w);
}

TEST_WITH(two_viewers_get_the_same, serve, end) {
    watcher both[2] = {{0}, {0}};
    for (int i = 0; i < 2; i++) {
        watch(&both[i]);
        SERVE_UNTIL(&both[i], both[i].hello[0]);
    }
    take_ticks(0, 100);
    for (int i = 0; i < 2; i++) {
        SERVE_UNTIL(&both[i], both[i].rows == 100);
        leave(&both[i]);
    }
}

TEST_WITH(another_token_origin_or_host_is_refused, serve, end) {
    char wrong[80];
    char right[80];
    (void)snprintf(right, sizeof right, "%slive", path);
    (void)snprintf(wrong, sizeof wrong, "%slive", path);
    wrong[5] = wrong[5] == '0' ? '1' : '0';
    const struct {
        const char *path, *host, *origin; /* http:// is put before it */
    } attempts[] = {{wrong, "127.0.0.1:%d", "127.0.0.1:%d"},    {"/live", "127.0.0.1:%d", "127.0.0.1:%d"},
                    {right, "evil.example:%d", "127.0.0.1:%d"}, {right, "127.0.0.1:%d", "evil.example:%d"},
                    {right, "127.0.0.1:%d", "127.0.0.1:%d0"},   {right, "127.0.0.1:%d", ""}};
    for (size_t i = 0; i < COUNT_OF(attempts); i++) {
        watcher w = {0};
        connect_as(&w, attempts[i].path, attempts[i].host, attempts[i].origin);
        SERVE_UNTIL(&w, w.is_closed);
        assert_int_equal(w.is_open, 0);
        leave(&w);
    }
}

TEST_WITH(a_viewer_that_sends_anything_is_disconnected, serve, end) {
    watcher w = {.says_something = 1};
    watch(&w);
    SERVE_UNTIL(&w, w.is_closed);
    assert_int_equal(w.is_open, 1);
    leave(&w);
}

/* Its sockets fill up: it misses ticks, and a later viewer still gets the newest ones. */
TEST_WITH(a_stalled_viewer_delays_nobody, serve, end) {
    watcher stalled = {0};
    watcher other = {0};
    const uint64_t flood = 100000; /* 18 MB */
    watch(&stalled);
    SERVE_UNTIL(&stalled, stalled.hello[0]);
    for (uint64_t k = 0; k < flood; k += 2000) {
        take_ticks(k, 2000);
        wait_ms(18); /* as long as the server collects ticks for */
    }
    watch(&other);
    SERVE_UNTIL(&other, other.hello[0]);
    take_ticks(flood, 50);
    SERVE_UNTIL(&other, other.rows == 50);
    CHECK_CLOSE(other.last[16], 1e-3 * (double)(flood + 49), 1e-9);
    SERVE_UNTIL(&stalled, stalled.last[16] > 1e-3 * (double)(flood + 48));
    assert_true(stalled.rows < flood);
    leave(&other);
    leave(&stalled);
}

/* libwebsockets has the process ignore it. */
TEST(the_processs_handling_of_SIGPIPE_is_unchanged) {
    void (*const was)(int) = signal(SIGPIPE, SIG_DFL);
    (void)serve(state);
    void (*const now)(int) = signal(SIGPIPE, was);
    (void)end(state);
    assert_true(now == SIG_DFL);
}

static int send_count; /* atomic */

/* Instead of the C library's, for libwebsockets, too. */
__attribute__((visibility("default"))) ssize_t send(int fd, const void *bytes, size_t size, int flags) {
    __atomic_add_fetch(&send_count, 1, __ATOMIC_RELAXED);
    return sendto(fd, bytes, size, flags, NULL, 0);
}

/* In pieces of 256 bytes, as by default, each viewer costs 2000 system calls a second. */
TEST_WITH(the_kernel_gets_a_message_in_one_piece, serve, end) {
    watcher w = {0};
    watch(&w);
    SERVE_UNTIL(&w, w.hello[0]);
    const int before = __atomic_load_n(&send_count, __ATOMIC_RELAXED);
    take_ticks(0, 500); /* 92 kB */
    SERVE_UNTIL(&w, w.rows == 500);
    assert_in_range(__atomic_load_n(&send_count, __ATOMIC_RELAXED) - before, 1, 10);
    leave(&w);
}

TEST(a_full_ring_drops_ticks_and_counts_them) {
    tick_ring ring;
    knurl_tick_output out;
    memset(&out, 0, sizeof out);
    assert_int_equal(tick_ring_create(&ring), 0);
    for (uint64_t k = 0; k < TICK_RING_ROWS + 10; k++) {
        out.tick = k;
        tick_ring_put(&ring, &out);
    }
    assert_int_equal(ring.lost, 10);
    for (uint64_t k = 0; k < TICK_RING_ROWS; k++) {
        assert_int_equal(tick_ring_first(&ring)->tick, k);
        tick_ring_drop(&ring);
    }
    assert_null(tick_ring_first(&ring));
    tick_ring_destroy(&ring);
}

TEST(the_tool_says_where_to_look) {
    const char plate[] = KNURL_TEST_ASSETS "/plate_1d.glb";
    process p = RUN_TOOL("run", plate, "--view", "--seconds", "0.3");
    check_done(&p);
    assert_non_null(strstr(p.err, "open http://127.0.0.1:"));
    process_free(&p);
    p = RUN_TOOL("run", plate, "--view", "--fast");
    check_refused(&p, 2, "--view or --fast", "both");
}

SUITE_FIXTURES(make_folder, remove_folder)
