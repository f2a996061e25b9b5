/* A library that is there when its user is linked, and nowhere when that is loaded. SPDX-License-Identifier: MIT */
__attribute__((visibility("default"))) int stub_io(void);

int stub_io(void) {
    return 42;
}
