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
        all[i] = {.move_a = a[a.size() == 1 ? 0 : i], .move_b = b[b.size() == 1 ? 0 : i]};
    return all;
}

/// `of(positions)` for pieces of the positions, its answers one after the other.
template <class Answer, class Of>
std::vector<Answer> for_positions(const std::vector<tf::mesh_positions>& positions, const Of& of) {
    std::vector<Answer> all(positions.size());
    run_pieces(positions.size(), [&](std::size_t begin, std::size_t end) {
        const auto answers = of(std::span(positions).subspan(begin, end - begin));
        for (std::size_t i = begin; i < end; ++i) all[i] = answers[i - begin];
    });
    return all;
}

py::array intersects(const held_mesh& a, const held_mesh& b, const array_of<double>& move_a,
                     const array_of<double>& move_b) {
    const auto positions = positions_of(move_a, move_b);
    if (positions.size() != 1)
        return as_array<std::uint8_t>(for_positions<std::uint8_t>(positions, [&](auto some) {
            return tf::intersects(a.prepared(), b.prepared(), some);
        }));
    const bool meet = run([&](const tf::progress_callback&) {
        return with_both(
            a, b, [&](const auto& m, const auto& n) { return tf::intersects(m, n, positions[0]); });
    });
    return as_array<std::uint8_t>(std::vector<std::uint8_t>{meet});
}

py::array distance(const held_mesh& a, const held_mesh& b, const array_of<double>& move_a,
                   const array_of<double>& move_b, double radius) {
    auto positions = positions_of(move_a, move_b);
    for (tf::mesh_positions& one : positions) one.radius = radius;
    return as_array<double>(for_positions<double>(
        positions, [&](auto some) { return tf::distance(a.prepared(), b.prepared(), some); }));
}

}  // namespace

void add_assembly(py::module_& module) {
    module.attr("RELATIONS") = py::cast(words_of<tf::mesh_relation>::all);
    add_job(module, "intersects", &intersects);
    add_job(module, "distance", &distance);
}

}  // namespace binding
