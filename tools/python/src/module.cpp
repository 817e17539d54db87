#include "bindings.hpp"

namespace binding {
namespace {

py::object of_errors(const char* name) {
    return py::module_::import("treeform._errors").attr(name);
}

/// Raises the exception of the package with this name.
void raise(const char* name, const char* text) { PyErr_SetString(of_errors(name).ptr(), text); }

/// Raises FileError, which is also a Python exception for `reason` if the system reported one.
void raise_file_error(const std::string& text, std::error_code reason, const std::string& path) {
    const py::object error = of_errors("file_error")(text, reason.value(), path);
    PyErr_SetObject(py::type::of(error).ptr(), error.ptr());
}

/// A message of C++ in words of Python, without the name of the function in front.
std::string in_python(std::string message) {
    if (message.starts_with("treeform:")) message.erase(0, message.find(": ") + 2);
    const auto tells = [&](const char* of) { return message.find(of) != std::string::npos; };
    if (tells(" is not finite") && (tells("point ") || tells("corner ")))
        message += "; read(..., drop_non_finite=True) drops such points";
    if (const auto at = message.find("precision float32, "); at != std::string::npos)
        message.replace(at, 17, "precision=\"float32\"") += "; or set round=True";
    return message;
}

/// Translates exceptions. pybind11 itself translates std::bad_alloc to MemoryError.
void translate(std::exception_ptr thrown) {
    try {
        std::rethrow_exception(thrown);
    } catch (const cancelled&) {
        raise("Cancelled", "progress returned False");
    } catch (const std::invalid_argument& error) {
        PyErr_SetString(PyExc_ValueError, in_python(error.what()).c_str());
    } catch (const std::out_of_range& error) {
        PyErr_SetString(PyExc_IndexError, in_python(error.what()).c_str());
    } catch (const tf::io_error& error) {
        raise_file_error(in_python(error.what()), error.reason(), error.path());
    } catch (const std::filesystem::filesystem_error& error) {
        raise_file_error(error.what(), error.code(), error.path1().string());
    } catch (const std::system_error& error) {
        if (error.code() != std::errc::resource_unavailable_try_again) throw;
        PyErr_SetString(PyExc_MemoryError, "not enough memory for a thread");
    }
}

void add_meshes(py::module_& module) {
    py::class_<held_mesh>(module, "HeldMesh", "A mesh or cloud in the arrays of Python.")
        .def(py::init<points_array, faces_array, bool>())
        .def(py::init<points_array>())
        .def_property_readonly("vertices", &held_mesh::points)
        .def_property_readonly("faces", &held_mesh::faces)
        .def_property("data", &held_mesh::data, &held_mesh::set_data)  // -> Optional[Attributes]
        .def_property_readonly("is_cloud",
                               [](const held_mesh& m) -> bool { return m.prepared().is_cloud(); })
        .def_property_readonly("indexes_built", [](const held_mesh& m) -> std::size_t {
            return m.prepared().indexes_built();
        });
    py::class_<tf::thread_scope>(module, "Threads").def(py::init<unsigned>());
    module.def("thread_count", &tf::thread_count);
    module.def("version", &tf::version_string);
    module.def("end", &end);
    add_job(module, "build", &build);  // -> Any
    leave_jobs_at_the_end();
}

}  // namespace
}  // namespace binding

PYBIND11_MODULE(_core, module) {
    using namespace binding;
    py::register_exception_translator(translate);
    add_meshes(module);
    add_options(module);
    add_files(module);
    add_intersections(module);
    add_robots(module);
    add_streams(module);
    add_pictures(module);
    add_trees(module);
    add_verbs(module);
    add_functions(module);
    add_operations(module);
}
