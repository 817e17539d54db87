#include <libmesh/attributes/scene_parts.hpp>
#include <libmesh/io/model_3mf.hpp>
#include <libmesh/io/writers.hpp>
#include <libmesh/io/xml_part.hpp>
#include <libmesh/io/zip_archive.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace treeform::detail::io {

namespace {

/// The list to which the corners of a triangle refer.
enum class look_list : std::uint8_t { none, materials, colors };

struct face_look {
    look_list list = look_list::none;
    face entries{};  ///< entry of each corner

    friend bool operator==(const face_look&, const face_look&) = default;
};

constexpr std::uint32_t white = 0xffffffff;

/// 0xRRGGBBAA.
[[nodiscard]] std::uint32_t color_of_row(const std::vector<const column*>& columns, std::size_t row,
                                         bool& is_rounded) {
    std::uint32_t color = 0;
    for (std::size_t c = 0; c < 4; ++c) {
        const double value = c < columns.size() ? color_value(*columns[c], row) : 1.0;
        const double share = value > 0.0 ? std::min(value, 1.0) : 0.0;  // of NaN: none
        const auto channel = static_cast<std::uint32_t>(std::lround(share * 255.0));
        is_rounded = is_rounded || !(std::abs(channel - value * 255.0) < 1e-3);
        color = color << 8 | channel;
    }
    return color;
}

/// The materials of parts with the colors of their faces; else the colors of faces; else the colors
/// of points, one for each corner. If only some faces have a color, the others are white. Colors
/// are 0xRRGGBBAA.
class face_looks {
  public:
    explicit face_looks(const write_job& job) {
        const mesh_file& file = job.file;
        const auto& parts = file.attributes.parts;
        const auto of_faces = color_columns(file.attributes.find("face"));
        auto of_points = color_columns(job.vertices);
        const bool named = std::any_of(parts.begin(), parts.end(),
                                       [](const named_faces& p) { return !p.material.empty(); });
        leaves_out_points = (named || !of_faces.empty()) && !of_points.empty();
        if (leaves_out_points) of_points.clear();
        lacks_colors = named && of_faces.empty() && !file.attributes.material_files.empty();
        if (!named && of_faces.empty() && of_points.empty()) return;
        const std::string nameless;
        std::size_t next = 0;
        for (std::uint32_t f = 0; f < file.mesh.faces.size(); ++f) {
            const std::size_t row = face_row(file, f);
            while (next < parts.size() && parts[next].first_face <= row) ++next;
            const std::string& material = next > 0 ? parts[next - 1].material : nameless;
            const std::uint32_t color =
                of_faces.empty() ? white : color_of_row(of_faces, row, rounds_colors);
            face_look look;
            if (!material.empty()) {
                look.list = look_list::materials;
                look.entries.fill(entry(number_of_material_, materials, {material, color}));
            } else if (!of_points.empty()) {
                look.list = look_list::colors;
                for (std::size_t k = 0; k < 3; ++k)
                    look.entries[k] =
                        entry(number_of_color_, colors,
                              color_of_row(of_points, file.mesh.faces[f][k], rounds_colors));
            } else {
                look.list = look_list::colors;
                look.entries.fill(entry(number_of_color_, colors, color));
            }
            looks_.push_back(look);
        }
    }

    [[nodiscard]] const face_look& of(std::uint32_t triangle) const {
        return looks_.empty() ? none_ : looks_[triangle];
    }

    /// Names and colors of materials, in the order of first use.
    std::vector<std::pair<std::string, std::uint32_t>> materials{};
    std::vector<std::uint32_t> colors{};
    bool leaves_out_points = false;  ///< points have colors that are not among these
    bool rounds_colors = false;      ///< some color is none of 8 bits a channel
    bool lacks_colors = false;  ///< colors of materials are in files of which nothing is known here

  private:
    template <class Entry>
    [[nodiscard]] static std::uint32_t entry(std::map<Entry, std::uint32_t>& numbers,
                                             std::vector<Entry>& list, const Entry& wanted) {
        const auto [at, is_new] = numbers.emplace(wanted, static_cast<std::uint32_t>(list.size()));
        if (is_new) list.push_back(wanted);
        return at->second;
    }

