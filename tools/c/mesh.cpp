#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/weld.hpp>

#include <tools/c/made/structs.hpp>

#include <limits>

namespace tf = treeform;

namespace {

constexpr std::uint32_t all_flags = TREEFORM_COPY | TREEFORM_ONE_USE;

/// Every function may rely on the numbers of corners: they are checked once, here.
void check_corners(std::span<const tf::face> faces, std::size_t point_count) {
    for (std::size_t f = 0; f < faces.size(); ++f)
        for (const std::uint32_t corner : faces[f])
            if (corner >= point_count)
                throw std::invalid_argument("face " + std::to_string(f) + " has the corner " +
                                            std::to_string(corner) + " of " +
                                            std::to_string(point_count) + " points");
}

void check_counts(std::size_t points, std::size_t faces, std::uint32_t flags) {
    constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max();
    if (points >= most || faces >= most)
        throw std::length_error(std::to_string(points) + " points and " + std::to_string(faces) +
                                " faces are more than 32 bits can number");
    if ((flags & ~all_flags) != 0)
        throw std::invalid_argument("flags " + std::to_string(flags) + " are not known");
}

std::vector<tf::point3> widened(const float* points, std::size_t count) {
    std::vector<tf::point3> result(count);
    const std::span all = glue::array(points, 3 * count, "points");
    for (std::size_t i = 0; i < count; ++i)
        result[i] = {static_cast<double>(all[3 * i]), static_cast<double>(all[3 * i + 1]),
                     static_cast<double>(all[3 * i + 2])};
    return result;
}

/// The handle for points and faces, which are in its arrays where it owns them.
void give_mesh(tf::mesh own, tf::points_view points, std::span<const tf::face> faces, bool cloud,
               std::uint32_t flags, treeform_mesh** out) {
    auto made = glue::make<treeform_mesh>();
    treeform_mesh& m = made->value;
    m.arrays = std::move(own);
    if ((flags & TREEFORM_COPY) != 0 && m.arrays.points.empty())
        m.arrays.points.assign(points.begin(), points.end());
    if ((flags & TREEFORM_COPY) != 0) m.arrays.faces.assign(faces.begin(), faces.end());
    if (!m.arrays.points.empty()) points = m.arrays.points;
    if (!m.arrays.faces.empty()) faces = m.arrays.faces;
    m.mine = cloud ? tf::prepared_mesh::borrow_cloud(points)
                   : tf::prepared_mesh::borrow(tf::mesh_view{points, faces});
    m.prepared = &m.mine;
    m.one_use = (flags & TREEFORM_ONE_USE) != 0 && !cloud;
    glue::give(std::move(made), out);
}

}  // namespace

treeform_code treeform_mesh_create(const double* points, size_t point_count, const uint32_t* faces,
                                   size_t face_count, uint32_t flags, treeform_mesh** mesh) {
    return glue::guard([&] {
        glue::start(mesh);
        check_counts(point_count, face_count, flags);
        const std::span corners = glue::faces(faces, face_count, "faces");
        check_corners(corners, point_count);
        give_mesh({}, glue::points(points, point_count, "points"), corners, false, flags, mesh);
    });
}

treeform_code treeform_mesh_create_float(const float* points, size_t point_count,
                                         const uint32_t* faces, size_t face_count, uint32_t flags,
                                         treeform_mesh** mesh) {
    return glue::guard([&] {
        glue::start(mesh);
        check_counts(point_count, face_count, flags);
        const std::span corners = glue::faces(faces, face_count, "faces");
        check_corners(corners, point_count);
        give_mesh({widened(points, point_count), {}}, {}, corners, false, flags, mesh);
    });
}

treeform_code treeform_cloud_create(const double* points, size_t point_count, uint32_t flags,
                                    treeform_mesh** cloud) {
    return glue::guard([&] {
        glue::start(cloud);
        check_counts(point_count, 0, flags);
        give_mesh({}, glue::points(points, point_count, "points"), {}, true, flags, cloud);
    });
}

