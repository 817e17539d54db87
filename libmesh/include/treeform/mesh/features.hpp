#pragma once
/// \file
/// Flat and cylindrical regions of a mesh, and how to bring two meshes together by them.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/mesh/prepared_mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace treeform {

enum class feature_kind : std::uint8_t { plane, axis };

/// A plane or an axis, fitted to faces by least squares.
struct mesh_feature {
    feature_kind kind = feature_kind::plane;
    point3 origin{};         ///< center of the faces, on the plane or the axis
    point3 direction{};      ///< of length 1: the normal, outward; along the axis, either way
    double radius = 0.0;     ///< of the cylinder
    bool hollow = false;     ///< of a cylinder: the faces look at the axis, as those of a hole
    double area = 0.0;       ///< of the faces
    double deviation = 0.0;  ///< largest distance of a corner from the plane or cylinder
    std::vector<std::uint32_t> faces{};  ///< ascending
};

struct feature_options {
    /// Largest distance of a corner from the plane or cylinder. Default: 1e-4 of the diagonal.
    std::optional<double> tolerance{};
    double plane_angle = 1.0;   ///< in degrees: what faces of a plane may lean
    double facet_angle = 46.0;  ///< in degrees: the most between faces of a cylinder side by side
    double arc = 60.0;          ///< in degrees: the least part of a circle that makes an axis
};

/// The flat or cylindrical regions of `mesh`, largest area first. A region grows over edges, from
/// the largest face, or pair of faces with an angle between them, that is not yet in one. Points
/// with equal coordinates have to be one (`join_equal_points`). A cone is none.
///
/// \throws std::invalid_argument naming a point that is not finite or a face with a corner out of
///         range, and for options that are negative or NaN
/// \cost   O(F log F), times the regions that a face is tried for
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::vector<mesh_feature> find_features(
    mesh_view mesh, feature_kind kind, const feature_options& options = {});

/// The region around one face: it need not be among the largest. None where that is not flat or
/// cylindrical.
///
/// \throws std::invalid_argument as `find_features`, and for a face out of range
[[nodiscard]] TREEFORM_API std::optional<mesh_feature> feature_at(
    mesh_view mesh, feature_kind kind, std::uint32_t face, const feature_options& options = {});
/// That around the face nearest to a point.
[[nodiscard]] TREEFORM_API std::optional<mesh_feature> feature_at(
    mesh_view mesh, feature_kind kind, const point3& near, const feature_options& options = {});

/// The plane, or axis, of exactly these faces, whatever their deviation. None where they have no
/// area, or for an axis, where they are flat.
///
/// \throws std::invalid_argument as `find_features`, and for a face out of range
[[nodiscard]] TREEFORM_API std::optional<mesh_feature> fit_feature(
    mesh_view mesh, feature_kind kind, std::span<const std::uint32_t> faces);

struct feature_mate_options {
    double clearance = 0.0;  ///< the gap to leave, a distance; 0: until contact
    /// Planes look the same way rather than at each other; axes are turned around.
    bool flip = false;
    treeform::precision precision = treeform::precision::float64;  ///< of the points returned
    std::size_t limit = 1000;                                      ///< contacts listed
    vertex_identity vertices = vertex_identity::by_coordinates;    ///< as in `relation`
    progress_callback progress{};
};

/// Two meshes brought together.
struct feature_mating {
    /// `travel` is 0; `matrix` is a turn and a translation.
    placement at{};
    double turn_angle = 0.0;  ///< in degrees, of the turn that makes the directions agree
    /// How far the center of the moving feature ended from that of the fixed one, along the
    /// direction of the fixed one. Of planes: their distance.
    double offset = 0.0;

    explicit operator bool() const { return static_cast<bool>(at); }
};

/// Turns `moving` by the least angle that makes the two features' directions opposite (planes) or
/// parallel (axes), puts center above center, and slides it from outside along the direction of the
/// fixed feature until first contact with any of `fixed`, or the clearance, exactly as `slide`
/// does. Planes come from the side that the fixed one looks to; axes from the side where `moving`
/// is.
///
/// A shaft may go through its bore and meet nothing: then its center stays at that of the bore, if
/// that penetrates nothing and keeps the clearance. The place is looked at exactly, in the
/// coordinates returned.
///
/// \throws std::invalid_argument for features of two kinds, or with a direction that is not of
///         length 1 or an origin that is not finite, and as `slide`
/// \cost   that of `slide`, and two trees over `moving`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API feature_mating mate_features(const prepared_mesh& moving,
                                                        std::span<const prepared_mesh> fixed,
                                                        const mesh_feature& of_moving,
                                                        const mesh_feature& of_fixed,
                                                        const feature_mate_options& options = {});
[[nodiscard]] TREEFORM_API feature_mating mate_features(mesh_view moving, mesh_view fixed,
                                                        const mesh_feature& of_moving,
                                                        const mesh_feature& of_fixed,
                                                        const feature_mate_options& options = {});

}  // namespace treeform
