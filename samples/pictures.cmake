# The search for ridges in pictures, for the tool, its tests and its fuzzer. It needs a Fourier transform, which the studies
# need as well, and decoders; without them, knurl tag --from-texture and --from-picture are errors.
find_package(PkgConfig)
if(PKG_CONFIG_FOUND)
  pkg_check_modules(KISSFFT IMPORTED_TARGET kissfft-float)
  pkg_check_modules(PICTURES IMPORTED_TARGET GLOBAL libpng libjpeg)
endif()
option(KNURL_PICTURES "Build knurl tag --from-texture and --from-picture, if their libraries are found" ON)
if(KNURL_PICTURES AND KISSFFT_FOUND AND PICTURES_FOUND)
  set(_tool ${CMAKE_CURRENT_LIST_DIR}/knurl)
  add_library(knurl_pictures STATIC ${_tool}/picture.c ${_tool}/raster.c ${_tool}/picture_png.c ${_tool}/picture_jpeg.c
    ${_tool}/spectrum.c ${_tool}/peaks.c ${_tool}/ridges.c ${_tool}/profile.c ${_tool}/texture.c)
  target_include_directories(knurl_pictures PUBLIC ${_tool} ${CMAKE_CURRENT_LIST_DIR}/common)
  target_compile_options(knurl_pictures PRIVATE ${KNURL_HARDENED})
  target_link_libraries(knurl_pictures PUBLIC knurl::knurl PRIVATE knurl_flags PkgConfig::KISSFFT PkgConfig::PICTURES m)
elseif(KNURL_PICTURES)
  message(STATUS "knurl tag --from-texture and --from-picture are left out: no libpng, libjpeg and kissfft-float")
endif()
