/* The force of a HIP on a voice coil: raw samples of 16 bits at 48 kHz, mono, written as the ticks happen. A sound
 * player sends them to a channel of a sound card that drives the coil, for example, with ALSA:
 *   coil /dev/stdout | aplay -D hw:1 -t raw -f S16_LE -r 48000 -c 1 --buffer-time=4000
 * usage: coil FILE [DEVICE]; by default the fake device strokes a grating. Runs for five seconds, and prints ten
 * times a second the strengths for a gamepad's two motors. SPDX-License-Identifier: MIT */
#include <knurl/knurl.h>

#include <math.h>
#include <stdio.h>

#define RATE     48000.0 /* Hz: samples */
#define TICKS    1000.0  /* Hz */
#define SECONDS  5.0
#define BLOCK    96    /* samples: 2 ms */
#define INTERVAL 0.001 /* s between two looks at the ticks */

/* A grating of 2 mm that the fake device's hand strokes. */
static knurl_result make_scene(knurl_scene **scene) {
    knurl_plane_desc plane;
    knurl_material_desc material;
    knurl_surface_desc surface;
    knurl_plane_desc_init(&plane, sizeof plane);
    knurl_material_desc_init(&material, sizeof material);
    knurl_surface_desc_init(&surface, sizeof surface);
    material.spatial_frequency[0] = 500.0;
    material.amplitude = 0.0004;
    surface.plane = &plane;
    surface.material = &material;
    surface.normal[1] = 1.0;
    knurl_result result = knurl_scene_create(NULL, scene);
    result = result ? result : knurl_scene_add_surface(*scene, &surface, NULL);
    return result ? result : knurl_scene_commit(*scene);
}

/* Writes as many samples as the ticks so far are long, so that no sample waits in a pipe. */
static int play(knurl_loop *loop, knurl_audio *audio, FILE *out) {
    uint64_t written = 0;
    int ended = 0;
    while (!ended) {
        knurl_loop_stats stats;
        double rumble[2];
        ended = knurl_loop_wait(loop, INTERVAL) != 0;
        knurl_loop_stats_init(&stats, sizeof stats);
        if (knurl_loop_get_stats(loop, &stats)) {
            return 1;
        }
        while ((double)written + BLOCK <= RATE * (double)stats.ticks / TICKS) {
            float samples[BLOCK];
            unsigned char bytes[2 * BLOCK];
            knurl_audio_fill(audio, samples, BLOCK);
            for (int i = 0; i < BLOCK; i++) {
                const int value = (int)lrintf(32767.0f * samples[i]) & 0xffff;
                bytes[2 * i] = (unsigned char)(value & 0xff);
                bytes[2 * i + 1] = (unsigned char)(value >> 8);
            }
            if (fwrite(bytes, sizeof bytes, 1, out) != 1 || fflush(out)) {
                (void)knurl_fail(KNURL_ERROR_IO, "the samples could not be written");
                return 1;
            }
            written += BLOCK;
            if (written % (50 * BLOCK) == 0 && !knurl_audio_get_rumble(audio, rumble)) {
                (void)fprintf(stderr, "rumble: slow motor %.2f, fast motor %.2f\n", rumble[0], rumble[1]);
            }
        }
    }
    return 0;
}

static knurl_result start(const char *uri, knurl_scene **scene, knurl_device **device, knurl_audio **audio,
                          knurl_loop **loop) {
    knurl_audio_desc voice;
    knurl_loop_desc desc;
    knurl_audio_desc_init(&voice, sizeof voice);
    knurl_loop_desc_init(&desc, sizeof desc);
    voice.voice = KNURL_VOICE_COIL;
    voice.sample_rate_hz = RATE;
    voice.update_rate_hz = TICKS;
    knurl_result result = make_scene(scene);
    result = result ? result : knurl_device_open(uri, device);
    result = result ? result : knurl_audio_create(&voice, audio);
    desc.scene = *scene;
    desc.device = *device;
    desc.tick_callback = knurl_audio_take; /* each tick, on the haptic thread */
    desc.user = *audio;
    desc.update_rate_hz = TICKS;
    desc.tick_limit = (uint64_t)(TICKS * SECONDS);
    result = result ? result : knurl_loop_create(&desc, loop);
    return result ? result : knurl_loop_start(*loop);
}

int main(int argc, char **argv) {
    knurl_scene *scene = NULL;
    knurl_device *device = NULL;
    knurl_audio *audio = NULL;
    knurl_loop *loop = NULL;
    FILE *out = argc > 1 ? fopen(argv[1], "wb") : NULL;
    if (!out) {
        (void)fprintf(stderr, "usage: coil FILE [DEVICE], with a file that can be written, such as /dev/stdout\n");
        return 2;
    }
    (void)knurl_device_zero_on_exit(0); /* zero force however this program ends */
    const int failed =
        start(argc > 2 ? argv[2] : "fake", &scene, &device, &audio, &loop) != KNURL_OK || play(loop, audio, out);
    if (failed) {
        (void)fprintf(stderr, "coil: %s\n", knurl_error_message());
    }
    knurl_loop_destroy(loop);
    knurl_audio_destroy(audio); /* after the loop, which gives it ticks */
    knurl_device_close(device);
    knurl_scene_destroy(scene);
    return fclose(out) != 0 || failed;
}
