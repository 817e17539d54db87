#pragma once
/// \file
/// Attributes: all data of a mesh besides points and faces. Columns of values for vertices, faces
/// and other elements; values of corners; names of parts; files of materials and textures;
/// comments.

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

/// Texture coordinates and normals that corners refer to by number, as in an OBJ. So a point may
/// have different ones in each of its triangles (a seam, a sharp edge). Corners that share a value
/// also share it in a written file.
struct corner_values {
    /// Instead of a number: the corner has no value.
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    std::vector<std::array<double, 3>> texture{};  ///< u, v, w
    bool has_w = false;                            ///< otherwise every w is 0 and is not written
    std::vector<point3> normals{};
    std::vector<face> texture_of_corner{};  ///< [F] numbers in `texture`; empty: no corner has any
    std::vector<face> normal_of_corner{};   ///< [F] numbers in `normals`; empty: no corner has any

    /// The values of the corners of some triangles, in the order of `triangles`. `texture` and
    /// `normals` stay complete.
    ///
    /// \pre each of `triangles` is less than the number of triangles of these values
    [[nodiscard]] TREEFORM_API corner_values
    gathered(std::span<const std::uint32_t> triangles) const;

    /// Appends `more`. This object has the values of `triangles` triangles, `more` those of
    /// `more_triangles`.
    ///
    /// \pre the total numbers of texture coordinates and of normals are less than `none`
    TREEFORM_API void append(std::size_t triangles, const corner_values& more,
                             std::size_t more_triangles);

    /// Why these are not valid values of `triangles` triangles; empty if they are valid.
    [[nodiscard]] TREEFORM_API std::string fault(std::size_t triangles) const;

    friend bool operator==(const corner_values&, const corner_values&) = default;
};

/// The type of the values of a column.
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

/// Size of one value in bytes.
[[nodiscard]] constexpr std::size_t size_of(scalar_type type) {
    constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
    return sizes[static_cast<std::size_t>(type)];
}

/// The scalar type of the C++ type T.
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

/// What a column contains. Only `data` columns have values. The others record the type and the
/// position of the columns in which a file stores `mesh::points` (x, y, z), `mesh::faces` (corners)
/// and `attributes::corners` (texture).
enum class column_role : std::uint8_t { data, x, y, z, corners, texture };

/// One named property: a value, or a list of values, for each row of its element.
struct column {
    std::string name{};
    scalar_type type = scalar_type::float64;
    /// Type of the length before each list; none if each row has exactly one value.
    std::optional<scalar_type> list_length{};
    column_role role = column_role::data;
    std::vector<std::byte> values{};          ///< in the machine's byte order, row after row
    std::vector<std::uint64_t> list_begin{};  ///< [rows + 1] first value of each list; else empty

    /// A column with one value a row.
    template <class T>
    [[nodiscard]] static column of(std::string name, std::span<const T> values) {
        column c;
        c.name = std::move(name);
        c.type = scalar_type_of<T>();
        c.values.resize(values.size_bytes());
        if (!values.empty()) std::memcpy(c.values.data(), values.data(), values.size_bytes());
        return c;
    }

    /// Number of values, over all rows.
    [[nodiscard]] std::size_t size() const { return values.size() / size_of(type); }

    /// Value `i` as a double: exact, except that whole numbers beyond 2^53 are rounded.
    [[nodiscard]] TREEFORM_API double number(std::size_t i) const;

    friend bool operator==(const column&, const column&) = default;
};

/// A kind of row in a file, such as vertices, with its properties in the order of the file.
struct element {
    std::string name{};  ///< "vertex", "face", "edge", ...
    std::size_t rows = 0;
    std::vector<column> columns{};

    /// The column of that name; null when there is none.
    [[nodiscard]] TREEFORM_API const column* find(std::string_view column_name) const;

    /// The names of the data columns that match `column_name`: the column of that name. If there is
    /// none, "normal", "uv" and "color" match all columns of that kind, in the naming of any
    /// format. Empty if nothing matches.
    [[nodiscard]] TREEFORM_API std::vector<std::string> columns_called(
        std::string_view column_name) const;

    /// Replaces the column of the same name by `c`, or appends `c`. Returns whether a column was
    /// replaced.
    ///
    /// \pre `c` has a value for each row
    TREEFORM_API bool set(column c);

    /// The rows `which`, in this order; a row may occur several times.
    ///
    /// \pre each of `which` is less than `rows`
    [[nodiscard]] TREEFORM_API element gathered(std::span<const std::uint32_t> which) const;

    friend bool operator==(const element&, const element&) = default;
};

/// Consecutive faces to which a file gives the same names. A part ends where the next one starts.
struct named_faces {
    std::string object{};          ///< OBJ `o`, the name of an STL solid or of a scene's node
    std::string group{};           ///< OBJ `g`
    std::string material{};        ///< OBJ `usemtl`
    std::uint32_t first_face = 0;  ///< number in the file

    friend bool operator==(const named_faces&, const named_faces&) = default;
};

/// All attributes of a mesh.
struct attributes {
    /// In the order of the file. "vertex" has a row for each point, "face" one for each face as
    /// stored.
    std::vector<element> elements{};
    /// Values of the corners of the mesh's triangles, even if the stored faces are polygons. The
    /// triangles of a polygon have equal values at shared corners.
    corner_values corners{};
    std::vector<named_faces> parts{};  ///< ascending by first face; empty if nothing is named
    std::vector<std::string> material_files{};  ///< OBJ `mtllib`, as in the file
    /// PLY: the names in the lines `comment TextureFile NAME`. The property "texnumber" of faces is
    /// a number in this list, from 0; without it, faces use the first.
    std::vector<std::string> texture_files{};
    std::vector<std::string> comments{};  ///< PLY: one line each, without those of texture files
    std::vector<std::string> obj_info{};  ///< PLY: one line each
    std::string header{};                 ///< binary STL: its first 80 bytes

    /// The element of that name; null when there is none.
    [[nodiscard]] TREEFORM_API const element* find(std::string_view element_name) const;

    /// The element of that name; when there is none, a new one with `rows` rows, at the end.
    [[nodiscard]] TREEFORM_API element& find_or_add(std::string_view element_name,
                                                    std::size_t rows);

    friend bool operator==(const attributes&, const attributes&) = default;
};

}  // namespace treeform
