#include <libmesh/base/nearest_float.hpp>
#include <libmesh/weld/group_points.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/weld.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace treeform::detail::stream {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

class rejoiner {
  public:
    rejoiner(mesh_file& file, std::span<const std::uint32_t> polygon, bool unlike_corners)
        : file_(file),
          polygon_(polygon),
          unlike_corners_(unlike_corners),
          last_face_(file.mesh.points.size(), none) {}

    void run() {
        const auto& faces = file_.mesh.faces;
        file_.face_of_triangle.resize(faces.size());
        for (std::uint32_t f = 0; f < faces.size(); ++f) {
            if (!continues(f)) begin_face(f);
            last_face_[faces[f][2]] = face();
            file_.face_of_triangle[f] = face();
        }
        for (element& e : file_.attributes.elements)
            if (e.name == "face") e = e.gathered(first_triangle_);
        for (named_faces& part : file_.attributes.parts)
            part.first_face = part.first_face < file_.face_of_triangle.size()
                                  ? file_.face_of_triangle[part.first_face]
                                  : static_cast<std::uint32_t>(first_triangle_.size());
        file_.stored_faces = first_triangle_.size();
    }

  private:
    [[nodiscard]] std::uint32_t face() const {
        return static_cast<std::uint32_t>(first_triangle_.size() - 1);
    }

    [[nodiscard]] bool continues(std::uint32_t f) const {
        if (f == 0 || polygon_[f] != polygon_[f - 1]) return false;
        const corner_values& corners = file_.attributes.corners;
        return continues(file_.mesh.faces, f) && continues(corners.texture_of_corner, f) &&
               continues(corners.normal_of_corner, f) &&
               !(unlike_corners_ && last_face_[file_.mesh.faces[f][2]] == face());
    }

    /// Corners that became one point may still have values that differ.
    [[nodiscard]] static bool continues(const std::vector<treeform::face>& faces, std::uint32_t f) {
        return faces.empty() || (faces[f][0] == faces[f - 1][0] && faces[f][1] == faces[f - 1][2]);
    }

    void begin_face(std::uint32_t f) {
        first_triangle_.push_back(f);
        for (const std::uint32_t corner : file_.mesh.faces[f]) last_face_[corner] = face();
    }

    mesh_file& file_;
    std::span<const std::uint32_t> polygon_;
    bool unlike_corners_;
    std::vector<std::uint32_t> last_face_;  ///< [V] the last face that has the point as a corner
    std::vector<std::uint32_t> first_triangle_{};  ///< of each face
};

/// Joins consecutive triangles of one polygon that still form a fan. Triangles that do not, or that
/// would repeat a corner although `unlike_corners` is set, stay separate faces. The row of a
/// polygon is that of its first triangle. The inverse of `mesh_file::split_polygons` if nothing
/// changed in between.
///
/// \pre `polygon` is [F], ascending; "face" has a row a triangle
void rejoin_polygons(mesh_file& file, std::span<const std::uint32_t> polygon, bool unlike_corners) {
    rejoiner(file, polygon, unlike_corners).run();
}

}  // namespace
}  // namespace treeform::detail::stream

