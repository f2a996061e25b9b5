/* A statically linked libstdc++ allocates 72 KiB for exceptions at each load of the engine's library and does not free
 * them at the unload. Its function that frees them has a reserved C++ name, so it is called by its symbol.
 * SPDX-License-Identifier: MIT */
void knurl_free_reserve(void) __asm__("_ZN9__gnu_cxx9__freeresEv");

__attribute__((destructor)) static void give_back(void) {
    knurl_free_reserve();
}
