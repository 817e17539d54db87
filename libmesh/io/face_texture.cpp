#include <libmesh/io/detail/face_texture.hpp>
#include <libmesh/io/detail/vertex_columns.hpp>
#include <libmesh/io/detail/writers.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace tf::detail {

namespace {

using texture_point = std::array<double, 3>;

[[nodiscard]] bool is_same(const texture_point& a, const texture_point& b) {
    return std::bit_cast<std::array<std::uint64_t, 3>>(a) ==
           std::bit_cast<std::array<std::uint64_t, 3>>(b);
}

/// Value `i` of the list as a double, which is written as the same bytes again.
template <class T>
[[nodiscard]] bool keeps_bits(const column& c, std::size_t i) {
    using bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
    bits before;
    std::memcpy(&before, c.values.data() + i * sizeof before, sizeof before);
    const double value = number_at(c, i);
    // What is none is written as this NaN.
    const T after = std::isnan(value) ? std::numeric_limits<T>::quiet_NaN() : static_cast<T>(value);
    return std::bit_cast<bits>(after) == before;
}

[[nodiscard]] bool is_none(const column& c, std::size_t i) {
    return std::isnan(number_at(c, i)) && std::isnan(number_at(c, i + 1));
}

/// Whether the list of a face of `corners` corners can be taken.
[[nodiscard]] bool fits(const column& c, std::size_t face, std::size_t corners) {
    const std::size_t first = c.list_begin[face];
    const std::size_t last = c.list_begin[face + 1];
    if (first == last) return true;
    if (last - first != 2 * corners) return false;
    bool any = false;
    for (std::size_t i = first; i < last; ++i) {
        const bool same =
            c.type == scalar_type::float32 ? keeps_bits<float>(c, i) : keeps_bits<double>(c, i);
        if (!same) return false;
        any = any || ((i - first) % 2 == 0 && !is_none(c, i));
    }
    return any;  // else an empty list would be written
}

[[nodiscard]] bool can_be_taken(const mesh_file& file, const column& c) {
    if (c.role != column_role::data || !c.list_length || c.type < scalar_type::float32)
        return false;
    bool fit = value_count(c) / 2 < corner_values::none;
    std::size_t face = 0;
    for_each_stored_face(file, [&](std::size_t, std::span<const std::uint32_t> corners) {
        fit = fit && fits(c, face++, corners.size());
    });
    return fit;
}

/// Gives corners their rows.
class row_sharer {
  public:
    explicit row_sharer(std::size_t points, std::vector<texture_point>& rows)
        : rows_(rows), last_(points, corner_values::none) {}

    [[nodiscard]] std::uint32_t row_of(std::uint32_t point, const texture_point& value) {
        std::uint32_t& last = last_[point];
        if (last == corner_values::none || !is_same(rows_[last], value)) {
            last = static_cast<std::uint32_t>(rows_.size());
            rows_.push_back(value);
        }
        return last;
    }

  private:
    std::vector<texture_point>& rows_;
    std::vector<std::uint32_t> last_;  ///< [V] that was given to a corner there
};

void take(mesh_file& file, const column& c) {
    corner_values& values = file.attributes.corners;
    constexpr face nothing{corner_values::none, corner_values::none, corner_values::none};
    values.texture_of_corner.assign(file.mesh.faces.size(), nothing);
    row_sharer sharer(file.mesh.points.size(), values.texture);
    std::size_t number = 0;
    for_each_stored_face(file, [&](std::size_t first, std::span<const std::uint32_t> corners) {
        const std::size_t begin = c.list_begin[number];
        const bool empty = begin == c.list_begin[++number];
        std::uint32_t first_row = corner_values::none;
        std::uint32_t previous = corner_values::none;
        for (std::size_t i = 0; i < corners.size() && !empty; ++i) {
            const std::size_t at = begin + 2 * i;
            const std::uint32_t row =
                is_none(c, at)
                    ? corner_values::none
                    : sharer.row_of(corners[i], {number_at(c, at), number_at(c, at + 1), 0.0});
            if (i == 0) first_row = row;
            if (i >= 2) values.texture_of_corner[first + i - 2] = {first_row, previous, row};
            previous = row;
        }
    });
}

}  // namespace

void take_face_texture(mesh_file& file) {
    for (element& e : file.attributes.elements) {
        if (e.name != "face" || e.rows == 0) continue;
        const auto at = std::find_if(e.columns.begin(), e.columns.end(),
                                     [](const column& c) { return c.name == face_texture_name; });
        if (at == e.columns.end() || !can_be_taken(file, *at)) continue;
        column placeholder = declaration(*at);
        placeholder.role = column_role::texture;
        take(file, std::exchange(*at, std::move(placeholder)));
    }
}

}  // namespace tf::detail
