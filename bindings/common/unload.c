/* Where the C++ library is linked in, each load of an engine's library makes its reserve for exceptions anew, and
 * nobody gives it back at the unloading: 72 KiB a round. libstdc++ has a function for just this, under a name that is
 * not for others to declare. SPDX-License-Identifier: MIT */
void knurl_free_reserve(void) __asm__("_ZN9__gnu_cxx9__freeresEv");

__attribute__((destructor)) static void give_back(void) {
    knurl_free_reserve();
}
