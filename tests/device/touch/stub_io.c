/* A library that exists when its user is linked, but not when that is loaded. SPDX-License-Identifier: MIT */
__attribute__((visibility("default"))) int stub_io(void);

int stub_io(void) {
    return 42;
}
