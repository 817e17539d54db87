#include <treeform/mesh/clash.hpp>

#include <tools/c/made/structs.hpp>

#include <algorithm>

namespace tf = treeform;

treeform_code treeform_pairs_named(const char* const* names, size_t count, const char* first,
                                   const char* second, treeform_indices** pairs) {
    return glue::guard([&] {
        glue::start(pairs);
        auto made = glue::make<treeform_indices>();
        const auto& found =
            made->keep(tf::pairs_named(glue::texts(names, count, "names"),
                                       &glue::need(first, "first"), &glue::need(second, "second")));
        made->value.values = found.empty() ? nullptr : found.data()->data();
        made->value.count = 2 * found.size();
        glue::give(std::move(made), pairs);
    });
}

treeform_code treeform_check_poses(const treeform_mesh* const* parts, size_t count,
                                   const double* poses, size_t pose_count,
                                   const treeform_poses_options* options,
                                   treeform_poses_result** result) {
    return glue::guard([&] {
        glue::start(result);
        const tf::pose_options how = glue::read(options);
        static_assert(sizeof(tf::transform<3>) == 12 * sizeof(double));
        if (count != 0 && pose_count > (std::size_t{1} << 36) / count)
            throw std::length_error("too many poses");
        (void)glue::array(poses, 12 * pose_count * count, "poses");
        const std::span where(reinterpret_cast<const tf::transform<3>*>(poses), pose_count * count);
        const tf::mesh_refs row = glue::refs(parts, count, "parts");
        const tf::pose_result found = tf::check_poses(row, where, how);
        glue::check(found.status);
        auto made = glue::make<treeform_poses_result>();
        std::vector<std::size_t> begin{0};
        std::vector<tf::pose_clash> all;
        for (const auto& one : found.poses) {
            all.insert(all.end(), one.begin(), one.end());
            begin.push_back(all.size());
        }
        treeform_poses_result& r = made->value;
        r.pose_count = found.poses.size();
        r.begin = made->keep(std::move(begin)).data();
        r.clashes = glue::same<treeform_pose_clash>(made->keep(std::move(all)));
        r.clashing = found.clashing;
        r.boxes_apart = found.boxes_apart;
        glue::give(std::move(made), result);
    });
}
