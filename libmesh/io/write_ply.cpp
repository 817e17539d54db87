#include <libmesh/io/number.hpp>
#include <libmesh/io/ply_header.hpp>
#include <libmesh/io/vertex_columns.hpp>
#include <libmesh/io/writers.hpp>

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <string>

namespace treeform::detail::io {

namespace {

[[nodiscard]] ply_encoding encoding_for(const write_job& job) {
    if (job.options.ascii) return ply_encoding::ascii;
    return job.file.format == "ply-binary-be" ? ply_encoding::big_endian
                                              : ply_encoding::little_endian;
}

class ply_writer {
  public:
    /// `by_runs`: as many points will come by `put_points`; else those of the job's file.
    explicit ply_writer(const write_job& job, std::optional<std::uint64_t> by_runs = {})
        : job_(job),
          encoding_(encoding_for(job)),
          count_(by_runs.value_or(job.file.mesh.points.size())) {
        if (encoding_ == ply_encoding::big_endian) job.result.format = "ply-binary-be";
        for (const element& e : job.file.attributes.elements) {
            names_.push_back({.name = e.name, .rows = e.rows});
            for (const column& c : e.columns) names_.back().columns.push_back(declaration(c));
        }
        declare_vertices(by_runs.has_value());
        declare_faces();
    }

    void write() {
        put_header();
        for (const element& e : names_) {
            const element* source =
                e.name == "vertex" ? job_.vertices : job_.file.attributes.find(e.name);
            if (e.name == "face")
                put_faces(e);
            else
                put_rows(e, source, e.rows, job_.file.mesh.points);
        }
    }

    void put_header() {
        sink& out = job_.out;
        out.put("ply\nformat ");
        out.put(ply_encodings[static_cast<std::size_t>(encoding_)]);
        out.put(" 1.0\n");
        for (const auto& line : job_.file.attributes.comments) put_remark("comment", line);
        for (const auto& name : job_.file.attributes.texture_files)
            put_remark("comment " + std::string(texture_file_keyword), name);
        for (const auto& line : job_.file.attributes.obj_info) put_remark("obj_info", line);
        for (const element& e : names_) {
            out.put("element " + e.name + ' ' + std::to_string(e.rows) + '\n');
            for (const column& c : e.columns) put_property(c);
        }
        out.put("end_header\n");
    }

    void put_points(std::span<const point3> points, const element* source) {
        const element& e = *find("vertex");
        check_axes(job_, is_text(), e, points);
        put_rows(e, source, points.size(), points);
    }

    void put_behind(const row_block& block) {
        const element& e = *find(block.rows.name);
        if (e.name != "face") return put_rows(e, &block.rows, block.rows.rows, {});
        face_values_.clear();
        for (std::size_t i = 0; i < e.columns.size(); ++i)
            face_values_.push_back(
                e.columns[i].role == column_role::data ? &with_values(e, &block.rows, i) : nullptr);
        put_by_pieces(job_, block.rows.rows, [&](const write_job& piece, auto first, auto last) {
            ply_writer some(*this, piece);
            for (std::size_t f = first; f < last; ++f)
                some.put_face(e, f, 0,
                              std::span(block.corners)
                                  .subspan(block.first_corner[f],
                                           block.first_corner[f + 1] - block.first_corner[f]));
        });
    }

  private:
    /// For some rows of what `whole` writes.
    ply_writer(const ply_writer& whole, const write_job& piece)
        : job_(piece),
          encoding_(whole.encoding_),
          count_(whole.count_),
          face_values_(whole.face_values_) {}

    [[nodiscard]] std::vector<element>::iterator find(std::string_view name) {
        return std::ranges::find(names_, name, &element::name);
    }

    element& declared(std::string_view name, std::size_t rows, std::size_t place) {
        const auto at = find(name);
        if (at != names_.end()) return *at;
        return *names_.insert(names_.begin() + static_cast<std::ptrdiff_t>(place),
                              {.name = std::string(name), .rows = rows});
    }

    void declare_vertices(bool by_runs) {
        const std::span<const point3> all(job_.file.mesh.points);
        element& e = declared("vertex", count_, 0);
        e = detail::io::declare_vertices(job_, is_text(),
                                         by_runs ? std::nullopt : std::optional(all));
        e.rows = count_;
    }

