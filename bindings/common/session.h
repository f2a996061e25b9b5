/* What all engine bindings share, in C, so that a binding is left with conversion, lifetime and editor support. A
 * session is one device, one scene and one loop that live together, and their events once per frame. Order of calls:
 * create; add surfaces to knurl_session_get_scene(); open; (add surfaces that need a running device); start; update
 * once per frame; close; open again or destroy. All calls come from the game thread and never wait for the haptic
 * thread. Scene axes are Knurl's (right-handed, SI); bindings convert their engine's.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SESSION_H
#define KNURL_SESSION_H

#include <knurl/audio.h>
#include <knurl/loop.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct knurl_session knurl_session;
typedef struct knurl_sound knurl_sound;

/** The latest ticks that a session keeps for plots. */
#define KNURL_SESSION_HISTORY 8192

/** How a device is run. Strings are copied. */
typedef struct knurl_session_desc {
    uint32_t struct_size;      /**< set by knurl_session_desc_init() */
    uint32_t reconnect;        /**< 1 (default): a lost device is looked for again; 0: losing it ends the run */
    uint32_t clamp;            /**< 1 (default): walls beyond what the device can do are felt at what it can */
    uint32_t reserved;         /**< 0 */
    const char *device;        /**< UTF-8: a URI of knurl_device_open(), default "fake"; or "auto": the first that is
                                    connected; or "mouse": no device, the game moves the HIP with
                                    knurl_session_move_hip() */
    const char *stroke;        /**< of a fake device's hand, over the scene's first surface: a name that
                                    knurl_stroke_from_name() knows; "" (default): it stands still at the origin */
    double update_rate_hz;     /**< KNURL_UPDATE_RATE_MIN to _MAX; default 1000 */
    double heartbeat_s;        /**< s without knurl_session_update() after which the force goes to zero; default 0.25;
                                    0: never */
    knurl_workspace workspace; /**< where the device's workspace lies in the scene */
} knurl_session_desc;

/** What a session's run is doing, as of its latest tick. Scene axes. All zeros while nothing runs. */
typedef struct knurl_session_state {
    double hip[3];             /**< m */
    double proxy[3];           /**< m: the point of the surface that holds the HIP */
    double force[3];           /**< N, as sent */
    double height;             /**< m: of the grating under the finger */
    double temporal_frequency; /**< Hz: ridges a second that the motion asks for */
    knurl_surface_id surface;  /**< what was last told to be touched (KNURL_SESSION_CONTACT_STARTED), or 0 */
    uint64_t ticks;            /**< sent since the start */
    uint64_t overruns;         /**< ticks that came late; updates count them ten times a second */
    uint32_t buttons;          /**< bit 0: first button; as of the latest update */
    uint32_t running;          /**< 1: the haptic thread runs */
    uint32_t in_contact;       /**< 1: something is touched, told or not */
    uint32_t paused;           /**< 1: as knurl_session_set_paused() had it */
    double velocity[3];        /**< m/s: of the HIP */
    double depth;              /**< m: how deep the HIP is in what is touched; negative among a grating's crests */
    double impulse[3];         /**< N s: the sum of all forces over time since the start: what is touched has got the
                                    opposite of what came in since the last look */
    double stylus[4];          /**< unit quaternion x, y, z, w from the stylus's axes to the scene's, as of the latest
                                    update; zeros where the device does not measure it */
    double ridges;             /**< passed since the start, of all surfaces touched */
} knurl_session_state;

/** What happened. */
enum {
    KNURL_SESSION_CONTACT_STARTED = 1, /**< `surface` is touched; of several, the one pressed deepest */
    KNURL_SESSION_CONTACT_ENDED = 2,   /**< `surface` is not the one touched any more, or the run ended */
    KNURL_SESSION_BUTTON = 3,          /**< button `code` was pressed (`value` 1) or released (0) */
    KNURL_SESSION_FAULT = 4,           /**< KNURL_FAULT_ `code`, with its `value` */
    KNURL_SESSION_ENDED = 5            /**< the loop ended by itself (the device was lost): close the session */
};

