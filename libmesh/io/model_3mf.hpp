#pragma once
/// \file
/// The parsed model parts of a 3MF package.

#include <libmesh/io/source.hpp>
#include <libmesh/io/zip_archive.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/aabb.hpp>

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace treeform::detail::io {

/// Namespaces of the core and of the extensions that are read.
inline constexpr const char* core_3mf = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
inline constexpr const char* materials_3mf =
    "http://schemas.microsoft.com/3dmanufacturing/material/2015/02";
inline constexpr const char* production_3mf =
    "http://schemas.microsoft.com/3dmanufacturing/production/2015/06";
inline constexpr const char* triangle_sets_3mf =
    "http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07";

/// The relationship type of a model part.
inline constexpr const char* model_relationship_3mf =
    "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";

/// The units of models; the second is the default.
inline constexpr std::array<std::string_view, 6> units_3mf{"micron", "millimeter", "centimeter",
                                                           "inch",   "foot",       "meter"};

/// An object of the package: the number of its part, and its id in that part.
struct object_key {
    std::uint32_t part = 0;
    std::uint32_t id = 0;

    friend auto operator<=>(const object_key&, const object_key&) = default;
};

/// A component or an item of the build.
struct placed_3mf {
    object_key object{};
    treeform::transform<3> transform{};
    std::string part_number{};
};

/// Of corners without texture coordinates.
inline constexpr face no_texture{corner_values::none, corner_values::none, corner_values::none};

/// A mesh or components.
struct object_3mf {
    std::string name{};     ///< the name, else the part number
    bool is_other = false;  ///< of type "other", which is not read
    bool is_support = false;
    std::vector<point3> points{};
    std::vector<face> faces{};
    std::vector<face> colors{};  ///< [F] palette entries of the corners; empty: none
    /// [F] numbers in `model_3mf::texture` of the corners; empty: none
    std::vector<face> texture{};
    std::vector<std::uint32_t> materials{};  ///< [F] numbers in `model_3mf::materials`; empty: none
    std::vector<placed_3mf> components{};
};

/// Counts of content that was not read.
struct unread_3mf {
    std::size_t not_built = 0;      ///< objects outside of the build
    std::size_t other = 0;          ///< items and components with objects of type "other"
    std::size_t support = 0;        ///< the same for supports, which are read
    std::size_t not_printable = 0;  ///< items marked as not printable, which are read
    std::size_t property_uses = 0;  ///< triangles with mixed materials
    std::size_t extensions = 0;     ///< unknown elements in meshes
    bool images = false;
};

struct model_3mf {
    std::vector<std::string> parts{};  ///< names in the archive; the first is the root
    std::map<object_key, object_3mf> objects{};
    std::vector<placed_3mf> items{};
    std::string unit{units_3mf[1]};
    /// Colors 0xRRGGBBAA; the first is for faces without a color.
    std::vector<std::uint32_t> palette{0xffffffff};
    std::vector<std::string> materials{{}};  ///< names; the first is for faces without a material
    std::vector<std::array<double, 3>> texture{};
    unread_3mf unread{};
};

/// The build of the package, and the objects that it needs; other objects are not parsed. `root` is
/// the name of the root model part. Other parts are read if items or components of the root refer
/// to them (production extension).
///
/// All references are valid, but objects may still be components of themselves.
///
/// \throws io_error
[[nodiscard]] model_3mf parse_3mf(const source& in, zip_archive& archive, std::string_view root);

}  // namespace treeform::detail::io
