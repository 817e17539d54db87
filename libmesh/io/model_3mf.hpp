#pragma once
/// \file
/// The parsed model parts of a 3MF package.

#include <treeform/mesh/mesh.hpp>

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
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
inline constexpr std::array<const char*, 6> units_3mf{"micron", "millimeter", "centimeter",
                                                      "inch",   "foot",       "meter"};

/// The twelve numbers m00 m01 m02 m10 ... m32 of an attribute: a matrix of four rows of three,
/// multiplied from the left by the row vector (x y z 1).
struct transform_3mf {
    std::array<double, 12> m{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};

    friend bool operator==(const transform_3mf&, const transform_3mf&) = default;
};

/// The transform that applies `inner` first, then `outer`.
[[nodiscard]] transform_3mf compose(const transform_3mf& inner, const transform_3mf& outer);
/// The transformed point; for the identity bit for bit the same, -0 included.
[[nodiscard]] point3 moved(const transform_3mf& t, const point3& p);
/// Whether the transform turns a surface inside out.
[[nodiscard]] bool mirrors(const transform_3mf& t);

/// An object of the package: the number of its part, and its id in that part.
struct object_key {
    std::uint32_t part = 0;
    std::uint32_t id = 0;

    friend auto operator<=>(const object_key&, const object_key&) = default;
};

/// A component or an item of the build.
struct placed_3mf {
    object_key object{};
    transform_3mf transform{};
    std::string part_number{};
};

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
    std::string unit = units_3mf[1];
    /// Colors 0xRRGGBBAA; the first is for faces without a color.
    std::vector<std::uint32_t> palette{0xffffffff};
    std::vector<std::string> materials{{}};  ///< names; the first is for faces without a material
    std::vector<std::array<double, 3>> texture{};
    unread_3mf unread{};
};

}  // namespace treeform::detail::io