treeform_code treeform_cloud_create_float(const float* points, size_t point_count, uint32_t flags,
                                          treeform_mesh** cloud) {
    return glue::guard([&] {
        glue::start(cloud);
        check_counts(point_count, 0, flags);
        give_mesh({widened(points, point_count), {}}, {}, {}, true, flags, cloud);
    });
}

treeform_code treeform_mesh_arrays(const treeform_mesh* mesh, treeform_arrays* arrays) {
    return glue::guard([&] {
        const tf::mesh_view view = glue::view(mesh);
        glue::need(arrays, "arrays") =
            glue::arrays(mesh->prepared->is_cloud() ? tf::mesh_view{view.points, {}} : view);
    });
}

treeform_code treeform_mesh_set_create(const treeform_mesh* const* meshes, size_t count,
                                       treeform_mesh_set** set) {
    return glue::guard([&] {
        glue::start(set);
        auto made = glue::make<treeform_mesh_set>();
        std::vector<tf::prepared_mesh> prepared;
        for (const treeform_mesh* one : glue::array(meshes, count, "meshes"))
            prepared.push_back(glue::borrow(glue::need(one, "meshes")));
        const auto& row = made->keep(std::move(prepared));
        auto& handles = made->keep(std::vector<treeform_mesh>(count));
        std::vector<const treeform_mesh*> pointers(count);
        for (std::size_t i = 0; i < count; ++i) {
            handles[i].prepared = &row[i];
            handles[i].set = row.data();
            pointers[i] = &handles[i];
        }
        made->value.meshes = made->keep(std::move(pointers)).data();
        made->value.count = count;
        glue::give(std::move(made), set);
    });
}

treeform_code treeform_join_equal_points(const treeform_mesh* mesh, treeform_made_mesh** made) {
    return glue::guard([&] {
        glue::start(made);
        const tf::mesh_view view = glue::view(mesh);
        tf::equal_points found = tf::find_equal_points(view.points);
        const tf::point_groups groups{std::move(found.new_of_old), std::move(found.first_of_new)};
        return glue::give(glue::made_mesh{groups.joined(view), groups.group_of_point}, made);
    });
}

treeform_code treeform_join_meshes(const treeform_mesh* const* meshes, size_t count,
                                   treeform_made_mesh** made) {
    return glue::guard([&] {
        glue::start(made);
        const std::vector<tf::mesh_view> views = glue::views(meshes, count, "meshes");
        for (const tf::mesh_view& view : views)
            if (const auto bad = tf::find_defects(view).nonfinite_faces; !bad.empty())
                throw std::invalid_argument("face " + std::to_string(bad[0]) +
                                            " has a corner that is not finite");
        tf::joined_meshes joined = tf::join_meshes(views);
        return glue::give(glue::made_mesh{std::move(joined.mesh), std::move(joined.mesh_of_face)},
                          made);
    });
}

treeform_code treeform_round(const treeform_mesh* mesh, treeform_precision precision,
                             treeform_made_mesh** made) {
    return glue::guard([&] {
        glue::start(made);
        const tf::mesh_view view = glue::view(mesh);
        return glue::give(tf::mesh{tf::rounded(view.points, glue::precision(precision)),
                                   {view.faces.begin(), view.faces.end()}},
                          made);
    });
}

treeform_code treeform_rounding_effects(const treeform_mesh* mesh, const double* matrix,
                                        const double* placed,
                                        const treeform_rounding_options* options,
                                        treeform_rounding** effects) {
    return glue::guard([&] {
        glue::start(effects);
        const auto o = glue::chosen(options, treeform_rounding_options_init);
        const tf::mesh_view view = glue::view(mesh);
        const tf::points_view after = glue::points(placed, view.points.size(), "placed");
        const tf::rounding_options how = glue::read(o);
        tf::rounding_effects found = glue::asked(mesh, [&](const auto& m) {
            return tf::effects_of_rounding(m, glue::matrix(matrix), after, how);
        });
        if (found.status == tf::status::ok && o.always_compare != 0 && !found.compared) {
            const tf::rounding_defects defects =
                tf::find_rounding_defects(view, after, how.progress);
            glue::check(defects.status);
            found.compared = true;
            found.collapsed = defects.collapsed;
            found.meeting = defects.meeting;
        }
        return glue::give(std::move(found), effects);
    });
}
