#pragma once
/// \file
/// Texture coordinates and normals of an OBJ: their lines, and the references of corners to them.

#include <libmesh/io/text.hpp>
#include <treeform/mesh/attributes.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace treeform::detail::io {

/// Skips blanks and line continuations; true at the end of the statement.
[[nodiscard]] inline bool statement_done(text& t) {
    for (;;) {
        if (t.line_done()) return true;
        if (*t.at != '\\' || t.end - t.at < 2 || !is_newline(t.at[1])) return false;
        const bool two_bytes = t.end - t.at > 2 && t.at[1] == '\r' && t.at[2] == '\n';
        t.at += two_bytes ? 3 : 2;
    }
}

/// Number of rows of each kind, the limits of references.
struct obj_row_counts {
    static constexpr std::uint64_t any = std::numeric_limits<std::uint32_t>::max();
    std::uint64_t vertices = any;
    std::uint64_t textures = any;
    std::uint64_t normals = any;
};

/// Parses references of corners to rows of one kind.
class obj_numbers {
  public:
    /// \pre `kind`, as in "texture", outlives this; `limit` is at most 2^32 - 1
    obj_numbers(const char* kind, std::uint64_t limit) : kind_(kind), limit_(limit) {}

    /// Parses a reference, and returns its row; `count` rows were read so far. Negative numbers
    /// count back from the last row, others from 1.
    [[nodiscard]] std::uint32_t read(text& t, std::size_t count) {
        const parsed<std::int64_t> index = parse_integer(t.at, t.end);
        const std::int64_t row =
            index.value > 0 ? index.value - 1 : static_cast<std::int64_t>(count) + index.value;
        // A missing number has the value 0.
        if (index.value == 0 || static_cast<std::uint64_t>(row) >= limit_) refuse(t, index);
        needed_ = std::max(needed_, static_cast<std::uint64_t>(row) + 1);
        t.at = index.end;
        return static_cast<std::uint32_t>(row);
    }

    /// The number of rows that all references require.
    [[nodiscard]] std::uint64_t needed() const { return needed_; }

  private:
    [[noreturn]] void refuse(const text& t, const parsed<std::int64_t>& index) const;

    const char* kind_;
    std::uint64_t limit_;
    std::uint64_t needed_ = 0;
};

/// The references of corners, cut into fans like their faces. Uses no memory before the first
/// reference.
class corner_fans {
  public:
    [[nodiscard]] bool used() const { return used_; }

    /// Adds the reference of corner `corner` of a face. `triangles` is the number of triangles so
    /// far, including those of the face; `expected` is a hint for the final number.
    void add(std::uint32_t number, std::size_t corner, std::size_t triangles, std::size_t expected,
             std::vector<face>& fans) {
        if (!used_ && number == corner_values::none) return;
        if (!used_) start(triangles, expected, fans);
        if (corner >= 2) fans.push_back({first_, previous_, number});
        if (corner == 0) first_ = number;
        previous_ = number;
    }

  private:
    void start(std::size_t triangles, std::size_t expected, std::vector<face>& fans);

    bool used_ = false;
    std::uint32_t first_ = corner_values::none;
    std::uint32_t previous_ = corner_values::none;
};

class obj_corners {
  public:
    explicit obj_corners(const obj_row_counts& limits)
        : textures_("texture", limits.textures), normals_("normal", limits.normals) {}

    /// Reserves memory for rows, and for the corners of triangles once one has a reference.
    void reserve(std::size_t textures, std::size_t normals, std::size_t triangles);

    /// Parse the rest of a statement `vt` or `vn`.
    void texture(text& t);
    void normal(text& t);

    /// Parses the text after the number of a vertex: "/vt", "//vn", "/vt/vn" or nothing; other
    /// arguments as in `corner_fans::add`. Text that cannot be parsed is left to the caller.
    void add(text& t, std::size_t corner, std::size_t triangles) {
        if ((t.at < t.end && *t.at == '/') || texture_fans_.used() || normal_fans_.used())
            add_numbers(t, corner, triangles);
    }

    /// Whether all references are in range. References to a kind without any rows in the file are
    /// dropped, and do not count.
    [[nodiscard]] bool in_range() const {
        return (lacks_textures() || textures_.needed() <= values_.texture.size()) &&
               (lacks_normals() || normals_.needed() <= values_.normals.size());
    }
    [[nodiscard]] const corner_values& values() const { return values_; }
    /// Returns the values, and adds warnings about dropped references.
    [[nodiscard]] corner_values take(std::vector<io_warning>& warnings);

  private:
    [[nodiscard]] bool lacks_textures() const {
        return values_.texture.empty() && textures_.needed() > 0;
    }
    [[nodiscard]] bool lacks_normals() const {
        return values_.normals.empty() && normals_.needed() > 0;
    }
    void add_numbers(text& t, std::size_t corner, std::size_t triangles);

    obj_numbers textures_;
    obj_numbers normals_;
    corner_fans texture_fans_{};
    corner_fans normal_fans_{};
    std::size_t expected_triangles_ = 0;
    corner_values values_{};
};

}  // namespace treeform::detail::io