    face_look none_{};
    std::vector<face_look> looks_{};
    std::map<std::pair<std::string, std::uint32_t>, std::uint32_t> number_of_material_{};
    std::map<std::uint32_t, std::uint32_t> number_of_color_{};
};

constexpr std::string_view xml_head = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";

constexpr std::string_view content_types =
    "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">\n"
    "<Default Extension=\"rels\" "
    "ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>\n"
    "<Default Extension=\"model\" "
    "ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/>\n"
    "</Types>\n";

/// An object to write.
struct written_object {
    scene_part part{};
    std::vector<std::uint32_t> points{};  ///< ascending
};

/// Parts are objects. Points that no face uses go with the object of the points before them, so
/// that a file of one object keeps all its points.
[[nodiscard]] std::vector<written_object> objects_of(const mesh_file& file) {
    std::vector<written_object> objects;
    for (scene_part& p : scene_parts(file.mesh, file.attributes.parts, file.face_of_triangle))
        objects.push_back({.part = std::move(p)});
    if (objects.empty()) return objects;
    // Parts with a point in common are one, so each point has one owner at most.
    constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> owner(file.mesh.points.size(), nobody);
    for (std::uint32_t o = 0; o < objects.size(); ++o)
        for (const std::uint32_t f : objects[o].part.faces)
            for (const std::uint32_t corner : file.mesh.faces[f]) owner[corner] = o;
    std::uint32_t last = 0;
    for (std::uint32_t v = 0; v < owner.size(); ++v) {
        if (owner[v] != nobody) last = owner[v];
        objects[last].points.push_back(v);
    }
    return objects;
}

/// Different names of parts that have faces; none is one, too.
[[nodiscard]] std::size_t count_named(const mesh_file& file) {
    std::set<std::pair<std::string, std::string>> names;
    const auto& parts = file.attributes.parts;
    if (!parts.empty() && parts[0].first_face > 0) names.emplace();
    for (std::size_t p = 0; p < parts.size(); ++p) {
        const std::size_t end =
            p + 1 < parts.size() ? parts[p + 1].first_face : stored_face_count(file);
        if (parts[p].first_face < end) names.emplace(parts[p].object, parts[p].group);
    }
    return names.size();
}

/// The unit that was read, or that of models which name none.
[[nodiscard]] std::string unit_of(const mesh_file& file) {
    for (const std::string& line : file.attributes.obj_info)
        for (const std::string_view unit : units_3mf)
            if (line == "unit " + std::string(unit)) return std::string(unit);
    return std::string(units_3mf[1]);
}

/// The text of the model part, which goes to the archive piece by piece.
class model_writer {
  public:
    model_writer(const write_job& job, zip_builder& archive)
        : job_(job),
          archive_(archive),
          objects_(objects_of(job.file)),
          looks_(job),
          local_(job.file.mesh.points.size()) {}

    /// No less than the model takes.
    [[nodiscard]] std::size_t most_bytes() const {
        const mesh& m = job_.file.mesh;
        std::size_t names = 0;
        for (const written_object& o : objects_) names += o.part.name.size() + 64;
        for (const auto& [name, color] : looks_.materials) names += name.size() + 16;
        return 4096 + 6 * names + 160 * (m.points.size() + m.faces.size()) +
               64 * looks_.colors.size();
    }

    void write() {
        put(xml_head, "<model unit=\"", unit_of(job_.file), "\" xml:lang=\"en-US\" xmlns=\"",
            core_3mf, "\"");
        if (!looks_.colors.empty()) put(" xmlns:m=\"", materials_3mf, "\"");
        put(">\n<metadata name=\"Application\">treeform</metadata>\n<resources>\n");
        put_materials();
        put_colors();
        first_object_ = next_id_;
        for (const written_object& o : objects_) put_object(o);
        put("</resources>\n<build>\n");
        for (std::uint32_t id = first_object_; id < next_id_; ++id)
            put("<item objectid=\"", id, "\"/>\n");
        put("</build>\n</model>\n");
        drain();
        const auto say = [&](bool is_so, const char* code, const std::string& text) {
            if (is_so) job_.result.warnings.push_back({code, text});
        };
        say(looks_.leaves_out_points, "colors-dropped",
            "colors of points left out, since their faces have colors or materials");
        say(count_named(job_.file) > objects_.size(), "data-dropped",
            "names of parts left out, since parts that share points are one object");
        say(looks_.rounds_colors, "colors", "colors are rounded to 8 bits");
        if (looks_.lacks_colors)
            say(true, "materials",
                "materials are written in white, since the faces have no colors: those of " +
                    job_.file.attributes.material_files[0] + " were not read or not kept");
    }

  private:
    template <class... Pieces>
    void put(const Pieces&... pieces) {
        (put_one(pieces), ...);
    }
    void put_one(std::string_view text) { out_.put(text); }
    void put_one(std::uint32_t number) { out_.number(number); }

    void put_color(std::uint32_t color) {
        constexpr std::string_view digits = "0123456789ABCDEF";
        out_.put('#');
        const int last = (color & 0xffU) == 0xffU ? 8 : 0;  // opaque needs no alpha
        for (int shift = 28; shift >= last; shift -= 4) out_.put(digits[color >> shift & 0xfU]);
    }

