#pragma once
/// \file
/// Fields of options and results, between C++ and Python: what `made/` is written with.

#include "carrying.hpp"
#include "made/words.hpp"

namespace binding {

// ---- options ----

/// \throws py::type_error, which names the argument to those who called the package
template <class T>
T cast_of(py::handle value) {
    try {
        return value.cast<T>();
    } catch (const py::cast_error&) {
        throw py::type_error("incompatible constructor arguments");
    }
}

template <class T>
requires std::is_arithmetic_v<T>
void take(const char*, py::handle value, T& to) {
    if (!value.is_none() || std::is_floating_point_v<T>)
        to = cast_of<T>(value);  // None of a count is the default
    else if (std::is_same_v<T, bool>)
        throw py::type_error("incompatible constructor arguments");
}
template <has_words Enum>
void take(const char* name, py::handle value, Enum& to) {
    to = choice<Enum>(name, words_of<Enum>::all, cast_of<std::string>(value));
}
/// What `function` of the package's `_arrays` makes of an argument; it names what it refuses.
template <class T>
T made_by(const char* function, const char* name, py::handle value) {
    return py::module_::import("treeform._arrays").attr(function)(value, name).template cast<T>();
}
inline void take(const char* name, py::handle value, std::string& to) {
    to = made_by<std::string>("word", name, value);
}
inline void take(const char* name, py::handle value, std::filesystem::path& to) {
    to = made_by<std::string>("path_of", name, value);
}
inline void take(const char* name, py::handle value, tf::point3& to) {
    to = point_of(made_by<array_of<double>>("vector", name, value));
}
inline void take(const char* name, py::handle value, tf::transform<3>& to) {
    to = transform_of(made_by<array_of<double>>("matrix", name, value));
}
inline void take(const char* name, py::handle value, std::array<double, 3>& to) {
    to = made_by<std::array<double, 3>>("vector", name, value);
}
inline void take(const char* name, py::handle value, name_pairs& to) {
    to = made_by<name_pairs>("columns_of", name, value);
}
inline void take(const char* name, py::handle value, std::array<double, 2>& to) {
    to = made_by<std::array<double, 2>>("pair", name, value);
}
inline void take(const char* name, py::handle value, std::vector<std::filesystem::path>& to) {
    to = made_by<std::vector<std::filesystem::path>>("paths", name, value);
}
inline void take(const char* name, py::handle value, std::vector<std::string>& to) {
    to = made_by<std::vector<std::string>>("words", name, value);
}
inline void take(const char* name, py::handle value, std::vector<tf::weld_condition>& to) {
    using conditions = std::vector<std::pair<std::string, double>>;
    for (const auto& [column, within] : made_by<conditions>("conditions", name, value))
        to.push_back({column, within});
}
inline void take(const char* name, py::handle value, tf::pair_kinds& to) {
    if (value.is_none()) return;
    to = {};
    for (const std::string& one : made_by<std::vector<std::string>>("words", name, value))
        to = to + choice<tf::pair_kind>(name, words_of<tf::pair_kind>::all, one);
}

template <class T>
void take(const char* name, py::handle value, std::optional<T>& to) {
    if (value.is_none()) return;
    T made{};
    take(name, value, made);
    to = std::move(made);
}

/// Options of named values; `each_field` of `made/options.cpp` says what the fields are.
template <class Options>
Options options_of(const py::kwargs& named) {
    Options how;
    for (const auto& [key, value] : named) {
        bool known = false;
        const auto name = py::cast<std::string>(key);
        each_field(how, [&, &given = value](const char* field, auto& to) {
            if (name != field) return;
            known = true;
            take(field, given, to);
        });
        if (!known) throw py::type_error(name + ": there is no such option");
    }
    return how;
}

/// The class of options, with `names` of them and `defaults` of those that are numbers or words.
template <class Options>
void add_options_of(py::module_& module, const char* type) {
    const py::object made = py::class_<Options>(module, type).def(py::init(&options_of<Options>));
    py::list names;
    py::dict defaults;
    Options how;
    each_field(how, [&](const char* name, auto& value) {
        using field = std::remove_cvref_t<decltype(value)>;
        names.append(name);
        if constexpr (std::is_arithmetic_v<field> || std::is_same_v<field, std::string>)
            defaults[name] = value;
        else if constexpr (has_words<field>)
            defaults[name] = word_of(value);
    });
    made.attr("names") = py::tuple(names);
    made.attr("defaults") = defaults;
}

}  // namespace binding

/// What Python has for a feature.
template <>
struct pybind11::detail::type_caster<treeform::mesh_feature> {
    PYBIND11_TYPE_CASTER(treeform::mesh_feature, const_name("Feature"));

