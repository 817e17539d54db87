#include <libmesh/attributes/known_columns.hpp>
#include <libmesh/carry/carried.hpp>
#include <libmesh/io/vertex_columns.hpp>
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/attribute_sources.hpp>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

namespace treeform {
namespace {

bool is_floating(scalar_type type) { return type >= scalar_type::float32; }

/// Whether every value of `narrow` is one of `wide`.
bool holds(scalar_type wide, scalar_type narrow) {
    bool result = false;
    with_type(wide, [&]<class W>(W) {
        with_type(narrow, [&]<class N>(N) {
            using w = std::numeric_limits<W>;
            using n = std::numeric_limits<N>;
            result = w::digits >= n::digits && (w::is_signed || !n::is_signed) &&
                     (!w::is_integer || n::is_integer);
        });
    });
    return result;
}

/// The smallest type that holds the values of both.
std::optional<scalar_type> wider(scalar_type a, scalar_type b) {
    using enum scalar_type;
    constexpr scalar_type all[] = {int8,   uint8, int16,  uint16,  int32,
                                   uint32, int64, uint64, float32, float64};
    const auto at = std::find_if(std::begin(all), std::end(all),
                                 [&](scalar_type t) { return holds(t, a) && holds(t, b); });
    return at == std::end(all) ? std::nullopt : std::optional(*at);
}

void append_values(column& to, const column& from) {
    if (to.type == from.type) {
        to.values.insert(to.values.end(), from.values.begin(), from.values.end());
        return;
    }
    with_type(to.type, [&]<class T>(T) {
        const std::size_t count = from.size();
        const std::size_t begin = to.values.size();
        to.values.resize(begin + count * sizeof(T));
        for (std::size_t i = 0; i < count; ++i) {
            const T value = static_cast<T>(from.number(i));
            std::memcpy(to.values.data() + begin + i * sizeof(T), &value, sizeof(T));
        }
    });
}

/// NaN, 0 or empty lists.
void append_nothing(column& to, std::size_t rows) {
    if (to.list_length) {
        to.list_begin.insert(to.list_begin.end(), rows, to.list_begin.back());
        return;
    }
    with_type(to.type, [&]<class T>(T nothing) {
        if constexpr (std::is_floating_point_v<T>) nothing = std::numeric_limits<T>::quiet_NaN();
        append_values(to, detail::io::column_of<T>(to.name, rows, [&](auto) { return nothing; }));
    });
}

void append_lists(column& to, const column& from) {
    const std::uint64_t before = to.list_begin.back();
    for (std::size_t row = 1; row < from.list_begin.size(); ++row)
        to.list_begin.push_back(before + from.list_begin[row]);
}

class joiner {
  public:
    joiner(std::vector<mesh_file> files, std::span<const std::string> names, bool mixed)
        : files_(std::move(files)), names_(names), mixed_(mixed) {}

    mesh_file join() {
        check_sizes();
        translate();
        unite_textures();
        join_descriptions();
        join_element("vertex", [](const mesh_file& f) { return f.mesh.points.size(); });
        join_element("face", [](const mesh_file& f) { return f.stored_faces; });
        leave_out_elements();
        for (mesh_file& file : files_) {
            join_parts(file);
            all_.attributes.corners.append(all_.mesh.faces.size(), file.attributes.corners,
                                           file.mesh.faces.size());
            join_faces(file);
            file = {};
        }
        if (const element* points = all_.attributes.find("vertex"))
            detail::attribute::look_at_ranges(*points, all_.ranges);
        return std::move(all_);
    }

  private:
    void warn(const std::string& code, const std::string& text) {
        all_.warnings.push_back({code, text});
    }

