#include "bindings.hpp"
#include "carrying.hpp"
#include "state.hpp"

namespace binding {

namespace {

/// A `Mesh` of the package.
py::object mesh_of(tf::mesh_file&& file) {
    tf::mesh mesh = std::exchange(file.mesh, {});
    return mesh_object(std::move(mesh), py::none(), py::cast(file_data(std::move(file))));
}

/// A `Mesh` of the file that `take` reads.
template <class Take>
py::object read_by(bool join, const Take& take) {
    tf::mesh_file file = run([&](const tf::progress_callback&) {
        tf::mesh_file read = take();
        if (join && !read.indexed) {
            for (tf::element& e : read.attributes.elements)
                if (e.name == "vertex")
                    e = e.gathered(tf::find_equal_points(read.mesh.points).first_of_group);
            read.mesh = tf::join_equal_points(read.mesh);
            read.indexed = true;
        }
        return read;
    });
    return mesh_of(std::move(file));
}

py::object read(const std::filesystem::path& path, const std::string& format, bool join,
                const tf::read_options& options) {
    return read_by(join, [&] { return tools::read_linked(path, format, options); });
}

/// `name` is the file name in errors; its extension may tell the format.
py::object read_bytes(const py::bytes& bytes, const std::string& name, const std::string& format,
                      bool join, const tf::read_options& options) {
    const auto content = static_cast<std::string_view>(bytes);
    return read_by(
        join, [&] { return tf::read(std::as_bytes(std::span(content)), name, format, options); });
}

/// Meshes as the parts of one file.
py::object scene(const held_meshes& meshes, const std::vector<std::string>& names) {
    const auto files = list_of(meshes, [](const held_mesh* one) { return file_of(*one); });
    const auto members = list_of(files, [](const tf::mesh_file& one) { return &one; });
    return mesh_of(
        run([&](const tf::progress_callback&) { return tools::scene_of(members, names); }));
}

/// The parts of a mesh by name. Those without a name are called "1", "2", ..., by their positions.
py::dict file_parts(const held_mesh& mesh, bool combine_patches) {
    const tf::mesh_file whole = file_of(mesh);
    require_rows(whole, 0);
    std::vector<tf::file_part> parts = run([&](const tf::progress_callback&) {
        return tf::file_parts({&whole, {}}, combine_patches);
    });
    py::dict all;
    for (tf::file_part& one : parts) {
        const std::string name = one.name.empty() ? std::to_string(all.size() + 1) : one.name;
        std::string key = name;
        for (int i = 2; all.contains(key); ++i) key = name + " (" + std::to_string(i) + ")";
        all[py::str(key)] = mesh_of(std::move(one.file));
    }
    return all;
}

/// `place` is the path, or "-" if its folder is not that of the output.
py::object write(const std::filesystem::path& path, const held_mesh& mesh, bool certified,
                 tf::write_options options, const std::string& place) {
    options.progress = [report = report_of_job()](double done) {
        return done < 1.0 ? !report || report(done) : commit_job();
    };
    const tf::mesh_file file = file_of(mesh);
    return as_python(run([&](const tf::progress_callback&) {
        return tools::write_linked(place, file, [&](const tf::mesh_file& at) {
            return certified && !options.round ? tf::detail::io::write_certified(path, at, options)
                                               : tf::write(path, at, options);
        });
    }));
}

// ---- columns ----

py::object column_values(const tf::column& c) {
    return tf::with_type(c.type, [&]<class T>(T) -> py::object {
        std::vector<T> values(c.size());
        if (!values.empty()) std::memcpy(values.data(), c.values.data(), c.values.size());
        py::array numbers = as_array(std::move(values));
        numbers.attr("setflags")(py::arg("write") = false);
        if (!c.list_length) return numbers;
        std::vector<std::uint64_t> begin = c.list_begin;
        return py::make_tuple(as_array(std::move(begin)), numbers);
    });
}

py::dict columns(const file_data& data, const std::string& element) {
    py::dict all;
    if (const tf::element* rows = data.file().attributes.find(element))
        for (const tf::column& c : rows->columns)
            if (c.role == tf::column_role::data) all[py::str(c.name)] = column_values(c);
    return all;
}

/// A mapping of the columns, in which columns can be set.
py::object column_dict(const py::object& data, const std::string& element) {
    return py::module_::import("treeform._arrays")
        .attr("ColumnDict")(data.attr("columns")(element), data.attr(("set_" + element).c_str()));
}

void set_column(file_data& data, const std::string& element, const std::string& name,
                const array_like& given) {
    const py::array values = py::module_::import("numpy").attr("asarray")(given);
    if (values.ndim() != 1)
        throw std::invalid_argument(name +
                                    ": expected a one-dimensional array, a value for each row");
    const auto rows = static_cast<std::size_t>(values.size());
    tf::element& to = data.own().attributes.find_or_add(element, rows);
    if (to.rows != rows)
        throw std::invalid_argument(name + ": " + std::to_string(rows) + " values for " +
                                    std::to_string(to.rows) + " rows");
    const auto add = [&]<class T>(T) {
        const auto typed = array_of<T>::ensure(values);
        to.set(tf::column::of<T>(name, {typed.data(), rows}));
    };
    for (int type = 0; type < 10; ++type) {
        const auto scalar = static_cast<tf::scalar_type>(type);
        const bool fits = tf::with_type(
            scalar, [&]<class T>(T) { return py::dtype::of<T>().is(values.dtype()); });
        if (fits) return tf::with_type(scalar, add);
    }
    throw std::invalid_argument(name +
                                ": expected integers of 8 to 64 bits, or floats of 32 or 64");
}

py::dict corners(const file_data& data) {
    tf::corner_values copy = data.file().attributes.corners;
    py::dict all;
    all["texture"] = as_array(std::move(copy.texture));
    all["texture_of_corner"] = as_array(std::move(copy.texture_of_corner));
    all["normals"] = as_array(std::move(copy.normals));
    all["normal_of_corner"] = as_array(std::move(copy.normal_of_corner));
    return all;
}

py::object face_of_triangle(const file_data& data) {
    if (data.file().face_of_triangle.empty()) return py::none();
    std::vector<std::uint32_t> copy = data.file().face_of_triangle;
    return as_array(std::move(copy));
}

std::vector<std::tuple<std::string, std::string>> warnings_in(const file_data& data) {
    return list_of(data.file().warnings,
                   [](const tf::io_warning& one) { return std::tuple(one.code, one.text); });
}

std::vector<std::string> names_of_rows(const file_data& data) {
    return list_of(data.file().attributes.elements, &tf::element::name);
}

std::vector<std::tuple<std::string, std::string, std::string, std::size_t>> parts_in(
    const file_data& data) {
    return list_of(data.file().attributes.parts, [](const tf::named_faces& one) {
        return std::tuple(one.object, one.group, one.material, std::size_t{one.first_face});
    });
}

std::string text_of(const file_data& data) {
    py::dict rows;
    for (const tf::element& one : data.file().attributes.elements)
        rows[py::str(one.name)] = py::list(columns(data, one.name));
    return "Attributes(format=" + std::string(py::repr(py::str(data.file().format))) +
           ", columns=" + std::string(py::repr(rows)) +
           (data.file().attributes.corners == tf::corner_values{} ? "" : ", corners=...") +
           ", warnings=" + std::to_string(data.file().warnings.size()) + ")";
}

void add_columns(py::class_<file_data>& made) {
    made.def_property_readonly(
            "vertex", [](const py::object& d) -> py::object { return column_dict(d, "vertex"); },
            "Read-only columns of vertices, (V,); assign to set one.")  // -> ColumnDict
        .def_property_readonly(
            "face", [](const py::object& d) -> py::object { return column_dict(d, "face"); },
            "Read-only columns of faces, as in the file; assign to set one.")  // -> ColumnDict
        .def("columns", &columns, py::arg("element"),
             "Read-only copies of the columns of `element`; lists are (begin, values).")
        .def(
            "set_vertex",
            [](file_data& d, const std::string& name, const array_like& values) {
                set_column(d, "vertex", name, values);
            },
            py::arg("name"), py::arg("values"),
            "Sets a column of vertices, (V,), with the type of `values`.")
        .def(
            "set_face",
            [](file_data& d, const std::string& name, const array_like& values) {
                set_column(d, "face", name, values);
            },
            py::arg("name"), py::arg("values"),
            "Sets a column of faces, (F,), with the type of `values`.");
}

void add_attributes(py::module_& module) {
    py::class_<file_data> made(module, "Attributes",
                               R"(Everything in a file besides points and faces.

Columns of numbers for vertices and faces (colors, normals, qualities), names of parts, texture
coordinates and normals of corners, comments, and the format of the file. `write` stores what the
format of the output supports. Operations carry columns, corners and parts over to their results,
but not lists and other elements.

>>> import numpy as np
>>> import treeform
>>> extra = treeform.Attributes()
>>> extra.vertex["quality"] = np.array([0.5, 1.0, 2.0])
>>> extra.vertex
{'quality': array([0.5, 1. , 2. ])})");
    made.attr("__module__") = "treeform";
    made.def(py::init<>())
        .def(pickled<file_data>([](file_data& d) -> tf::mesh_file& { return d.own(); }))
        .def("__copy__", [](const file_data& d) { return file_data(d); })
        .def("__repr__", &text_of)
        .def_property_readonly(
            "format", [](const file_data& d) -> std::string { return d.file().format; },
            "Format of the file: 'stl-binary', 'ply-ascii', 'obj', ...; empty without a file.")
        .def_property_readonly(
            "precision",
            [](const file_data& d) -> std::string { return word_of(d.file().stored_as); },
            "Precision of the coordinates in the file: 'float32' or 'float64'.")
        .def_property_readonly("warnings", &warnings_in, "Warnings about the file: (code, text).")
        .def_property_readonly(
            "comments",
            [](const file_data& d) -> std::vector<std::string> {
                return d.file().attributes.comments;
            },
            "Comment lines of a PLY file.")
        .def_property_readonly("elements", &names_of_rows,
                               "Names of the elements of the file: 'vertex', 'face', ...")
        .def_property_readonly(
            "parts", &parts_in,
            "Parts of the file: (object, group, material, number in the file of the first face); "
            "see `file_parts`.")
        .def_property_readonly("corners", &corners,
                               "Values of the corners of faces: `texture` (n, 3) and "
                               "`texture_of_corner` (F, 3), "
                               "which has row numbers in `texture`, or 4294967295; likewise "
                               "`normals`.")  // -> dict[str, NDArray[Any]]
        .def_property_readonly(
            "face_of_triangle", &face_of_triangle,
            "(F,) the number in the file of the face that contains each triangle; None if all "
            "faces are triangles.");  // -> Optional[Ids]
    add_columns(made);
}

}  // namespace

void add_files(py::module_& module) {
    add_attributes(module);
    add_job(module, "read", &read, job_kind::long_work);              // -> Mesh
    add_job(module, "read_bytes", &read_bytes, job_kind::long_work);  // -> Mesh
    add_job(module, "scene", &scene);                                 // -> Mesh
    add_job(module, "file_parts", &file_parts);                       // -> dict[str, Mesh]
    add_job(module, "write", &write, job_kind::writes);               // -> Written
}

}  // namespace binding
