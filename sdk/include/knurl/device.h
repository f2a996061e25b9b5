/* Knurl: force-feedback devices behind one interface: 3D Systems Touch, Novint Falcon, raw HID devices, a caller's own,
 * and a fake one, a simulated Touch in a simulated hand, for people with no device on the desk.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_DEVICE_H
#define KNURL_DEVICE_H

#include <knurl/base.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct knurl_device knurl_device;

/** What a device is. An output: set struct_size with knurl_device_info_init() first. Device frame, SI. */
typedef struct knurl_device_info {
    uint32_t struct_size;
    uint32_t reserved;       /**< 0 */
    char name[64];           /**< for people */
    double workspace_min[3]; /**< m */
    double workspace_max[3]; /**< m */
    double resolution;       /**< position quantum, m; 0: not quantised */
    double max_force;        /**< N */
    double delay;            /**< ticks from a force written to a force felt, beyond the tick itself */
    double continuous_force; /**< N that the motors can hold for ever; INFINITY: no limit but max_force */
    double heat_time;        /**< s: time constant with which the motors warm up, > 0 */
    double mass;             /**< kg: apparent mass at the grip, without the hand's */
    double viscous;          /**< N s/m: the device's own viscous friction */
    double coulomb;          /**< N: the device's own dry friction */
    double max_stiffness;    /**< N/m: the stiffest wall that its maker promises; INFINITY: nothing is promised */
    double max_damping;      /**< N s/m: the strongest damper that its maker promises; INFINITY: nothing is promised */
    double native_rate;      /**< Hz at which it brings positions by itself; 0: at whatever rate it is read */
} knurl_device_info;

/** One reading. Device frame: x right, y up, z towards the user. */
typedef struct knurl_device_sample {
    double position[3]; /**< m */
    uint32_t buttons;   /**< bit 0: first button */
    uint32_t reserved;  /**< 0 */
} knurl_device_sample;

/** One device that is connected, or one kind of device of which none is. */
typedef struct knurl_device_listing {
    char uri[256];     /**< what to open it with */
    char name[128];    /**< for people */
    char reason[1024]; /**< why it cannot be used and what helps, or "" where it can */
} knurl_device_listing;

/** Every fault with its number, its name, its sentence, and the unit of an event's value ("": it has none): the one
 * table that codes and texts come from. */
#define KNURL_FAULTS(X)                                                                                                \
    X(KNURL_FAULT_LOST, 1, "lost", "the device is gone: unplugged or switched off", "")                                \
    X(KNURL_FAULT_SILENT, 2, "silent", "no position came for too long", "s")                                           \
    X(KNURL_FAULT_CORRUPT, 3, "corrupt", "what came was not a whole message and was thrown away", "bytes")             \
    X(KNURL_FAULT_NOT_FINITE, 4, "not_finite", "a position was not a number", "")                                      \
    X(KNURL_FAULT_JUMP, 5, "jump", "the position jumped further than a hand can move", "m")                            \
    X(KNURL_FAULT_LATE, 6, "late", "the newest force was too old to be played on", "s")                                \
    X(KNURL_FAULT_OVERRUN, 7, "overrun", "ticks came late; told once for a row of them", "s")                          \
    X(KNURL_FAULT_WATCHDOG, 8, "watchdog", "the haptic thread stood still", "s")                                       \
    X(KNURL_FAULT_HEARTBEAT, 9, "heartbeat", "the game gave no sign of life", "s")                                     \
    X(KNURL_FAULT_REFUSED, 10, "refused", "the device refused the force", "(its own code)")                            \
    X(KNURL_FAULT_UNCALIBRATED, 11, "uncalibrated", "the device does not know where it is: it needs homing", "")       \
    X(KNURL_FAULT_UNGUARDED, 12, "unguarded", "the guard process is gone: when this one is killed, the force stays",   \
      "")                                                                                                              \
    X(KNURL_FAULT_RESUMED, 32, "resumed", "no fault: the force comes back, by the ramp", "")                           \
    X(KNURL_FAULT_RECONNECTED, 33, "reconnected", "no fault: the device is there again", "")

