#pragma once
/// \file
/// Converts the fields of options and results between C++ and Python; used by `made/`.

#include "carrying.hpp"
#include "made/words.hpp"

namespace binding {

// ---- options ----

/// The function of the package's `_arrays` that checks and converts a value to each type.
using conditions = std::vector<std::pair<std::string, double>>;
inline auto converter(bool) { return "flag"; }
inline auto converter(std::integral auto) { return "whole"; }
inline auto converter(double) { return "number"; }
inline auto converter(const std::string&) { return "word"; }
inline auto converter(const std::filesystem::path&) { return "path_of"; }
inline auto converter(const std::array<double, 2>&) { return "pair"; }
inline auto converter(const std::array<double, 3>&) { return "vector"; }
inline auto converter(const array_of<double>&) { return "matrix"; }
inline auto converter(const name_pairs&) { return "columns_of"; }
inline auto converter(const conditions&) { return "conditions"; }
inline auto converter(const std::vector<std::filesystem::path>&) { return "paths"; }
inline auto converter(const std::vector<std::string>&) { return "words"; }

/// Sets an option. None for a count is its default.
template <class T>
requires requires(const T& to) { converter(to); }
void take(const char* name, py::handle value, T& to) {
    if (std::is_integral_v<T> && !std::is_same_v<T, bool> && value.is_none()) return;
    if constexpr (std::is_arithmetic_v<T>) {  // usually of the right type: no call of Python
        py::detail::make_caster<T> direct;
        if (direct.load(value, false)) {
            to = direct;
            return;
        }
    }
    const py::object package = py::module_::import("treeform._arrays");
    try {
        to = package.attr(converter(to))(value, name).template cast<T>();
    } catch (const py::cast_error&) {
        throw std::invalid_argument(std::string(name) + ": out of range");
    }
}
/// What `take` makes of a value.
template <class T>
T taken(const char* name, py::handle value);
template <has_words Enum>
void take(const char* name, py::handle value, Enum& to) {
    to = choice<Enum>(name, words_of<Enum>::all, taken<std::string>(name, value));
}
inline void take(const char* name, py::handle value, tf::point3& to) {
    const auto [x, y, z] = taken<std::array<double, 3>>(name, value);
    to = {x, y, z};
}
inline void take(const char* name, py::handle value, tf::transform<3>& to) {
    to = transform_of(taken<array_of<double>>(name, value));
}
inline void take(const char* name, py::handle value, std::vector<tf::weld_condition>& to) {
    for (const auto& [column, within] : taken<conditions>(name, value))
        to.push_back({column, within});
}
inline void take(const char* name, py::handle value, tf::pair_kinds& to) {
    if (value.is_none()) return;
    to = {};
    const py::object list = py::isinstance<py::str>(value)
                                ? py::object(py::make_tuple(value))
                                : py::reinterpret_borrow<py::object>(value);
    for (const std::string& one : taken<std::vector<std::string>>(name, list))
        to = to + choice<tf::pair_kind>(name, words_of<tf::pair_kind>::all, one);
}
template <class T>
void take(const char* name, py::handle value, std::optional<T>& to) {
    if (!value.is_none()) to = taken<T>(name, value);
}
template <class T>
T taken(const char* name, py::handle value) {
    T made{};
    take(name, value, made);
    return made;
}

/// Options from keyword arguments; `each_field` in `made/options.cpp` lists the fields.
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

/// The class for options, with their `names`, and the `defaults` of numbers, words and strings.
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

/// Takes a `Feature` of the package.
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
template <row T>
py::object value_of(std::vector<T>&& rows) {
    return as_array(std::move(rows));
}
template <class T, std::size_t N>
requires std::is_arithmetic_v<T> py::object value_of(const std::array<T, N>& numbers) {
    return py::tuple(py::cast(numbers));
}
template <std::size_t N>
py::object value_of(const std::array<tf::point3, N>& rows) {
    return column(rows, [](const tf::point3& p) { return numbers(p); });
}
inline py::object value_of(const tf::box3& box) { return value_of(std::array{box.min, box.max}); }
template <class T>
py::object value_of(std::optional<T>&& value) {
    return value ? value_of(std::move(*value)) : py::object(py::none());
}

/// Selects the overloads of `object` in `made/results.cpp`, by argument-dependent lookup.
struct of_result {};

/// A value or result in Python. `context` is what a result also needs, such as the attributes of
/// the operands.
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

/// Counts by word.
template <class Enum, std::size_t N>
py::dict counts_of(const std::array<std::uint64_t, N>& counts) {
    py::dict made;
    for (std::size_t i = 0; i < N; ++i) made[words_of<Enum>::all[i]] = counts[i];
    return made;
}

/// `made` with one more entry.
template <class T>
py::dict with(py::dict made, const char* name, const T& value) {
    made[name] = value;
    return made;
}

/// A `Mesh` of the package.
py::object mesh_object(tf::mesh&& mesh, const py::object& certificate, const py::object& data);
/// A `Mesh` of a body moved by `matrix`, with its attributes.
py::object moved_mesh(std::vector<tf::point3>&& points, const held_mesh& body,
                      const tf::transform<3>& matrix, const py::object& certificate);

/// The attributes of a result, carried over from its operands.
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
