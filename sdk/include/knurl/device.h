/* Knurl: force-feedback devices behind one interface: 3D Systems Touch, Novint Falcon, raw HID devices and others, a
 * caller's own (device_functions.h), and a fake one for developing without hardware (fake.h).
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_DEVICE_H
#define KNURL_DEVICE_H

#include <knurl/base.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct knurl_device knurl_device;

/** Properties of a device. An output: set struct_size with knurl_device_info_init() first. Device frame, SI. A device
 * with a number out of range is not opened. */
typedef struct knurl_device_info {
    uint32_t struct_size;
    uint32_t reserved;       /**< 0 */
    char name[64];           /**< for display */
    double workspace_min[3]; /**< m, within KNURL_COORDINATE_MAX; 0 with 0 in workspace_max: not known */
    double workspace_max[3]; /**< m, workspace_min to KNURL_COORDINATE_MAX */
    double resolution;       /**< position quantum, 1e-9 to 0.01 m; 0: not quantised */
    double max_force;        /**< 0.01 to 1000 N */
    double delay;            /**< ticks from writing a force until it acts, beyond the tick itself, 0 to 16 */
    double continuous_force; /**< 0.01 to 1000 N that the motors can hold indefinitely; INFINITY: no limit but
                                  max_force */
    double heat_time;        /**< time constant of the motors' heating, 0.001 to 1e6 s */
    double mass;             /**< apparent mass at the grip, without the hand's, 0.001 to 10 kg; 0: not known */
    double viscous;          /**< the device's own viscous friction, 0 to 1000 N s/m */
    double coulomb;          /**< the device's own dry friction, 0 to 10 N */
    double max_stiffness;    /**< the stiffest wall in its maker's specification, 1 to 1e9 N/m; or INFINITY */
    double native_rate;      /**< its own rate of position reports, 1 to 1e5 Hz; 0: a new position at each read */
    double max_torque;       /**< 0.0001 to 100 N m that it can play for long; 0: it plays no torques */
    double max_grip;         /**< 0.01 to 1000 N that its gripper can play for long; 0: none */
} knurl_device_info;

/** One reading. Device frame: x right, y up, z towards the user. */
typedef struct knurl_device_sample {
    double position[3];    /**< m */
    double orientation[4]; /**< of the stylus: a unit quaternion x, y, z, w, from its axes to the device's; 0, 0, 0, 0
                              if the device does not measure it. For drawing only: contact is that of a point */
    double grip;           /**< angle of its gripper, rad, 0: closed; 0 without a gripper */
    double joints[8];      /**< angles of its joints, rad, in its maker's order and directions */
    uint32_t buttons;      /**< bit 0: first button */
    uint32_t joint_count;  /**< angles in `joints`, 0 to 8 */
    uint32_t reserved[8];  /**< 0 */
} knurl_device_sample;

/** A torque and a gripper's force, for devices that play them (knurl_device_info.max_torque, max_grip). */
typedef struct knurl_device_torque {
    double torque[3];   /**< N m about the device's axes, right-handed */
    double grip;        /**< N; positive opens the gripper */
    double reserved[4]; /**< 0 */
} knurl_device_torque;

/** A connected device, or a kind of device without a connected one. */
typedef struct knurl_device_listing {
    char uri[256];        /**< for knurl_device_open() */
    char name[128];       /**< for display */
    char reason[1024];    /**< why it cannot be used, and the remedy; "" if it can */
    uint64_t reserved[4]; /**< 0 */
} knurl_device_listing;

