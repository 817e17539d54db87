#pragma once
/// \file
/// Bodies of files, and clashes, in C.

#include <treeform/mesh/clash.hpp>
#include <treeform/mesh/placement.hpp>

#include <tools/c/made/structs.hpp>

namespace glue {

/// The bodies of `files` [count], for `treeform_clash` and all placements. `labels` [count] are the
/// names of the files in messages. Files are copied.
inline answer_of<treeform_bodies> bodies_of(const treeform_file* const* files,
                                            const char* const* labels, std::size_t count,
                                            treeform_body_kind kind) {
    constexpr std::array add{&tf::body_set::add, &tf::body_set::add_parts,
                             &tf::body_set::add_named_parts};
    const auto which = choice<std::size_t>(kind, add.size(), "kind");
    const std::vector<std::string> names = texts(labels, count, "labels");
    auto made = make<treeform_bodies>();
    auto& set = made->keep(tf::body_set{});
    for (std::size_t i = 0; i < count; ++i)
        (set.*add[which])(content(array(files, count, "files")[i], "files"), names[i], names[i]);
    auto& bodies = made->keep(std::vector<treeform_body>(set.shapes.size()));
    made->value.meshes = handles(*made, set.shapes);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const std::size_t face_count = set.shapes[i].indexed_view().faces.size();
        auto& faces = made->keep(std::vector<std::uint32_t>(face_count));
        for (std::uint32_t f = 0; f < faces.size(); ++f) faces[f] = set.face_in_file(i, f);
        bodies[i] = {made->value.meshes[i],
                     static_cast<std::uint32_t>(set.file_number(i)),
                     set.part_name(i).c_str(),
                     made->keep(set.label(i)).c_str(),
                     faces.data(),
                     faces.size()};
    }
    made->value.bodies = bodies.data();
    made->value.count = bodies.size();
    return made;
}

/// Replaces the body's points in its file by `points` [count][3], the points of a placement,
/// transforms all other points of the file by `matrix` [12], and returns the file. The meshes of
/// the bodies do not change.
inline tf::mesh_file move_in_file(treeform_bodies* bodies, std::size_t body, const double* points,
                                  std::size_t count, const double* matrix,
                                  tf::precision written_as) {
    auto& set = kept_in<tf::body_set>(need(bodies, "bodies"), "bodies");
    if (body >= set.shapes.size())
        throw std::invalid_argument("body " + std::to_string(body) + " does not exist");
    const std::size_t wanted = set.shapes[body].indexed_view().points.size();
    if (count != wanted)
        throw std::invalid_argument(std::to_string(count) + " points for a body of " +
                                    std::to_string(wanted));
    set.move_in_file(body, glue::points(points, count, "points"), finite_matrix(matrix),
                     written_as);
    return set.file_of(body).content;
}

/// All pairs of a part whose name matches the pattern `first` and one whose name matches `second`;
/// * matches any characters, ? one character. Two numbers for each pair, for
/// `treeform_clash_options::ignored`.
inline std::vector<std::uint32_t> pairs_named(std::span<const std::string> names,
                                              const std::string& first, const std::string& second) {
    std::vector<std::uint32_t> flat;
    for (const tf::part_pair& one : tf::pairs_named(names, first, second))
        flat.insert(flat.end(), one.begin(), one.end());
    return flat;
}

/// The clashes in each of many poses: `poses` [pose_count][count][12] has a matrix for each part,
/// pose after pose. Exact for the moved corners, rounded to double.
inline answer_of<treeform_poses_result> check_poses(const treeform_mesh* const* parts,
                                                    std::size_t count, const double* poses,
                                                    std::size_t pose_count,
                                                    const tf::clash_options& options) {
    if (count != 0 && pose_count > (std::size_t{1} << 36) / count)
        throw std::length_error("too many poses");
    (void)array(poses, 12 * pose_count * count, "poses");
    tf::pose_result found = tf::check_poses(
        refs(parts, count, "parts"),
        {reinterpret_cast<const tf::transform<3>*>(poses), pose_count * count}, options);
    check(found.status);
    auto made = make<treeform_poses_result>();
    auto& begin = made->keep(std::vector<std::size_t>{0});
    auto& all = made->keep(std::vector<tf::pose_clash>());
    for (const auto& one : found.poses) {
        all.insert(all.end(), one.begin(), one.end());
        begin.push_back(all.size());
    }
    made->value.pose_count = found.poses.size();
    made->value.begin = begin.data();
    made->value.clashes = same<treeform_pose_clash>(all);
    made->value.clashing = found.clashing;
    made->value.boxes_apart = found.boxes_apart;
    made->value.in_collision = made->keep(std::move(found.in_collision)).data();
    return made;
}

}  // namespace glue
