# An overlay port: it builds the tree that it lies in. In a registry, vcpkg_from_github would get the
# sources of a tag instead.
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../../../.." ABSOLUTE)

vcpkg_check_features(OUT_FEATURE_OPTIONS FEATURE_OPTIONS
    FEATURES
        tools TREEFORM_BUILD_TOOLS)

# The library in C is always a shared one.
string(COMPARE EQUAL "${VCPKG_LIBRARY_LINKAGE}" dynamic BUILD_C)

# assimp is left out: a static one needs libraries that its users would have to name.
vcpkg_cmake_configure(
    SOURCE_PATH "${SOURCE_PATH}"
    OPTIONS
        ${FEATURE_OPTIONS}
        -DTREEFORM_BUILD_C=${BUILD_C}
        -DTREEFORM_BUILD_PYTHON=OFF
        -DTREEFORM_BUILD_TESTS=OFF
        -DTREEFORM_INSTALL=ON
        -DTREEFORM_WITH_ASSIMP=OFF
        -DCMAKE_DISABLE_FIND_PACKAGE_MPI=ON)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/treeform)
vcpkg_fixup_pkgconfig()
if("tools" IN_LIST FEATURES)
    vcpkg_copy_tools(
        TOOL_NAMES tf-boolean tf-cut tf-place tf-repair tf-selfintersect tf-weld
        AUTO_CLEAN)
endif()

file(REMOVE_RECURSE
    "${CURRENT_PACKAGES_DIR}/debug/include"
    "${CURRENT_PACKAGES_DIR}/debug/share")
file(INSTALL "${CMAKE_CURRENT_LIST_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