    bool load(handle from, bool) {
        binding::take("kind", from.attr("kind"), value.kind);
        binding::take("origin", from.attr("origin"), value.origin);
        binding::take("direction", from.attr("direction"), value.direction);
        return true;
    }
};

namespace binding {

// ---- results ----

/// The object of a class of the package, with these fields.
inline py::object object_of(const char* module, const char* type, const py::dict& fields) {
    return py::module_::import(module).attr(type)(**fields);
}

template <class T>
requires std::is_arithmetic_v<T> py::object value_of(T number) { return py::cast(number); }
inline py::object value_of(const std::string& text) { return py::cast(text); }
inline py::object value_of(const tf::point3& p) { return as_array(p); }
inline py::object value_of(const tf::transform<3>& map) { return as_array(map); }
inline py::object value_of(const std::array<std::array<double, 3>, 3>& rows) {
    return column(rows, [](const auto& row) { return row; });
}
template <has_words Enum>
py::object value_of(Enum value) {
    return py::cast(word_of(value));
}
template <class T>
requires std::is_arithmetic_v<T> py::object value_of(std::vector<T>&& numbers) {
    return as_array<T>(std::move(numbers));
}
inline py::object value_of(std::vector<tf::point3>&& points) { return as_array(std::move(points)); }
inline py::object value_of(std::vector<tf::face>&& faces) { return as_array(std::move(faces)); }
inline py::object value_of(std::vector<tf::operand_element>&& elements) {
    return as_array<std::uint32_t>(std::move(elements));
}
template <class T, std::size_t N>
requires std::is_arithmetic_v<T> py::object value_of(const std::array<T, N>& numbers) {
    return py::tuple(py::cast(numbers));
}
/// Corners or axes, as rows.
template <std::size_t N>
py::object value_of(const std::array<tf::point3, N>& rows) {
    return column(rows, [](const tf::point3& p) { return numbers(p); });
}
inline py::object value_of(const tf::box3& box) { return value_of(std::array{box.min, box.max}); }
template <class T>
py::object value_of(std::optional<T>&& value) {
    return value ? value_of(std::move(*value)) : py::object(py::none());
}

/// Finds the functions of results, `made/results.cpp`.
struct of_result {};

/// The same with what the objects are made in: attributes of operands, the mesh that moves.
template <class T, class... Context>
py::object as_python(T&& value, const Context&... context) {
    if constexpr (requires { object(of_result{}, std::forward<T>(value), context...); })
        return object(of_result{}, std::forward<T>(value), context...);
    else
        return value_of(std::forward<T>(value));
}
template <class T, class... Context>
py::object as_python(std::vector<T>&& values, const Context&... context) {
    if constexpr (requires { object(of_result{}, std::move(values), context...); }) {
        return object(of_result{}, std::move(values), context...);
    } else if constexpr (requires { value_of(std::move(values)); }) {
        return value_of(std::move(values));
    } else {
        py::list made;
        for (T& one : values) made.append(as_python(std::move(one), context...));
        return made;
    }
}
template <class T, class... Context>
py::object as_python(std::optional<T>&& value, const Context&... context) {
    return value ? as_python(std::move(*value), context...) : py::object(py::none());
}

/// How many there are of each word.
template <class Enum, std::size_t N>
py::dict counts_of(const std::array<std::uint64_t, N>& counts) {
    py::dict made;
    for (std::size_t i = 0; i < N; ++i) made[words_of<Enum>::all[i]] = counts[i];
    return made;
}

/// A dictionary with one more.
template <class T>
py::dict with(py::dict made, const char* name, const T& value) {
    made[name] = value;
    return made;
}

/// `Mesh` of the package.
py::object mesh_object(tf::mesh&& mesh, const py::object& certificate, const py::object& data);
/// `Mesh` of a body that `matrix` has moved, with its attributes.
py::object moved_mesh(std::vector<tf::point3>&& points, const held_mesh& body,
                      const tf::transform<3>& matrix, const py::object& certificate);

/// What results get of their operands.
template <class Result>
py::object data_of(const Result& from, const carrying& attributes) {
    if constexpr (!requires { from.face_source; })
        return py::none();
    else if constexpr (requires { from.face_of_cut_vertex; })
        return attributes.to(from.mesh, std::span(from.face_source), std::span(from.vertex_source),
                             std::span(from.face_of_cut_vertex));
    else if constexpr (requires { from.cap; })
        return attributes.to(from.mesh, from.face_source, from.vertex_source, {}, {}, from.cap);
    else if constexpr (requires { from.face_of_new_vertex; })
        return attributes.to(from.mesh, from.face_source, from.vertex_source,
                             from.face_of_new_vertex, from.corner_source);
    else
        return attributes.to(from.mesh, from.face_source, from.vertex_source);
}

}  // namespace binding