enum {
#define KNURL_FAULT_ENUMERATOR(code, number, name, text, unit) code = (number),
    KNURL_FAULTS(KNURL_FAULT_ENUMERATOR)
#undef KNURL_FAULT_ENUMERATOR
};

/** Something that went wrong, or was well again. */
typedef struct knurl_device_event {
    int64_t time_ns;   /**< when it was seen, on the system's monotonic clock */
    double value;      /**< how long, how far or how much, in knurl_fault_unit(code); else 0 */
    int32_t code;      /**< KNURL_FAULT_ */
    uint32_t reserved; /**< 0 */
} knurl_device_event;

/** How a device does. An output: set struct_size with knurl_device_status_init() first. */
typedef struct knurl_device_status {
    uint32_t struct_size;
    uint32_t lost;          /**< 1: gone, until it is opened again */
    uint32_t halted;        /**< 1: the force was zeroed and nothing has taken the device up again */
    uint32_t buttons;       /**< of the latest reading; bit 0: first button */
    uint64_t exchanges;     /**< positions that an I/O thread brought; 0 where there is no such thread */
    uint64_t bad_bytes;     /**< thrown away because they made no message; Touch, whose library hands out no bytes:
                                 errors of its that were neither a loss nor a refusal */
    uint64_t events;        /**< reported so far, see knurl_device_next_event() */
    double exchange_ns_p50; /**< median duration of an exchange on the I/O thread, within 3 % */
    double exchange_ns_p99; /**< the same, 99th percentile */
} knurl_device_status;

/** A caller's own device, so that one that was built at home needs no change of Knurl. All are called with `user`. */
typedef struct knurl_device_functions {
    uint32_t struct_size; /**< set by knurl_device_functions_init() */
    uint32_t blocking; /**< 1: read and write may wait; they are called in turn on a thread of their own, and the haptic
                            thread gets the newest position and leaves the newest force. 0 (default): they are called
                            on the haptic thread, and while that one stands still nobody zeroes the force */
    void *user;
    /** What the device is; `info` comes with defaults that promise nothing. Required: max_force > 0. [any thread] */
    void (*get_info)(void *user, knurl_device_info *info);
    /** Prepares for being read so often; or null. The first time before anything is read; later, where blocking, while
     * the I/O thread goes on reading. [game thread] */
    knurl_result (*start)(void *user, double update_rate_hz);
    /** The newest position. Required. KNURL_OK, KNURL_ERROR_DEVICE_NOT_READY (none this time: the one before holds for
     * 10 ms, then the device is silent) or KNURL_ERROR_DEVICE_LOST. [haptic thread; where blocking, the I/O thread: it
     * should return within 5 ms, and after 1 s without a position the device counts as lost] */
    knurl_result (*read)(void *user, knurl_device_sample *sample);
    /** Plays a force, finite and at most max_force. Required. KNURL_OK or KNURL_ERROR_DEVICE_LOST.
     * [as read; also once at the end, on the thread that closes] */
    knurl_result (*write)(void *user, const double force[3]);
    /** Tries to find a lost device again: KNURL_OK or KNURL_ERROR_DEVICE_LOST; or null: it cannot be. [a thread of the
     * loop, while nothing is read or written] */
    knurl_result (*reopen)(void *user);
    /** The last call; or null. [the thread that closes the device, or that destroys the loop that still had it] */
    void (*close)(void *user);
} knurl_device_functions;

/** The fake device's strokes: how its hand's target moves over the stroke frame. */
enum {
    KNURL_STROKE_LINE = 1,   /**< back and forth along x at a steady speed, slower at the turns */
    KNURL_STROKE_SWEEP = 2,  /**< back and forth along x, speed 0 to `speed` and back to 0 within `period` */
    KNURL_STROKE_CIRCLE = 3, /**< round and round at a steady speed: every direction of the grating */
    KNURL_STROKE_PRESS = 4,  /**< down to three times the depth and up again, on the spot */
    KNURL_STROKE_REST = 5    /**< stands still at the depth */
};

/** A stroke of the fake device's hand, in device coordinates. The target starts 5 mm above the surface, comes down
 * within 0.25 s and then moves, `depth` below the surface. */
