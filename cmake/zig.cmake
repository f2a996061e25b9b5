# macOS (arm64, x86-64), Linux and Windows (arm64) from Linux, with the compiler in build/zig, from cmake/zig.sh.
# KNURL_ZIG_TARGET: Zig's name of the target; presets set it. KNURL_ZIG_ROOT: further libraries for it, e.g. from
# cmake/arm64.sh.
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES KNURL_ZIG_TARGET KNURL_ZIG_ROOT)
string(REGEX MATCH "^[^-]+" CMAKE_SYSTEM_PROCESSOR ${KNURL_ZIG_TARGET})
if(KNURL_ZIG_TARGET MATCHES macos)
  set(CMAKE_SYSTEM_NAME Darwin)
  set(CMAKE_USER_MAKE_RULES_OVERRIDE ${CMAKE_CURRENT_LIST_FILE}) # to be read again after CMake's own rules,
  set(CMAKE_SHARED_LIBRARY_RUNTIME_C_FLAG "-Wl,-rpath,") # which use @rpath only if sw_vers tells a new enough macOS
  set(CMAKE_BUILD_WITH_INSTALL_RPATH ON) # files are installed as they were linked, and signed: nothing here could sign again
  set(CMAKE_INSTALL_NAME_TOOL true)
  set(CMAKE_STRIP true)
elseif(KNURL_ZIG_TARGET MATCHES windows)
  set(CMAKE_SYSTEM_NAME Windows)
else()
  set(CMAKE_SYSTEM_NAME Linux)
endif()
file(REAL_PATH ${CMAKE_CURRENT_LIST_DIR}/../build/zig _zig)
set(CMAKE_C_COMPILER ${_zig}/bin/${KNURL_ZIG_TARGET}-cc)
set(CMAKE_CXX_COMPILER ${_zig}/bin/${KNURL_ZIG_TARGET}-c++)
set(CMAKE_AR ${_zig}/bin/ar)
set(CMAKE_RANLIB ${_zig}/bin/ranlib)
foreach(kind EXE SHARED MODULE) # the C++ library has debug information, which contains folder names
  set(CMAKE_${kind}_LINKER_FLAGS_INIT -s)
endforeach()
set(CMAKE_FIND_ROOT_PATH ${_zig}/prefix)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(ENV{PKG_CONFIG_LIBDIR} ${_zig}/prefix/lib/pkgconfig)
if(KNURL_ZIG_ROOT)
  list(APPEND CMAKE_FIND_ROOT_PATH ${KNURL_ZIG_ROOT})
  set(CMAKE_LIBRARY_ARCHITECTURE ${CMAKE_SYSTEM_PROCESSOR}-linux-gnu)
  set(ENV{PKG_CONFIG_LIBDIR}
    $ENV{PKG_CONFIG_LIBDIR}:${KNURL_ZIG_ROOT}/usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/pkgconfig)
endif()
