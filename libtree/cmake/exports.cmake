# treeform_limit_exports(TARGET): a shared library shows the names of exports.map alone, where the
# linker can be told so: of ELF.
include(CheckLinkerFlag)
set(TREEFORM_EXPORTS ${CMAKE_CURRENT_LIST_DIR}/exports.map)
if(BUILD_SHARED_LIBS)
    check_linker_flag(CXX LINKER:--version-script=${TREEFORM_EXPORTS} TREEFORM_CAN_LIMIT_EXPORTS)
endif()

function(treeform_limit_exports target)
    get_target_property(type ${target} TYPE)
    if(type STREQUAL SHARED_LIBRARY AND TREEFORM_CAN_LIMIT_EXPORTS)
        target_link_options(${target} PRIVATE LINKER:--version-script=${TREEFORM_EXPORTS})
        set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS ${TREEFORM_EXPORTS})
    endif()
endfunction()
