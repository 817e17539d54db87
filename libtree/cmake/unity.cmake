# treeform_group_by_room(TARGET): with TREEFORM_UNITY, the sources of a folder are compiled together,
# in units of at most this many bytes. Units of their own stay those that Highway compiles once for
# each instruction set, since they include themselves, and those that say so
# (SKIP_UNITY_BUILD_INCLUSION).
set(TREEFORM_UNIT_BYTES 200000)

function(treeform_group_by_room target)
    set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
    get_target_property(sources ${target} SOURCES)
    foreach(source IN LISTS sources)
        cmake_path(ABSOLUTE_PATH source OUTPUT_VARIABLE file)
        if(NOT source MATCHES "\\.cpp$" OR NOT EXISTS "${file}")
            continue()
        endif()
        get_source_file_property(alone ${source} SKIP_UNITY_BUILD_INCLUSION)
        file(STRINGS "${file}" repeated REGEX "^#define HWY_TARGET_INCLUDE" LIMIT_COUNT 1)
        if(alone OR repeated)
            continue()
        endif()
        cmake_path(GET file PARENT_PATH folder)
        cmake_path(GET folder FILENAME room)
        file(SIZE "${file}" bytes)
        math(EXPR bytes_of_${room} "0${bytes_of_${room}} + ${bytes}")
        math(EXPR unit "${bytes_of_${room}} / ${TREEFORM_UNIT_BYTES}")
        set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${room}_${unit})
    endforeach()
endfunction()