    void check_sizes() const {
        std::uint64_t points = 0;
        std::uint64_t triangles = 0;
        std::uint64_t values = 0;
        for (const mesh_file& file : files_) {
            points += file.mesh.points.size();
            triangles += file.mesh.faces.size();
            const corner_values& corners = file.attributes.corners;
            values += std::max(corners.texture.size(), corners.normals.size());
        }
        constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max() - 1;
        if (points > most || triangles > most || values > most)
            throw std::length_error(
                "treeform::concatenate_files: the inputs together have more points or triangles "
                "than 32-bit "
                "numbers can name");
    }

    /// Points have the columns that the format of the first file has for them.
    void translate() {
        for (std::size_t i = 1; i < files_.size(); ++i)
            for (element& e : files_[i].attributes.elements) {
                if (e.name != "vertex") continue;
                const detail::attribute::translation to(e, files_[i].format, files_[0].format, {});
                if (!to.changes()) continue;
                e = to.apply(e);
                for (const io_warning& w : to.warnings()) warn(w.code, names_[i] + ": " + w.text);
            }
    }

    void unite_textures() {
        std::vector<mesh_file*> files;
        for (mesh_file& file : files_) files.push_back(&file);
        for (const io_warning& w : treeform::unite_textures(files, names_)) warn(w.code, w.text);
        all_.attributes.texture_files = files_.front().attributes.texture_files;
    }

    void join_descriptions() {
        all_.format = files_.front().format;
        all_.attributes.header = files_.front().attributes.header;
        all_.las = detail::carry::join_las(files_, names_, mixed_);
        for (std::size_t i = 0; i < files_.size(); ++i)
            if (!all_.las && files_[i].las && !files_[i].las->records.empty())
                warn("data-dropped", names_[i] + ": records of LAS left out");
        all_.stored_as = precision::float32;
        for (std::size_t i = 0; i < files_.size(); ++i) {
            const mesh_file& file = files_[i];
            all_.indexed = all_.indexed && file.indexed;
            polygons_ = polygons_ || !file.face_of_triangle.empty();
            parts_ = parts_ || !file.attributes.parts.empty();
            if (file.stored_as == precision::float64) all_.stored_as = precision::float64;
            for (const io_warning& w : file.warnings) warn(w.code, names_[i] + ": " + w.text);
            append_new(all_.attributes.comments, file.attributes.comments);
            append_new(all_.attributes.obj_info, file.attributes.obj_info);
            append_new(all_.attributes.material_files, file.attributes.material_files);
        }
    }

    /// Tiles of one scan repeat their remarks.
    static void append_new(std::vector<std::string>& to, const std::vector<std::string>& lines) {
        for (const std::string& line : lines)
            if (std::find(to.begin(), to.end(), line) == to.end()) to.push_back(line);
    }

    void leave_out_elements() {
        for (std::size_t i = 0; i < files_.size(); ++i)
            for (const element& e : files_[i].attributes.elements)
                if (e.name != "vertex" && e.name != "face")
                    warn("data-dropped", names_[i] + ": element " + e.name + " left out");
    }

    /// Values of the files' elements `name` are used up.
    template <class Rows>
    void join_element(const std::string& name, Rows&& rows_of) {
        element joined{.name = name};
        for (const mesh_file& file : files_) {
            joined.rows += rows_of(file);
            if (const element* e = file.attributes.find(name))
                declare_columns(joined, *e, &file == &files_.front());
        }
        if (joined.columns.empty()) return;
        for (column& c : joined.columns)
            if (c.role == column_role::data) fill(c, name, rows_of);
        all_.attributes.elements.push_back(std::move(joined));
    }

    void declare_columns(element& joined, const element& e, bool first) {
        for (const column& c : e.columns) {
            if (c.role != column_role::data) {
                declare_place(joined, c, first);
                continue;
            }
            const auto at = std::ranges::find_if(joined.columns, [&](const column& d) {
                return d.role == column_role::data && d.name == c.name;
            });
            if (at == joined.columns.end())
                joined.columns.push_back(
                    {.name = c.name, .type = c.type, .list_length = c.list_length});
            else
                widen(*at, c);
        }
    }

