#include <treeform/mesh/clash.hpp>

#include <tools/c/glue.hpp>

#include <algorithm>

namespace tf = treeform;

namespace {

std::span<const tf::part_pair> pairs_of(const std::uint32_t* pairs, std::size_t count) {
    static_assert(sizeof(tf::part_pair) == 2 * sizeof(std::uint32_t));
    (void)glue::array(pairs, count, "ignored");
    return {reinterpret_cast<const tf::part_pair*>(pairs), count};
}

treeform_part_clash clash_of(glue::answer<treeform_clashes>& made, const tf::part_clash& from) {
    std::vector<treeform_contact_region> regions;
    for (const tf::contact_region& one : from.regions)
        regions.push_back({glue::copied(one.box), one.face_pairs, one.faces_a.data(),
                           one.faces_a.size(), one.faces_b.data(), one.faces_b.size()});
    treeform_part_clash c{};
    c.a = from.a;
    c.b = from.b;
    c.how = static_cast<treeform_standing>(from.how);
    c.a_inside_b = from.a_inside_b;
    c.b_inside_a = from.b_inside_a;
    c.distance = from.distance;
    const tf::point3 nowhere{glue::not_known, glue::not_known, glue::not_known};
    glue::copy(from.nearest ? (*from.nearest)[0] : nowhere, c.on_a);
    glue::copy(from.nearest ? (*from.nearest)[1] : nowhere, c.on_b);
    c.face_pairs = from.face_pairs;
    c.region_count = regions.size();
    c.regions = made.keep(std::move(regions)).data();
    c.volume = from.volume.value_or(glue::not_known);
    c.depth = from.depth.value_or(glue::not_known);
    glue::copy(from.move, c.move);
    c.depth_effort = glue::copied(from.depth_effort);
    return c;
}

}  // namespace

void treeform_clash_options_init(treeform_clash_options* options, size_t size) {
    const tf::clash_options from;
    treeform_clash_options defaults{};
    defaults.volumes = from.volumes;
    defaults.depths = from.depths;
    defaults.limit = from.limit;
    glue::init(options, size, defaults);
}

treeform_code treeform_clash(const treeform_mesh* const* parts, size_t count,
                             const treeform_clash_options* options, treeform_clashes** clashes) {
    return glue::guard([&] {
        glue::start(clashes);
        const auto o = glue::chosen(options, treeform_clash_options_init);
        tf::clash_options how;
        how.clearance = o.clearance;
        how.volumes = o.volumes != 0;
        how.depths = o.depths != 0;
        how.effort = o.effort;
        how.limit = glue::limit(o.limit);
        how.ignored = pairs_of(o.ignored, o.ignored_count);
        how.vertices = glue::vertices(o.vertices);
        how.progress = glue::progress(o);
        const tf::mesh_refs row = glue::refs(parts, count, "parts");
        auto made = glue::make<treeform_clashes>();
        const tf::clash_result& found = made->keep(tf::clash(row, how));
        if (found.status == tf::status::cancelled) throw glue::cancelled{};
        std::vector<treeform_part_clash> pairs;
        for (const tf::part_clash& one : found.pairs) pairs.push_back(clash_of(*made, one));
        treeform_clashes& c = made->value;
        c.count = pairs.size();
        c.pairs = made->keep(std::move(pairs)).data();
        std::copy(found.counts.begin(), found.counts.end(), c.counts);
        c.boxes_apart = found.boxes_apart;
        c.ignored = found.ignored;
        c.parts_indexed = found.parts_indexed;
        c.clashes = found.clashes;
        glue::give(std::move(made), clashes);
    });
}

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

void treeform_poses_options_init(treeform_poses_options* options, size_t size) {
    glue::init(options, size, treeform_poses_options{});
}

treeform_code treeform_check_poses(const treeform_mesh* const* parts, size_t count,
                                   const double* poses, size_t pose_count,
                                   const treeform_poses_options* options,
                                   treeform_poses_result** result) {
    return glue::guard([&] {
        glue::start(result);
        const auto o = glue::chosen(options, treeform_poses_options_init);
        tf::pose_options how;
        how.clearance = o.clearance;
        how.first_only = o.first_only != 0;
        how.ignored = pairs_of(o.ignored, o.ignored_count);
        how.vertices = glue::vertices(o.vertices);
        how.progress = glue::progress(o);
        static_assert(sizeof(tf::transform<3>) == 12 * sizeof(double));
        if (count != 0 && pose_count > (std::size_t{1} << 36) / count)
            throw std::length_error("too many poses");
        (void)glue::array(poses, 12 * pose_count * count, "poses");
        const std::span where(reinterpret_cast<const tf::transform<3>*>(poses), pose_count * count);
        const tf::mesh_refs row = glue::refs(parts, count, "parts");
        const tf::pose_result found = tf::check_poses(row, where, how);
        if (found.status == tf::status::cancelled) throw glue::cancelled{};
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
