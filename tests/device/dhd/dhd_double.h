/* Force Dimension's row in the table of faults. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_DHD_DOUBLE_H
#define KNURL_TEST_DHD_DOUBLE_H

#include "device/dhd/stub_dhd.h"
#include "support/double.h"

extern const device_double dhd_double;

/** The stand-in's functions, once the double was opened. */
extern struct dhd_stub {
    stub_dhd_reset_function reset;
    stub_dhd_inject_function inject;
    stub_dhd_ask_function ask;
    stub_dhd_set_function set;
    stub_dhd_torque_function tell_torque;
    stub_dhd_limp_function limp_since;
    stub_dhd_opens_function opens;
} dhd_stub;

#endif
