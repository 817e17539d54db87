# Debian packages of the components that install rules name. deb.sh configures with this and runs
# CPack; deb_finish.cmake puts into each package what Debian expects besides.
set(maintainer "treeform developers <treeform@example.org>")
set(TREEFORM_MAINTAINER "${maintainer}" CACHE STRING "Who answers for Debian packages")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME treeform)
set(CPACK_PACKAGE_VENDOR treeform)
# This very text means that there is none: each package has its own.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "treeform built using CMake")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/deb_finish.cmake)
set(CPACK_TREEFORM_SOURCE ${PROJECT_SOURCE_DIR})  # for that script

# Less than the 1 of a first package by Debian, which then would take the place of ours.
set(CPACK_DEBIAN_PACKAGE_RELEASE 0treeform1)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${TREEFORM_MAINTAINER}")
set(CPACK_DEBIAN_PACKAGE_SOURCE treeform)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEB_COMPONENT_INSTALL ON)
# What the files of a package link is found out; our own libraries belong to no package yet.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS
    ${PROJECT_BINARY_DIR}/libtree ${PROJECT_BINARY_DIR}/libmesh ${PROJECT_BINARY_DIR}/tools/c)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(soname ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(ours "= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}")
set(about "treeform finds self-intersections of triangle meshes and removes them, combines
solids, merges points, and places parts. Every yes or no is exact on the
coordinates as given, and what is written has been checked.
.
")

# treeform_deb(COMPONENT NAME SECTION SUMMARY TEXT [DEPENDS...]): in CPACK_DEBIAN_NAME the component is
# in capitals.
set(CPACK_COMPONENTS_ALL "")
function(treeform_deb component name section summary text)
    string(TOUPPER ${component} upper)
    list(JOIN ARGN ", " depends)
    foreach(pair IN ITEMS "PACKAGE_NAME=${name}" "PACKAGE_SECTION=${section}"
                          "PACKAGE_DEPENDS=${depends}" "DESCRIPTION=${summary}\n${about}${text}")
        string(REGEX MATCH "^[A-Z_]+" key "${pair}")
        string(REGEX REPLACE "^[A-Z_]+=" "" value "${pair}")
        set(CPACK_DEBIAN_${upper}_${key} "${value}" PARENT_SCOPE)
    endforeach()
    set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} ${component} PARENT_SCOPE)
endfunction()

treeform_deb(libraries libtreeform${soname} libs
    "exact processing of triangle meshes - shared libraries"
    "This package has the libraries for programs in C++ and C.")
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_LIST_DIR}/debian/triggers)
treeform_deb(development libtreeform-dev libdevel
    "exact processing of triangle meshes - development files"
    "This package has the headers, and what makes CMake and pkg-config find the
libraries."
    "libtreeform${soname} (${ours})")
treeform_deb(tools treeform-tools graphics
    "exact processing of triangle meshes - command line tools"
    "This package has tf-boolean, tf-cut, tf-place, tf-repair,
tf-selfintersect and tf-weld, their manual pages, and completions for bash, fish and zsh."
    "libtreeform${soname} (${ours})")
set(CPACK_DEBIAN_TOOLS_PACKAGE_SUGGESTS "treeform-tools-mpi")
if(TARGET treeform_mpi)
    treeform_deb(mpi treeform-tools-mpi graphics
        "exact processing of triangle meshes - tools on many machines"
        "This package lets tf-selfintersect and tf-weld share their work under
mpirun."
        "treeform-tools (${ours})")
endif()
if(TARGET treeform_python)
    execute_process(COMMAND ${TREEFORM_PYTHON} -c "import sys; print(sys.version_info.minor)"
        OUTPUT_VARIABLE minor OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
    math(EXPR next "${minor} + 1")
    treeform_deb(python python3-treeform python
        "exact processing of triangle meshes - Python package"
        "This package has the Python package, which takes and gives NumPy arrays."
        "libtreeform${soname} (${ours})"
        "python3 (>= 3.${minor})" "python3 (<< 3.${next})"
        "python3-numpy (>= 1:1.20)")
    set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
        ${CMAKE_CURRENT_LIST_DIR}/debian/postinst ${CMAKE_CURRENT_LIST_DIR}/debian/prerm)
endif()
include(CPack)
