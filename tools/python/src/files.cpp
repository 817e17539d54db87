#include "bindings.hpp"
#include "state.hpp"

namespace treeform {

// For `state_writer` and `state_reader`, found by the type of the value.

template <class State>
static void all_fields(State& state, io_warning& w) {
    state(w.code, w.text);
}
template <class State>
static void all_fields(State& state, column& c) {
    state(c.name, c.type, c.list_length, c.role, c.values, c.list_begin);
}
template <class State>
static void all_fields(State& state, element& e) {
    state(e.name, e.rows, e.columns);
}
template <class State>
static void all_fields(State& state, part& p) {
    state(p.object, p.group, p.material, p.first_face);
}
template <class State>
static void all_fields(State& state, corner_values& c) {
    state(c.texture, c.has_w, c.normals, c.texture_of_corner, c.normal_of_corner);
}
template <class State>
static void all_fields(State& state, attributes& a) {
    state(a.elements, a.corners, a.parts, a.material_files, a.texture_files, a.comments, a.obj_info,
          a.header);
}
template <class State>
static void all_fields(State& state, las_record& r) {
    state(r.user_id, r.record_id, r.description, r.reserved, r.data);
}
template <class State>
static void all_fields(State& state, las_header& h) {
    state(h.version_minor, h.point_format, h.scale, h.offset, h.block, h.records, h.behind_records,
          h.extended_records);
}
template <class State>
static void all_fields(State& state, value_range& r) {
    state(r.column, r.least, r.greatest, r.whole);
}
template <class State>
static void all_fields(State& state, mesh_file& f) {
    state(f.stored_face, f.stored_faces, f.indexed, f.stored_as, f.format, f.warnings, f.attributes,
          f.las, f.ranges);
}

}  // namespace treeform

