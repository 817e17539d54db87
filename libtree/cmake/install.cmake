# What `cmake --install` writes: headers under include/treeform/, the libraries, and what makes them
# found by find_package(treeform CONFIG) and by pkg-config. The folder can be moved afterwards.
#
# Components, by which packages are split: libraries (shared ones, by their versions), development,
# tools, mpi, and python, which only `cmake --install --component python` installs, as where a Python
# looks is its own affair.
include(CMakePackageConfigHelpers)

# A shared library carries its own dependencies; who links a static one has to find them too.
get_target_property(treeform_kind treeform_mesh TYPE)
set(treeform_dependencies "")
set(treeform_pc_private "")
if(treeform_kind STREQUAL "STATIC_LIBRARY")
    set(treeform_packages Threads hwy pugixml ZLIB)
    set(treeform_found_libraries minizip)
    set(treeform_pc_packages libhwy pugixml minizip zlib)
    if(NOT TREEFORM_PLAIN_THREADS)
        list(APPEND treeform_packages TBB)
        list(APPEND treeform_pc_packages tbb)
    endif()
    if(TREEFORM_WITH_ASSIMP)
        list(APPEND treeform_found_libraries assimp)
        list(APPEND treeform_pc_packages assimp)
    endif()
    if(treeform_with_draco)
        list(APPEND treeform_found_libraries draco)
        list(APPEND treeform_pc_packages draco)
    endif()
    foreach(package IN LISTS treeform_packages)
        string(APPEND treeform_dependencies "find_dependency(${package})\n")
    endforeach()
    foreach(library IN LISTS treeform_found_libraries)
        string(APPEND treeform_dependencies "treeform_find_library(${library})\n")
    endforeach()
    list(JOIN treeform_pc_packages ", " treeform_pc_packages)
    # "Requires", not "Requires.private": this installation has no shared library, so that the
    # dependencies are needed without --static too.
    set(treeform_pc_private "Requires: ${treeform_pc_packages}\nLibs.private: -pthread -lstdc++")
endif()

set(treeform_config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/treeform)
set(treeform_libraries treeform_tree treeform_mesh)
if(TREEFORM_BUILD_C)
    list(APPEND treeform_libraries treeform_c)
endif()
install(TARGETS ${treeform_libraries}
    EXPORT treeformTargets
    LIBRARY COMPONENT libraries NAMELINK_COMPONENT development
    ARCHIVE COMPONENT development
    FILE_SET HEADERS COMPONENT development)
install(EXPORT treeformTargets NAMESPACE treeform:: DESTINATION ${treeform_config_dir}
    COMPONENT development)

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/treeformConfig.cmake.in
    ${PROJECT_BINARY_DIR}/treeformConfig.cmake
    INSTALL_DESTINATION ${treeform_config_dir}
    NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/treeformConfigVersion.cmake
    COMPATIBILITY SameMinorVersion)
install(FILES
    ${PROJECT_BINARY_DIR}/treeformConfig.cmake
    ${PROJECT_BINARY_DIR}/treeformConfigVersion.cmake
    DESTINATION ${treeform_config_dir}
    COMPONENT development)

file(RELATIVE_PATH treeform_pc_prefix
    /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
set(treeform_pc_files treeform.pc)
if(TREEFORM_BUILD_C)
    list(APPEND treeform_pc_files treeform-c.pc)
endif()
foreach(name IN LISTS treeform_pc_files)
    configure_file(${CMAKE_CURRENT_LIST_DIR}/${name}.in ${PROJECT_BINARY_DIR}/${name} @ONLY)
    install(FILES ${PROJECT_BINARY_DIR}/${name} DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
        COMPONENT development)
endforeach()

if(TARGET treeform_python)
    set(TREEFORM_PYTHON_DIR lib/python3/dist-packages CACHE STRING
        "Where the component python goes, of the prefix")
    file(GLOB treeform_modules CONFIGURE_DEPENDS
        ${PROJECT_SOURCE_DIR}/tools/python/treeform/*.py
        ${PROJECT_SOURCE_DIR}/tools/python/treeform/*.pyi
        ${PROJECT_SOURCE_DIR}/tools/python/treeform/py.typed)
    install(TARGETS treeform_python LIBRARY DESTINATION ${TREEFORM_PYTHON_DIR}/treeform
        COMPONENT python EXCLUDE_FROM_ALL)
    install(FILES ${treeform_modules} DESTINATION ${TREEFORM_PYTHON_DIR}/treeform
        COMPONENT python EXCLUDE_FROM_ALL)
endif()
