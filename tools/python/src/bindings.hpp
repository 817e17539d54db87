#pragma once
/// \file
/// What each source adds to the module.

#include <pybind11/pybind11.h>

namespace binding {

void add_assembly(pybind11::module_& module);
void add_booleans(pybind11::module_& module);
void add_boxes(pybind11::module_& module);
void add_carrying(pybind11::module_& module);
void add_certificates(pybind11::module_& module);
void add_clouds(pybind11::module_& module);
void add_cuts(pybind11::module_& module);
void add_functions(pybind11::module_& module);
void add_files(pybind11::module_& module);
void add_intersections(pybind11::module_& module);
void add_nearness(pybind11::module_& module);
void add_options(pybind11::module_& module);
void add_pictures(pybind11::module_& module);
void add_placement(pybind11::module_& module);
void add_repair(pybind11::module_& module);
void add_robots(pybind11::module_& module);
void add_streams(pybind11::module_& module);
void add_weld(pybind11::module_& module);

}  // namespace binding