    void declare_faces() {
        const std::size_t count = stored_face_count(job_.file);
        const auto at = find("face");
        if (at == names_.end() && count == 0) return;
        element& e = declared("face", count, at == names_.end() ? 1 : 0);
        declare_face_columns(e);
        std::size_t most = job_.most_corners;
        for_each_stored_face(job_.file, [&](std::size_t, std::span<const std::uint32_t> corners) {
            most = std::max(most, corners.size());
        });
        for (column& c : e.columns) {
            if (c.role == column_role::texture && !holds(*c.list_length, 2 * most))
                c.list_length = scalar_type::uint32;
            if (c.role != column_role::corners) continue;
            if (!holds(*c.list_length, most)) c.list_length = scalar_type::uint32;
            if (!holds(c.type, count_)) c.type = scalar_type::uint32;
        }
    }

    /// Those of the element in their order, with corners and their texture coordinates, which the
    /// file may have had in its formats or not.
    void declare_face_columns(element& e) {
        const element* source = job_.file.attributes.find(e.name);
        const bool has_texture = !job_.file.attributes.corners.texture_of_corner.empty();
        e.columns.clear();
        for (std::size_t i = 0; source != nullptr && i < source->columns.size(); ++i) {
            const column& c = source->columns[i];
            if (c.role == column_role::texture && !has_texture) continue;
            if (c.role == column_role::data && has_texture && c.name == face_texture_name) {
                job_.result.warnings.push_back(
                    {"corner-values", "list " + c.name +
                                          " of faces left out, since texture coordinates of "
                                          "corners have the same name"});
                continue;
            }
            e.columns.push_back(declaration(c));
            face_values_.push_back(&c);
        }
        const auto add = [&](std::size_t place, column c) {
            const auto at = static_cast<std::ptrdiff_t>(place);
            face_values_.insert(face_values_.begin() + at, nullptr);
            e.columns.insert(e.columns.begin() + at, std::move(c));
        };
        if (with_role(e, column_role::corners) == nullptr)
            add(0, {.name = "vertex_indices",
                    .type = scalar_type::int32,
                    .list_length = scalar_type::uint8,
                    .role = column_role::corners});
        if (has_texture && with_role(e, column_role::texture) == nullptr)
            add(e.columns.size(), {.name = std::string(face_texture_name),
                                   .type = scalar_type::float32,
                                   .list_length = scalar_type::uint8,
                                   .role = column_role::texture});
    }

    [[nodiscard]] static bool holds(scalar_type type, std::size_t number) {
        return with_type(type, [&]<class T>(T) {
            return static_cast<double>(number) <=
                   static_cast<double>(std::numeric_limits<T>::max());
        });
    }

