#include <libmesh/io/ply_header.hpp>
#include <libmesh/io/scratch.hpp>
#include <libmesh/io/vertex_columns.hpp>
#include <libmesh/io/writers.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

namespace treeform::detail::io {

namespace {

using texture_point = std::array<double, 3>;

[[nodiscard]] bool is_same(const texture_point& a, const texture_point& b) {
    return std::bit_cast<std::array<std::uint64_t, 3>>(a) ==
           std::bit_cast<std::array<std::uint64_t, 3>>(b);
}

/// The values of the list as they are stored.
template <class T>
class stored_values {
  public:
    explicit stored_values(const column& c) : bytes_(c.values.data()), begin_(c.list_begin) {}

    [[nodiscard]] T at(std::size_t i) const {
        T value;
        std::memcpy(&value, bytes_ + i * sizeof value, sizeof value);
        return value;
    }
    /// Of the list of a face.
    [[nodiscard]] std::size_t begin(std::size_t face) const { return begin_[face]; }
    [[nodiscard]] std::size_t end(std::size_t face) const { return begin_[face + 1]; }

    /// Whether the corner whose two numbers start at `i` has none.
    [[nodiscard]] bool is_none(std::size_t i) const {
        return std::isnan(at(i)) && std::isnan(at(i + 1));
    }
    /// Whether it becomes a double and the same bytes again: of NaN, only the one that is written
    /// for corners that have none does surely.
    [[nodiscard]] bool keeps_bits(std::size_t i) const {
        const T value = at(i);
        if (!std::isnan(value)) return true;
        using bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
        return std::bit_cast<bits>(value) ==
               std::bit_cast<bits>(std::numeric_limits<T>::quiet_NaN());
    }

  private:
    const std::byte* bytes_;
    std::span<const std::uint64_t> begin_;
};

/// Whether the list of a face of `corners` corners can be taken.
template <class T>
[[nodiscard]] bool fits(const stored_values<T>& values, std::size_t face, std::size_t corners) {
    const std::size_t first = values.begin(face);
    const std::size_t last = values.end(face);
    if (first == last) return true;
    if (last - first != 2 * corners) return false;
    bool any = false;
    for (std::size_t i = first; i < last; i += 2) {
        if (!values.keeps_bits(i) || !values.keeps_bits(i + 1)) return false;
        any = any || !values.is_none(i);
    }
    return any;  // else an empty list would be written
}

template <class T>
void take(mesh_file& file, const stored_values<T>& lists) {
    corner_values& values = file.attributes.corners;
    constexpr face nothing{corner_values::none, corner_values::none, corner_values::none};
    reserve_large(values.texture_of_corner, file.mesh.faces.size());
    values.texture_of_corner.assign(file.mesh.faces.size(), nothing);
    reserve_large(values.texture, file.mesh.points.size());
    std::vector<std::uint32_t> last(file.mesh.points.size(), corner_values::none);
    const auto row_of = [&](std::uint32_t point, const texture_point& value) {
        std::uint32_t& row = last[point];  // that was given to a corner there
        if (row == corner_values::none || !is_same(values.texture[row], value)) {
            row = static_cast<std::uint32_t>(values.texture.size());
            values.texture.push_back(value);
        }
        return row;
    };
    std::size_t number = 0;
    for_each_stored_face(file, [&](std::size_t first, std::span<const std::uint32_t> corners) {
        const std::size_t begin = lists.begin(number);
        const bool empty = begin == lists.end(number++);
        std::uint32_t first_row = corner_values::none;
        std::uint32_t previous = corner_values::none;
        for (std::size_t i = 0; i < corners.size() && !empty; ++i) {
            const std::size_t at = begin + 2 * i;
            const std::uint32_t row = lists.is_none(at)
                                          ? corner_values::none
                                          : row_of(corners[i], {lists.at(at), lists.at(at + 1), 0});
            if (i == 0) first_row = row;
            if (i >= 2) values.texture_of_corner[first + i - 2] = {first_row, previous, row};
            previous = row;
        }
    });
}

/// Moves the values of the list, if all of them can be. Whether it did.
template <class T>
[[nodiscard]] bool take_if_all_fit(mesh_file& file, const column& c) {
    const stored_values<T> lists(c);
    bool fit = true;
    std::size_t face = 0;
    for_each_stored_face(file, [&](std::size_t, std::span<const std::uint32_t> corners) {
        fit = fit && fits(lists, face++, corners.size());
    });
    if (fit) take(file, lists);
    return fit;
}

[[nodiscard]] bool take_if_all_fit(mesh_file& file, const column& c) {
    if (c.role != column_role::data || !c.list_length || c.size() / 2 >= corner_values::none)
        return false;
    if (c.type == scalar_type::float32) return take_if_all_fit<float>(file, c);
    return c.type == scalar_type::float64 && take_if_all_fit<double>(file, c);
}

}  // namespace

void take_face_texture(mesh_file& file) {
    for (element& e : file.attributes.elements) {
        if (e.name != "face" || e.rows == 0) continue;
        const auto at = std::ranges::find(e.columns, face_texture_name, &column::name);
        if (at == e.columns.end() || !take_if_all_fit(file, *at)) continue;
        *at = declaration(*at);
        at->role = column_role::texture;
    }
}

}  // namespace treeform::detail::io