/** All faults: code, number, name, sentence, and the unit of an event's value ("": no value). */
#define KNURL_FAULTS(X)                                                                                                \
    X(KNURL_FAULT_LOST, 1, "lost", "the device is gone: unplugged or switched off", "")                                \
    X(KNURL_FAULT_SILENT, 2, "silent", "no position from the device for too long", "s")                                \
    X(KNURL_FAULT_CORRUPT, 3, "corrupt", "an incomplete or corrupt message was discarded", "bytes")                    \
    X(KNURL_FAULT_NOT_FINITE, 4, "not_finite", "a position was not a number", "")                                      \
    X(KNURL_FAULT_JUMP, 5, "jump", "the position jumped further than a hand can move", "m")                            \
    X(KNURL_FAULT_LATE, 6, "late", "the last force was too old to keep playing", "s")                                  \
    X(KNURL_FAULT_OVERRUN, 7, "overrun", "ticks came late; reported once for several in a row", "s")                   \
    X(KNURL_FAULT_WATCHDOG, 8, "watchdog", "the haptic thread stalled", "s")                                           \
    X(KNURL_FAULT_HEARTBEAT, 9, "heartbeat", "no heartbeat from the game", "s")                                        \
    X(KNURL_FAULT_REFUSED, 10, "refused", "the device refused the force", "(its own code)")                            \
    X(KNURL_FAULT_UNCALIBRATED, 11, "uncalibrated",                                                                    \
      "the device is not homed: pull a Falcon's grip out and push it in, put a Touch's stylus into its inkwell, "      \
      "hold a WoodenHaptics in its home pose and press its button",                                                    \
      "")                                                                                                              \
    X(KNURL_FAULT_UNGUARDED, 12, "unguarded",                                                                          \
      "the guard process ended; if this process is killed now, the last force keeps playing", "")                      \
    X(KNURL_FAULT_GAP, 13, "gap", "the loop did not run for a while: the program or the machine was paused", "s")      \
    X(KNURL_FAULT_BACKWARDS_X, 14, "backwards_x",                                                                      \
      "the handle does not follow the force along x: a motor is wired or signed backwards; swap its two wires "        \
      "(or, in a caller's device, change its sign), and open the device again",                                        \
      "")                                                                                                              \
    X(KNURL_FAULT_BACKWARDS_Y, 15, "backwards_y",                                                                      \
      "the handle does not follow the force along y: a motor is wired or signed backwards; swap its two wires "        \
      "(or, in a caller's device, change its sign), and open the device again",                                        \
      "")                                                                                                              \
    X(KNURL_FAULT_BACKWARDS_Z, 16, "backwards_z",                                                                      \
      "the handle does not follow the force along z: a motor is wired or signed backwards; swap its two wires "        \
      "(or, in a caller's device, change its sign), and open the device again",                                        \
      "")                                                                                                              \
    X(KNURL_FAULT_FORCE_OFF, 17, "force_off",                                                                          \
      "the device switched its forces off; no force is sent until they are on again", "")                              \
    X(KNURL_FAULT_RESUMED, 32, "resumed", "no fault: the force ramps up again", "")                                    \
    X(KNURL_FAULT_RECONNECTED, 33, "reconnected", "no fault: the device is connected again", "")                       \
    X(KNURL_FAULT_BATTERY, 34, "battery", "no fault: the battery of its grip is almost empty", "(0 to 1)")

enum {
#define KNURL_FAULT_ENUMERATOR(code, number, name, text, unit) code = (number),
    KNURL_FAULTS(KNURL_FAULT_ENUMERATOR)
#undef KNURL_FAULT_ENUMERATOR
};

/** Why a device has switched its forces off: the value of a KNURL_FAULT_FORCE_OFF event. Constant, number, sentence. */
#define KNURL_FORCE_OFF_CAUSES(X)                                                                                      \
    X(KNURL_FORCE_OFF_UNTOLD, 0, "no reason given; press its force button, or open it again")                          \
    X(KNURL_FORCE_OFF_BUTTON, 1, "by its force button; press it again")                                                \
    X(KNURL_FORCE_OFF_VELOCITY, 2, "it moved faster than its controller allows; press its force button")               \
    X(KNURL_FORCE_OFF_WATCHDOG, 3, "no command reached it for too long; press its force button, or open it again")     \
    X(KNURL_FORCE_OFF_SOFTWARE, 4, "by another call of its maker's library; press its force button, or open it again") \
    X(KNURL_FORCE_OFF_CABLE, 5, "its cable was unplugged; press its force button, or open it again")                   \
    X(KNURL_FORCE_OFF_DEADMAN, 6, "its grip was released; hold it, and press its force button")                        \
    X(KNURL_FORCE_OFF_POWER, 7, "its power supply is unplugged; plug it in")                                           \
    X(KNURL_FORCE_OFF_NOT_READY, 8, "its maker's service reports that it is not ready; the Haply Hub shows why")       \
    X(KNURL_FORCE_OFF_BRAKE, 9, "its emergency brake is on; the Haply Hub shows how to release it")