typedef struct knurl_stroke_desc {
    uint32_t struct_size; /**< set by knurl_stroke_desc_init() */
    int32_t stroke;       /**< KNURL_STROKE_; default LINE */
    double centre[3];     /**< on the surface, m; default 0 */
    double x[3];          /**< unit: the direction of the stroke; default 1, 0, 0 */
    double normal[3];     /**< unit, outward, at right angles to x; default 0, 1, 0 */
    double reach[2];      /**< m either side of the centre along x and along normal x x, > 0; default 0.05, 0.02 */
    double depth;         /**< m below the surface; default 0.001 */
    double speed;         /**< m/s, > 0; default 0 means: 0.25 for SWEEP, else 0.1 */
    double period;        /**< s, of SWEEP and PRESS, > 0; default 5 */
    const double *path;   /**< a way over what is curved: rows of x, y, z on the surface (m) and of its outward normal
                               (unit); copied. LINE and SWEEP go back and forth between its ends from its middle,
                               CIRCLE from its first row to its last and round again from row path_loop, the others
                               stay at its middle. centre, x, normal and reach are not used then. Default null */
    uint32_t path_rows;   /**< 2 to KNURL_PATH_ROWS_MAX; 0 without a path */
    uint32_t path_loop;   /**< CIRCLE: below path_rows - 1; its row and the last one are the same place */
} knurl_stroke_desc;

/** Rows of a stroke's path at most. */
#define KNURL_PATH_ROWS_MAX 65536

/** Fill in defaults; `size` is the caller's sizeof. [any thread] */
KNURL_API void knurl_device_info_init(knurl_device_info *info, uint32_t size);
KNURL_API void knurl_device_status_init(knurl_device_status *status, uint32_t size);
KNURL_API void knurl_device_functions_init(knurl_device_functions *functions, uint32_t size);
KNURL_API void knurl_stroke_desc_init(knurl_stroke_desc *desc, uint32_t size);

/** Opens a device by URI; "name:" alone is "name".
 *
 * - fake, fake:?key=value&...: keys as knurl_fake_keys() lists them; the latest counts, `preset` sets all of them anew.
 * - touch, touch:NAME: the default Touch, or the one that its set-up program gave this name. ?library=PATH: where libHD
 *   is, before the environment variable KNURL_HD_LIBRARY and the usual places.
 * - falcon: the first one. ?firmware=PATH: the image to load where the device has none, before the environment variable
 *   KNURL_FALCON_FIRMWARE. ?gain=G, 0.05 to 1: what its motors are told over libnifalcon's 10000 units a N m, which
 *   nobody has weighed; 0.35 to 0.53 in recorded packets of its maker's driver. Default 0.35: no force is stronger than
 *   was asked for, if those packets are right. The device's name tells the gain.
 * - rawhid, rawhid:VID:PID: the first one that is known, or which one (hexadecimal). ?geometry=PATH: a file that says
 *   how it is built, see assets/devices. ?home=1: it rests in its home pose now.
 *
 * falcon and rawhid, on Linux: ?guard=1 starts a small process of its own session that holds the device's handle too,
 * and sends zero force when this process is gone (SIGKILL, _exit()) or has given no sign of life for 50 ms (SIGSTOP, a
 * machine that stands still). It ends with this process, or when the device is closed. Should it be gone itself, that
 * is an event (unguarded).
 *
 * Errors: KNURL_ERROR_UNKNOWN (device), KNURL_ERROR_ARGUMENT (key or value), KNURL_ERROR_UNSUPPORTED (this build has no
 * such driver, a library that it needs cannot be loaded, or the device cannot be guarded), KNURL_ERROR_DEVICE_LOST
 * (none is connected, or it does not answer), KNURL_ERROR_SYSTEM (it is there but may not be used: permissions, or this
 * program or another has it open), KNURL_ERROR_IO and KNURL_ERROR_FORMAT (a firmware or geometry file),
 * KNURL_ERROR_MEMORY. [game thread] */
KNURL_API knurl_result knurl_device_open(const char *uri, knurl_device **device);

