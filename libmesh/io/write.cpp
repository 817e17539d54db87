#include <libmesh/attributes/known_columns.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/io/formats.hpp>
#include <libmesh/io/number.hpp>
#include <libmesh/io/vertex_columns.hpp>
#include <libmesh/io/writers.hpp>
#include <treeform/mesh/write.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace treeform {

namespace detail::io {

namespace {

[[noreturn]] void refuse_file(const std::string& what) {
    throw std::invalid_argument("treeform::write: " + what);
}

}  // namespace

void check_columns(const element& e) {
    for (const column& c : e.columns) {
        if (c.name.empty() || std::any_of(c.name.begin(), c.name.end(), is_space))
            refuse_file("column name '" + c.name + "' is empty or has blanks");
        if (c.role != column_role::data) continue;
        const std::size_t values = c.size();
        const bool fits = c.list_length
                              ? c.list_begin.size() == e.rows + 1 && c.list_begin.back() == values
                              : values == e.rows;
        if (!fits) refuse_file("column " + c.name + " does not fit element " + e.name);
    }
}

void put_number(sink& out, const column& c, std::size_t i) {
    with_type(c.type, [&]<class T>(T value) {
        std::memcpy(&value, c.values.data() + i * sizeof(T), sizeof(T));
        out.number(value);
    });
}

std::vector<const column*> scalar_columns(const element* e,
                                          std::initializer_list<std::string_view> names) {
    std::vector<const column*> found;
    for (const std::string_view name : names) {
        const column* c = e == nullptr ? nullptr : e->find(name);
        if (c == nullptr || c->list_length || c->role != column_role::data) return {};
        found.push_back(c);
    }
    return found;
}

void check_finite(const write_job& job, const char* format) {
    const std::vector<point3>& points = job.file.mesh.points;
    const auto at =
        std::ranges::find_if_not(points, [](const point3& p) { return base::is_finite(p); });
    if (at == points.end()) return;
    throw io_error(std::string(job.out.name()) + ": point " + std::to_string(at - points.begin()) +
                   ": " + format + " can hold only finite coordinates");
}

std::vector<const column*> color_columns(const element* e) {
    std::vector<const column*> found;
    for (const std::string_view name : {"red", "green", "blue", "alpha"}) {
        const column* c = e == nullptr ? nullptr : e->find(name);
        for (std::size_t i = 0; c == nullptr && e != nullptr && i < e->columns.size(); ++i) {
            const auto* const known = attribute::find_known(e->columns[i].name);
            if (known != nullptr && known->in[0].name == name) c = &e->columns[i];
        }
        if (c == nullptr || c->list_length || c->role != column_role::data) break;
        found.push_back(c);
    }
    return found.size() < 3 ? std::vector<const column*>() : found;
}

namespace {

/// Whether triangle `f` and the one before it have their common corners where a fan has them.
bool continues_fan(const std::vector<face>& faces, std::size_t f) {
    return faces.empty() || (faces[f][0] == faces[f - 1][0] && faces[f][1] == faces[f - 1][2]);
}

void check_faces(const mesh_file& file) {
    const auto& faces = file.mesh.faces;
    for (std::size_t f = 0; f < faces.size(); ++f)
        for (const std::uint32_t corner : faces[f])
            if (corner >= file.mesh.points.size())
                refuse_file("face " + std::to_string(f) + " has a corner out of range");
    const auto& stored = file.face_of_triangle;
    if (const auto fault = file.attributes.corners.fault(faces.size()); !fault.empty())
        refuse_file(fault);
    if (stored.empty()) return;
    if (stored.size() != faces.size()) refuse_file("face_of_triangle and faces differ in size");
    if (stored[0] != 0) refuse_file("face_of_triangle does not start with face 0");
    for (std::size_t f = 1; f < faces.size(); ++f) {
        if (stored[f] == stored[f - 1]) {
            const corner_values& corners = file.attributes.corners;
            if (!continues_fan(faces, f) || !continues_fan(corners.texture_of_corner, f) ||
                !continues_fan(corners.normal_of_corner, f))
                refuse_file("the triangles of stored face " + std::to_string(stored[f]) +
                            " are not a fan");
        } else if (stored[f] != stored[f - 1] + 1) {
            refuse_file("face_of_triangle skips a face before triangle " + std::to_string(f));
        }
    }
}

void check_attributes(const mesh_file& file) {
    for (const element& e : file.attributes.elements) {
        if (e.name == "vertex" && e.rows != file.mesh.points.size())
            refuse_file("element vertex has " + std::to_string(e.rows) + " rows for " +
                        std::to_string(file.mesh.points.size()) + " points");
        if (e.name == "face" && e.rows != stored_face_count(file))
            refuse_file("element face has " + std::to_string(e.rows) + " rows for " +
                        std::to_string(stored_face_count(file)) +
                        " stored faces (a polygon is one, not one for each triangle)");
        check_columns(e);
    }
}

}  // namespace

double largest_move(std::span<const point3> points, std::size_t first, const std::string& name) {
    // Numbers from here on round away from the largest float: half a last place above it.
    constexpr double beyond = 0x1.ffffffp127;
    double largest = 0.0;
    for (std::size_t v = 0; v < points.size(); ++v) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double x = points[v][axis];
            if (!std::isfinite(x)) continue;
            if (std::abs(x) >= beyond)
                throw io_error(name + ": vertex " + std::to_string(first + v) +
                               " is beyond the range of float32");
            largest = std::max(largest, std::abs(base::nearest_float(x) - x));
        }
    }
    return largest;
}

