#include "tools/common/turned_normals.hpp"

#include <treeform/mesh/attributes.hpp>
#include <treeform/tf.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>

namespace tools {
namespace {

/// The cofactors of the linear part, which is how normals go.
tf::transform<3> of_normals(const tf::transform<3>& m) {
    tf::transform<3> result;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const auto& r = m.rows[(i + 1) % 3];
            const auto& s = m.rows[(i + 2) % 3];
            result.rows[i][j] = r[(j + 1) % 3] * s[(j + 2) % 3] - r[(j + 2) % 3] * s[(j + 1) % 3];
        }
    return result;
}

bool only_shifts(const tf::transform<3>& m) {
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            if (m.rows[i][j] != (i == j ? 1.0 : 0.0)) return false;
    return true;
}

bool holds_numbers(const tf::column& c) {
    return !c.list_length && c.role == tf::column_role::data &&
           (c.type == tf::scalar_type::float32 || c.type == tf::scalar_type::float64);
}

void set_number(tf::column& c, std::size_t row, double value) {
    const auto put = [&](auto one) {
        std::memcpy(c.values.data() + row * sizeof(one), &one, sizeof(one));
    };
    if (c.type == tf::scalar_type::float32)
        put(static_cast<float>(value));
    else
        put(value);
}

/// As long as before; as it was where the matrix leaves nothing of it.
tf::point3 turned(const tf::transform<3>& turn, const tf::point3& n) {
    const tf::point3 there = turn(n);
    const double before = std::hypot(n.x, n.y, n.z);
    const double after = std::hypot(there.x, there.y, there.z);
    if (!(after > 0.0)) return n;
    return {there.x / after * before, there.y / after * before, there.z / after * before};
}

void turn_columns(tf::element& e, const tf::transform<3>& turn) {
    std::array<tf::column*, 3> axes{};
    constexpr std::array<const char*, 3> names{"nx", "ny", "nz"};
    for (tf::column& c : e.columns)
        for (std::size_t k = 0; k < 3; ++k)
            if (c.name == names[k] && holds_numbers(c)) axes[k] = &c;
    if (!axes[0] || !axes[1] || !axes[2]) return;
    for (std::size_t row = 0; row < e.rows; ++row) {
        tf::point3 n;
        for (std::size_t k = 0; k < 3; ++k) n[k] = tf::number_at(*axes[k], row);
        n = turned(turn, n);
        for (std::size_t k = 0; k < 3; ++k) set_number(*axes[k], row, n[k]);
    }
}

}  // namespace

void turn_normals(tf::mesh_file& file, const tf::transform<3>& matrix) {
    if (only_shifts(matrix)) return;  // else last digits would change
    const tf::transform<3> turn = of_normals(matrix);
    for (tf::element& e : file.attributes.elements) turn_columns(e, turn);
    for (tf::point3& n : file.attributes.corners.normals) n = turned(turn, n);
}

}  // namespace tools
