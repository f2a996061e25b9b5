/* Every public function with null for each of its pointers in turn, with handles of another kind and with handles that
 * were destroyed: nothing crashes, nothing is written, and a sentence names the parameter. pointers.py writes the table
 * from the headers, so that no function is left out. Each call is made in a process of its own.
 * SPDX-License-Identifier: MIT */
#include "support/close.h"
#include "support/idle_device.h"

#include "session.h"

#include <knurl/knurl.h>
#include <signal.h>
#include <stdio.h>
#include <sys/wait.h>
#include <unistd.h>

#include "pointers.g.h"

enum { KIND_SCENE = 1, KIND_DEVICE, KIND_LOOP, KIND_SESSION, KIND_AUDIO, KINDS = KIND_AUDIO };
enum { RETURNS_NOTHING, RETURNS_VALUE, RETURNS_RESULT };
enum { MOST_PARAMETERS = 6 };

/* Valid arguments. */
typedef struct fixture {
    structs with;
    knurl_scene *scene, *open_scene; /* committed, with a surface 'plate'; not committed */
    knurl_device *device;
    knurl_loop *loop;
    knurl_session *session, *open_session, *mouse_session, *played_session;
    knurl_audio *audio;
    const void *destroyed[KINDS + 1];
    knurl_surface_id surface, session_surface;
    knurl_scene *new_scene;
    knurl_device *new_device;
    knurl_loop *new_loop;
    knurl_session *new_session;
    knurl_audio *new_audio;
    knurl_sound *sound;
    knurl_surface_id new_surface;
    unsigned char file[65536];
    uint64_t file_size, count;
    int32_t number;
    double vector[4], axis[4], quaternion[4], matrix[12], rows[8], out[4], forces[12];
    float history[2];
    knurl_gain gains[KNURL_GAINS];
    knurl_effect effect;
    char text[256];
    knurl_hip_contact contacts[1];
} fixture;

typedef struct parameter {
    const char *name;
    int kind; /* KIND_, or 0: no handle */
    int may_be_null;
} parameter;

typedef struct function {
    const char *name;
    int returns;
    int is_quiet; /* 1: on the haptic path: a message only if it returns a result */
    int pointer_count;
    parameter pointers[MOST_PARAMETERS];
    void (*fill)(fixture *f, void **pointers);
    int64_t (*call)(fixture *f, void **pointers);
} function;

static double no_height(const knurl_method_input *input, double *memory, void *user) KNURL_NONBLOCKING {
    (void)input;
    (void)memory;
    (void)user;
    return 0.0;
}

static void ignore_texture(void *user, const knurl_gltf_texture *texture) {
    (void)user;
    (void)texture;
}

static void ignore_tag(void *user, const char *array, uint32_t index, const char *object, const char *tag) {
    (void)user, (void)array, (void)index, (void)object, (void)tag;
}

static void ignore_file(void *user, const void *data, uint64_t size) {
    (void)user, (void)data, (void)size;
}

#define FUNCTIONS
#include "pointers.g.h"

