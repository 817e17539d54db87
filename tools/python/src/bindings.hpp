#pragma once
/// \file
/// The functions by which each source adds to the module.

#include "job.hpp"
#include "parts.hpp"

namespace binding {

void add_functions(py::module_& module);
void add_files(py::module_& module);
void add_intersections(py::module_& module);
void add_operations(py::module_& module);
void add_options(py::module_& module);
void add_pictures(py::module_& module);
void add_robots(py::module_& module);
void add_streams(py::module_& module);
void add_trees(py::module_& module);
void add_verbs(py::module_& module);

}  // namespace binding
