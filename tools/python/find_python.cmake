# TREEFORM_PYTHON: a Python that has pybind11 and NumPy. treeform_python_too: whether the package is
# built without being asked for: in a release with tests, where there is one.
if(NOT TREEFORM_PYTHON AND (TREEFORM_BUILD_PYTHON OR TREEFORM_BUILD_TESTS))
    foreach(candidate python3 /usr/bin/python3)
        execute_process(COMMAND ${candidate} -c "import numpy, pybind11" RESULT_VARIABLE missing
            OUTPUT_QUIET ERROR_QUIET)
        if(missing EQUAL 0)
            set(TREEFORM_PYTHON ${candidate} CACHE STRING "Python with pybind11 and NumPy" FORCE)
            break()
        endif()
    endforeach()
endif()
set(treeform_python_too OFF)
if(TREEFORM_PYTHON AND TREEFORM_BUILD_TESTS AND NOT TREEFORM_SANITIZE AND NOT BUILD_SHARED_LIBS
   AND (NOT CMAKE_BUILD_TYPE OR CMAKE_BUILD_TYPE STREQUAL Release))
    set(treeform_python_too ON)
endif()