    void put_materials() {
        if (looks_.materials.empty()) return;
        materials_id_ = next_id_++;
        put("<basematerials id=\"", materials_id_, "\">\n");
        for (const auto& [name, color] : looks_.materials) {
            put("<base name=\"", xml_text(name), "\" displaycolor=\"");
            put_color(color);
            put("\"/>\n");
        }
        put("</basematerials>\n");
    }

    void put_colors() {
        if (looks_.colors.empty()) return;
        colors_id_ = next_id_++;
        put("<m:colorgroup id=\"", colors_id_, "\">\n");
        for (const std::uint32_t color : looks_.colors) {
            put("<m:color color=\"");
            put_color(color);
            put("\"/>\n");
        }
        put("</m:colorgroup>\n");
        drain();
    }

    [[nodiscard]] std::uint32_t id_of(look_list list) const {
        return list == look_list::materials ? materials_id_ : colors_id_;
    }

    /// The look of an object, which its faces have unless they say otherwise. Readers want one
    /// wherever a face has a look.
    [[nodiscard]] face_look usual_look(const written_object& o) const {
        face_look usual = looks_.of(o.part.faces[0]);
        usual.entries.fill(usual.entries[0]);
        return usual;
    }

    void put_object(const written_object& o) {
        put("<object id=\"", next_id_++, "\" type=\"model\"");
        if (!o.part.name.empty()) put(" name=\"", xml_text(o.part.name), "\"");
        const face_look usual = usual_look(o);
        if (usual.list != look_list::none)
            put(" pid=\"", id_of(usual.list), "\" pindex=\"", usual.entries[0], "\"");
        put("><mesh>\n<vertices>\n");
        for (const std::uint32_t v : o.points) put_vertex(v);
        put("</vertices>\n<triangles>\n");
        for (std::uint32_t n = 0; n < o.points.size(); ++n) local_[o.points[n]] = n;
        for (const std::uint32_t f : o.part.faces) put_triangle(f, usual);
        put("</triangles>\n</mesh></object>\n");
        drain();
    }

    void put_vertex(std::uint32_t v) {
        constexpr std::array<std::string_view, 3> names{"<vertex x=\"", "\" y=\"", "\" z=\""};
        const point3& p = job_.file.mesh.points[v];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            out_.put(names[axis]);
            out_.number(job_.rounded(p[axis]));
        }
        put("\"/>\n");
        drain_if_large();
    }

    void put_triangle(std::uint32_t f, const face_look& usual) {
        const face& corners = job_.file.mesh.faces[f];
        put("<triangle v1=\"", local_[corners[0]], "\" v2=\"", local_[corners[1]], "\" v3=\"",
            local_[corners[2]]);
        const face_look& look = looks_.of(f);
        if (look != usual) {
            const face& e = look.entries;
            put("\" pid=\"", id_of(look.list), "\" p1=\"", e[0]);
            if (e[0] != e[1] || e[0] != e[2]) put("\" p2=\"", e[1], "\" p3=\"", e[2]);
        }
        put("\"/>\n");
        drain_if_large();
    }

    void drain() {
        job_.out.check_cancelled();
        out_.flush();
        archive_.put(piece_);
        piece_.clear();
    }
    void drain_if_large() {
        constexpr std::size_t large = std::size_t{1} << 18;
        if (piece_.size() >= large) drain();
    }

    const write_job& job_;
    zip_builder& archive_;
    std::vector<written_object> objects_;
    face_looks looks_;
    std::vector<std::uint32_t> local_;  ///< [V] number of each point in the object being written
    std::string piece_{};
    sink out_{piece_};
    std::uint32_t next_id_ = 1;
    std::uint32_t materials_id_ = 0;
    std::uint32_t colors_id_ = 0;
    std::uint32_t first_object_ = 0;
};

void put_member(zip_builder& archive, const char* name, const std::string& text) {
    archive.begin(name, text.size());
    archive.put(text);
    archive.end();
}

[[nodiscard]] std::string relationships_to(std::string_view model) {
    std::string text(xml_head);
    text +=
        "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">\n";
    text += "<Relationship Target=\"/" + std::string(model) + "\" Id=\"model\" Type=\"";
    text += std::string(model_relationship_3mf) + "\"/>\n</Relationships>\n";
    return text;
}

}  // namespace

void write_3mf(const write_job& job) {
    constexpr const char* model_name = "3D/3dmodel.model";
    check_finite(job, "3MF");
    std::string bytes;
    {
        zip_builder archive(bytes);
        put_member(archive, "[Content_Types].xml",
                   std::string(xml_head) + std::string(content_types));
        put_member(archive, "_rels/.rels", relationships_to(model_name));
        model_writer model(job, archive);
        archive.begin(model_name, model.most_bytes());
        model.write();
        archive.end();
        archive.finish();
    }
    job.out.put(bytes);
}

}  // namespace treeform::detail::io