namespace binding {

template <class State>
static void all_fields(State& state, file_data& d) {
    state(d.own());
}

namespace {

/// What `take` has read.
template <class Take>
py::tuple read_by(bool join, const Take& take) {
    tf::mesh_file file = run([&](const tf::progress_callback&) {
        tf::mesh_file read = take();
        if (join && !read.indexed) {
            for (tf::element& e : read.attributes.elements)
                if (e.name == "vertex")
                    e = e.gathered(tf::find_equal_points(read.mesh.points).first_of_new);
            read.mesh = tf::join_equal_points(read.mesh);
            read.indexed = true;
        }
        return read;
    });
    py::array points = as_array(std::move(file.mesh.points));
    py::array faces = as_array(std::move(file.mesh.faces));
    file.mesh = {};
    return py::make_tuple(points, faces, file_data{std::move(file)});
}

py::tuple read(const std::filesystem::path& path, const std::string& format, bool join,
               const name_pairs& columns, bool drop_nan) {
    return read_by(join, [&] {
        return tf::read(path, format, {.columns = columns_of(columns), .drop_nan = drop_nan});
    });
}

/// `name` stands for the file in errors, and its extension counts.
py::tuple read_bytes(const py::bytes& bytes, const std::string& name, const std::string& format,
                     bool join, const name_pairs& columns, bool drop_nan) {
    const auto content = static_cast<std::string_view>(bytes);
    return read_by(join, [&] {
        return tf::read(std::as_bytes(std::span(content)), name, format,
                        {.columns = columns_of(columns), .drop_nan = drop_nan});
    });
}

/// Meshes as the parts of one file: its points, faces and all else.
py::tuple scene(const held_meshes& meshes, const std::vector<const file_data*>& data,
                const std::vector<std::string>& names) {
    std::vector<tf::mesh_file> files;
    std::vector<std::optional<file_data>> kept;
    for (const file_data* one : data)
        kept.push_back(one == nullptr ? std::nullopt : std::optional(*one));
    tf::mesh_file made = run([&](const tf::progress_callback&) {
        std::vector<tf::scene_member> members;
        for (std::size_t i = 0; i < meshes.size(); ++i) {
            const auto [points, faces] = meshes[i]->view();
            tf::mesh_file one = kept[i] ? kept[i]->file() : tf::mesh_file{};
            one.mesh = {{points.begin(), points.end()}, {faces.begin(), faces.end()}};
            if (one.stored_face.empty()) one.stored_faces = faces.size();
            files.push_back(std::move(one));
        }
        for (std::size_t i = 0; i < files.size(); ++i)
            members.push_back({.file = &files[i], .name = names[i], .label = names[i]});
        return tf::scene_of(members);
    });
    py::array points = as_array(std::move(made.mesh.points));
    py::array faces = as_array(std::move(made.mesh.faces));
    made.mesh = {};
    return py::make_tuple(points, faces, file_data{std::move(made)});
}

tf::write_result write_to(const std::filesystem::path& path, const held_mesh& mesh,
                          const file_data* data, bool certified, const tf::write_options& options) {
    const auto [points, faces] = mesh.view();
    tf::mesh copy{{points.begin(), points.end()}, {faces.begin(), faces.end()}};
    certified = certified && !options.round && !tf::fits_single(points);
    tf::mesh_file file = data == nullptr ? tf::mesh_file{} : data->file();
    file.mesh = std::move(copy);
    if (file.stored_face.empty()) file.stored_faces = file.mesh.faces.size();
    tf::write_options as = options;
    if (!certified) return tf::write(path, file, as);
    if (data != nullptr && !as.precision) as.precision = tf::precision::float64;
    return tf::detail::io::write_certified(path, file, as);
}

py::object write(const std::filesystem::path& path, const held_mesh& mesh, const file_data* data,
                 bool certified, const std::string& format, bool ascii,
                 const std::optional<std::string>& precision, bool round,
                 const std::vector<std::string>& drop, const name_pairs& rename,
                 const std::optional<std::array<double, 3>>& las_scale,
                 const std::optional<std::array<double, 3>>& las_offset) {
    tf::write_options options{.format = format,
                              .ascii = ascii,
                              .drop = drop,
                              .rename = columns_of(rename),
                              .las_scale = las_scale,
                              .las_offset = las_offset,
                              .round = round};
    if (precision)
        options.precision =
            choice<tf::precision>("precision", words_of<tf::precision>::all, *precision);
    options.progress = [report = report_of_job()](double done) {
        return done < 1.0 ? !report || report(done) : commit_job();
    };
    const std::optional<file_data> kept = data == nullptr ? std::nullopt : std::optional(*data);
    tf::write_result written = run([&](const tf::progress_callback&) {
        return write_to(path, mesh, kept ? &*kept : nullptr, certified, options);
    });
    return as_python(std::move(written));
}

// ---- columns ----

py::object column_values(const tf::column& c) {
    return tf::with_type(c.type, [&]<class T>(T) -> py::object {
        std::vector<T> values(c.size());
        if (!values.empty()) std::memcpy(values.data(), c.values.data(), c.values.size());
        py::array numbers = as_array<T>(std::move(values));
        if (!c.list_length) return numbers;
        std::vector<std::uint64_t> begin = c.list_begin;
        return py::make_tuple(as_array<std::uint64_t>(std::move(begin)), numbers);
    });
}

py::dict columns(const file_data& data, const std::string& element) {
    py::dict all;
    if (const tf::element* rows = data.file().attributes.find(element))
        for (const tf::column& c : rows->columns)
            if (c.role == tf::column_role::data) all[py::str(c.name)] = column_values(c);
    return all;
}

void set_column(file_data& data, const std::string& element, const std::string& name,
                const py::array& values) {
    if (values.ndim() != 1)
        throw std::invalid_argument(name +
                                    ": one value for each row, in an array of one dimension");
    const auto rows = static_cast<std::size_t>(values.size());
    tf::element& to = data.own().attributes.obtain(element, rows);
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
    throw std::invalid_argument(name + ": numbers of 8 to 64 bits, or floats of 32 or 64");
}

py::list parts(const file_data& data) {
    py::list all;
    for (const tf::part& one : data.file().attributes.parts)
        all.append(py::make_tuple(one.object, one.group, one.material, one.first_face));
    return all;
}

py::list warnings(const file_data& data) {
    py::list all;
    for (const tf::io_warning& one : data.file().warnings)
        all.append(py::make_tuple(one.code, one.text));
    return all;
}

py::dict corners(const file_data& data) {
    tf::corner_values copy = data.file().attributes.corners;
    py::dict all;
    all["texture"] = as_array<double>(std::move(copy.texture));
    all["texture_of_corner"] = as_array(std::move(copy.texture_of_corner));
    all["normals"] = as_array(std::move(copy.normals));
    all["normal_of_corner"] = as_array(std::move(copy.normal_of_corner));
    return all;
}

py::object stored_face(const file_data& data) {
    if (data.file().stored_face.empty()) return py::none();
    std::vector<std::uint32_t> copy = data.file().stored_face;
    return as_array(std::move(copy));
}

}  // namespace

void add_files(py::module_& module) {
    py::class_<file_data>(module, "FileData", "All that a file has besides points and faces.")
        .def(py::init<>())
        .def(py::init<const file_data&>())
        .def(pickled<file_data>())
        .def_property_readonly("format", [](const file_data& d) { return d.file().format; })
        .def_property_readonly("precision",
                               [](const file_data& d) { return word_of(d.file().stored_as); })
        .def_property_readonly("warnings", &warnings)
        .def_property_readonly("parts", &parts)
        .def_property_readonly("corners", &corners)
        .def_property_readonly("stored_face", &stored_face)
        .def_property_readonly("comments",
                               [](const file_data& d) { return d.file().attributes.comments; })
        .def_property_readonly("is_las",
                               [](const file_data& d) { return d.file().las.has_value(); })
        .def_property_readonly("elements",
                               [](const file_data& d) {
                                   std::vector<std::string> names;
                                   for (const tf::element& one : d.file().attributes.elements)
                                       names.push_back(one.name);
                                   return names;
                               })
        .def("columns", &columns)
        .def("set_column", &set_column);
    add_job(module, "read", &read, job_kind::long_work);
    add_job(module, "read_bytes", &read_bytes, job_kind::long_work);
    add_job(module, "scene", &scene);
    add_job(module, "write", &write, job_kind::writes);
}

}  // namespace binding
