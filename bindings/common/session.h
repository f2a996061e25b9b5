/* The code shared by the engine bindings. A binding itself only converts types and axes, ties lifetimes to the engine's
 * objects and supports the editor. A session owns one device, one scene and one loop, and delivers their events once
 * per frame. Order of calls: create; add surfaces to knurl_session_get_scene(); open; (add surfaces that need a running
 * device); start; update once per frame; close; open again or destroy. All calls come from the game thread and never
 * wait for the haptic thread. Scene axes are Knurl's (right-handed, SI); bindings convert their engine's.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SESSION_H
#define KNURL_SESSION_H

#include <knurl/audio.h>
#include <knurl/loop.h>
#include <knurl/query.h>
#include <knurl/stroke.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct knurl_session knurl_session;
typedef struct knurl_sound knurl_sound;

/** Number of ticks that a session keeps for plots. */
#define KNURL_SESSION_HISTORY 8192

/** How a device is run. Strings are copied. */
typedef struct knurl_session_desc {
    uint32_t struct_size;  /**< set by knurl_session_desc_init() */
    uint32_t reconnect;    /**< 1 (default): a lost device is reopened when it is back; 0: its loss ends the run */
    uint32_t clamp;        /**< 1 (default): stiffness and amplitude are limited to what the device can render */
    uint32_t even;         /**< 1: even sensation: ridges as strong at any speed, by `response` or, without one, by the
                                device's mass and friction (knurl_gains_from_plant()). A mouse, and a device whose mass is
                                not known, do without. Default 0 */
    const char *device;    /**< UTF-8: a URI of knurl_device_open(), default "fake"; "auto": the first device that is
                                connected; or "mouse": no hardware, the game moves the HIP by
                                knurl_session_move_hip() */
    const char *stroke;    /**< how a fake device's hand strokes the scene's first surface: a name of
                                knurl_stroke_from_name(); "" (default): it rests at the origin */
    double update_rate_hz; /**< KNURL_UPDATE_RATE_MIN to _MAX; default 1000 */
    double heartbeat_s;    /**< s without knurl_session_update() after which the force goes to zero; default 0.25;
                                0: never */
    knurl_workspace workspace; /**< pose and scale of the device's workspace in the scene */
    const char *response;      /**< `response_size` bytes of a response file (knurl_gains_from_response()); null
                                    (default): none. Not used without `even` */
    uint64_t response_size;
} knurl_session_desc;

/** State of a session's run, as of its last tick. Scene axes. All zeros while nothing runs. */
typedef struct knurl_session_state {
    double hip[3];             /**< m */
    double proxy[3];           /**< m: the point of the surface that holds the HIP */
    double force[3];           /**< N, as sent */
    double height;             /**< m: of the grating under the finger */
    double temporal_frequency; /**< Hz: ridges per second at the HIP's velocity */
    knurl_surface_id surface;  /**< of the last KNURL_SESSION_CONTACT_STARTED; 0 after its end */
    uint64_t ticks;            /**< sent since the start */
    uint64_t overruns;         /**< late ticks; counted ten times per second */
    uint32_t buttons;          /**< bit 0: first button; as of the last update */
    uint32_t running;          /**< 1: the haptic thread runs */
    uint32_t in_contact;       /**< 1: the last tick touched a surface, whether its event was fetched or not */
    uint32_t paused;           /**< 1: paused by knurl_session_set_paused() */
    double velocity[3];        /**< m/s: of the HIP */
    double depth;              /**< m: of the HIP below the surface; negative among a grating's crests */
    double impulse[3];         /**< N s: all forces since the start, integrated over time. The touched object received
                                    the opposite of the difference between two reads */
    double stylus[4]; /**< unit quaternion x, y, z, w from the stylus's axes to the scene's, as of the last update;
                         zeros if the device does not measure it */
    double ridges;    /**< ridges crossed since the start, on all surfaces */
} knurl_session_state;

