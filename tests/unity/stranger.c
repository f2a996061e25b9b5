/* Libraries of the package's name that are not its own: of another version, of its version but another interface, or
 * older than interfaces. SPDX-License-Identifier: MIT */
#ifndef VERSION
#define VERSION "9.8.7"
#endif

const char *knurl_version_string(void);
const char *knurl_unity_interface(void);

const char *knurl_version_string(void) {
    return VERSION;
}

#ifndef OLD
const char *knurl_unity_interface(void) {
    return "0123456789abcdef";
}
#endif
