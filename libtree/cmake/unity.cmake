# treeform_group_by_room(TARGET): with CMAKE_UNITY_BUILD, the sources of a folder are compiled as one
# unit. Those that Highway compiles once for each instruction set stay units of their own, since
# they include themselves.
function(treeform_group_by_room target)
    set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
    get_target_property(sources ${target} SOURCES)
    foreach(source IN LISTS sources)
        cmake_path(ABSOLUTE_PATH source OUTPUT_VARIABLE file)
        if(NOT source MATCHES "\\.cpp$" OR NOT EXISTS "${file}")
            continue()
        endif()
        file(STRINGS "${file}" repeated REGEX "^#define HWY_TARGET_INCLUDE" LIMIT_COUNT 1)
        if(NOT repeated)
            cmake_path(GET file PARENT_PATH room)
            cmake_path(GET room FILENAME room)
            set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${room})
        endif()
    endforeach()
endfunction()
