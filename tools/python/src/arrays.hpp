#pragma once
/// \file
/// NumPy arrays as spans, and vectors as NumPy arrays, without copies.

#include "base.hpp"

namespace binding {

/// An array from the package, which has made it contiguous, aligned and of this type.
template <class T>
using array_of = py::array_t<T, py::array::c_style>;
using points_array = array_of<double>;        ///< [V][3]
using faces_array = array_of<std::uint32_t>;  ///< [F][3]
using ids_array = array_of<std::uint32_t>;    ///< [N]
/// Anything that NumPy can convert to an array.
using array_like = py::object;

/// `of(value)` for each value, where `of` is a function or a member.
template <class Values, class Of>
auto list_of(Values&& values, const Of& of) {
    std::vector<std::decay_t<decltype(std::invoke(of, *std::begin(values)))>> all;
    all.reserve(std::size(values));
    for (auto&& one : values) all.push_back(std::invoke(of, one));
    return all;
}

/// The rows of `array`, each a Row of equal numbers T.
template <class Row, class T>
std::span<const Row> rows_of(const array_of<T>& array) {
    constexpr auto width = static_cast<py::ssize_t>(sizeof(Row) / sizeof(T));
    const bool fits = width == 1 ? array.ndim() == 1 : array.ndim() == 2 && array.shape(1) == width;
    if (!fits || reinterpret_cast<std::uintptr_t>(array.data()) % alignof(T) != 0)
        throw std::invalid_argument("treeform: the array has a wrong shape, or is not aligned");
    return {reinterpret_cast<const Row*>(array.data()), static_cast<std::size_t>(array.shape(0))};
}

inline tf::points_view points_of(const points_array& array) { return rows_of<tf::point3>(array); }

/// The rows of an array (n, 4), as a point and a number each.
inline std::vector<std::pair<tf::point3, double>> points_and_numbers(
    const array_of<double>& array) {
    return list_of(rows_of<std::array<double, 4>>(array), [](const auto& row) {
        return std::pair(tf::point3{row[0], row[1], row[2]}, row[3]);
    });
}

inline tf::offset_options with_drains(tf::offset_options options,
                                      std::vector<std::pair<tf::point3, double>> drains) {
    options.drains = std::move(drains);
    return options;
}

inline std::array<double, 3> numbers(const tf::point3& p) { return {p.x, p.y, p.z}; }

/// A row of an array: a number, or equal numbers.
template <class T>
concept row = std::is_trivially_copyable_v<T> &&
    (std::is_arithmetic_v<T> || std::is_same_v<T, tf::operand_element> ||
     requires(T value) { requires std::is_arithmetic_v<std::remove_cvref_t<decltype(value[0])>>; });

/// The type of the numbers in a row.
template <row Row>
auto number_of() {
    if constexpr (std::is_arithmetic_v<Row>)
        return Row{};
    else if constexpr (std::is_same_v<Row, tf::operand_element>)
        return std::uint32_t{};
    else
        return std::remove_cvref_t<decltype(Row{}[0])>{};
}

/// An array that owns the memory of `values`, with a row for each of them.
template <row Row>
auto as_array(std::vector<Row>&& values) {
    using number = decltype(number_of<Row>());
    constexpr auto width = static_cast<py::ssize_t>(sizeof(Row) / sizeof(number));
    auto owned = std::make_unique<std::vector<Row>>(std::move(values));
    std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(owned->size())};
    if (width != 1) shape.push_back(width);
    const auto* const data = reinterpret_cast<const number*>(owned->data());
    const py::capsule owner(owned.get(),
                            [](void* rows) { delete static_cast<std::vector<Row>*>(rows); });
    owned.release();
    return py::array_t<number>(std::move(shape), data, owner);
}

/// The number that stands for no element.
constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// A value as it is stored in an array: a number, or an array of numbers.
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

/// What is stored if there is no value: no distance, no element, no point.
inline double no_cell(double) { return std::numeric_limits<double>::infinity(); }
inline std::uint32_t no_cell(std::uint32_t) { return none; }
inline std::array<double, 3> no_cell(std::array<double, 3> of) {
    of.fill(std::numeric_limits<double>::quiet_NaN());
    return of;
}

/// The cell for `of(row)`, where `of` may be a member of an optional row.
template <class Row, class Of>
auto cell_of(const Row& row, const Of& of) {
    if constexpr (std::is_member_pointer_v<Of> && requires { row.has_value(); })
        return row ? cell(std::invoke(of, *row)) : no_cell(decltype(cell(std::invoke(of, *row))){});
    else
        return cell(std::invoke(of, row));
}

/// An array of `of(row)` for each row, where `of` is a function or a member.
template <class Rows, class Of>
auto column(const Rows& rows, const Of& of) {
    return as_array(list_of(rows, [&](const auto& row) { return cell_of(row, of); }));
}

/// The number of entries of a table.
///
/// \throws std::bad_alloc if it is larger than any array
inline std::size_t entries(std::size_t rows, std::size_t width) {
    constexpr std::size_t most = std::numeric_limits<std::ptrdiff_t>::max() / sizeof(double);
    if (rows != 0 && width > most / rows) throw std::bad_alloc();
    return rows * width;
}

/// Three numbers as an array.
inline py::array_t<double> as_array(const tf::point3& p) {
    return as_array(std::vector{p.x, p.y, p.z});
}

}  // namespace binding