/** Makes a device of a caller's functions. Its positions are checked as any device's: what is not finite, or moves
 * faster than 10 m/s, is a fault. Errors: KNURL_ERROR_ARGUMENT, KNURL_ERROR_MEMORY, KNURL_ERROR_SYSTEM (no thread).
 * [game thread] */
KNURL_API knurl_result knurl_device_open_functions(const knurl_device_functions *functions, knurl_device **device);

/** Zeroes the motors' force at once and for good, and closes; null is allowed. While a loop has the device it is kept
 * for that loop, which ends by itself; knurl_loop_destroy() then closes it, and what a caller's own device needs must
 * last until its `close` was called. To the caller it is gone. [game thread, or any that destroys what nobody else
 * uses; not the haptic one of a device that no loop has] */
KNURL_API void knurl_device_close(knurl_device *device);

/** What is connected, and for kinds of which nothing is, why and what helps: fills at most `capacity` listings (none
 * where `listings` is null), returns how many there are. Looks at the machine's USB devices: some milliseconds. [game
 * thread] */
KNURL_API uint32_t knurl_device_list(knurl_device_listing *listings, uint32_t capacity);

/** What the device is. Errors: KNURL_ERROR_ARGUMENT. [any thread] */
KNURL_API knurl_result knurl_device_get_info(const knurl_device *device, knurl_device_info *info);

/** How the device does. Errors: KNURL_ERROR_ARGUMENT. [any thread] */
KNURL_API knurl_result knurl_device_get_status(const knurl_device *device, knurl_device_status *status);

/** The next event, oldest first: 1, or 0 where there is none. The device keeps the latest 64; whoever comes too late
 * misses the older ones (knurl_device_status.events counts all). [one thread, any] */
KNURL_API uint32_t knurl_device_next_event(knurl_device *device, knurl_device_event *event);

/** A fault's name ("lost"), its sentence, and the unit of its events' value ("s", or "" where they have none); static,
 * never null, also for codes this version does not know. [any thread] */
KNURL_API const char *knurl_fault_name(int32_t code);
KNURL_API const char *knurl_fault_string(int32_t code);
KNURL_API const char *knurl_fault_unit(int32_t code);

/** Prepares for reading once every 1/update_rate_hz; the fake device starts its simulated time anew. A lost device is
 * looked for first. Errors: KNURL_ERROR_ARGUMENT (rate), KNURL_ERROR_UNSUPPORTED (a rate that the device cannot keep;
 * with an I/O thread below 200 Hz), KNURL_ERROR_DEVICE_LOST, KNURL_ERROR_STATE (a loop has the device, which has
 * started it). [game thread] */
KNURL_API knurl_result knurl_device_start(knurl_device *device, double update_rate_hz);

/** Reads the newest sample; the fake device's simulated time moves on by one period. The Touch's own scheduler calls
 * the loop, and only there can it be read and written. Errors: KNURL_ERROR_DEVICE_LOST; KNURL_ERROR_DEVICE_NOT_READY:
 * there is no position to be trusted now, and the force is zeroed (halted); why is an event; KNURL_ERROR_STATE. No
 * heap, lock, wait or formatting. [haptic thread] */
KNURL_API knurl_result knurl_device_read(knurl_device *device, knurl_device_sample *sample);

/** Writes the force (device axes, N). A force that is not finite is written as 0; longer than max_force is shortened.
 * A device with an I/O thread plays it until the next one, 10 ms at most.
 * Errors: KNURL_ERROR_DEVICE_LOST, KNURL_ERROR_STATE. No heap, lock, wait or formatting. [haptic thread] */
KNURL_API knurl_result knurl_device_write(knurl_device *device, const double force[3]);

/** Zeroes the force at once, whatever the haptic thread does; what it writes afterwards counts again only after
 * knurl_device_release_halt(). [any thread] */
KNURL_API void knurl_device_halt(knurl_device *device);

/** Ends a halt. [haptic thread] */
KNURL_API void knurl_device_release_halt(knurl_device *device);

/** 1 while halted; 0 for a device that is none. [any thread] */
KNURL_API uint32_t knurl_device_is_halted(const knurl_device *device);