namespace {

/// Columns of these names with the values that the points' corners have; none where some point has
/// several. Points without any have zeros.
template <class Row>
[[nodiscard]] std::vector<column> values_of_points(const mesh& m,
                                                   const std::vector<face>& rows_of_corner,
                                                   const std::vector<Row>& rows,
                                                   std::initializer_list<const char*> names) {
    constexpr std::uint32_t none = corner_values::none;
    if (rows_of_corner.empty()) return {};
    std::vector<std::uint32_t> row_of(m.points.size(), none);
    for (std::size_t f = 0; f < rows_of_corner.size(); ++f)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t row = rows_of_corner[f][k];
            std::uint32_t& held = row_of[m.faces[f][k]];
            if (row == none) return {};
            if (held == none) held = row;
            if (held != row && rows[held] != rows[row]) return {};
        }
    std::vector<column> columns;
    for (const char* const name : names)
        columns.push_back(column_of<double>(name, row_of.size(), [&](std::size_t v) {
            return row_of[v] == none ? 0.0 : rows[row_of[v]][columns.size()];
        }));
    return columns;
}

class writing {
  public:
    writing(const std::filesystem::path& path, const mesh_file& file, const write_options& options,
            bool may_round = true)
        : file_(file),
          options_(options),
          name_(path.string()),
          format_(find_format(path, options)) {
        check_faces(file);
        check_attributes(file);
        const bool text = writes_text(format_, options);
        writer_ = text ? format_.text : format_.binary;
        result_.format = text ? format_.text_name : format_.binary_name;
        const bool single =
            (!text && format_.single_only) || (format_.single_unless_asked && !options.precision);
        result_.written_as =
            single ? precision::float32 : options.precision.value_or(file.stored_as);
        // A node's transform has made doubles of float32 numbers; those are worth keeping.
        if (!options.precision && result_.written_as == precision::float32 && !single &&
            !fits_float32(file.mesh.points))
            result_.written_as = precision::float64;
        if (result_.written_as == precision::float32)
            result_.max_displacement = largest_move(file.mesh.points, 0, name_);
        if (!may_round && result_.max_displacement > 0.0)
            throw io_error(name_ + ": " + result_.format +
                           " would round certified coordinates; compute the result with "
                           "precision float32, or write " +
                           (format_.single_unless_asked && options.precision != precision::float32
                                ? "with precision float64"
                                : "a format that holds doubles"));
        if (file.mesh.faces.empty() && !file.mesh.points.empty() &&
            (format_.extension == "stl" || format_.extension == "glb" ||
             format_.extension == "3mf"))
            throw io_error(name_ + ": " + std::string(format_.extension) +
                           " cannot hold points without faces");
    }

    write_result run(sink& out) {
        const element* vertices = file_.attributes.find("vertex");
        std::optional<element> with_looks = looks_of_points(vertices);
        if (with_looks) vertices = &*with_looks;
        std::optional<element> translated;
        if (vertices != nullptr) {
            std::vector<value_range> ranges = file_.ranges;
            if (ranges.empty()) attribute::look_at_ranges(*vertices, ranges);
            const attribute::translation to(*vertices, source_format(), format_.extension, ranges,
                                            options_.drop, options_.rename);
            if (to.changes()) vertices = &translated.emplace(to.apply(*vertices));
            result_.warnings = to.warnings();
        }
        writer_({.file = file_,
                 .options = options_,
                 .result = result_,
                 .out = out,
                 .vertices = vertices});
        const bool text = writes_text(format_, options_);
        for (io_warning& w : left_out(format_, file_, vertices, text))
            result_.warnings.push_back(std::move(w));
        out.flush();
        return std::move(result_);
    }

