/* Sound: an AudioStream and its AudioStreamPlayback, whose samples come from the session. The playback is used by the
 * engine's audio thread, and may live longer than the device. SPDX-License-Identifier: MIT */
#include "sound.h"

#include "serve.h"

/* The child node of the device that plays the sound, the game's or ours. */
#define PLAYER "Sound"

typedef struct sound_user {
    gd_instance base;
    knurl_sound
        *sound; /* or null: silence. Only a stream's first playback gets it: two would get half of the samples each */
    uint32_t is_playing;
} sound_user;

static int init(void *self) {
    (void)self;
    return 1;
}

static void finish(void *self) {
    knurl_sound_release(((sound_user *)self)->sound);
}

static void make_playback(GDExtensionClassInstancePtr self, const GDExtensionConstTypePtr *arguments,
                          GDExtensionTypePtr result) {
    sound_user *stream = self;
    const GDExtensionObjectPtr made = gd_create(gd_unconst(&sound_playback_class));
    sound_user *playback = gd_instance_of(made, &sound_playback_class);
    (void)arguments;
    if (playback) {
        playback->sound = stream->sound;
        stream->sound = NULL;
    }
    gd.ref_set_object(result, made);
}

static void start(GDExtensionClassInstancePtr self, const GDExtensionConstTypePtr *arguments,
                  GDExtensionTypePtr result) {
    (void)arguments;
    (void)result;
    __atomic_store_n(&((sound_user *)self)->is_playing, 1, __ATOMIC_RELEASE);
}

static void stop(GDExtensionClassInstancePtr self, const GDExtensionConstTypePtr *arguments,
                 GDExtensionTypePtr result) {
    (void)arguments;
    (void)result;
    __atomic_store_n(&((sound_user *)self)->is_playing, 0, __ATOMIC_RELEASE);
}

static void is_playing(GDExtensionClassInstancePtr self, const GDExtensionConstTypePtr *arguments,
                       GDExtensionTypePtr result) {
    (void)arguments;
    *(uint8_t *)result = __atomic_load_n(&((sound_user *)self)->is_playing, __ATOMIC_ACQUIRE) != 0;
}

/* Both channels get the same samples. */
static void mix(GDExtensionClassInstancePtr self, const GDExtensionConstTypePtr *arguments, GDExtensionTypePtr result) {
    enum { CHUNK = 256 };
    float mono[CHUNK] = {0.0F};
    float *frames;
    int64_t count;
    memcpy(&frames, arguments[0], sizeof frames);
    memcpy(&count, arguments[2], sizeof count);
    for (int64_t done = 0; done < count; done += CHUNK) {
        const uint32_t now = (uint32_t)(count - done < CHUNK ? count - done : CHUNK);
        knurl_sound_fill(((sound_user *)self)->sound, mono, now);
        for (uint32_t i = 0; i < now; i++) {
            *frames++ = mono[i];
            *frames++ = mono[i];
        }
    }
    *(int64_t *)result = count;
}

double sound_mix_rate(void) {
    double rate = 0.0;
    gd_name name = gd_name_new("AudioServer");
    gd_variant found = gd_call_named(gd.global_get_singleton(&name), "get_mix_rate", NULL, 0);
    gd_types[GDEXTENSION_VARIANT_TYPE_FLOAT].from_variant(&rate, &found);
    gd.variant_destroy(&found);
    gd_name_end(&name);
    return rate;
}

static gd_variant wrap_text(const char *text) {
    gd_string string;
    gd.string_new_with_utf8_chars(&string, text);
    const gd_variant wrapped = gd_wrap(GDEXTENSION_VARIANT_TYPE_STRING, &string);
    gd_types[GDEXTENSION_VARIANT_TYPE_STRING].end(&string);
    return wrapped;
}

static void call(GDExtensionObjectPtr object, const char *method, gd_variant argument) {
    gd_variant result = gd_call_named(object, method, &argument, 1);
    gd.variant_destroy(&result);
    gd.variant_destroy(&argument);
}

static GDExtensionObjectPtr find_player(const device *d) {
    GDExtensionObjectPtr player = NULL;
    gd_variant path = wrap_text(PLAYER);
    gd_variant found = gd_call_named(d->base.object, "get_node_or_null", &path, 1);
    gd_types[GDEXTENSION_VARIANT_TYPE_OBJECT].from_variant(&player, &found);
    gd.variant_destroy(&found);
    gd.variant_destroy(&path);
    return player;
}

static GDExtensionObjectPtr make_player(const device *d) {
    gd_name class_name = gd_name_new("AudioStreamPlayer");
    GDExtensionObjectPtr player = gd.classdb_construct_object(&class_name);
    gd_name_end(&class_name);
    call(player, "set_name", wrap_text(PLAYER));
    call(d->base.object, "add_child", gd_wrap(GDEXTENSION_VARIANT_TYPE_OBJECT, &player));
    return player;
}

knurl_result sound_start(const device *d) {
    knurl_sound *sound = NULL;
    const double start_at = 0.0;
    if (!d->sound || !d->runs) {
        return KNURL_OK;
    }
    const knurl_result result = knurl_session_get_sound(d->session, sound_mix_rate(), &sound);
    if (result) {
        return result;
    }
    GDExtensionObjectPtr player = find_player(d);
    player = player ? player : make_player(d);
    const GDExtensionObjectPtr stream = gd_create(gd_unconst(&sound_stream_class));
    sound_user *user = gd_instance_of(stream, &sound_stream_class);
    if (user) {
        user->sound = sound;
        call(player, "set_stream", gd_wrap(GDEXTENSION_VARIANT_TYPE_OBJECT, &stream));
        call(player, "play", gd_wrap(GDEXTENSION_VARIANT_TYPE_FLOAT, &start_at));
    } else {
        knurl_sound_release(sound);
    }
    return KNURL_OK;
}

void sound_stop(const device *d) {
    const GDExtensionObjectPtr player = d->sound ? find_player(d) : NULL;
    if (player) {
        gd_variant nothing;
        gd.variant_new_nil(&nothing);
        call(player, "set_stream", nothing); /* and stops */
    }
}

static const gd_virtual_row stream_virtuals[] = {{"_instantiate_playback", make_playback}};
static const gd_virtual_row playback_virtuals[] = {
    {"_start", start}, {"_stop", stop}, {"_is_playing", is_playing}, {"_mix", mix}};

const gd_class sound_stream_class = {
    .name = "KnurlSoundStream",
    .base = "AudioStream",
    .size = sizeof(sound_user),
    .init = init,
    .finish = finish,
    .is_hidden = 1,
    .virtuals = stream_virtuals,
    .virtual_count = sizeof stream_virtuals / sizeof *stream_virtuals,
};

const gd_class sound_playback_class = {
    .name = "KnurlSoundPlayback",
    .base = "AudioStreamPlayback",
    .size = sizeof(sound_user),
    .init = init,
    .finish = finish,
    .is_hidden = 1,
    .virtuals = playback_virtuals,
    .virtual_count = sizeof playback_virtuals / sizeof *playback_virtuals,
};
