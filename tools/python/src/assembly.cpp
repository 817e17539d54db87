#include "bindings.hpp"

namespace binding {
namespace {

tf::clash_result clash_of(const held_meshes& parts, tf::clash_options options,
                          const ids_array& ignored) {
    options.ignored = rows_of<tf::part_pair>(ignored);
    const std::vector<tf::prepared_mesh> all = borrowed(parts);
    return run([&](const tf::progress_callback& report) {
        options.progress = report;
        return tf::clash(all, options);
    });
}

py::object clash(const held_meshes& parts, const tf::clash_options& options,
                 const ids_array& ignored) {
    return as_python(clash_of(parts, options, ignored));
}

// ---- poses ----

/// The maps of matrices [n][4][4].
std::vector<tf::transform<3>> transforms_of(const array_of<double>& matrices) {
    const std::size_t count = static_cast<std::size_t>(matrices.size()) / 16;
    std::vector<tf::transform<3>> all(count);
    for (std::size_t i = 0; i < count; ++i) all[i] = transform_of(matrices.data() + i * 16);
    return all;
}

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

py::object check_poses(const held_meshes& parts, const array_of<double>& matrices,
                       tf::pose_options options, const ids_array& ignored) {
    options.ignored = rows_of<tf::part_pair>(ignored);
    const std::vector<tf::prepared_mesh> all = borrowed(parts);
    const std::vector<tf::transform<3>> poses = transforms_of(matrices);
    tf::pose_result found = run([&](const tf::progress_callback& report) {
        options.progress = report;
        return tf::check_poses(all, poses, options);
    });
    return as_python(std::move(found));
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
    return as_array<double>(for_positions<double>(positions_of(move_a, move_b), [&](auto some) {
        return tf::distance(a.prepared(), b.prepared(), some, radius);
    }));
}

}  // namespace

void add_assembly(py::module_& module) {
    module.attr("RELATIONS") = py::cast(words_of<tf::mesh_relation>::all);
    add_job(module, "clash", &clash);
    add_job(module, "check_poses", &check_poses);
    add_job(module, "intersects", &intersects);
    add_job(module, "distance", &distance);
}

}  // namespace binding