enum {
#define KNURL_FORCE_OFF_ENUMERATOR(code, number, text) code = (number),
    KNURL_FORCE_OFF_CAUSES(KNURL_FORCE_OFF_ENUMERATOR)
#undef KNURL_FORCE_OFF_ENUMERATOR
};

/** A device's fault or recovery. */
typedef struct knurl_device_event {
    int64_t time_ns;   /**< when it was detected, on a monotonic clock that continues while the machine sleeps (Linux:
                          CLOCK_BOOTTIME) */
    double value;      /**< a duration, distance or amount in knurl_fault_unit(code); for KNURL_FAULT_FORCE_OFF a
                          KNURL_FORCE_OFF_; else 0 */
    int32_t code;      /**< KNURL_FAULT_ */
    uint32_t reserved; /**< 0 */
} knurl_device_event;

/** State of a device. An output: set struct_size with knurl_device_status_init() first. */
typedef struct knurl_device_status {
    uint32_t struct_size;
    uint32_t lost;      /**< 1: lost, until it is reopened */
    uint32_t halted;    /**< 1: the force was zeroed, and no loop has resumed it yet */
    uint32_t buttons;   /**< of the last reading; bit 0: first button */
    uint64_t exchanges; /**< positions read by the I/O thread; 0 if there is no such thread */
    uint64_t bad_bytes; /**< bytes discarded because they were not a valid message. For a Touch, whose library does not
                           show bytes: errors other than losses and refusals */
    uint64_t events;    /**< reported so far, see knurl_device_next_event() */
    double exchange_ns_p50; /**< median duration of an exchange on the I/O thread, within 3 % */
    double exchange_ns_p99; /**< the same, 99th percentile */
    double orientation[4];  /**< of the last reading, as knurl_device_sample.orientation */
    double grip;            /**< the same, as knurl_device_sample.grip */
    double battery;         /**< charge of its grip's battery, 0 to 1; 0: unknown, or no battery */
} knurl_device_status;

/** Fill in defaults; `size` is the caller's sizeof. [any thread] */
KNURL_API void knurl_device_info_init(knurl_device_info *info, uint32_t size);
KNURL_API void knurl_device_status_init(knurl_device_status *status, uint32_t size);

