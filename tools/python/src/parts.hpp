#pragma once
/// \file
/// Parts of results that look other than in C++.

#include "made/made.hpp"

namespace binding {

py::object volumes_of(const tf::boolean_result& from);
py::array ends_of(const std::vector<std::array<tf::point3, 2>>& edges);
py::list regions_of(tf::part_clash& from);
/// Of values of points, those of a loop.
template <class T>
py::array part_of(const std::vector<T>& all, const tf::section_loop& loop) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(loop.first_point);
    return as_array(std::vector(begin, begin + static_cast<std::ptrdiff_t>(loop.point_count)));
}
/// The loop around one, by its number in the layer.
py::object parent_of(const tf::section_result& whole, const tf::section_loop& loop);
struct robot_data {
    robot_data(const tf::urdf_robot& robot, const std::vector<tf::urdf_mesh>& parts);

    tf::urdf_robot content{};
    std::vector<std::uint32_t> links{};  ///< of parts
};
py::list meshes_of(std::vector<tf::urdf_mesh>&& parts);
/// What is said in warnings.
py::list texts_of(const std::vector<tf::io_warning>& warnings);
py::array faces_in_file(const tf::usable_mesh& part);
/// What a welded mesh has, of what it had; None without.
py::object with_attributes(const file_data* data, tf::attributes&& attributes);

/// The rays of two arrays.
class rays {
  public:
    rays(const points_array& origins, const points_array& directions, double t_min, double t_max)
        : from_(points_of(origins)), along_(points_of(directions)), t_min_(t_min), t_max_(t_max) {
        if (from_.size() != along_.size())
            throw std::invalid_argument("directions: " + std::to_string(along_.size()) + " for " +
                                        std::to_string(from_.size()) + " origins");
    }
    [[nodiscard]] std::size_t size() const { return from_.size(); }

    [[nodiscard]] std::vector<tf::ray3> piece(std::size_t begin, std::size_t end) const {
        std::vector<tf::ray3> some;
        for (std::size_t i = begin; i < end; ++i)
            some.push_back({numbers(from_[i]), numbers(along_[i]), t_min_, t_max_});
        return some;
    }

  private:
    tf::points_view from_, along_;
    double t_min_, t_max_;
};

/// `t` of a hit of ray `i` of a piece. It may be infinite by the length of the direction alone.
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

/// Where points are, and the winding numbers.
py::object object(of_result, std::vector<tf::point_location>&& from);

/// A cloud is no solid, not even the empty one.
inline void require_faces(const held_mesh& mesh, const std::string& name) {
    const auto [points, faces] = mesh.view();
    if (!points.empty() && faces.empty())
        throw std::invalid_argument(name + ": " + std::to_string(points.size()) +
                                    " points without a face are no solid");
}

void require_faces(const held_meshes& meshes, const std::vector<std::string>& names);
/// What is made of so many operands: by name, or by a formula in letters or names.
tf::boolean_expression expression_of(const std::string& operation, const std::string& formula,
                                     const std::vector<std::string>& names, std::size_t count);

std::vector<tf::face_pair> pairs_of(const ids_array& pairs, const array_of<std::uint8_t>& kinds);
/// The regions, and that of each pair.
/// Points, and paths by their numbers.
py::object object(of_result, tf::curve_network&& from);

/// The pieces, the certificate of all, and whether the mesh was resolved.
py::object object(of_result, tf::cut_result&& from, const carrying& attributes);
/// Each with its part.
py::list packed_parts(std::vector<tf::packed_part>&& from, const held_meshes& parts);
/// The counts, as a pair.
py::object object(of_result, tf::rounding_effects&& from);

/// `of(pose, clash)` of all clashes, pose after pose.
template <class Of>
auto column_of_poses(const tf::pose_result& from, const Of& of) {
    std::vector<decltype(of(0U, tf::pose_clash{}))> values;
    for (std::uint32_t pose = 0; pose < from.poses.size(); ++pose)
        for (const tf::pose_clash& one : from.poses[pose]) values.push_back(of(pose, one));
    return column(values, [](const auto& value) { return value; });
}

py::list warnings_of(const tf::weld_stream_result& from);

}  // namespace binding