namespace treeform {
namespace {

/// Corners of a soup that are equal are one vertex before anything else is asked: only then has it
/// edges, open or not.
mesh join_corners(const mesh& soup, const point_groups& equal) {
    mesh joined;
    joined.points.reserve(equal.first_of_group.size());
    for (const std::uint32_t p : equal.first_of_group) joined.points.push_back(soup.points[p]);
    joined.faces = soup.faces;
    for (face& corners : joined.faces)
        for (std::uint32_t& corner : corners) corner = equal.group_of_point[corner];
    return joined;
}

weld_result weld_soup(const mesh_file& file, const weld_options& options) {
    const point_groups equal = detail::weld::find_groups("weld", file.mesh.points, {});
    weld_result welded = weld(join_corners(file.mesh, equal), file.attributes, options);
    point_groups& groups = welded.groups;
    if (welded.status == status::cancelled) return welded;
    std::vector<std::uint32_t> group_of_corner(file.mesh.points.size());
    for (std::size_t c = 0; c < group_of_corner.size(); ++c)
        group_of_corner[c] = groups.group_of_point[equal.group_of_point[c]];
    groups.group_of_point = std::move(group_of_corner);
    for (auto* points : {&welded.vertex_source, &groups.first_of_group})
        for (std::uint32_t& p : *points) p = equal.first_of_group[p];
    welded.statistics.groups = detail::weld::count_groups_of_several(groups);
    return welded;
}

/// What must hold of any result.
void check_counts(const mesh_file& file, const weld_result& r, const weld_options& options) {
    std::uint64_t kept = 0;
    for (std::uint32_t p = 0; p < r.groups.group_of_point.size(); ++p) {
        const std::uint32_t group = r.groups.group_of_point[p];
        if (group >= r.vertex_source.size()) throw std::logic_error("a point belongs to no group");
        kept += r.vertex_source[group] == p ? 1U : 0U;
    }
    if (r.groups.group_of_point.size() != file.mesh.points.size() || kept != r.vertex_source.size())
        throw std::logic_error("points in are not points kept and points removed");
    const std::uint64_t dropped =
        options.keep_degenerate ? 0 : r.statistics.collapsed + r.statistics.degenerate;
    if (r.mesh.faces.size() + dropped != file.mesh.faces.size() ||
        r.face_source.size() != r.mesh.faces.size())
        throw std::logic_error("faces in are not faces kept and faces dropped");
}

/// All that a file has but its points, faces, and what belongs to them.
mesh_file head_of(const mesh_file& file) {
    mesh_file head;
    head.stored_as = file.stored_as;
    head.format = file.format;
    head.las = file.las;
    head.ranges = file.ranges;
    head.warnings = file.warnings;
    return head;
}

weld_result weld_triangles(const mesh_file& file, const weld_options& options) {
    // Joining a soup's corners would make the edges that `keep_manifold` is to prevent.
    const bool soup =
        !file.indexed && !options.keep_manifold && file.attributes.find("vertex") == nullptr;
    weld_result welded =
        soup ? weld_soup(file, options) : weld(file.mesh, file.attributes, options);
    if (welded.status != status::cancelled) check_counts(file, welded, options);
    return welded;
}

}  // namespace

file_weld_result weld(const mesh_file& file, const weld_options& options) {
    const bool has_polygons = !file.face_of_triangle.empty();
    weld_result welded;
    if (has_polygons) {
        mesh_file triangles = file;
        triangles.split_polygons();
        welded = weld_triangles(triangles, options);
    } else {
        welded = weld_triangles(file, options);
    }
    file_weld_result result{head_of(file),
                            std::move(welded.groups),
                            std::move(welded.vertex_source),
                            std::move(welded.face_source),
                            welded.statistics,
                            welded.status};
    if (result.status == status::cancelled) return result;
    result.file.mesh = std::move(welded.mesh);
    result.file.attributes = std::move(welded.attributes);
    result.file.stored_faces = result.file.mesh.faces.size();
    if (!has_polygons) return result;
    std::vector<std::uint32_t> polygon;
    polygon.reserve(result.face_source.size());
    for (const std::uint32_t f : result.face_source) polygon.push_back(file.face_of_triangle[f]);
    detail::stream::rejoin_polygons(result.file, polygon, !options.keep_degenerate);
    return result;
}

void file_weld_result::withhold(mesh_file& file) const {
    const file_weld_result& welded = *this;
    const std::vector<std::uint32_t>& group_of = welded.groups.group_of_point;
    if (group_of.size() != file.mesh.points.size())
        throw std::invalid_argument(
            "treeform::withhold: the result has a different number of points");
    element& vertices = file.attributes.find_or_add("vertex", group_of.size());
    const column* const before = vertices.find("withheld");
    const bool has_flags = before != nullptr && !before->list_length;
    std::vector<std::uint8_t> flags(group_of.size());
    for (std::uint32_t p = 0; p < flags.size(); ++p) {
        const bool was = has_flags && before->number(p) != 0.0;
        flags[p] = was || welded.vertex_source[group_of[p]] != p ? 1 : 0;
    }
    vertices.set(column::of<std::uint8_t>("withheld", flags));
}

std::optional<std::uint64_t> count_mergeable(const mesh_file& welded, const weld_options& options,
                                             precision written_as) {
    if (options.only_borders || options.keep_manifold) return std::nullopt;
    std::vector<point3> rounded;
    points_view points = welded.mesh.points;
    if (written_as == precision::float32 && !fits_float32(points)) {
        rounded.assign(points.begin(), points.end());
        for (point3& p : rounded)
            for (std::size_t k = 0; k < 3; ++k) p[k] = detail::base::nearest_float(p[k]);
        points = rounded;
    } else if (options.keep == weld_keep::first) {
        return 0;  // kept points are as they were, and the rule leaves none within the tolerance
    }
    weld_options again = options;
    again.keep = weld_keep::first;
    again.keep_by.clear();
    again.same = options.conditions(welded.attributes, !welded.mesh.faces.empty());
    again.keep_seams = false;
    attributes properties;
    if (const element* vertices = welded.attributes.find("vertex"))
        if (!again.same.empty() || !again.order_by.empty())
            properties.elements.push_back(*vertices);
    const weld_result twice = weld(points, properties, again);
    if (twice.status == status::cancelled) return std::nullopt;
    return points.size() - twice.mesh.points.size();
}

}  // namespace treeform
