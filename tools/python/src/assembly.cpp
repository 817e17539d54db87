#include "bindings.hpp"

namespace binding {
namespace {

/// [P] where both meshes are: one of the two may be for all.
std::vector<tf::mesh_positions> positions_of(const array_of<double>& move_a,
                                             const array_of<double>& move_b) {
    const auto a = transforms_of(move_a), b = transforms_of(move_b);
    if (a.size() != b.size() && a.size() != 1 && b.size() != 1)
        throw std::invalid_argument("treeform: " + std::to_string(a.size()) + " positions of a, " +
                                    std::to_string(b.size()) + " of b");
    std::vector<tf::mesh_positions> all(a.size() == 1 ? b.size() : a.size());
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = {a[a.size() == 1 ? 0 : i], b[b.size() == 1 ? 0 : i]};
    return all;
}

/// The positions of a piece.
std::span<const tf::mesh_positions> some_of(const std::vector<tf::mesh_positions>& all,
                                            std::size_t begin, std::size_t end) {
    return std::span(all).subspan(begin, end - begin);
}

py::array intersects(const held_mesh& a, const held_mesh& b, const array_of<double>& move_a,
                     const array_of<double>& move_b) {
    const auto positions = positions_of(move_a, move_b);
    if (positions.size() != 1)
        return column(in_pieces(positions.size(),
                                [&](std::size_t begin, std::size_t end) {
                                    return tf::intersects(a.prepared(), b.prepared(),
                                                          some_of(positions, begin, end));
                                }),
                      [](bool one) { return one; });
    const bool meet = run([&](const tf::progress_callback&) {
        return with_both(
            a, b, [&](const auto& m, const auto& n) { return tf::intersects(m, n, positions[0]); });
    });
    return as_array<std::uint8_t>(std::vector<std::uint8_t>{meet});
}

py::array distance(const held_mesh& a, const held_mesh& b, const array_of<double>& move_a,
                   const array_of<double>& move_b, double radius) {
    const auto all = positions_of(move_a, move_b);
    return as_array<double>(in_pieces(all.size(), [&](std::size_t begin, std::size_t end) {
        return tf::distance(a.prepared(), b.prepared(), some_of(all, begin, end), radius);
    }));
}

}  // namespace

void add_assembly(py::module_& module) {
    module.attr("RELATIONS") = py::cast(words_of<tf::mesh_relation>::all);
    add_job(module, "intersects", &intersects);
    add_job(module, "distance", &distance);
}

}  // namespace binding
