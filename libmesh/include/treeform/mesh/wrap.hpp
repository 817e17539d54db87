#pragma once
/// \file
/// A closed surface around whatever there is.
///
///     tf::mesh solid = tf::wrap(mesh, 0.5).value();

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/prepared_mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstdint>
#include <optional>

namespace treeform {

/// How to wrap.
struct wrap_options {
    /// How far the vertices of the wrap are from the mesh, in its length unit; where it is not
    /// given, a thirtieth of the size.
    std::optional<double> offset{};
    /// Precision of the coordinates returned. float32 values are stored as doubles.
    treeform::precision precision = treeform::precision::float64;
    progress_callback progress{};
};

/// What it took, for reports.
struct wrap_statistics {
    double size = 0.0;
    double offset = 0.0;
    double area = 0.0;             ///< of the mesh that was wrapped
    std::uint64_t points = 0;      ///< of the tetrahedra that were made
    std::uint64_t tetrahedra = 0;  ///< at the end
    std::uint64_t filled = 0;      ///< of them, filled so that the wrap is a manifold
};

/// The wrap, and what was checked.
struct TREEFORM_API wrap_result {
    treeform::mesh mesh;
    /// Status ok says, checked on the coordinates above: a closed manifold, outward, no two faces
    /// of which meet beyond common corners and edges.
    treeform::certificate certificate{};
    wrap_statistics statistics{};

    /// The mesh.
    ///
    /// \throws not_certified_error unless the certificate's status is ok
    [[nodiscard]] const treeform::mesh& value() const&;
    [[nodiscard]] treeform::mesh value() &&;
};

/// A solid that holds all faces of `mesh`, whatever they are: open, crossing, turned any way, of
/// no area. A ball of diameter 2 `size` is rolled over them from outside, so to speak: it enters no
/// hole or gap that is narrower. So the wrap closes these, rounds what is sharp, and fills cavities
/// that nothing leads to. A smaller size follows the mesh more closely, with more faces, some
/// area / `size`^2 of them.
///
/// No face of the mesh meets the wrap, or is outside of it: that is decided exactly, on the
/// coordinates of both. The distance of its vertices is met as far as rounding allows.
///
/// \throws std::invalid_argument naming the face with a corner out of range or not finite; where
///         the mesh has no faces, where it is larger than 2^150 or smaller than 2^-150, for a
///         size or offset that is not positive and finite, or so small that coordinates of the
///         precision do not tell apart what is as near as the offset, or the wrap would have more
///         than 2^30 faces
/// \cost   for n points O(n log n) in most cases, O(n log F) queries of the tree over the faces; some
///         400 bytes a point; serial
/// \same   on every machine
/// \source Portaneri, Rouxel-Labbe, Hemmer, Cohen-Steiner and Alliez, Alpha Wrapping with an Offset,
///         ACM TOG 41 (2022). Tetrahedra are cut out by their circumspheres only where that keeps
///         all of them oriented (`orient3d`), so that rounded circumspheres do no harm.
[[nodiscard]] TREEFORM_API wrap_result wrap(const mesh_ref& mesh, double size,
                                            const wrap_options& options = {});

}  // namespace treeform
