#pragma once
/// \file
/// NumPy arrays as the spans that treeform takes, and vectors as NumPy arrays. Nothing is copied.

#include "base.hpp"

namespace binding {

/// What the Python side hands over: it has made the array contiguous, aligned and of this type.
template <class T>
using array_of = py::array_t<T, py::array::c_style>;
using points_array = array_of<double>;        ///< [V][3]
using faces_array = array_of<std::uint32_t>;  ///< [F][3]
using ids_array = array_of<std::uint32_t>;    ///< [N]

/// Anything that NumPy makes an array of.
using array_like = py::object;

/// The rows of `array`, each a Row of equal numbers T.
template <class Row, class T>
std::span<const Row> rows_of(const array_of<T>& array) {
    constexpr auto width = static_cast<py::ssize_t>(sizeof(Row) / sizeof(T));
    const bool fits = width == 1 ? array.ndim() == 1 : array.ndim() == 2 && array.shape(1) == width;
    if (!fits || reinterpret_cast<std::uintptr_t>(array.data()) % alignof(T) != 0)
        throw std::invalid_argument("treeform: an array of another shape, or not aligned");
    return {reinterpret_cast<const Row*>(array.data()), static_cast<std::size_t>(array.shape(0))};
}

inline tf::points_view points_of(const points_array& array) { return rows_of<tf::point3>(array); }

/// (n, 4): points, and a number for each.
inline std::vector<std::pair<tf::point3, double>> points_and_numbers(
    const array_of<double>& array) {
    std::vector<std::pair<tf::point3, double>> all;
    for (const auto& [x, y, z, number] : rows_of<std::array<double, 4>>(array))
        all.push_back({{x, y, z}, number});
    return all;
}

inline std::array<double, 3> numbers(const tf::point3& p) { return {p.x, p.y, p.z}; }

/// The memory of `values` as an array of numbers T, a row for each; it lives as long as the array.
template <class T, class Row>
py::array_t<T> as_array(std::vector<Row>&& values) {
    static_assert(sizeof(Row) % sizeof(T) == 0);
    constexpr auto width = static_cast<py::ssize_t>(sizeof(Row) / sizeof(T));
    auto owned = std::make_unique<std::vector<Row>>(std::move(values));
    std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(owned->size())};
    if (width != 1) shape.push_back(width);
    const T* const data = reinterpret_cast<const T*>(owned->data());
    const py::capsule owner(owned.get(),
                            [](void* rows) { delete static_cast<std::vector<Row>*>(rows); });
    owned.release();
    return py::array_t<T>(std::move(shape), data, owner);
}

inline py::array_t<double> as_array(std::vector<tf::point3>&& points) {
    return as_array<double>(std::move(points));
}
inline py::array_t<std::uint32_t> as_array(std::vector<tf::face>&& faces) {
    return as_array<std::uint32_t>(std::move(faces));
}
inline py::array_t<std::uint32_t> as_array(std::vector<std::uint32_t>&& ids) {
    return as_array<std::uint32_t>(std::move(ids));
}

/// Where an element has no other.
constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// A value as it stands in an array, a number or equal numbers.
template <class T>
auto cell(const T& value) {
    if constexpr (std::is_same_v<T, tf::point3>)
        return numbers(value);
    else if constexpr (std::is_enum_v<T> || std::is_same_v<T, bool>)
        return static_cast<std::uint8_t>(value);
    else
        return value;
}
inline std::uint32_t cell(const std::optional<std::uint32_t>& id) { return id.value_or(none); }

/// What stands where there is none: for a distance, a point, a number.
inline double no_cell(double) { return std::numeric_limits<double>::infinity(); }
inline std::uint32_t no_cell(std::uint32_t) { return none; }
inline std::array<double, 3> no_cell(std::array<double, 3> of) {
    of.fill(std::numeric_limits<double>::quiet_NaN());
    return of;
}

/// `of` a row, which may be a field of it; of a row that is not there, what stands for it.
template <class Row, class Of>
auto cell_of(const Row& row, const Of& of) {
    if constexpr (std::is_member_pointer_v<Of> && requires { row.has_value(); })
        return row ? cell(std::invoke(of, *row)) : no_cell(decltype(cell(std::invoke(of, *row))){});
    else
        return cell(std::invoke(of, row));
}

/// An array of `of` each row: a function, or a field.
template <class Rows, class Of>
auto column(const Rows& rows, const Of& of) {
    using value = decltype(cell_of(*std::begin(rows), of));
    std::vector<value> values;
    values.reserve(std::size(rows));
    for (const auto& row : rows) values.push_back(cell_of(row, of));
    if constexpr (std::is_arithmetic_v<value>)
        return as_array<value>(std::move(values));
    else
        return as_array<std::remove_cvref_t<decltype(value{}[0])>>(std::move(values));
}

/// How many entries a table has.
///
/// \throws std::bad_alloc where that is more than can be
inline std::size_t entries(std::size_t rows, std::size_t width) {
    constexpr std::size_t most = std::numeric_limits<std::ptrdiff_t>::max() / sizeof(double);
    if (rows != 0 && width > most / rows) throw std::bad_alloc();
    return rows * width;
}

/// Three numbers as an array.
inline py::array_t<double> as_array(const tf::point3& p) {
    py::array_t<double> made(3);
    for (py::ssize_t k = 0; k < 3; ++k) made.mutable_at(k) = p[static_cast<std::size_t>(k)];
    return made;
}

}  // namespace binding
