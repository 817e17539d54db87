#pragma once
/// \file
/// Parts of results that differ from those of C++.

#include "made/made.hpp"

namespace binding {

py::object volumes_of(const tf::boolean_result& from);
py::array ends_of(const std::vector<std::array<tf::point3, 2>>& edges);
std::vector<py::tuple> regions_of(tf::part_clash& from);
/// The values of the points of a loop, from those of all points.
template <class T>
py::array part_of(const std::vector<T>& all, const tf::section_loop& loop) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(loop.first_point);
    return as_array(std::vector(begin, begin + static_cast<std::ptrdiff_t>(loop.point_count)));
}
/// The number, in its layer, of the loop that encloses `loop`.
py::object parent_of(const tf::section_result& whole, const tf::section_loop& loop);
struct robot_data {
    robot_data(const tf::urdf_robot& robot, const std::vector<tf::urdf_mesh>& parts);

    tf::urdf_robot content{};
    std::vector<std::uint32_t> links{};  ///< the link of each part
};
std::vector<py::object> meshes_of(std::vector<tf::urdf_mesh>&& parts);
py::array faces_in_file(const tf::usable_mesh& part);
/// The attributes of a welded mesh; None if the input has none.
py::object with_attributes(const file_data* data, tf::attributes&& attributes);

/// The rays of two arrays.
class rays {
  public:
    rays(const points_array& origins, const points_array& directions, double t_min, double t_max)
        : from_(points_of(origins)), along_(points_of(directions)), t_min_(t_min), t_max_(t_max) {
        if (from_.size() != along_.size() && from_.size() != 1 && along_.size() != 1)
            throw std::invalid_argument("directions: " + std::to_string(along_.size()) + " for " +
                                        std::to_string(from_.size()) + " origins");
    }
    [[nodiscard]] std::size_t size() const {
        return from_.size() == 1 ? along_.size() : from_.size();
    }

    [[nodiscard]] std::vector<tf::ray3> piece(std::size_t begin, std::size_t end) const {
        std::vector<tf::ray3> some;
        for (std::size_t i = begin; i < end; ++i)
            some.push_back({numbers(from_[from_.size() == 1 ? 0 : i]),
                            numbers(along_[along_.size() == 1 ? 0 : i]), t_min_, t_max_});
        return some;
    }

  private:
    tf::points_view from_, along_;
    double t_min_, t_max_;
};

/// `t` of a hit of ray `i` of a piece.
///
/// \throws std::invalid_argument if it is infinite, since the direction is too short
inline double finite(double t, std::size_t i) {
    if (std::isfinite(t)) return t;
    throw std::invalid_argument("directions: that of ray " + std::to_string(i) +
                                " is too short: where it hits a face, t is no number of float64");
}
inline std::vector<std::optional<tf::mesh_hit>> finite(
    std::vector<std::optional<tf::mesh_hit>> hits) {
    for (std::size_t i = 0; i < hits.size(); ++i)
        if (hits[i]) (void)finite(hits[i]->t, i);
    return hits;
}

/// The locations of points, and their winding numbers.
py::object object(of_result, std::vector<tf::point_location>&& from);

/// \throws std::invalid_argument for a point cloud
inline void require_faces(const held_mesh& mesh, const std::string& name) {
    const auto [points, faces] = mesh.view();
    if (!points.empty() && faces.empty())
        throw std::invalid_argument(name + ": " + std::to_string(points.size()) +
                                    " points without faces are not a solid");
}

void require_faces(const held_meshes& meshes, const std::vector<std::string>& names);
/// The expression for `count` operands: an operation by name, or a formula with letters or `names`.
tf::boolean_expression expression_of(const std::string& operation, const std::string& formula,
                                     const std::vector<std::string>& names, std::size_t count);

std::vector<tf::face_pair> pairs_of(const ids_array& pairs, const array_of<std::uint8_t>& kinds);
/// Points, and paths of point numbers.
py::object object(of_result, tf::curve_network&& from);

/// The pieces, with the certificate and whether self-intersections were resolved.
py::object object(of_result, tf::cut_result&& from, const carrying& attributes);
py::list packed_parts(std::vector<tf::packed_part>&& from, const held_meshes& parts);
/// The two counts.
py::object object(of_result, tf::rounding_effects&& from);

/// An array of `of(pose, clash)` for all clashes, pose after pose.
template <class Of>
auto column_of_poses(const tf::pose_result& from, const Of& of) {
    std::vector<decltype(of(0U, tf::pose_clash{}))> values;
    for (std::uint32_t pose = 0; pose < from.poses.size(); ++pose)
        for (const tf::pose_clash& one : from.poses[pose]) values.push_back(of(pose, one));
    return column(values, [](const auto& value) { return value; });
}

std::vector<std::string> warnings_of(const tf::weld_stream_result& from);

}  // namespace binding