/* For the child, in which cmocka would continue with the next test. */
#define NEED(condition)                                                                                                \
    do {                                                                                                               \
        if (!(condition)) {                                                                                            \
            print_error("%s:%d: %s: %s\n", __FILE__, __LINE__, #condition, knurl_error_message());                     \
            _exit(3);                                                                                                  \
        }                                                                                                              \
    } while (0)
#define NEED_OK(call) NEED((call) == KNURL_OK)

static void no_force(uint64_t tick, const knurl_device_sample *sample, double force[3], void *user) {
    (void)tick;
    (void)sample;
    (void)user;
    force[0] = force[1] = force[2] = 0.0;
}

static knurl_surface_id add_plate(fixture *f, knurl_scene *scene) {
    knurl_surface_id id = 0;
    NEED_OK(knurl_scene_add_surface(scene, &f->with.surface_desc, &id));
    return id;
}

static knurl_session *make_session(fixture *f, const char *device, int is_played) {
    knurl_session *session = NULL;
    knurl_session_desc desc;
    knurl_session_desc_init(&desc, sizeof desc);
    desc.device = device;
    NEED_OK(knurl_session_create(&session));
    f->session_surface = add_plate(f, knurl_session_get_scene(session));
    if (device) {
        NEED_OK(knurl_session_open(session, &desc));
    }
    if (is_played) {
        NEED_OK(knurl_session_play(session, f->rows, 2, 4, f->forces, &f->count));
    }
    return session;
}

static void read_plate(fixture *f) {
    FILE *file = fopen(KNURL_TEST_ASSETS "/plate_1d.glb", "rb");
    NEED(file);
    f->file_size = fread(f->file, 1, sizeof f->file, file);
    NEED(f->file_size > 0 && f->file_size < sizeof f->file);
    NEED(fclose(file) == 0);
}

static void fill_structs(fixture *f) {
    structs *w = &f->with;
    init_structs(w);
    w->surface_desc.name = "plate";
    w->surface_desc.plane = &w->plane_desc;
    w->surface_desc.material = &w->material_desc;
    w->device_functions = idle_functions();
    w->grating.spatial_frequency[0] = 1000.0;
    w->grating.update_rate_hz = 1000.0;
    w->grating.method = KNURL_METHOD_BANDLIMITED;
    w->session_desc.device = "fake";
    knurl_workspace_set_identity(&w->workspace);
    NEED_OK(knurl_vibration_event_prepare(5.0, 1e-4, &w->vibration_event));
    NEED_OK(knurl_wave_prepare(KNURL_WAVE_T3, 0.01, 1.0, 1000.0, &w->wave));
    NEED_OK(knurl_velocity_prepare(KNURL_VELOCITY_AUTO, 0.0, 1000.0, &w->velocity));
}

/* Destroys some handles, as the last action, so that their memory is not reused. */
static void destroy_some(fixture *f) {
    knurl_scene *scene = NULL;
    knurl_device *device = NULL;
    knurl_loop *loop = NULL;
    knurl_session *session = NULL;
    knurl_audio *audio = NULL;
    NEED_OK(knurl_session_create(&session));
    NEED_OK(knurl_audio_create(NULL, &audio));
    NEED_OK(knurl_scene_create(NULL, &scene));
    NEED_OK(knurl_device_open("fake", &device));
    f->with.loop_desc.device = device;
    NEED_OK(knurl_loop_create(&f->with.loop_desc, &loop));
    knurl_loop_destroy(loop);
    knurl_device_close(device);
    knurl_scene_destroy(scene);
    knurl_audio_destroy(audio);
    knurl_session_destroy(session);
    f->destroyed[KIND_SCENE] = scene;
    f->destroyed[KIND_DEVICE] = device;
    f->destroyed[KIND_LOOP] = loop;
    f->destroyed[KIND_SESSION] = session;
    f->destroyed[KIND_AUDIO] = audio;
}

static void make(fixture *f) {
    memset(f, 0, sizeof *f);
    f->axis[0] = f->quaternion[3] = f->matrix[0] = f->matrix[5] = f->matrix[10] = 1.0;
    f->rows[4] = 1.0;
    f->number = 1;
    fill_structs(f);
    read_plate(f);
    NEED_OK(knurl_scene_create(NULL, &f->scene));
    f->surface = add_plate(f, f->scene);
    NEED_OK(knurl_scene_commit(f->scene));
    NEED_OK(knurl_scene_create(NULL, &f->open_scene));
    NEED_OK(knurl_device_open("fake", &f->device));
    knurl_device *other = NULL;
    NEED_OK(knurl_device_open("fake", &other));
    f->with.loop_desc.force_callback = no_force;
    f->with.loop_desc.device = other;
    NEED_OK(knurl_loop_create(&f->with.loop_desc, &f->loop));
    NEED_OK(knurl_audio_create(NULL, &f->audio));
    f->session = make_session(f, NULL, 0);
    f->mouse_session = make_session(f, "mouse", 0);
    f->played_session = make_session(f, "fake", 1);
    f->open_session = make_session(f, "fake", 0);
    NEED_OK(knurl_session_get_sound(f->played_session, 48000.0, &f->sound));
    destroy_some(f);
    f->with.loop_desc.device = f->device;
}

static const void *handle_of(const fixture *f, int kind) {
    return kind == KIND_SCENE    ? (const void *)f->scene
           : kind == KIND_DEVICE ? (const void *)f->device
           : kind == KIND_LOOP   ? (const void *)f->loop
           : kind == KIND_AUDIO  ? (const void *)f->audio
                                 : (const void *)f->session;
}

/* The value that a function returns for an invalid handle. */
static int64_t value_of_none(const char *name) {
    return strcmp(name, "knurl_loop_wait") == 0; /* it is not running: an endless wait must not happen */
}

/* In the child: calls a function with `bad` for one of its pointers. Returns the fault of the result, or null. */
static const char *call_with(const function *on, int at, const void *bad, fixture *f) {
    static fixture before;
    void *p[MOST_PARAMETERS] = {NULL};
    on->fill(f, p);
    memcpy(&p[at], &bad, sizeof bad);
    (void)knurl_fail(KNURL_ERROR_STATE, "stale");
    before = *f;
    const int64_t returned = on->call(f, p);
    const char *message = knurl_error_message();
    if (bad == NULL && on->pointers[at].may_be_null) {
        return NULL;
    }
    if (on->returns == RETURNS_RESULT && returned != KNURL_ERROR_ARGUMENT) {
        return "it does not return KNURL_ERROR_ARGUMENT";
    }
    if (on->returns == RETURNS_VALUE && returned != value_of_none(on->name)) {
        return "it returns something";
    }
    if (strcmp(on->name, "knurl_scene_tick") == 0) { /* its output is always filled in, with no force */
        before.with.tick_output = f->with.tick_output;
    }
    if (memcmp((const unsigned char *)&before, (const unsigned char *)f, sizeof before) != 0) {
        return "it writes something";
    }
    if ((on->returns == RETURNS_RESULT || !on->is_quiet) && !strstr(message, on->pointers[at].name)) {
        return message[0] ? message : "no message";
    }
    return NULL;
}

/* A process of its own for one call; cmocka's handlers would have it go on after a crash. Returns 0 in it. */
static pid_t begin_child(void) {
    static const int crashes[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
    (void)fflush(NULL);
    const pid_t child = fork();
    assert_true(child >= 0);
    for (size_t i = 0; child == 0 && i < COUNT_OF(crashes); i++) {
        (void)signal(crashes[i], SIG_DFL);
    }
    if (child == 0) {
        (void)alarm(10); /* nothing here waits */
    }
    return child;
}

typedef struct tally {
    int calls, crashes, complaints;
    int crashing_functions;
} tally;

enum { BAD_NULL, BAD_KIND, BAD_DESTROYED };

static const char *const bad_names[] = {"null", "a handle of another kind", "a destroyed handle"};

/* One call with a bad pointer in a process of its own. Returns 1 if it crashed. */
static int try_one(const function *on, int at, int bad, tally *sum) {
    const int kind = on->pointers[at].kind;
    const pid_t child = begin_child();
    if (child == 0) {
        static fixture f;
        make(&f);
        const void *pointer = bad == BAD_NULL   ? NULL
                              : bad == BAD_KIND ? handle_of(&f, kind % KINDS + 1)
                                                : f.destroyed[kind];
        const char *wrong = call_with(on, at, pointer, &f);
        if (wrong) {
            print_error("%s: %s is %s: %s\n", on->name, on->pointers[at].name, bad_names[bad], wrong);
        }
        _exit(wrong ? 2 : 0);
    }
    int status = 0;
    assert_int_equal(waitpid(child, &status, 0), child);
    const int crashed = !WIFEXITED(status) || (WEXITSTATUS(status) != 0 && WEXITSTATUS(status) != 2);
    if (crashed) {
        print_error("%s: %s is %s: it crashes\n", on->name, on->pointers[at].name, bad_names[bad]);
    }
    sum->calls++;
    sum->crashes += crashed;
    sum->complaints += !crashed && WEXITSTATUS(status) != 0;
    return crashed;
}

/* Each pointer of each function once; only handles can be of another kind or destroyed. */
static void try_all(int bad) {
    tally sum = {0, 0, 0, 0};
    for (size_t i = 0; i < COUNT_OF(functions); i++) {
        int crashes = 0;
        for (int at = 0; at < functions[i].pointer_count; at++) {
            if (bad == BAD_NULL || functions[i].pointers[at].kind) {
                crashes += try_one(&functions[i], at, bad, &sum);
            }
        }
        sum.crashing_functions += crashes > 0;
    }
    print_message("%d calls with %s: %d crashed (%d functions), %d went wrong\n", sum.calls, bad_names[bad],
                  sum.crashes, sum.crashing_functions, sum.complaints);
    assert_true(sum.calls > 0);
    assert_int_equal(sum.crashes + sum.complaints, 0);
}

TEST(null_for_any_pointer_is_an_error_that_names_it) {
    try_all(BAD_NULL);
}

TEST(a_handle_of_another_kind_is_an_error_that_names_it) {
    try_all(BAD_KIND);
}

TEST(a_handle_that_was_destroyed_is_an_error_that_names_it) {
    try_all(BAD_DESTROYED);
}

/* Otherwise the calls above might be refused for another reason. */
TEST(the_table_s_arguments_are_valid_but_for_the_one_that_is_replaced) {
    for (size_t i = 0; i < COUNT_OF(functions); i++) {
        const pid_t child = begin_child();
        if (child == 0) {
            static fixture f;
            void *p[MOST_PARAMETERS] = {NULL};
            make(&f);
            functions[i].fill(&f, p);
            const int64_t returned = functions[i].call(&f, p);
            const int is_meant = returned == KNURL_OK || strcmp(functions[i].name, "knurl_fail") == 0 ||
                                 functions[i].returns != RETURNS_RESULT;
            if (!is_meant) {
                print_error("%s: %d, %s\n", functions[i].name, (int)returned, knurl_error_message());
            }
            _exit(!is_meant);
        }
        int status = 0;
        assert_int_equal(waitpid(child, &status, 0), child);
        if (status != 0) {
            print_error("%s with valid arguments\n", functions[i].name);
        }
        assert_int_equal(status, 0);
    }
}
