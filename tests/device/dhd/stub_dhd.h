/* The stand-in for Force Dimension's library: what tests do to it and ask it. One device, the project's own plant in
 * the project's own hand. SPDX-License-Identifier: MIT */
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

/** What its motors play now (N, Knurl's axes), and: the sum of the torques and the gripper's force that it was told;
 * how many forces it was told while it played none; the greatest rise of its force in one command (N). */
typedef void (*stub_dhd_ask_function)(double force[3], double others[3]);

/** What can be set: its system type, why its forces go off at the next DOUBLE_OFF (as DHD_FORCEOFF_), and that commands
 * of a force time out (1). */
enum { STUB_DHD_TYPE, STUB_DHD_CAUSE, STUB_DHD_REFUSES };
typedef void (*stub_dhd_set_function)(int setting, int value);
typedef int64_t (*stub_dhd_limp_function)(void); /**< ns since when its motors get nothing; 0: they get something */
typedef int (*stub_dhd_opens_function)(void);    /**< opened less closed */

#endif
