#include "tools/shell/mesh_output.hpp"
#include "tools/tf-cut/cutting.hpp"
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/cut.hpp>
#include <treeform/tf.hpp>

#include <system_error>
#include <utility>

namespace tools {
namespace {

constexpr const char* number_mark = "%d";

/// Where "%d" or "%03d" is in the text, and how long; how many digits at least.
struct number_place {
    std::size_t at = std::string::npos, length = 0, digits = 0;
};

number_place number_in(const std::string& text) {
    for (std::size_t at = text.find('%'); at != std::string::npos; at = text.find('%', at + 1)) {
        std::size_t end = at + 1, digits = 0;
        if (end < text.size() && text[end] == '0')
            for (; end < text.size() && text[end] >= '0' && text[end] <= '9' && digits < 10; ++end)
                digits = 10 * digits + static_cast<std::size_t>(text[end] - '0');
        if (end < text.size() && text[end] == 'd') return {at, end + 1 - at, digits};
    }
    return {};
}

/// Of formats with objects, each piece is one.
bool has_objects(const std::string& format) {
    return format == "3mf" || format == "obj" || format == "glb";
}

/// The file of what was made, with the attributes of the input.
tf::mesh_file carried(const cut_settings& s, const usable_input& input, cut_off&& piece) {
    tf::mesh_file file = file_of(std::move(piece.mesh), piece.certificate);
    tf::attribute_sources(input.source())
        .transfer(file, piece.face_source, piece.vertex_source, piece.face_of_new_vertex,
                  piece.corner_source);
    input.source().texture_caps(file, piece.cap);
    if (!s.caps.empty()) {
        std::vector<std::int32_t> cap(piece.cap.begin(), piece.cap.end());  // none is -1
        file.attributes.find_or_add("face", file.mesh.faces.size())
            .set(tf::column::of<std::int32_t>(s.caps, cap));
    }
    return file;
}

/// All pieces as one, and where the faces of each begin.
cut_off together(std::vector<cut_off>& pieces, std::vector<tf::named_faces>& parts) {
    cut_off all;
    std::vector<tf::mesh_view> views;
    for (const cut_off& piece : pieces) {
        parts.push_back({.object = "piece " + std::to_string(views.size()),
                         .first_face = static_cast<std::uint32_t>(all.face_source.size())});
        views.emplace_back(piece.mesh);
        const auto append = [](auto& to, const auto& more) {
            to.insert(to.end(), more.begin(), more.end());
        };
        append(all.face_source, piece.face_source);
        append(all.vertex_source, piece.vertex_source);
        append(all.cap, piece.cap);
        all.certificate.precision = piece.certificate.precision;
    }
    all.mesh = tf::concatenate(views);
    return all;
}

}  // namespace

bool has_number(const std::filesystem::path& path) {
    return number_in(path.string()).at != std::string::npos;
}

std::vector<std::filesystem::path> numbered_paths(job& work, const std::filesystem::path& path,
                                                  std::size_t count) {
    const number_place place = number_in(path.string());
    if (place.at == std::string::npos) return {path};
    std::vector<std::filesystem::path> paths;
    for (std::size_t i = 0; i < count; ++i) {
        std::string digits = std::to_string(i);
        if (digits.size() < place.digits) digits.insert(0, place.digits - digits.size(), '0');
        const std::filesystem::path& one =
            paths.emplace_back(path.string().replace(place.at, place.length, digits));
        std::error_code ignored;
        if (std::filesystem::equivalent(one, work.path, ignored))
            refuse(one.string() + " is an input; no output may replace it");
        check_outputs(work, {one});
    }
    return paths;
}

void check_pieces_path(const common_options& o, const std::string& what) {
    if (o.output.empty() || has_number(o.output)) return;
    const std::string format = mesh_format(o, o.output);
    if (has_objects(format)) return;
    const std::filesystem::path example =
        o.output.parent_path() /
        (o.output.stem().string() + "_" + number_mark + o.output.extension().string());
    refuse("there may be several " + what + ", but " + format + " holds one: use -o " +
           example.string() + ", or write 3mf, obj or glb");
}

void write_pieces(job& work, const cut_settings& s, const usable_input& input,
                  std::vector<cut_off>& pieces) {
    const common_options& o = work.options;
    const auto output = mesh_output(o, work.path);
    if (!output || o.dry_run) return;
    const auto timing = work.time("write");
    const written_form form = form_of(work, input.file, *output);
    if (const tf::attribute_source source = input.source();
        tf::attribute_sources(source).has_values_left_out())
        work.warn("attributes", "not all properties of the input are carried over");
    const auto write = [&](tf::mesh_file&& file, const std::filesystem::path& path, double moved,
                           bool certified) {
        if (certified) return write_certified(work, file, form, path, moved);
        tf::write_options how = write_options_for(o, form);
        if (!how.precision) how.precision = file.stored_as;
        write_mesh(work, file, how, path, moved);
    };
    if (!has_number(*output) && pieces.size() != 1) {
        std::vector<tf::named_faces> parts;
        cut_off all = together(pieces, parts);
        tf::mesh_file file = carried(s, input, std::move(all));
        file.attributes.parts = std::move(parts);
        for (json& piece : work.entry["pieces"]) piece["file"] = output->string();
        write(std::move(file), *output, 0.0, false);
        return;
    }
    const auto paths = numbered_paths(work, *output, pieces.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const double moved = pieces[i].certificate.max_displacement;
        const bool certified = s.mode != cut_mode::parts && !s.open;
        write(carried(s, input, std::move(pieces[i])), paths[i], moved, certified);
        work.entry["pieces"][i]["file"] = paths[i].string();
    }
}

}  // namespace tools