    void put_property(const column& c) {
        sink& out = job_.out;
        if (c.type == scalar_type::int64 || c.type == scalar_type::uint64)
            job_.result.warnings.push_back(
                {"ply-int64",
                 "property " + c.name + " has a 64-bit type that not every PLY reader supports"});
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

    void put_remark(std::string_view keyword, const std::string& line) {
        job_.out.put(keyword);
        job_.out.put(' ');
        job_.out.put(one_line(line));
        job_.out.put('\n');
    }

    [[nodiscard]] bool is_text() const { return encoding_ == ply_encoding::ascii; }

    void put_blank() {
        if (row_started_) job_.out.put(' ');
        row_started_ = true;
    }

    /// `value` as one of that type.
    template <class V>
    void put_as(scalar_type type, V value) {
        if (is_text()) put_blank();
        with_type(type, [&]<class T>(T) {
            if (is_text())
                job_.out.number(static_cast<T>(value));
            else if (encoding_ == ply_encoding::big_endian)
                job_.out.raw<std::endian::big>(static_cast<T>(value));
            else
                job_.out.raw<std::endian::little>(static_cast<T>(value));
        });
    }

    void put_value(const column& c, std::size_t i) {
        if (encoding_ == ply_encoding::little_endian)
            return put_bits<std::endian::little>(job_.out, c, i);
        if (encoding_ == ply_encoding::big_endian)
            return put_bits<std::endian::big>(job_.out, c, i);
        put_blank();
        put_number(job_.out, c, i);
    }

    void put_coordinate(const column& c, double x) {
        // In text a float column has the digits of the double, as in every text format.
        put_as(is_text() && keeps_digits(c) ? scalar_type::float64 : c.type, job_.rounded(x));
    }

    void put_data(const column& c, std::size_t row) {
        if (!c.list_length) return put_value(c, row);
        put_as(*c.list_length, c.list_begin[row + 1] - c.list_begin[row]);
        for (std::uint64_t i = c.list_begin[row]; i < c.list_begin[row + 1]; ++i) put_value(c, i);
    }

    void end_row() {
        if (is_text()) job_.out.put('\n');
        row_started_ = false;
    }

    void put_rows(const element& e, const element* source, std::size_t rows,
                  std::span<const point3> points) {
        if (e.columns.empty()) return;
        put_by_pieces(job_, rows, [&](const write_job& piece, auto first, auto last) {
            ply_writer some(*this, piece);
            for (std::size_t row = first; row < last; ++row) some.put_row(e, source, row, points);
        });
    }

    void put_row(const element& e, const element* source, std::size_t row,
                 std::span<const point3> points) {
        for (std::size_t i = 0; i < e.columns.size(); ++i) {
            const column& c = e.columns[i];
            if (c.role == column_role::data)
                put_data(with_values(e, source, i), row);
            else
                put_coordinate(c, points[row][axis_number(c.role)]);
        }
        end_row();
    }

    void put_faces(const element& e) {
        const mesh_file& file = job_.file;
        if (file.face_of_triangle.empty()) {
            put_by_pieces(job_, file.mesh.faces.size(),
                          [&](const write_job& piece, auto first, auto last) {
                              ply_writer some(*this, piece);
                              for (std::size_t f = first; f < last; ++f)
                                  some.put_face(e, f, f, file.mesh.faces[f]);
                          });
            return;
        }
        std::size_t row = 0;
        for_each_stored_face(file, [&](std::size_t first, std::span<const std::uint32_t> corners) {
            put_face(e, row++, first, corners);
        });
    }

    /// `first` is the first of its triangles.
    void put_face(const element& e, std::size_t row, std::size_t first,
                  std::span<const std::uint32_t> corners) {
        for (std::size_t i = 0; i < e.columns.size(); ++i) {
            const column& c = e.columns[i];
            if (c.role == column_role::data) {
                put_data(*face_values_[i], row);
            } else if (c.role == column_role::texture) {
                put_texture(c, first, corners.size());
            } else {
                put_as(*c.list_length, corners.size());
                for (const std::uint32_t corner : corners) put_as(c.type, corner);
            }
        }
        end_row();
    }

    /// An empty list where no corner has any.
    void put_texture(const column& c, std::size_t first, std::size_t corners) {
        const corner_values& values = job_.file.attributes.corners;
        const auto row_of = [&](std::size_t corner) {
            const auto [triangle, place] = place_in_fan(corner);
            return values.texture_of_corner[first + triangle][place];
        };
        bool any = false;
        for (std::size_t i = 0; i < corners; ++i) any |= row_of(i) != corner_values::none;
        put_as(*c.list_length, any ? 2 * corners : std::size_t{0});
        for (std::size_t i = 0; i < corners && any; ++i) {
            constexpr double nan = std::numeric_limits<double>::quiet_NaN();
            const std::uint32_t row = row_of(i);
            for (std::size_t k = 0; k < 2; ++k)
                put_as(c.type, row == corner_values::none ? nan : values.texture[row][k]);
        }
    }

    write_job job_;
    ply_encoding encoding_;
    std::uint64_t count_;
    std::vector<element> names_{};              ///< what the header declares; without values
    std::vector<const column*> face_values_{};  ///< of the columns of faces
    bool row_started_ = false;
};

}  // namespace

void write_ply(const write_job& job) { ply_writer(job).write(); }

point_sink start_ply_points(const write_job& job, std::uint64_t count) {
    auto writer = std::make_shared<ply_writer>(job, count);
    writer->put_header();
    return {.rows = [writer](std::span<const point3> points,
                             const element* vertices) { writer->put_points(points, vertices); },
            .behind = [writer](const row_block& block) { writer->put_behind(block); }};
}

}  // namespace treeform::detail::io
