# Linux (x86-64) with Debian 11's C library: from build/debian11, made by cmake/debian11.sh.
# Without links: the path as in the compiler's assertions.
file(REAL_PATH ${CMAKE_CURRENT_LIST_DIR}/../build/debian11/root _root)
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_SYSROOT ${_root})
set(CMAKE_C_COMPILER ${_root}/usr/bin/x86_64-linux-gnu-gcc-10)
set(CMAKE_CXX_COMPILER ${_root}/usr/bin/x86_64-linux-gnu-g++-10)
foreach(language C CXX) # assertions name headers: the same wherever the folder is
  set(CMAKE_${language}_FLAGS_INIT -ffile-prefix-map=${_root}=)
endforeach()
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(ENV{PKG_CONFIG_SYSROOT_DIR} ${_root})
set(ENV{PKG_CONFIG_LIBDIR} ${_root}/usr/lib/x86_64-linux-gnu/pkgconfig:${_root}/usr/share/pkgconfig)
