#pragma once
/// \file
/// What travels with a mesh beside its points and faces: columns of values for vertices, faces and
/// further elements, values of corners, names of parts, files of materials and textures, comments.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace treeform {

/// Texture coordinates and normals that corners name by their numbers, as in an OBJ: a point may
/// have others in each of its triangles (a seam, a sharp edge), and corners that share one share it
/// in a file that is written, too.
struct corner_values {
    /// In place of a number: the corner has none.
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    std::vector<std::array<double, 3>> texture{};  ///< u, v, w
    bool has_w = false;                            ///< else every w is 0 and stands in no file
    std::vector<point3> normals{};
    std::vector<face> texture_of_corner{};  ///< [F] numbers in `texture`; empty: no corner has any
    std::vector<face> normal_of_corner{};   ///< [F] numbers in `normals`; empty: no corner has any

    friend bool operator==(const corner_values&, const corner_values&) = default;
};

/// The corners of the triangles `triangles`, in that order; `texture` and `normals` stay whole.
///
/// \pre each one is less than the number of triangles that `c` is for
[[nodiscard]] TREEFORM_API corner_values gather(const corner_values& c,
                                                std::span<const std::uint32_t> triangles);

/// Puts those of `more` behind those of `triangles` triangles that `to` is for.
///
/// \pre both together have fewer rows of a kind than `corner_values::none`
TREEFORM_API void append(corner_values& to, std::size_t triangles, const corner_values& more,
                         std::size_t more_triangles);

/// What is wrong with `c` as values of `triangles` triangles, in words; empty when nothing is.
[[nodiscard]] TREEFORM_API std::string fault_of(const corner_values& c, std::size_t triangles);

enum class scalar_type : std::uint8_t {
    int8,
    uint8,
    int16,
    uint16,
    int32,
    uint32,
    int64,
    uint64,
    float32,
    float64
};

/// Bytes that one value takes.
[[nodiscard]] constexpr std::size_t size_of(scalar_type type) {
    constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
    return sizes[static_cast<std::size_t>(type)];
}

template <class T>
[[nodiscard]] constexpr scalar_type scalar_type_of() {
    if constexpr (std::is_same_v<T, std::int8_t>)
        return scalar_type::int8;
    else if constexpr (std::is_same_v<T, std::uint8_t>)
        return scalar_type::uint8;
    else if constexpr (std::is_same_v<T, std::int16_t>)
        return scalar_type::int16;
    else if constexpr (std::is_same_v<T, std::uint16_t>)
        return scalar_type::uint16;
    else if constexpr (std::is_same_v<T, std::int32_t>)
        return scalar_type::int32;
    else if constexpr (std::is_same_v<T, std::uint32_t>)
        return scalar_type::uint32;
    else if constexpr (std::is_same_v<T, std::int64_t>)
        return scalar_type::int64;
    else if constexpr (std::is_same_v<T, std::uint64_t>)
        return scalar_type::uint64;
    else if constexpr (std::is_same_v<T, float>)
        return scalar_type::float32;
    else {
        static_assert(std::is_same_v<T, double>, "not a type that a column can hold");
        return scalar_type::float64;
    }
}

/// `f(T{})` for the C++ type T that `type` stands for.
template <class F>
decltype(auto) with_type(scalar_type type, F&& f) {
    switch (type) {
        case scalar_type::int8:
            return f(std::int8_t{});
        case scalar_type::uint8:
            return f(std::uint8_t{});
        case scalar_type::int16:
            return f(std::int16_t{});
        case scalar_type::uint16:
            return f(std::uint16_t{});
        case scalar_type::int32:
            return f(std::int32_t{});
        case scalar_type::uint32:
            return f(std::uint32_t{});
        case scalar_type::int64:
            return f(std::int64_t{});
        case scalar_type::uint64:
            return f(std::uint64_t{});
        case scalar_type::float32:
            return f(float{});
        case scalar_type::float64:
            break;
    }
    return f(double{});
}