    /// Of what is no data. The type in which texture coordinates are written is to hold all.
    static void declare_place(element& joined, const column& c, bool first) {
        const auto at = std::ranges::find(joined.columns, c.role, &column::role);
        if (c.role == column_role::texture && at != joined.columns.end())
            widen(*at, c);
        else if (first || c.role == column_role::texture)
            joined.columns.push_back(
                {.name = c.name, .type = c.type, .list_length = c.list_length, .role = c.role});
    }

    static void widen(column& c, const column& other) {
        const auto type = wider(c.type, other.type);
        if (!type || c.list_length.has_value() != other.list_length.has_value())
            throw std::invalid_argument("treeform::concatenate_files: property " + c.name +
                                        " has different types in the inputs");
        c.type = *type;
        if (c.list_length) c.list_length = wider(*c.list_length, *other.list_length);
    }

    template <class Rows>
    void fill(column& c, const std::string& element_name, Rows&& rows_of) {
        if (c.list_length) c.list_begin.push_back(0);
        for (std::size_t i = 0; i < files_.size(); ++i) {
            const std::size_t rows = rows_of(files_[i]);
            const element* e = files_[i].attributes.find(element_name);
            const column* from = e == nullptr ? nullptr : e->find(c.name);
            if (from != nullptr && from->role == column_role::data) {
                if (c.list_length) append_lists(c, *from);
                append_values(c, *from);
            } else if (rows > 0) {
                append_nothing(c, rows);
                if (from != nullptr) continue;  // what corners have
                warn("missing-property", names_[i] + ": no " + element_name + " property " +
                                             c.name + "; filled with " + filler_of(c));
            }
        }
    }

    static const char* filler_of(const column& c) {
        return c.list_length ? "empty lists" : is_floating(c.type) ? "NaN" : "0";
    }

    void join_parts(const mesh_file& file) {
        const auto offset = static_cast<std::uint32_t>(all_.stored_faces);
        // Faces without a name must not come under the last name of the file before.
        const auto& parts = file.attributes.parts;
        if (parts_ && file.stored_faces > 0 && (parts.empty() || parts.front().first_face > 0))
            all_.attributes.parts.push_back({.first_face = offset});
        for (named_faces part : parts) {
            part.first_face += offset;
            all_.attributes.parts.push_back(std::move(part));
        }
    }

    void join_faces(const mesh_file& file) {
        const auto first_point = static_cast<std::uint32_t>(all_.mesh.points.size());
        const auto first_face = static_cast<std::uint32_t>(all_.stored_faces);
        for (std::size_t f = 0; f < file.mesh.faces.size(); ++f) {
            face corners = file.mesh.faces[f];
            for (std::uint32_t& corner : corners) corner += first_point;
            all_.mesh.faces.push_back(corners);
            if (polygons_)
                all_.face_of_triangle.push_back(first_face + (file.face_of_triangle.empty()
                                                                  ? static_cast<std::uint32_t>(f)
                                                                  : file.face_of_triangle[f]));
        }
        all_.mesh.points.insert(all_.mesh.points.end(), file.mesh.points.begin(),
                                file.mesh.points.end());
        all_.stored_faces += file.stored_faces;
    }

    std::vector<mesh_file> files_;
    std::span<const std::string> names_;
    bool mixed_;
    mesh_file all_{};
    bool polygons_ = false;
    bool parts_ = false;
};

}  // namespace

mesh_file concatenate_files(std::vector<mesh_file> files, std::span<const std::string> names,
                            bool mixed) {
    if (files.empty()) return {};
    if (files.size() != names.size())
        throw std::invalid_argument("treeform::concatenate_files: " + std::to_string(names.size()) +
                                    " names for " + std::to_string(files.size()) + " files");
    return joiner(std::move(files), names, mixed).join();
}

}  // namespace treeform