typedef struct knurl_session_event {
    int32_t kind; /**< KNURL_SESSION_ */
    int32_t code;
    double value;
    knurl_surface_id surface; /**< it may be gone from the scene by now */
} knurl_session_event;

/** What moves an engine's objects: each frame, or each step of its physics. */
enum { KNURL_SESSION_FRAMES = 0, KNURL_SESSION_STEPS = 1, KNURL_SESSION_CLOCKS = 2 };

/** A surface that follows an engine's object. The binding's, one a surface and session; before its first move in a run:
 * the position that it was added with, zeros, and its clock. */
typedef struct knurl_session_way {
    double position[3]; /**< m: where the scene last heard it is */
    uint64_t tick;      /**< when */
    double time;        /**< s: that clock's, at the latest move; for the session */
    double lag;         /**< s: that this surface's moves come late; for the session */
    uint32_t clock;     /**< KNURL_SESSION_FRAMES (default) or _STEPS: what moves it, as of the next move */
    uint32_t moved;     /**< 1: it has moved by that clock; for the session */
} knurl_session_way;

/** A matrix as Knurl wants it: matrix = translation(position) * rotation * rest. */
typedef struct knurl_session_pose {
    double position[3];
    double rotation[9];   /**< row-major, orthonormal, right-handed */
    double quaternion[4]; /**< the same: x, y, z, w */
    double rest[9]; /**< row-major scale, shear and mirror: baked into meshes; exactly 1 where it is within 1e-5 */
} knurl_session_pose;

/** Fills in defaults; `size` is the caller's sizeof. [any thread] */
KNURL_API void knurl_session_desc_init(knurl_session_desc *desc, uint32_t size);

/** Makes a session with an empty scene. Errors: KNURL_ERROR_MEMORY. [game thread] */
KNURL_API knurl_result knurl_session_create(knurl_session **session);

/** Closes and gives everything back; null is allowed. The haptic thread ends first, with a ramp of the force to zero.
 * [game thread; or, once nobody uses the session, any thread] */
KNURL_API void knurl_session_destroy(knurl_session *session);

/** Closes every session of the process: before a library is unloaded. Returns how many were running. [game thread; what
 * nobody uses may be destroyed on others meanwhile] */
KNURL_API uint32_t knurl_session_close_all(void);

/** The session's scene, for surfaces: knurl_scene_add_surface() and so on, knurl_gltf_load_file(). It is the same from
 * create to destroy, never null. [game thread] */
KNURL_API knurl_scene *knurl_session_get_scene(knurl_session *session);

/** The device of an open session, for knurl_device_get_info() and so on; null while closed. [game thread] */
KNURL_API knurl_device *knurl_session_get_device(knurl_session *session);

/** The loop of a session that was started or has played, for knurl_loop_get_stats(); null otherwise. [game thread] */
KNURL_API knurl_loop *knurl_session_get_loop(knurl_session *session);

/** Opens the device. Errors: KNURL_ERROR_STATE (open already), KNURL_ERROR_ARGUMENT (which field), KNURL_ERROR_UNKNOWN
 * (stroke), and those of knurl_device_open(). [game thread] */
KNURL_API knurl_result knurl_session_open(knurl_session *session, const knurl_session_desc *desc);

/** Commits the scene where that has not happened, sets up its HIP, lays the fake hand's stroke and starts the haptic
 * thread. warning: null, or gets a sentence about what will not be as asked for ("" where all is well), at most `size`
 * bytes. Errors: KNURL_ERROR_STATE (not open, or started), those of knurl_scene_configure_hip() and
 * knurl_loop_create(); the session is to be closed then. [game thread] */
KNURL_API knurl_result knurl_session_start(knurl_session *session, char *warning, uint32_t size);

