/* `knurl run --wav`: a sound file of the run's length, with the line of the stroke's frequency.
 * SPDX-License-Identifier: MIT */
#include "support/close.h"
#include "tool/plate.h"

#define PI     3.14159265358979323846
#define HEADER 44
#define LEVEL  (0.5 * 400.0 * 0.0002 / 0.25) /* K A over the default full scale */

static uint32_t little_endian(const unsigned char *bytes, int count) {
    uint32_t value = 0;
    for (int i = count - 1; i >= 0; i--) {
        value = value << 8 | bytes[i];
    }
    return value;
}

/* The samples of a WAV file of mono, 48 kHz, 16 bits. */
static size_t read_wav(const char *path, double *samples, size_t most) {
    static unsigned char bytes[1 << 20];
    FILE *file = fopen(path, "rb");
    if (!file) {
        fail_msg("%s: nothing there", path);
        return 0;
    }
    const size_t size = fread(bytes, 1, sizeof bytes, file);
    assert_int_equal(fclose(file), 0);
    assert_true(size >= HEADER && size < sizeof bytes);
    assert_memory_equal(bytes, "RIFF", 4);
    assert_int_equal(little_endian(bytes + 4, 4), size - 8);
    assert_memory_equal(bytes + 8, "WAVEfmt \x10\0\0\0\1\0\1\0", 16);
    assert_int_equal(little_endian(bytes + 24, 4), 48000);
    assert_int_equal(little_endian(bytes + 28, 4), 96000);
    assert_memory_equal(bytes + 32, "\2\0\x10\0data", 8);
    assert_int_equal(little_endian(bytes + 40, 4), size - HEADER);
    const size_t count = (size - HEADER) / 2;
    assert_true(count <= most);
    for (size_t i = 0; i < count; i++) {
        samples[i] = (int16_t)little_endian(bytes + HEADER + 2 * i, 2) / 32767.0;
    }
    return count;
}

/* 0.1 s above the plate, then 0.25 m/s along x: 250 Hz. */
TEST(a_stroke_at_250_hz_sounds_at_250_hz) {
    static double samples[60000];
    write_text(
        tool_path("trace.csv"),
        "t,x,y,z\n0,0.205,0.501,-0.125\n0.1,0.205,0.501,-0.125\n0.11,0.205,0.499,-0.125\n0.47,0.295,0.499,-0.125\n");
    SCOPED_PROCESS p = RUN_TOOL("run", write_plate("plate.gltf", TAG), "--trace", tool_path("trace.csv"), "--fast",
                                "--seconds", "0.45", "--wav", tool_path("felt.wav"));
    check_done(&p);
    assert_int_equal(read_wav(tool_path("felt.wav"), samples, COUNT_OF(samples)), 450 * 48);
    for (int i = 0; i < 100 * 48; i++) {
        CHECK_SAME(samples[i], 0.0);
    }
    double line[2] = {0.0, 0.0};
    for (int i = 9600; i < 2 * 9600; i++) {
        line[0] += samples[i] * cos(2.0 * PI * 250.0 * i / 48000.0) / 4800.0;
        line[1] += samples[i] * sin(2.0 * PI * 250.0 * i / 48000.0) / 4800.0;
    }
    /* Four ticks a cycle, from a crest on, are the worst case of loudness: the mean fourth power of a cosine of 4/pi A
     * is 1/2 of its peak's there, not 3/8. */
    CHECK_CLOSE(sqrt(line[0] * line[0] + line[1] * line[1]), 4.0 / PI * 4.0 / PI * pow(0.5, 0.25) * LEVEL,
                0.01 * LEVEL);
}

TEST(real_time_gives_the_same_sound_as_fast) {
    const char *path = write_plate("plate.gltf", TAG);
    SCOPED_PROCESS a = RUN_TOOL("run", path, "--seconds", "1", "--wav", tool_path("a.wav"), "--fast");
    SCOPED_PROCESS b = RUN_TOOL("run", path, "--seconds", "1", "--wav", tool_path("b.wav"));
    static double of[2][48000];
    check_done(&a);
    check_done(&b);
    assert_int_equal(read_wav(tool_path("a.wav"), of[0], 48000), 48000);
    assert_int_equal(read_wav(tool_path("b.wav"), of[1], 48000), 48000);
    assert_memory_equal(of[0], of[1], sizeof of[0]);
}

TEST(a_sound_does_not_replace_the_model) {
    const char *path = write_plate("plate.gltf", TAG);
    SCOPED_PROCESS p = RUN_TOOL("run", path, "--seconds", "1", "--fast", "--wav", path);
    check_refused(&p, 1, "it would be replaced", "a model");
}

SUITE_FIXTURES(make_folder, remove_folder)
