/* The C++ library is linked in, so each load of the extension makes its reserve for exceptions anew; nobody else gives
 * it back when the extension is unloaded: 72 KiB a round. SPDX-License-Identifier: MIT */
namespace __gnu_cxx {
void __freeres(); /* libstdc++'s own, for just this */
}

__attribute__((destructor)) static void give_back() {
    __gnu_cxx::__freeres();
}
