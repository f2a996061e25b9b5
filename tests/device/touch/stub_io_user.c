/* A libHD whose own library is missing, as OpenHaptics' is without the device driver. SPDX-License-Identifier: MIT */
int stub_io(void);
__attribute__((visibility("default"))) int hdInitDevice(void);

int hdInitDevice(void) {
    return stub_io();
}
