/* Where the C++ library is linked in, each load of the extension makes its reserve for exceptions anew, and nobody
 * gives it back when the extension is unloaded: 72 KiB a round. libstdc++ has a function for just this, under a name
 * that is not for others to declare. SPDX-License-Identifier: MIT */
#include "api.h"

#if defined(KNURL_STATIC_LIBSTDCXX)
void knurl_godot_free_reserve(void) __asm__("_ZN9__gnu_cxx9__freeresEv");

__attribute__((destructor)) static void give_back(void) {
    knurl_godot_free_reserve();
}
#endif
