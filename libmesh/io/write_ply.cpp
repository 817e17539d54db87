#include <libmesh/io/detail/ply_header.hpp>
#include <libmesh/io/detail/ply_values.hpp>
#include <libmesh/io/detail/writers.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tf::detail {

namespace {

[[nodiscard]] bool has_role(const element& e, column_role role) {
    return std::any_of(e.columns.begin(), e.columns.end(),
                       [&](const column& c) { return c.role == role; });
}

[[nodiscard]] double axis_of(const point3& p, column_role role) {
    return role == column_role::x ? p.x : role == column_role::y ? p.y : p.z;
}

/// A column without its values.
[[nodiscard]] column declaration(const column& c) {
    return {.name = c.name, .type = c.type, .list_length = c.list_length, .role = c.role};
}

/// True when every coordinate of that axis is a value of the type.
[[nodiscard]] bool fits(std::span<const point3> points, column_role axis, scalar_type type) {
    if (type == scalar_type::float64) return true;
    return with_type(type, [&]<class T>(T) {
        return std::all_of(points.begin(), points.end(), [&](const point3& p) {
            const double x = axis_of(p, axis);
            if constexpr (std::is_floating_point_v<T>) {
                const point3 alone{x, x, x};
                return fits_single(std::span(&alone, 1));
            }
            return x >= std::numeric_limits<T>::min() && x <= std::numeric_limits<T>::max() &&
                   x == std::floor(x);
        });
    });
}

class ply_writer {
  public:
    ply_writer(const write_job& job, ply_encoding encoding) : job_(job), encoding_(encoding) {
        for (const element& e : job.file.attributes.elements) {
            names_.push_back({.name = e.name, .rows = e.rows});
            for (const column& c : e.columns) names_.back().columns.push_back(declaration(c));
        }
        declare_vertices();
        declare_faces();
    }

    void write() {
        put_header();
        for (const element& e : names_) {
            const element* source = find_element(job_.file.attributes, e.name);
            if (e.name == "face")
                put_faces(e, source);
            else
                put_rows(e, source);
        }
    }

  private:
    element& declared(std::string_view name, std::size_t rows, std::size_t place) {
        const auto at = std::find_if(names_.begin(), names_.end(),
                                     [&](const element& e) { return e.name == name; });
        if (at != names_.end()) return *at;
        return *names_.insert(names_.begin() + static_cast<std::ptrdiff_t>(place),
                              {.name = std::string(name), .rows = rows});
    }

    void declare_vertices() {
        element& e = declared("vertex", job_.file.mesh.points.size(), 0);
        const scalar_type wanted = job_.single() ? scalar_type::float32 : scalar_type::float64;
        constexpr column_role axes[] = {column_role::x, column_role::y, column_role::z};
        std::ptrdiff_t added = 0;  // missing ones go ahead of all others
        for (std::size_t a = 0; a < 3; ++a) {
            if (has_role(e, axes[a])) {
                choose_type(e, axes[a], wanted);
                continue;
            }
            column axis{.name = std::string(1, "xyz"[a]), .type = wanted, .role = axes[a]};
            e.columns.insert(e.columns.begin() + added++, std::move(axis));
        }
    }

    /// A declared type stays where it can: text may have more digits than the type, bytes may not.
    void choose_type(element& e, column_role axis, scalar_type wanted) {
        for (column& c : e.columns) {
            if (c.role != axis) continue;
            const bool text = encoding_ == ply_encoding::ascii && c.type == scalar_type::float32;
            if (job_.options.precision)
                c.type = wanted;
            else if (!text && !fits(job_.file.mesh.points, axis, c.type))
                c.type = wanted;
        }
    }

    void declare_faces() {
        const std::size_t count = stored_face_count(job_.file);
        const auto at = std::find_if(names_.begin(), names_.end(),
                                     [](const element& e) { return e.name == "face"; });
        if (at == names_.end() && count == 0) return;
        element& e = declared("face", count, at == names_.end() ? 1 : 0);
        if (!has_role(e, column_role::corners))
            e.columns.insert(e.columns.begin(), {.name = "vertex_indices",
                                                 .type = scalar_type::int32,
                                                 .list_length = scalar_type::uint8,
                                                 .role = column_role::corners});
        std::size_t most = 0;
        for_each_stored_face(job_.file, [&](std::size_t, std::span<const std::uint32_t> corners) {
            most = std::max(most, corners.size());
        });
        for (column& c : e.columns) {
            if (c.role != column_role::corners) continue;
            if (!holds(*c.list_length, most)) c.list_length = scalar_type::uint32;
            if (!holds(c.type, job_.file.mesh.points.size())) c.type = scalar_type::uint32;
        }
    }

