/* A library to be loaded at run time. SPDX-License-Identifier: MIT */
__declspec(dllexport) int knurl_test_answer(void);

int knurl_test_answer(void) {
    return 42;
}