/** Kinds of events. */
enum {
    KNURL_SESSION_CONTACT_STARTED = 1, /**< `surface` is touched; if several are, the one pressed deepest */
    KNURL_SESSION_CONTACT_ENDED = 2,   /**< `surface` is no longer the touched one, or the run ended */
    KNURL_SESSION_BUTTON = 3,          /**< button `code` was pressed (`value` 1) or released (0) */
    KNURL_SESSION_FAULT = 4,           /**< KNURL_FAULT_ `code`, with its `value` */
    KNURL_SESSION_ENDED = 5            /**< the loop ended by itself (the device was lost): close the session */
};

typedef struct knurl_session_event {
    int32_t kind; /**< KNURL_SESSION_ */
    int32_t code;
    double value;
    knurl_surface_id surface; /**< may have been removed from the scene since */
} knurl_session_event;

/** The engine's clock that an object is moved by: frames or physics steps. */
enum { KNURL_SESSION_FRAMES = 0, KNURL_SESSION_STEPS = 1, KNURL_SESSION_CLOCKS = 2 };

/** State of a surface that follows an engine's object. The binding keeps one per surface and session. Before the first
 * move of a run: `position` as the surface was added, `clock`, `is_guess`, and zeros. */
typedef struct knurl_session_way {
    double position[3]; /**< m: as of the last move */
    double rotation[4]; /**< likewise */
    double times[2];    /**< s: of both clocks at the last move; used by the session */
    double speeds[2];   /**< by both clocks, in the last move; used by the session */
    double changes[2];  /**< of these speeds from move to move, lately; used by the session */
    double lag;         /**< s: delay of this surface's moves by `clock`; used by the session */
    uint64_t tick;      /**< of the last move */
    uint32_t clock;     /**< KNURL_SESSION_FRAMES (default) or _STEPS: for the next move */
    uint32_t is_guess;  /**< 1: `clock` is a guess; the session changes to the one by which the speed is more even */
    uint32_t moved;     /**< 1: it has moved by that clock; used by the session */
    uint32_t reserved;
} knurl_session_way;

/** A matrix as a rigid motion and a remainder: matrix = translation(position) * rotation * rest. */
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

/** Closes and frees a session; null is allowed. The haptic thread ends first: the force ramps down to zero.
 * [game thread; any thread once no other uses the session] */
KNURL_API void knurl_session_destroy(knurl_session *session);

/** Closes all sessions of the process, before the library is unloaded. Returns how many were running. [game thread;
 * other threads may destroy unused sessions meanwhile] */
KNURL_API uint32_t knurl_session_close_all(void);

/** The session's scene, for surfaces: knurl_scene_add_surface() and so on, knurl_gltf_load_file(). It is the same from
 * create to destroy, never null. [game thread] */
KNURL_API knurl_scene *knurl_session_get_scene(knurl_session *session);

/** The device of an open session, for knurl_device_get_info() and so on; null while closed. [game thread] */
KNURL_API knurl_device *knurl_session_get_device(knurl_session *session);

/** The loop of a session after knurl_session_start() or _play(), for knurl_loop_get_stats(); else null. [game thread]
 */
KNURL_API knurl_loop *knurl_session_get_loop(knurl_session *session);

/** Opens the device. Errors: KNURL_ERROR_STATE (open already), KNURL_ERROR_ARGUMENT (which field), KNURL_ERROR_UNKNOWN
 * (stroke), KNURL_ERROR_FORMAT (response), and those of knurl_device_open(). [game thread] */
KNURL_API knurl_result knurl_session_open(knurl_session *session, const knurl_session_desc *desc);

/** Commits the scene if it is not committed yet, sets up its HIP and the fake hand's stroke, and starts the haptic
 * thread. warning: null, or receives a sentence on settings that cannot be honoured ("": all are), at most `size`
 * bytes. Errors: KNURL_ERROR_STATE (not open, or started before), those of knurl_scene_configure_hip(),
 * knurl_loop_create() and knurl_loop_start(); the session stays open. [game thread] */
KNURL_API knurl_result knurl_session_start(knurl_session *session, char *warning, uint32_t size);