/** Opt-in: zeroes the forces of all open devices before the process ends or stops. Up to 20 ms are waited until zero
 * has been sent, which takes the thread that writes to the device: an I/O thread, or the haptic one where there is
 * none.
 *
 * - exit(), a return from main(), quick_exit(), and being unloaded (dlclose()).
 * - SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT: then what handled them before is called, or they end the process.
 * - SIGTERM, SIGHUP, SIGINT, SIGQUIT, SIGPIPE, SIGALRM, SIGUSR1, SIGUSR2, SIGXCPU, SIGXFSZ, SIGTRAP, SIGSYS, SIGPROF,
 *   SIGVTALRM, SIGPOLL, SIGPWR, SIGSTKFLT where they are at their default, which ends the process.
 * - SIGTSTP (Ctrl-Z), SIGTTIN, SIGTTOU at their default, which stops it; after SIGCONT the devices are halted, so that
 * a loop's forces come back by the ramp.
 * - Windows: exceptions that nobody handles, abort(), the console's events, exit().
 *
 * Signals that are ignored stay ignored; those of the last two groups that have a handler are left to it, and handlers
 * that are installed later replace this one: install them first, or hand on what they get. Real-time signals are left
 * alone. After an end has begun no force goes out any more, also where a handler lets the process live. SIGKILL,
 * SIGSTOP, _exit() and a machine that stands still cannot be seen from within: see ?guard=1 at knurl_device_open().
 *
 * @param faults_recover 0; or 1 in a process whose runtime recovers from SIGSEGV, SIGBUS, SIGFPE or SIGILL, as C#'s do
 * at a null reference: a handler that these have is left alone as well.
 *
 * The calling thread gets a stack for handlers where it has none. The first call counts, later ones change nothing.
 * Errors: KNURL_ERROR_ARGUMENT, KNURL_ERROR_SYSTEM. [game thread] */
KNURL_API knurl_result knurl_device_zero_on_exit(uint32_t faults_recover);

/** The keys of a fake URI, their units, defaults and meaning, a line each; static. [any thread] */
KNURL_API const char *knurl_fake_keys(void);

/** Gives the fake device's hand a stroke; from the next knurl_device_start().
 * Errors: KNURL_ERROR_ARGUMENT, KNURL_ERROR_UNSUPPORTED (not a fake device), KNURL_ERROR_STATE (a loop with a haptic
 * thread has it). [game thread] */
KNURL_API knurl_result knurl_fake_set_stroke(knurl_device *device, const knurl_stroke_desc *desc);

/** What the simulated world really is, for studies and tests: nothing that a real device could tell. */
typedef struct knurl_fake_truth {
    double position[3]; /**< m, device frame: before it is quantised */
    double velocity[3]; /**< m/s */
    double motor[3];    /**< N: the force that acted over the period that ends now, delayed and limited */
    double hand[3];     /**< N: what the hand's spring and damper pull with now */
} knurl_fake_truth;

/** The fake device as of its latest reading. Errors: KNURL_ERROR_UNSUPPORTED (not a fake device, or one that plays a
 * trace). No heap or lock. [haptic thread] */
KNURL_API knurl_result knurl_fake_get_truth(const knurl_device *device, knurl_fake_truth *truth);

/** Plays positions instead of a hand: rows of t (s, ascending), x, y, z (m, device frame), copied, interpolated
 * linearly, the last one held. The positions are exact unless the URI names a resolution; no force moves them. Errors:
 * KNURL_ERROR_ARGUMENT (which row), KNURL_ERROR_UNSUPPORTED (not a fake device), KNURL_ERROR_STATE (a loop with a
 * haptic thread has it), KNURL_ERROR_MEMORY. [game thread] */
KNURL_API knurl_result knurl_fake_set_trace(knurl_device *device, const double *rows, uint64_t row_count);

/** The stroke of a name ("line", "sweep", "circle", "press", "rest").
 * Errors: KNURL_ERROR_UNKNOWN, with the names that are known. [any thread] */
KNURL_API knurl_result knurl_stroke_from_name(const char *name, int32_t *stroke);

#ifdef __cplusplus
}
#endif
#endif
