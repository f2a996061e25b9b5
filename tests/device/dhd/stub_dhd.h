/* The stand-in for Force Dimension's library: its interface for tests. One device, the project's plant in the project's
 * hand. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_STUB_DHD_H
#define KNURL_TEST_STUB_DHD_H

#include <stdint.h>

typedef struct stub_dhd_time {
    int64_t (*now_ns)(void);
    void (*sleep_until_ns)(int64_t deadline_ns);
} stub_dhd_time;

/** As new: an omega.3 at rest at the middle of its workspace, or (strokes) whose hand strokes along x, 1 mm below y =
 * 0.
 */
typedef void (*stub_dhd_reset_function)(const stub_dhd_time *time, int strokes);
typedef void (*stub_dhd_inject_function)(int fault); /**< DOUBLE_ */

/** Its motors' present force (N, Knurl's axes), and: the sum of the commanded torques and gripper forces; the number of
 * forces commanded while it played no force; the largest increase of its force in one command (N). */
typedef void (*stub_dhd_ask_function)(double force[3], double others[3]);

/** Settings: its system type; the cause of the next DOUBLE_OFF (DHD_FORCEOFF_); 1: commands of a force time out; 1: the
 * hand lets go; 1: left-handed. */
enum { STUB_DHD_TYPE, STUB_DHD_CAUSE, STUB_DHD_REFUSES, STUB_DHD_LOOSE, STUB_DHD_LEFT, STUB_DHD_SETTINGS };
typedef void (*stub_dhd_set_function)(int setting, int value);
/** The present torque (N m, the library's axes) and gripper's force; the largest since the last call: torque, gripper's
 * force; commands since then with one of these but without a force; the gravity compensation (-1: never set). */
typedef struct stub_dhd_torque {
    double torque[3], grip, most_torque, most_grip;
    int alone, gravity;
} stub_dhd_torque;
typedef void (*stub_dhd_torque_function)(stub_dhd_torque *told);
typedef int64_t (*stub_dhd_limp_function)(void); /**< ns: start of its motors' zero force; 0: they have a force */
typedef int (*stub_dhd_opens_function)(void);    /**< opened less closed */

#endif