/** Instead of a start: what an open fake device would play along a path, as fast as the machine can, on this thread.
 * rows: t (s, ascending), x, y, z (m, scene) each, interpolated. forces: three a tick (N, scene), room for
 * `ticks` (1 to 1e8). *played: how many ticks there were. The session is to be closed afterwards.
 * Errors: as knurl_session_start(), KNURL_ERROR_ARGUMENT, KNURL_ERROR_UNSUPPORTED (not a fake device). [game thread] */
KNURL_API knurl_result knurl_session_play(knurl_session *session, const double *rows, uint64_t row_count,
                                          uint64_t ticks, double *forces, uint64_t *played);

/** Ends the run, zeroes the force and closes the device; what was touched is told as ended by the next
 * knurl_session_next_event(). Surfaces stay. Twice is fine. [game thread] */
KNURL_API void knurl_session_close(knurl_session *session);

/** A sign of life, once a frame, and collects what happened since the last. Nothing is asked of the heap; what nobody
 * fetches is kept up to a bound, the latest of it. [game thread] */
KNURL_API void knurl_session_update(knurl_session *session);

/** 1: a pause: the force goes to zero by a ramp, what is touched is told as ended, and the HIP is told on; 0: the end
 * of one, see knurl_loop_pause(). No update is needed meanwhile. It counts for this run and for later ones, until it is
 * set anew; knurl_session_play() knows no pause. [game thread] */
KNURL_API void knurl_session_set_paused(knurl_session *session, uint32_t paused);

/** The next event, oldest first: 1, or 0 where there is none. A touch shorter than a frame is told as well; what comes
 * back within a frame was never away; each start has its end. Of faults no more than 64 are told an update, so that a
 * frame ends however slowly they are handled. Closing in the middle is fine. [game thread] */
KNURL_API uint32_t knurl_session_next_event(knurl_session *session, knurl_session_event *event);

/** A fault's sentence with its value and unit, as "no position came for too long (0.012 s)". Texts in a caller's buffer
 * are UTF-8, end with a 0 and are cut off after a whole character where `size` bytes do not hold them. [any thread] */
KNURL_API void knurl_session_fault_text(int32_t code, double value, char *text, uint32_t size);

/** What the run is doing. [game thread] */
KNURL_API void knurl_session_get_state(const knurl_session *session, knurl_session_state *state);

/** The latest ticks, at most KNURL_SESSION_HISTORY, oldest first: two floats each, the grating's height (m) and the
 * force along the normal (N). rows: room for `count` ticks. Returns how many there were; none while closed.
 * [game thread] */
KNURL_API uint32_t knurl_session_get_history(const knurl_session *session, uint32_t count, float *rows);

/** Moves the HIP of the device "mouse" (scene, m). What comes in steps is smoothed: it lags 25 ms behind. Errors:
 * KNURL_ERROR_STATE (another device, or none), KNURL_ERROR_ARGUMENT (not finite). [game thread] */
KNURL_API knurl_result knurl_session_move_hip(knurl_session *session, const double position[3]);

/** Moves a running session's workspace along with the engine's node: as surfaces are, see knurl_session_move_surface(),
 * so that a HIP is carried through what is in its way; or as a leap where it is faster than 10 m/s: then what lies in
 * between is not touched. A change of scale moves the HIP likewise, see knurl_scene_set_workspace(); the mouse's HIP
 * stays where the game moved it. clock: what moves it. Errors: KNURL_ERROR_STATE (it does not run), those of
 * knurl_scene_set_workspace(), KNURL_ERROR_ARGUMENT (clock). [game thread] */
KNURL_API knurl_result knurl_session_move_workspace(knurl_session *session, uint32_t clock,
                                                    const knurl_workspace *workspace);

/** 1: nothing is felt, and the HIP stays where it is in the scene, while the hand moves its device elsewhere; 0: the
 * HIP follows the hand again, from where it stayed, and walls come back as after a pause. A scale that is given
 * meanwhile counts from then on, about the HIP. Errors: KNURL_ERROR_STATE (it does not run). [game thread] */