/** Opens a device by URI; "name:" is the same as "name".
 *
 * - fake, fake:?key=value&...: a simulated device; keys are listed by knurl_fake_keys(). If a key is repeated, the last
 *   one counts; `preset` resets all of them.
 * - touch, touch:NAME: the default Touch, or the one with this name in its setup program. ?library=PATH: the path of
 *   libHD, tried before the environment variable KNURL_HD_LIBRARY and the usual places.
 * - falcon: the first one. ?firmware=PATH: the firmware image to load if the device has none; tried before the
 *   environment variable KNURL_FALCON_FIRMWARE. ?gain=G, 0.05 to 1: the scale of its motor commands, relative to
 *   libnifalcon's 10000 units per N m, which was never measured. Recorded packets of the maker's driver give 0.35 to
 *   0.53. Default 0.35: if those packets are right, no force is stronger than requested. The device's name contains the
 *   gain. Without ?gain it is read from the file in KNURL_FALCON_GAIN (from `knurl calibrate falcon`).
 * - rawhid, rawhid:VID:PID: the first known one, or the one with these hexadecimal ids. ?geometry=PATH: a file that
 *   describes its mechanics, see assets/devices. ?home=1: the device is in its home pose now.
 * - serial, serial:PATH: WoodenHaptics with its makers' Teensy 4.0 firmware, on the first Teensy's serial port or on
 *   this one. ?geometry=PATH and ?home=1: as rawhid. Switch it on, or press its button, in its home pose.
 * - dhd, dhd:N: the first, or the Nth (from 0), of Force Dimension's devices. ?library=PATH: its maker's DHD library,
 *   tried before the environment variable KNURL_DHD_LIBRARY and the usual names. ?gravity=1 or 0 switches its gravity
 *   compensation, which is left alone otherwise.
 * - inverse3, inverse3:ID: the first Haply Inverse3, Inverse3x or Minverse, or the one with this id, by its maker's
 *   service on this machine, whose filters may cut textures.
 *   ?port=N: the service's port, 1 to 65535; default 10001. ?grip=ID: the handle's id, if there are several; by default
 *   the first that tells its orientation. ?gravity=: as dhd.
 *
 * falcon, rawhid, serial and a caller's functions check their motors, because a motor that is wired or signed backwards
 * pushes with the hand. The first force above 0.25 N along each axis is limited to 1 N and sent as pulses of 12 ms
 * until the handle has followed it, usually for 0.1 to 0.5 s, then it ramps up. If the handle moves against the force,
 * or sideways, that is a fault (backwards_x, _y, _z): no force until the device is opened again. ?motors_known=1: no
 * check.
 *
 * falcon and rawhid on Linux: ?guard=1 starts a small process in a session of its own that also holds the device. It
 * sends zero force if this process has ended (SIGKILL, _exit()) or has not run for 50 ms (SIGSTOP, a frozen machine),
 * and ends with this process or when the device is closed. If the guard itself ends, that is an event (unguarded).
 *
 * Errors: KNURL_ERROR_UNKNOWN (device), KNURL_ERROR_ARGUMENT (key or value), KNURL_ERROR_UNSUPPORTED (this build has no
 * such driver, a library that it needs cannot be loaded, or the device cannot be guarded), KNURL_ERROR_DEVICE_LOST (not
 * connected, or it does not answer), KNURL_ERROR_SYSTEM (it exists but cannot be used: permissions, or this or another
 * program has it open), KNURL_ERROR_IO and KNURL_ERROR_FORMAT (a firmware or geometry file), KNURL_ERROR_MEMORY. [game
 * thread] */
KNURL_API knurl_result knurl_device_open(const char *uri, knurl_device **device);

/** Zeroes the force and closes the device; null is allowed. The force is zero on return. (It waits for a period of the
 * device's loop, or a transfer; if one of these hangs, no longer than 50 ms.) A loop that uses the device ends by
 * itself, and its knurl_loop_destroy() frees the device; a caller's own device must keep its resources until its
 * `close` is called. Do not use the handle afterwards. [game thread, or any while no other thread uses the device; not
 * the haptic thread of a device that no loop has] */
KNURL_API void knurl_device_close(knurl_device *device);

/** Lists the connected devices, and for each kind without one the reason and the remedy. Fills at most `capacity`
 * listings (0 if `listings` is null) and returns the number that exist. Reads the USB devices, which takes some
 * milliseconds. If a device's library does not answer within 2 s, the listing gives that reason; the thread that waits
 * for it, and its memory, are then never freed. [game thread] */
KNURL_API uint32_t knurl_device_list(knurl_device_listing *listings, uint32_t capacity);

/** Gets a device's properties. Errors: KNURL_ERROR_ARGUMENT (also if get_info of a caller's device now gives a number
 * out of range). [any thread] */
KNURL_API knurl_result knurl_device_get_info(const knurl_device *device, knurl_device_info *info);

/** Gets a device's state. Errors: KNURL_ERROR_ARGUMENT. [any thread] */
KNURL_API knurl_result knurl_device_get_status(const knurl_device *device, knurl_device_status *status);

/** Removes the oldest event: 1, or 0 if there is no event. The last 64 are kept; older ones are lost
 * (knurl_device_status.events counts all). [any thread, but only one] */
KNURL_API uint32_t knurl_device_next_event(knurl_device *device, knurl_device_event *event);

/** A fault's name ("lost"), its sentence, and the unit of its events' value ("s"; "" if it has no value). Static, never
 * null, even for codes unknown to this version. [any thread] */
KNURL_API const char *knurl_fault_name(int32_t code);
KNURL_API const char *knurl_fault_string(int32_t code);
KNURL_API const char *knurl_fault_unit(int32_t code);

