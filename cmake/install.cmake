# Files of `cmake --install`: libraries (component runtime), headers and package files (dev), the tool and the rules for
# devices (tool). All paths are relative: an installed tree can be moved.
include(CMakePackageConfigHelpers)
set(_package ${CMAKE_INSTALL_LIBDIR}/cmake/knurl)
set(_libraries knurl)
if(KNURL_GLTF)
  list(APPEND _libraries knurl_gltf)
  set_target_properties(knurl_gltf PROPERTIES EXPORT_NAME gltf)
endif()
# For pkg-config: the prefix relative to its files, and the dependencies of static libraries.
file(RELATIVE_PATH KNURL_PREFIX ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
if(NOT BUILD_SHARED_LIBS)
  set(KNURL_PC_LIBS " -lm -pthread")
  set(KNURL_PC_CXX_LIBS " -lstdc++")
  if(WIN32)
    string(APPEND KNURL_PC_LIBS " -lwinmm")
    set(KNURL_PC_DEFINES " -DKNURL_STATIC")
  elseif(CMAKE_DL_LIBS)
    string(APPEND KNURL_PC_LIBS " -l${CMAKE_DL_LIBS}")
  endif()
endif()
set(_here $ORIGIN) # the folder of the file that needs a library
if(APPLE)
  set(_here @loader_path)
endif()
foreach(library ${_libraries})
  install(TARGETS ${library} EXPORT ${library}
    RUNTIME COMPONENT runtime
    LIBRARY COMPONENT runtime NAMELINK_COMPONENT dev
    ARCHIVE COMPONENT dev)
  install(EXPORT ${library} NAMESPACE knurl:: FILE ${library}-targets.cmake DESTINATION ${_package} COMPONENT dev)
  set_target_properties(${library} PROPERTIES INSTALL_RPATH ${_here})
  configure_file(cmake/${library}.pc.in ${library}.pc @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${library}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT dev)
endforeach()
install(DIRECTORY sdk/include/knurl DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev)

# api.json: the declarations of the headers, for makers of bindings; only if ./run mirror has fetched libclang.
set(_libclang ${PROJECT_SOURCE_DIR}/build/mirror-venv/bin/python)
if(EXISTS ${_libclang})
  file(GLOB _headers CONFIGURE_DEPENDS sdk/include/knurl/*.h)
  add_custom_command(OUTPUT api.json DEPENDS scripts/api.py ${_headers}
    COMMAND ${_libclang} -B ${CMAKE_CURRENT_SOURCE_DIR}/scripts/api.py ${CMAKE_CURRENT_BINARY_DIR}/api.json)
  add_custom_target(knurl_api ALL DEPENDS api.json)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/api.json DESTINATION ${CMAKE_INSTALL_DATADIR}/knurl COMPONENT dev OPTIONAL)
endif()

configure_package_config_file(cmake/knurl-config.cmake.in knurl-config.cmake INSTALL_DESTINATION ${_package}
  NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(knurl-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/knurl-config.cmake ${CMAKE_CURRENT_BINARY_DIR}/knurl-config-version.cmake
  DESTINATION ${_package} COMPONENT dev)
install(CODE "
  file(READ \"${CMAKE_CURRENT_SOURCE_DIR}/CHANGELOG.md\" changes) # without links: the pages are not beside it there
  string(REGEX REPLACE [=[\\[([^]]*)\\]\\([a-z][^):]*\\)]=] [=[\\1]=] changes \"\${changes}\")
  file(WRITE \"${CMAKE_CURRENT_BINARY_DIR}/CHANGELOG.md\" \"\${changes}\")" COMPONENT runtime)
install(FILES LICENSE ${CMAKE_CURRENT_BINARY_DIR}/CHANGELOG.md bindings/godot/addons/knurl/THIRD_PARTY.md
  DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime)

if(TARGET knurl_tool)
  file(RELATIVE_PATH _up ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
  foreach(program knurl_tool knurl_study_tool) # the tool runs the other one
    if(TARGET ${program})
      if(BUILD_SHARED_LIBS)
        set_target_properties(${program} PROPERTIES INSTALL_RPATH ${_here}/${_up})
      endif()
      install(TARGETS ${program} RUNTIME COMPONENT tool OPTIONAL)
    endif()
  endforeach()
  if(NOT CMAKE_CROSSCOMPILING) # the tool writes its man page and completions itself
    set(_pages man/knurl.1 completion/bash/knurl completion/fish/knurl.fish completion/zsh/_knurl)
    set(_write)
    foreach(page ${_pages})
      get_filename_component(_folder ${page} DIRECTORY)
      file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/${_folder})
      string(REPLACE "/" ";" _arguments ${_folder})
      list(APPEND _write COMMAND knurl_tool ${_arguments} > ${page})
    endforeach()
    add_custom_command(OUTPUT ${_pages} ${_write} DEPENDS knurl_tool)
    add_custom_target(knurl_pages ALL DEPENDS ${_pages})
    foreach(_place man/knurl.1:man/man1 completion/bash/knurl:bash-completion/completions
        completion/fish/knurl.fish:fish/vendor_completions.d completion/zsh/_knurl:zsh/site-functions)
      string(REPLACE ":" ";" _place ${_place})
      list(GET _place 0 _page)
      list(GET _place 1 _folder)
      install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${_page} DESTINATION ${CMAKE_INSTALL_DATADIR}/${_folder} COMPONENT tool OPTIONAL)
    endforeach()
  endif()
  if(CMAKE_SYSTEM_NAME STREQUAL "Linux")
    install(FILES sdk/udev/70-knurl.rules DESTINATION lib/udev/rules.d COMPONENT tool)
  endif()
endif()
