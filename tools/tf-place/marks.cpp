#include "tools/tf-place/marks.hpp"

#include "tools/common/class_colors.hpp"
#include <libmesh/base/face_tree.hpp>
#include <libmesh/geometry/triangle_distance.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh_intersections.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/search_pair.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace tools {
namespace {

constexpr std::uint8_t penetrating = 1, touching = 2, closer = 3;

/// The gravest class stays.
void mark(std::uint8_t& present, std::uint8_t one) {
    if (present == 0 || one < present) present = one;
}

/// MOVING at its place.
struct placed_body {
    const body& moving;
    tf::mesh_view mesh;
    const tf::tree<3>& faces;
    tf::box3 box;
};

void mark_meeting(const placed_body& placed, body& part, face_classes& a, face_classes& b) {
    const tf::still_part still = part.still();
    const auto found = tf::mesh_intersections(placed.mesh, placed.faces, still.mesh, *still.faces);
    for (const tf::face_pair& pair : found.pairs) {
        const std::uint8_t one = pair.kind == tf::pair_kind::crossing ? penetrating : touching;
        mark(a[placed.moving.triangle(pair.a)], one);
        mark(b[part.triangle(pair.b)], one);
    }
}

tf::triangle3 triangle_of(tf::mesh_view mesh, std::uint32_t f) {
    const tf::face& corners = mesh.faces[f];
    return {mesh.points[corners[0]], mesh.points[corners[1]], mesh.points[corners[2]]};
}

void mark_closer(const placed_body& placed, body& part, double clearance, face_classes& a,
                 face_classes& b) {
    const auto wide = tf::build(placed.mesh.faces, [&](const tf::face& f) {
        tf::aabb<double, 3> box;
        for (const std::uint32_t corner : f) box.include(placed.mesh.points[corner]);
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
                tf::closest_points(triangle_of(placed.mesh, i), triangle_of(still.mesh, j));
            if (std::sqrt(near.squared_distance) < clearance) mine.emplace_back(i, j);
            return false;
        });
    for (const pairs& chunk : chunks)
        for (const auto& [i, j] : chunk) {
            mark(a[placed.moving.triangle(i)], closer);
            mark(b[part.triangle(j)], closer);
        }
}

/// A clearance that was given is kept: what stopped at it is not closer, and shown all the same.
void mark_contacts(const placed_body& placed, const surroundings& among, const placement& p,
                   all_classes& classes) {
    const std::uint8_t one = p.clearance > 0.0 ? closer : touching;
    for (const contact_row& c : p.contacts) {
        mark(classes.moving[placed.moving.triangle(c.moving)], one);
        if (!c.fixed) continue;
        const body& part = among.all()[c.part];
        mark(classes.fixed[part.file_number][part.triangle(*c.fixed)], one);
    }
    if (!p.on_bed || !p.bed) return;
    for (std::uint32_t f = 0; f < placed.mesh.faces.size(); ++f)
        for (const std::uint32_t corner : placed.mesh.faces[f])
            if (placed.mesh.points[corner].z <= p.bed->used)
                mark(classes.moving[placed.moving.triangle(f)], one);
}

std::size_t rows_of(const body& b) {
    return b.cloud ? b.file->mesh.points.size() : b.file->mesh.faces.size();
}

bool has_colors(const tf::mesh_file& file) {
    return std::any_of(file.attributes.elements.begin(), file.attributes.elements.end(),
                       [](const tf::element& e) { return tf::find_column(e, "red") != nullptr; });
}

}  // namespace

all_classes classify_faces(body& moving, const surroundings& among, const placement& p) {
    const tf::mesh_view there{p.points, moving.mesh.faces};
    std::optional<tf::tree<3>> own;
    if (p.points != moving.mesh.points) own = tf::face_tree(there);
    const placed_body placed{moving, there, own ? *own : moving.faces(),
                             *tf::bounding_box(there.points)};
    all_classes classes;
    classes.moving.resize(rows_of(moving));
    for (body& part : among.all()) {
        if (part.file_number == classes.fixed.size()) classes.fixed.emplace_back(rows_of(part));
        face_classes& mine = classes.fixed.back();
        bool apart = false;
        for (std::size_t k = 0; k < 3; ++k)
            apart |= part.box->min[k] - placed.box.max[k] > p.clearance ||
                     placed.box.min[k] - part.box->max[k] > p.clearance;
        if (apart) continue;
        if (p.clearance > 0.0) mark_closer(placed, part, p.clearance, classes.moving, mine);
        mark_meeting(placed, part, classes.moving, mine);
    }
    mark_contacts(placed, among, p, classes);
    return classes;
}

face_classes by_stored_face(const tf::mesh_file& file, const face_classes& classes) {
    if (file.stored_face.empty()) return classes;
    face_classes stored(file.stored_faces);
    for (std::size_t t = 0; t < classes.size(); ++t)
        if (classes[t] != 0) mark(stored[file.stored_face[t]], classes[t]);
    return stored;
}

void set_classes(tf::mesh_file& file, const char* element, const face_classes& classes,
                 bool keep_colors) {
    const bool colored = has_colors(file);
    tf::element& rows = tf::obtain_element(file.attributes, element, classes.size());
    if (!colored || !keep_colors) set_colors(rows, classes, class_colors);
    const std::vector<std::int32_t> numbers(classes.begin(), classes.end());
    tf::set_column(rows, tf::make_column<std::int32_t>("tf_class", numbers));
}

}  // namespace tools