/** The sentence of an event's cause (KNURL_FORCE_OFF_), or "" if its value is not a cause. Static, never null. [any
 * thread] */
KNURL_API const char *knurl_fault_cause(int32_t code, double value);

/** Prepares for reads every 1/update_rate_hz; the fake device's simulated time restarts. Ends a halt. If the device is
 * lost, it is searched for first. Errors: KNURL_ERROR_ARGUMENT (rate), KNURL_ERROR_UNSUPPORTED (a rate that the device
 * cannot keep; with an I/O thread below 200 Hz), KNURL_ERROR_DEVICE_LOST, KNURL_ERROR_STATE (a loop uses the device and
 * has started it). [game thread] */
KNURL_API knurl_result knurl_device_start(knurl_device *device, double update_rate_hz);

/** Reads the newest sample; the fake device's simulated time advances by one period. A Touch can be read and written
 * only from its own scheduler, which calls the loop. Errors: KNURL_ERROR_DEVICE_LOST; KNURL_ERROR_DEVICE_NOT_READY (no
 * valid position now; the force is zeroed (halted), and an event gives the reason); KNURL_ERROR_STATE. No heap, lock,
 * wait or formatting. [haptic thread] */
KNURL_API knurl_result knurl_device_read(knurl_device *device, knurl_device_sample *sample);

/** Writes the force (device axes, N). If it is not finite, 0 is written; if it is above max_force, it is shortened;
 * while the motors are checked (see knurl_device_open()) less is sent. A device with an I/O thread plays it until the
 * next one, for at most 10 ms.
 * Errors: KNURL_ERROR_DEVICE_LOST, KNURL_ERROR_STATE. No heap, lock, wait or formatting. [haptic thread] */
KNURL_API knurl_result knurl_device_write(knurl_device *device, const double force[3]);

/** Zeroes the force at once, whatever the haptic thread does. Forces written later have no effect until its loop
 * ramps them up again (in the next tick) or, without a loop, until knurl_device_start(). [any thread] */
KNURL_API void knurl_device_halt(knurl_device *device);

/** Zeroes the forces of all open devices before the process ends or stops; off until called. It waits up to 20 ms until
 * zero has been sent by the device's I/O thread, or by the haptic thread if there is no I/O thread.
 *
 * - exit(), a return from main(), quick_exit(), and unloading the library (dlclose()).
 * - SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT: afterwards the earlier handler is called, or the process ends.
 * - SIGTERM, SIGHUP, SIGINT, SIGQUIT, SIGPIPE, SIGALRM, SIGUSR1, SIGUSR2, SIGXCPU, SIGXFSZ, SIGTRAP, SIGSYS, SIGPROF,
 *   SIGVTALRM, SIGPOLL, SIGPWR, SIGSTKFLT if their action is the default, which ends the process.
 * - SIGTSTP (Ctrl-Z), SIGTTIN, SIGTTOU if their action is the default, which stops the process; after SIGCONT the
 *   devices are halted, so that a loop's force ramps up again.
 * - Windows: unhandled exceptions, abort(), console events, exit().
 *
 * Ignored signals stay ignored. If a signal of the last two groups has a handler, it is left to that handler. Handlers
 * installed later replace this one: install yours first, or pass the signal on. Real-time signals are not handled. Once
 * an end has begun, no more force is sent, even if a handler keeps the process alive. SIGKILL, SIGSTOP, _exit() and a
 * frozen machine cannot be caught from within: see ?guard=1 at knurl_device_open().
 *
 * @param faults_recover 0; or 1 in a process whose runtime recovers from SIGSEGV, SIGBUS, SIGFPE or SIGILL, as C#'s do
 * at a null reference: existing handlers of these signals are then kept.
 *
 * The calling thread gets a signal stack unless it has one. Only the first call has an effect.
 * Errors: KNURL_ERROR_ARGUMENT, KNURL_ERROR_SYSTEM. [game thread] */
KNURL_API knurl_result knurl_device_zero_on_exit(uint32_t faults_recover);

#ifdef __cplusplus
}
#endif
#endif
