/* Messages: reasons why a surface is not felt, and faults. SPDX-License-Identifier: MIT */
#include "session_rig.h"

static knurl_surface_id add_at(knurl_session *s, double x, double stiffness) {
    surface_parts parts = surface_plane();
    set_grating(&parts, KNURL_METHOD_DEFAULT, 0.0, 0.0, 0.0);
    parts.material.stiffness = stiffness;
    parts.desc.name = "\xC3\xA9\xE2\x82\xAC\xF0\x9F\x98\x80"; /* two bytes, three, four */
    parts.desc.position[0] = x;
    return add_surface(knurl_session_get_scene(s), &parts);
}

TEST(a_surface_that_can_be_felt_needs_no_explanation) {
    char text[64] = "?";
    SCOPED_SESSION *s = make_session();
    const knurl_surface_id plate = add_at(s, 0.0, 300.0);
    const knurl_surface_id far = add_at(s, 5.0, 1e6);
    knurl_session_explain(s, far, text, sizeof text);
    assert_string_equal(text, ""); /* closed: unknown */
    begin_with(s, "fake", "");
    knurl_session_explain(s, plate, text, sizeof text);
    assert_string_equal(text, "");
    knurl_session_explain(s, 0, text, sizeof text);
    assert_string_equal(text, ""); /* no message for a missing surface */
}

/* The fake device is 0.16 m wide, a plate 0.1 m: they meet up to 0.13 m. */
TEST(a_surface_out_of_reach_is_reported) {
    const double cases[][2] = {{0.129, 1.0}, {0.131, 1.0}, {-0.131, 1.0}, {0.20, 2.0}, {0.211, 2.0}};
    const int far[] = {0, 1, 1, 0, 1};
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        knurl_session_desc desc = describe("fake", "");
        char text[1024] = "?";
        SCOPED_SESSION *s = make_session();
        const knurl_surface_id plate = add_at(s, cases[i][0], 100.0);
        desc.workspace.scale = cases[i][1];
        open_session(s, &desc);
        begin(s);
        knurl_session_explain(s, plate, text, sizeof text);
        assert_int_equal(strstr(text, "outside of the device's workspace") != NULL, far[i]);
    }
}

TEST(reasons_have_a_line_each) {
    char text[2048] = "?";
    knurl_surface_check check;
    SCOPED_SESSION *s = make_session();
    const knurl_surface_id hard = add_at(s, 5.0, 1e5);
    begin_with(s, "fake", "");
    knurl_surface_check_init(&check, sizeof check);
    assert_int_equal(knurl_scene_check_surface(s->scene, 0, hard, &check), KNURL_OK);
    knurl_session_explain(s, hard, text, sizeof text);
    char *second = strchr(text, '\n');
    assert_non_null(second);
    assert_string_equal(second + 1, check.message);
}

/* However small the buffer, the text is the whole one's beginning, ends, and ends with a whole character. */
static void check_cuts(const char *whole, uint32_t size, const char *text) {
    const size_t length = strlen(text);
    assert_true(length < size && strncmp(whole, text, length) == 0);
    assert_true(((unsigned char)whole[length] & 0xC0) != 0x80); /* the next byte is not a continuation byte */
    assert_true(length + 4 >= size || length == strlen(whole)); /* no more than that is lost */
}

TEST(a_fault_is_its_sentence_with_value_and_unit) {
    char text[256];
    knurl_session_fault_text(KNURL_FAULT_SILENT, 0.012, text, sizeof text);
    assert_string_equal(text, "no position from the device for too long (0.012 s)");
    knurl_session_fault_text(KNURL_FAULT_LOST, 0.0, text, sizeof text);
    assert_string_equal(text, "the device is gone: unplugged or switched off");
    knurl_session_fault_text(12345, 1.0, text, sizeof text);
    assert_string_equal(text, knurl_fault_string(12345));
}

TEST(texts_are_cut_off_at_their_size) {
    const char *whole = "no position from the device for too long (0.012 s)";
    for (uint32_t size = 1; size < 64; size++) {
        char text[64];
        memset(text, '#', sizeof text);
        knurl_session_fault_text(KNURL_FAULT_SILENT, 0.012, text, size);
        check_cuts(whole, size, text);
        for (uint32_t i = size; i < sizeof text; i++) {
            assert_int_equal(text[i], '#');
        }
    }
    char untouched = '#';
    knurl_session_fault_text(KNURL_FAULT_SILENT, 0.012, &untouched, 0);
    knurl_session_fault_text(KNURL_FAULT_SILENT, 0.012, NULL, 100);
    assert_int_equal(untouched, '#');
}

TEST(they_are_cut_off_between_characters) {
    const char *whole = "\xC3\xA9\xE2\x82\xAC\xF0\x9F\x98\x80.\xC3\xA9\xE2\x82\xAC\xF0\x9F\x98\x80";
    for (uint32_t size = 1; size < 32; size++) {
        char text[32] = "";
        knurl_session_add_line(text, size, "%s", whole);
        check_cuts(whole, size, text);
    }
}

TEST(invalid_utf_8_is_cut_off_too) {
    for (uint32_t size = 1; size < 16; size++) {
        char text[16] = "";
        knurl_session_add_line(text, size, "%s",
                               "\x80\x80\x80\x80\x80\x80\xFF\xFF\xC0\xE0\xF0\x80\x80\x80\x80\x80\x80");
        assert_true(strlen(text) < size);
    }
}

TEST(a_stroke_that_cannot_be_laid_is_warned_of) {
    char warning[256] = "?";
    SCOPED_SESSION *s = make_session();
    (void)add_at(s, 1.0, 300.0);
    open_with(s, "fake", "line");
    assert_int_equal(knurl_session_start(s, warning, sizeof warning), KNURL_OK);
    assert_non_null(strstr(warning, "outside of the workspace"));
    assert_non_null(strstr(warning, "\xF0\x9F\x98\x80"));
    for (uint32_t size = 1; size < 20; size++) {
        char cut[20] = "";
        knurl_session_close(s);
        open_with(s, "fake", "line");
        assert_int_equal(knurl_session_start(s, cut, size), KNURL_OK);
        check_cuts(warning, size, cut);
    }
}

TEST(one_that_can_is_not) {
    char warning[256] = "?";
    SCOPED_SESSION *s = make_session();
    (void)add_at(s, 0.0, 300.0);
    open_with(s, "fake", "line");
    assert_int_equal(knurl_session_start(s, warning, sizeof warning), KNURL_OK);
    assert_string_equal(warning, "");
}

/* A plate at many heights of the fake device's workspace, from -35 to 35 mm: there is a warning if the plate is
 * outside, and none if it is inside but near an end. */
TEST(a_stroke_that_touches_a_surface_inside_is_not_warned_of) {
    for (int mm = -40; mm < 40; mm++) {
        const double z = 1e-3 * mm + 5e-4;
        knurl_surface_id outside = 0;
        knurl_hip_counts counts;
        SCOPED_SESSION *s = make_session();
        const knurl_surface_id plate = add_plate(s, 0.0, 0.0, z);
        begin_with(s, "fake", "line");
        step(s, 700);
        assert_int_equal(knurl_scene_get_tick(s->scene, 0, NULL, &counts), KNURL_OK);
        assert_int_equal(knurl_session_lay_stroke(s, &outside), KNURL_OK);
        if (fabs(z) < 0.035) {
            assert_true(counts.contact_ticks > 450 && outside == 0);
        } else {
            assert_true(outside == plate);
        }
    }
}
