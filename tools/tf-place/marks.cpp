#include "tools/tf-place/marks.hpp"

#include "tools/common/class_colors.hpp"
#include <libmesh/attributes.hpp>
#include <libmesh/geometry/triangle_distance.hpp>
#include <libmesh/intersect/mesh_intersections.hpp>
#include <libtree/build.hpp>
#include <libtree/search_pair.hpp>

#include <cmath>
#include <limits>
#include <utility>

namespace tools {
namespace {

constexpr std::uint8_t penetrating = 1, touching = 2, closer = 3;

/// The gravest class stays.
void mark(std::uint8_t& present, std::uint8_t one) {
    if (present == 0 || one < present) present = one;
}

void mark_meeting(body& moving, body& part, face_classes& a, face_classes& b) {
    const tf::still_part still = part.still();
    const auto found =
        tf::mesh_intersections(moving.mesh, moving.faces(), still.mesh, *still.faces);
    for (const tf::face_pair& pair : found.pairs) {
        const std::uint8_t one = pair.kind == tf::pair_kind::crossing ? penetrating : touching;
        mark(a[moving.triangle(pair.a)], one);
        mark(b[part.triangle(pair.b)], one);
    }
}

tf::triangle3 triangle_of(tf::mesh_view mesh, std::uint32_t f) {
    const tf::face& corners = mesh.faces[f];
    return {mesh.points[corners[0]], mesh.points[corners[1]], mesh.points[corners[2]]};
}

void mark_closer(body& moving, body& part, double clearance, face_classes& a, face_classes& b) {
    const auto wide = tf::build(moving.mesh.faces, [&](const tf::face& f) {
        tf::aabb<double, 3> box;
        for (const std::uint32_t corner : f) box.include(moving.mesh.points[corner]);
        constexpr double infinity = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < 3; ++k) {
            box.min[k] = std::nextafter(box.min[k] - clearance, -infinity);
            box.max[k] = std::nextafter(box.max[k] + clearance, infinity);
        }
        return box;
    });
    using pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
    const tf::still_part still = part.still();
    const auto chunks =
        tf::search<pairs>(wide, *still.faces, [&](pairs& mine, std::uint32_t i, std::uint32_t j) {
            const auto near =
                tf::closest_points(triangle_of(moving.mesh, i), triangle_of(still.mesh, j));
            if (std::sqrt(near.squared_distance) < clearance) mine.emplace_back(i, j);
            return false;
        });
    for (const pairs& chunk : chunks)
        for (const auto& [i, j] : chunk) {
            mark(a[moving.triangle(i)], closer);
            mark(b[part.triangle(j)], closer);
        }
}

}  // namespace

all_classes classify_faces(body& moving, const surroundings& among, double clearance) {
    all_classes classes;
    classes.moving.resize(moving.file->mesh.faces.size());
    for (body& part : among.all()) {
        if (part.file_number == classes.fixed.size())
            classes.fixed.emplace_back(part.file->mesh.faces.size());
        face_classes& mine = classes.fixed.back();
        bool apart = false;
        for (std::size_t k = 0; k < 3; ++k)
            apart |= part.box->min[k] - moving.box->max[k] > clearance ||
                     moving.box->min[k] - part.box->max[k] > clearance;
        if (apart) continue;
        if (clearance > 0.0) mark_closer(moving, part, clearance, classes.moving, mine);
        mark_meeting(moving, part, classes.moving, mine);
    }
    return classes;
}

void set_class_colors(tf::mesh_file& file, const face_classes& classes) {
    tf::element& faces = tf::obtain_element(file.attributes, "face", file.mesh.faces.size());
    set_colors(faces, classes, class_colors);
    const std::vector<std::int32_t> numbers(classes.begin(), classes.end());
    tf::set_column(faces, tf::make_column<std::int32_t>("tf_class", numbers));
}

}  // namespace tools