    [[nodiscard]] static bool holds(scalar_type type, std::size_t number) {
        return with_type(type, [&]<class T>(T) {
            return static_cast<double>(number) <=
                   static_cast<double>(std::numeric_limits<T>::max());
        });
    }

    void put_header() {
        sink& out = job_.out;
        out.put("ply\nformat ");
        out.put(name_of(encoding_));
        out.put(" 1.0\n");
        for (const auto& line : job_.file.attributes.comments) put_remark("comment", line);
        for (const auto& line : job_.file.attributes.obj_info) put_remark("obj_info", line);
        for (const element& e : names_) {
            out.put("element " + e.name + ' ' + std::to_string(e.rows) + '\n');
            for (const column& c : e.columns) {
                out.put("property ");
                if (c.list_length) {
                    out.put("list ");
                    out.put(name_of(*c.list_length));
                    out.put(' ');
                }
                out.put(name_of(c.type));
                out.put(' ');
                out.put(c.name);
                out.put('\n');
            }
        }
        out.put("end_header\n");
    }

    void put_remark(std::string_view keyword, std::string line) {
        std::replace_if(line.begin(), line.end(), is_newline, ' ');
        job_.out.put(keyword);
        job_.out.put(' ');
        job_.out.put(line);
        job_.out.put('\n');
    }

    /// Calls f with a value of the type of `c`, made from `value`.
    template <class V>
    void put_as(scalar_type type, V value) {
        if (encoding_ != ply_encoding::ascii) {
            with_type(type, [&]<class T>(T) {
                if (encoding_ == ply_encoding::big_endian)
                    job_.out.raw<std::endian::big>(static_cast<T>(value));
                else
                    job_.out.raw<std::endian::little>(static_cast<T>(value));
            });
            return;
        }
        if (row_started_) job_.out.put(' ');
        row_started_ = true;
        with_type(type, [&]<class T>(T) {
            if constexpr (sizeof(T) == 1)
                job_.out.number(static_cast<int>(value));
            else
                job_.out.number(static_cast<T>(value));
        });
    }

    void put_coordinate(const column& c, double x) {
        // In text a float column has the digits of the double, as in every text format.
        const bool digits = encoding_ == ply_encoding::ascii && c.type == scalar_type::float32;
        put_as(digits ? scalar_type::float64 : c.type, job_.rounded(x));
    }

    void put_data(const column& c, std::size_t row) {
        if (!c.list_length) return put_as(c.type, number_at(c, row));
        put_as(*c.list_length, c.list_begin[row + 1] - c.list_begin[row]);
        for (std::uint64_t i = c.list_begin[row]; i < c.list_begin[row + 1]; ++i)
            put_as(c.type, number_at(c, i));
    }

    /// The column with the values that belongs to number `i` of the declared ones.
    [[nodiscard]] static const column& with_values(const element& declared, const element* source,
                                                   std::size_t i) {
        // Columns that the writer has added stand ahead of all others.
        return source->columns[i - (declared.columns.size() - source->columns.size())];
    }

    void end_row() {
        if (encoding_ == ply_encoding::ascii) job_.out.put('\n');
        row_started_ = false;
    }

    void put_rows(const element& e, const element* source) {
        if (e.columns.empty()) return;
        for (std::size_t row = 0; row < e.rows; ++row) {
            for (std::size_t i = 0; i < e.columns.size(); ++i) {
                const column& c = e.columns[i];
                if (c.role == column_role::data)
                    put_data(with_values(e, source, i), row);
                else
                    put_coordinate(c, axis_of(job_.file.mesh.points[row], c.role));
            }
            end_row();
        }
    }

    void put_faces(const element& e, const element* source) {
        std::size_t row = 0;
        for_each_stored_face(job_.file, [&](std::size_t, std::span<const std::uint32_t> corners) {
            for (std::size_t i = 0; i < e.columns.size(); ++i) {
                const column& c = e.columns[i];
                if (c.role == column_role::data) {
                    put_data(with_values(e, source, i), row);
                    continue;
                }
                put_as(*c.list_length, corners.size());
                for (const std::uint32_t corner : corners) put_as(c.type, corner);
            }
            end_row();
            ++row;
        });
    }

    const write_job& job_;
    ply_encoding encoding_;
    std::vector<element> names_{};  ///< what the header declares; without values
    bool row_started_ = false;
};

}  // namespace

void write_ply(const write_job& job) {
    ply_encoding encoding = ply_encoding::little_endian;
    if (job.options.ascii)
        encoding = ply_encoding::ascii;
    else if (job.file.format == "ply-binary-be")
        encoding = ply_encoding::big_endian;
    if (encoding == ply_encoding::big_endian) job.result.format = "ply-binary-be";
    ply_writer(job, encoding).write();
}

}  // namespace tf::detail