/// What a column stands for. All but `data` hold no values of their own: they keep the type and
/// the place among their neighbors of what lives in `mesh::points`, `mesh::faces` and, for
/// `texture`, in `attributes::corners`.
enum class column_role : std::uint8_t { data, x, y, z, corners, texture };

/// One named property: a value, or a list of values, for each row of its element.
struct column {
    std::string name{};
    scalar_type type = scalar_type::float64;
    /// Type of the length written ahead of each list; none when a row has exactly one value.
    std::optional<scalar_type> list_length{};
    column_role role = column_role::data;
    std::vector<std::byte> values{};          ///< in the machine's byte order, row after row
    std::vector<std::uint64_t> list_begin{};  ///< [rows + 1] first value of each list; else empty

    friend bool operator==(const column&, const column&) = default;
};

/// Number of values a column holds, over all its rows.
[[nodiscard]] inline std::size_t value_count(const column& c) {
    return c.values.size() / size_of(c.type);
}

/// Value number `i` as a double: exact, except for whole numbers beyond 2^53, which are rounded.
[[nodiscard]] TREEFORM_API double number_at(const column& c, std::size_t i);

/// A column with one value a row.
template <class T>
[[nodiscard]] column make_column(std::string name, std::span<const T> values) {
    column c;
    c.name = std::move(name);
    c.type = scalar_type_of<T>();
    c.values.resize(values.size_bytes());
    if (!values.empty()) std::memcpy(c.values.data(), values.data(), values.size_bytes());
    return c;
}

/// A kind of thing that a file counts, with its properties in the order of the file.
struct element {
    std::string name{};  ///< "vertex", "face", "edge", ...
    std::size_t rows = 0;
    std::vector<column> columns{};

    friend bool operator==(const element&, const element&) = default;
};

/// The rows `rows` of `e`, in that order; a row may be asked for several times.
///
/// \pre every row is less than `e.rows`
[[nodiscard]] TREEFORM_API element gather(const element& e, std::span<const std::uint32_t> rows);

/// The column of that name; null when there is none.
[[nodiscard]] TREEFORM_API const column* find_column(const element& e, std::string_view name);

/// Puts `c` in the place of the column of its name, at the end when there is none. Returns whether
/// there was one.
///
/// \pre `c` has a value for each row of `e`
TREEFORM_API bool set_column(element& e, column c);

/// A run of faces that a file puts under one name; it ends where the next one starts.
struct part {
    std::string object{};          ///< OBJ `o`, the name of an STL solid or of a scene's node
    std::string group{};           ///< OBJ `g`
    std::string material{};        ///< OBJ `usemtl`
    std::uint32_t first_face = 0;  ///< number in the file

    friend bool operator==(const part&, const part&) = default;
};

struct attributes {
    /// In the order of the file. "vertex" has a row a point, "face" a row a face as stored.
    std::vector<element> elements{};
    /// By triangles of the mesh, also where faces as stored are polygons: those of one polygon, a
    /// fan, have the same at the corners that they have in common.
    corner_values corners{};
    std::vector<part> parts{};  ///< by ascending first face; empty when nothing is named
    std::vector<std::string> material_files{};  ///< OBJ `mtllib`, as in the file
    /// Of PLY, the lines `comment TextureFile NAME`: what the faces' property "texnumber" counts,
    /// from 0 on; without it, texture coordinates are those of the first.
    std::vector<std::string> texture_files{};
    std::vector<std::string> comments{};  ///< of PLY, one line each, except for those
    std::vector<std::string> obj_info{};  ///< of PLY, one line each
    std::string header{};                 ///< the 80 bytes ahead of a binary STL

    friend bool operator==(const attributes&, const attributes&) = default;
};

/// The element of that name; null when there is none.
[[nodiscard]] TREEFORM_API const element* find_element(const attributes& a, std::string_view name);

/// The element of that name, added with `rows` rows at the end when there is none.
[[nodiscard]] TREEFORM_API element& obtain_element(attributes& a, std::string_view name,
                                                   std::size_t rows);

}  // namespace treeform
