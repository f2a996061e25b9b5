# Knurl for vcpkg: `vcpkg install knurl --overlay-ports=packages/recipes/vcpkg`, in a checkout or an unpacked source archive.
# Drivers that need libusb, hidapi or libwebsockets are left out. SPDX-License-Identifier: MIT
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../../.." ABSOLUTE)
vcpkg_check_features(OUT_FEATURE_OPTIONS _features FEATURES gltf KNURL_GLTF)
vcpkg_cmake_configure(SOURCE_PATH "${SOURCE_PATH}" OPTIONS ${_features} -DBUILD_TESTING=OFF -DKNURL_GODOT=OFF -DKNURL_UNITY=OFF
  -DKNURL_FALCON=OFF -DKNURL_RAWHID=OFF -DKNURL_INVERSE3=OFF -DKNURL_VIEW=OFF -DKNURL_PICTURES=OFF
  -DCMAKE_DISABLE_FIND_PACKAGE_PkgConfig=ON)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/knurl)
vcpkg_fixup_pkgconfig()
if("gltf" IN_LIST FEATURES)
  vcpkg_copy_tools(TOOL_NAMES knurl AUTO_CLEAN)
endif()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share"
  "${CURRENT_PACKAGES_DIR}/debug/lib/udev" "${CURRENT_PACKAGES_DIR}/lib/udev")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE" "${SOURCE_PATH}/bindings/godot/addons/knurl/THIRD_PARTY.md")
