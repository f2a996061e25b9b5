/* Variables that name libraries and files, in a program that has more rights than its user. Linked with --wrap to
 * simulate the kernel's answer. SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L /* setenv() */

#include "support/close.h"

#include "base/system.h"

#include <knurl/device.h>

#include <stdlib.h>
#include <sys/auxv.h>

static unsigned long is_secure;

unsigned long __real_getauxval(unsigned long type);
unsigned long __wrap_getauxval(unsigned long type);
unsigned long __wrap_getauxval(unsigned long type) {
    return type == AT_SECURE ? is_secure : __real_getauxval(type);
}

/* True if opening fails because of the file that the variable names. */
static int is_followed(const char *uri, const char *variable) {
    knurl_device *device = NULL;
    assert_int_equal(setenv(variable, "/nowhere/named", 1), 0);
    assert_int_not_equal(knurl_device_open(uri, &device), KNURL_OK);
    assert_int_equal(unsetenv(variable), 0);
    return strstr(knurl_error_message(), "/nowhere/named") != NULL;
}

TEST(a_program_with_more_rights_than_its_user_follows_no_variable) {
    static const char *const variables[][2] = {
        {"touch", "KNURL_HD_LIBRARY"}, {"dhd", "KNURL_DHD_LIBRARY"}, {"falcon", "KNURL_FALCON_GAIN"}};
    for (size_t i = 0; i < COUNT_OF(variables); i++) {
        is_secure = 0;
        assert_true(is_followed(variables[i][0], variables[i][1]));
        is_secure = 1;
        assert_false(is_followed(variables[i][0], variables[i][1]));
    }
    assert_int_equal(setenv("KNURL_FALCON_FIRMWARE", "/nowhere/named", 1), 0); /* is read when there is a Falcon */
    assert_null(knurl_system_environment("KNURL_FALCON_FIRMWARE"));
}