KNURL_API knurl_result knurl_session_set_clutch(knurl_session *session, uint32_t on);

/** See knurl_loop_set_gain(). It counts for this run and for later ones, until it is set anew; 1 before. Errors:
 * KNURL_ERROR_ARGUMENT. [game thread] */
KNURL_API knurl_result knurl_session_set_gain(knurl_session *session, double gain);

/** See knurl_loop_set_force() and knurl_loop_vibrate(); until the run ends. Errors: theirs, KNURL_ERROR_STATE (it does
 * not run). [game thread] */
KNURL_API knurl_result knurl_session_set_force(knurl_session *session, const double force[3]);
KNURL_API knurl_result knurl_session_vibrate(knurl_session *session, int32_t method, double frequency_hz,
                                             double amplitude, const double direction[3], double seconds);

/** The sound of what is felt in this run, see knurl_audio; made at the first call. sample_rate_hz: 8000 to 192000;
 * later calls in the same run give the same sound, of the first call's rate. *sound: to be released. Errors:
 * KNURL_ERROR_STATE (it does not run), KNURL_ERROR_ARGUMENT (sample_rate_hz), KNURL_ERROR_MEMORY. [game thread] */
KNURL_API knurl_result knurl_session_get_sound(knurl_session *session, double sample_rate_hz, knurl_sound **sound);

/** Renders the next `count` samples, as knurl_audio_fill(). After the run they fade to exactly 0. Null: nothing is
 * done. [audio thread, one per run] */
KNURL_API void knurl_sound_fill(knurl_sound *sound, float *samples, uint32_t count) KNURL_NONBLOCKING;

/** Gives a sound back, also after its session was destroyed; null is allowed. [any thread, after its last fill] */
KNURL_API void knurl_sound_release(knurl_sound *sound);

/** Tells how far one of the engine's clocks has come, once a frame, before surfaces are moved. clock:
 * KNURL_SESSION_FRAMES: the sum of the frames' lengths, as objects that are moved in frames are given them; or _STEPS:
 * the physics steps so far times their length. seconds: in real time, that is, divided by a time scale. Surfaces are
 * then moved evenly by that clock, later by what its moves come late: frames and steps of any pair of rates come in no
 * even rhythm. Errors: KNURL_ERROR_ARGUMENT. [game thread] */
KNURL_API knurl_result knurl_session_tell_time(knurl_session *session, uint32_t clock, double seconds);

/** Moves a surface along with its object: felt as a motion that is over when the next move is due by its way's clock;
 * where nobody tells that clock, one that took the time since the last move, in ticks; or as a leap where it is faster
 * than 10 m/s. rotation: unit quaternion. Errors: those of knurl_scene_set_transform(), KNURL_ERROR_ARGUMENT (the way's
 * clock). [game thread] */
KNURL_API knurl_result knurl_session_move_surface(knurl_session *session, knurl_surface_id surface,
                                                  knurl_session_way *way, const double position[3],
                                                  const double rotation[4]);

/** Why a surface of an open session cannot be felt, or, once that is started, not as asked for: a sentence a line, ""
 * where all is well; cut off after `size` - 1 bytes. [game thread] */
KNURL_API void knurl_session_explain(knurl_session *session, knurl_surface_id surface, char *text, uint32_t size);

/** Splits a matrix (row-major, three rows of four, the last column m): 1, or 0, with the pose untouched, where it has
 * no volume (a scale of 0) or is not finite. [any thread] */
KNURL_API uint32_t knurl_session_split_pose(const double matrix[12], knurl_session_pose *pose);

/** 1 where two rests are the same to a float's rounding. [any thread] */
KNURL_API uint32_t knurl_session_same_rest(const double a[9], const double b[9]);

#ifdef __cplusplus
}
#endif
#endif