/** Instead of knurl_session_start(): runs an open fake device along a path on this thread, as fast as possible.
 * rows: t (s, ascending), x, y, z (m, scene) each, interpolated. forces: three per tick (N, scene), room for
 * `ticks` (1 to 1e8). *played: the number of ticks that ran. Close the session afterwards.
 * Errors: as knurl_session_start(), KNURL_ERROR_ARGUMENT, KNURL_ERROR_UNSUPPORTED (not a fake device). [game thread] */
KNURL_API knurl_result knurl_session_play(knurl_session *session, const double *rows, uint64_t row_count,
                                          uint64_t ticks, double *forces, uint64_t *played);

/** Ends the run, zeroes the force and closes the device. A contact's end is reported by the next
 * knurl_session_next_event(). Surfaces stay. May be repeated. [game thread] */
KNURL_API void knurl_session_close(knurl_session *session);

/** Call once per frame: it is the loop's heartbeat, and collects the events since the last update. It allocates
 * nothing; of events that are not fetched, the oldest are dropped. [game thread] */
KNURL_API void knurl_session_update(knurl_session *session);

/** 1: pauses: the force ramps down to zero, contacts end, and the HIP is still reported; 0: resumes, see
 * knurl_loop_pause(). No update is needed during a pause. Holds for this run and later ones until set again;
 * knurl_session_play() ignores it. [game thread] */
KNURL_API void knurl_session_set_paused(knurl_session *session, uint32_t paused);

/** Fetches the next event, oldest first: 1, or 0 if there is none. Contacts shorter than a frame are reported; a
 * contact that is interrupted within a frame is reported as one. Each start is followed by its end. At most 64 faults
 * are reported per update, so that a slow handler does not block a frame. The session may be closed between two calls.
 * [game thread] */
KNURL_API uint32_t knurl_session_next_event(knurl_session *session, knurl_session_event *event);

/** A fault's sentence with its value and unit, like "no heartbeat from the game (0.05 s)". Texts in a caller's buffer
 * are UTF-8 and end with a 0; a text longer than `size` bytes is cut after a whole character. [any thread] */
KNURL_API void knurl_session_fault_text(int32_t code, double value, char *text, uint32_t size);

/** Reads the state of the run. [game thread] */
KNURL_API void knurl_session_get_state(const knurl_session *session, knurl_session_state *state);

/** The last ticks, at most KNURL_SESSION_HISTORY, oldest first: two floats each, the grating's height (m) and the
 * force along the normal (N). rows: room for `count` ticks. Returns their number; 0 while closed.
 * [game thread] */
KNURL_API uint32_t knurl_session_get_history(const knurl_session *session, uint32_t count, float *rows);

/** Moves the HIP of the device "mouse" (scene, m). A filter smooths the steps, with a delay of 25 ms. Errors:
 * KNURL_ERROR_STATE (another device, or not running), KNURL_ERROR_ARGUMENT (not finite). [game thread] */
KNURL_API knurl_result knurl_session_move_hip(knurl_session *session, const double position[3]);

/** Moves a running session's workspace along with the engine's node, as knurl_session_move_surface() moves a surface:
 * the HIP moves with it and touches what it meets. Above 10 m/s it jumps, and touches nothing in between. A change of
 * scale moves the HIP too, see knurl_scene_set_workspace(); the mouse's HIP stays where the game moved it. clock: when
 * the node is moved, KNURL_SESSION_FRAMES or _STEPS. Errors: KNURL_ERROR_STATE (not running), those of
 * knurl_scene_set_workspace(), KNURL_ERROR_ARGUMENT (clock). [game thread] */
KNURL_API knurl_result knurl_session_move_workspace(knurl_session *session, uint32_t clock,
                                                    const knurl_workspace *workspace);

/** 1: clutched: zero force, and the HIP stays where it is in the scene while the hand moves the device; 0: the HIP
 * follows the hand again from there, and the force returns as after a pause. A scale set while clutched
 * applies from then on, about the HIP. Errors: KNURL_ERROR_STATE (not running). [game thread] */