  private:
    /// With what corners have, where the format holds that of points alone, and each has one; else
    /// none.
    [[nodiscard]] std::optional<element> looks_of_points(const element* vertices) const {
        const holdings& holds = format_.holds;
        const corner_values& corners = file_.attributes.corners;
        if (holds.points < columns_held::looks) return std::nullopt;
        element made{.name = "vertex", .rows = file_.mesh.points.size()};
        if (vertices != nullptr) made = *vertices;
        bool changed = false;
        const auto add = [&](std::vector<column> columns) {
            if (columns.empty() || made.find(columns.front().name) != nullptr) return;
            for (column& c : columns) made.columns.push_back(std::move(c));
            changed = true;
        };
        if (!holds.normals)
            add(values_of_points(file_.mesh, corners.normal_of_corner, corners.normals,
                                 {"nx", "ny", "nz"}));
        if (!holds.texture)
            add(values_of_points(file_.mesh, corners.texture_of_corner, corners.texture,
                                 {"s", "t"}));
        return changed ? std::optional(std::move(made)) : std::nullopt;
    }

    /// That of the file, unless its columns are to stay as they are.
    [[nodiscard]] std::string_view source_format() const {
        return options_.keep_names ? format_.extension : std::string_view(file_.format);
    }

    const mesh_file& file_;
    const write_options& options_;
    std::string name_;
    const known_format& format_;
    writer writer_ = nullptr;
    write_result result_{};
};

/// A file without what is dropped of its corners, which are no columns.
class dropped_corners {
  public:
    dropped_corners(const mesh_file& file, const write_options& options)
        : file_(file), options_(options) {
        const element* const points = file.attributes.find("vertex");
        const auto drop = [&](const char* name, auto corner_values::*values, const auto& clear) {
            if (std::ranges::count(options.drop, name) == 0) return;
            if ((file.attributes.corners.*values).empty()) return;
            if (!less_) less_ = file;
            clear(less_->attributes.corners);
            if (points != nullptr && !points->columns_called(name).empty()) return;
            if (!fewer_) fewer_ = options;
            std::erase(fewer_->drop, name);
        };
        drop("normal", &corner_values::normal_of_corner, [](corner_values& c) {
            c.normal_of_corner.clear();
            c.normals.clear();
        });
        drop("uv", &corner_values::texture_of_corner, [](corner_values& c) {
            c.texture_of_corner.clear();
            c.texture.clear();
        });
    }
    [[nodiscard]] const mesh_file& file() const { return less_ ? *less_ : file_; }
    [[nodiscard]] const write_options& options() const { return fewer_ ? *fewer_ : options_; }

  private:
    const mesh_file& file_;
    const write_options& options_;
    std::optional<mesh_file> less_;
    std::optional<write_options> fewer_;
};

write_result write_file(const std::filesystem::path& path, const mesh_file& file,
                        const write_options& options, bool may_round) {
    const dropped_corners less(file, options);
    writing job(path, less.file(), less.options(), may_round);
    const auto may_continue = [&](double done) {
        return !options.progress || options.progress(done);
    };
    if (!may_continue(0.0)) return {.status = status::cancelled};
    output_file target(path);
    sink out(target.descriptor(), target.name(), [&] { return may_continue(0.0); });
    write_result result;
    try {
        result = job.run(out);
    } catch (const writing_stopped&) {
        return {.status = status::cancelled};
    }
    if (!may_continue(1.0)) result.status = status::cancelled;
    if (result.status != treeform::status::cancelled) target.commit();
    return result;
}

}  // namespace

write_result write_certified(const std::filesystem::path& path, mesh surface,
                             const write_options& options) {
    return write_file(path, {.mesh = std::move(surface)}, options, false);
}

write_result write_certified(const std::filesystem::path& path, const mesh_file& file,
                             const write_options& options) {
    return write_file(path, file, options, false);
}

}  // namespace detail::io

write_result write(const std::filesystem::path& path, const mesh_file& file,
                   const write_options& options) {
    return detail::io::write_file(path, file, options, true);
}

write_result write(const std::filesystem::path& path, mesh surface, const write_options& options) {
    return detail::io::write_file(path, {.mesh = std::move(surface)}, options, true);
}

std::string write_to_memory(const mesh_file& file, const write_options& options) {
    std::string bytes;
    detail::io::sink out(bytes);
    const detail::io::dropped_corners less(file, options);
    (void)detail::io::writing("memory", less.file(), less.options()).run(out);
    return bytes;
}

}  // namespace treeform
