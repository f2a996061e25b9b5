/* Libraries of the package's name that are not its own: of another interface, or older than interfaces.
 * SPDX-License-Identifier: MIT */
const char *knurl_version_string(void);
const char *knurl_unity_interface(void);

#ifdef OLD
const char *knurl_version_string(void) {
    return "0.0.9";
}
#else
const char *knurl_version_string(void) {
    return "9.8.7";
}

const char *knurl_unity_interface(void) {
    return "0123456789abcdef";
}
#endif