KNURL_API knurl_result knurl_session_set_clutch(knurl_session *session, uint32_t on);

/** See knurl_loop_set_gain(). Holds for this run and later ones until set again; default 1. Errors:
 * KNURL_ERROR_ARGUMENT. [game thread] */
KNURL_API knurl_result knurl_session_set_gain(knurl_session *session, double gain);

/** See knurl_loop_set_force() and knurl_loop_vibrate(); until the run ends. Errors: theirs, KNURL_ERROR_STATE (not
 * running). [game thread] */
KNURL_API knurl_result knurl_session_set_force(knurl_session *session, const double force[3]);
KNURL_API knurl_result knurl_session_vibrate(knurl_session *session, int32_t method, double frequency_hz,
                                             double amplitude, const double direction[3], double seconds);

/** The sound of this run's gratings, see knurl_audio; created by the first call. sample_rate_hz: 8000 to 192000;
 * later calls in the same run return the same sound, at the first call's rate. *sound: release it. Errors:
 * KNURL_ERROR_STATE (not running), KNURL_ERROR_ARGUMENT (sample_rate_hz), KNURL_ERROR_MEMORY. [game thread] */
KNURL_API knurl_result knurl_session_get_sound(knurl_session *session, double sample_rate_hz, knurl_sound **sound);

/** Renders the next `count` samples, as knurl_audio_fill(). After the run they fade to exactly 0. Null: does nothing.
 * [audio thread, one per run] */
KNURL_API void knurl_sound_fill(knurl_sound *sound, float *samples, uint32_t count) KNURL_NONBLOCKING;

/** The force for a gamepad's two rumble motors, see knurl_audio_get_rumble(); it needs no fill. Errors:
 * KNURL_ERROR_ARGUMENT. [any thread] */
KNURL_API knurl_result knurl_sound_get_rumble(const knurl_sound *sound, double rumble[2]);

/** Releases a sound, also after its session was destroyed; null is allowed. [any thread, after its last fill] */
KNURL_API void knurl_sound_release(knurl_sound *sound);

/** Sets the time of one of the engine's clocks, once per frame, before surfaces are moved. clock: KNURL_SESSION_FRAMES:
 * the sum of the frames' lengths, as given to objects that are moved in frames; _STEPS: the number of physics steps
 * times their length. seconds: real time, that is, divided by the time scale. Frames and physics steps arrive at uneven
 * times; surfaces move evenly by this clock instead, with a delay as long as moves arrive late.
 * Errors: KNURL_ERROR_ARGUMENT. [game thread] */
KNURL_API knurl_result knurl_session_tell_time(knurl_session *session, uint32_t clock, double seconds);

/** Moves a surface along with its object. The motion ends when the next move is due by the clock of `way`; if the
 * engine has not set that clock, it takes as many ticks as passed since the last move. Above 10 m/s the surface jumps.
 * rotation: unit quaternion. Errors: those of knurl_scene_set_transform(), KNURL_ERROR_ARGUMENT (the way's clock).
 * [game thread] */
KNURL_API knurl_result knurl_session_move_surface(knurl_session *session, knurl_surface_id surface,
                                                  knurl_session_way *way, const double position[3],
                                                  const double rotation[4]);

/** Why a surface of an open session cannot be felt or, after the start, cannot be felt as requested: one sentence per
 * line, "" if there are no problems; at most `size` bytes. [game thread] */
KNURL_API void knurl_session_explain(knurl_session *session, knurl_surface_id surface, char *text, uint32_t size);

/** Splits a matrix (row-major, three rows of four, the last column in m). Returns 1; or 0, with the pose untouched, if
 * the matrix has no volume (a scale of 0) or is not finite. [any thread] */
KNURL_API uint32_t knurl_session_split_pose(const double matrix[12], knurl_session_pose *pose);

/** 1 if two rests are equal to a float's rounding. [any thread] */
KNURL_API uint32_t knurl_session_same_rest(const double a[9], const double b[9]);

#ifdef __cplusplus
}
#endif
#endif
