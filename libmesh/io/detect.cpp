#include <libmesh/base/byte_order.hpp>
#include <libmesh/io/detect.hpp>
#include <libmesh/io/readers.hpp>
#include <libmesh/io/text.hpp>
#include <libmesh/io/text_columns.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace treeform::detail::io {

namespace {

[[nodiscard]] std::string_view head_of(const source& in) {
    return {in.begin(), std::min<std::size_t>(in.size(), 4096)};
}

/// The size decides, whatever the header says: many exporters start it with "solid".
[[nodiscard]] bool is_binary_stl(const source& in) {
    return in.size() >= 84 &&
           in.size() == 84 + std::size_t{50} *
                                 base::load<std::uint32_t, std::endian::little>(in.begin() + 80);
}

/// Text has no zero byte and few other control characters; bytes above 127 may be names in any
/// character set.
[[nodiscard]] bool is_text(std::string_view head) {
    const auto control = [](char c) { return c >= 0 && c < ' ' && !is_space(c); };
    return std::none_of(head.begin(), head.end(), [](char c) { return c == '\0'; }) &&
           std::count_if(head.begin(), head.end(), control) * 20 <=
               static_cast<std::ptrdiff_t>(head.size());
}

void refuse_utf16(const source& in) {
    const std::string_view head = head_of(in);
    if (head.starts_with("\xfe\xff") || head.starts_with("\xff\xfe"))
        in.fail_byte(in.begin(), "UTF-16 text; convert it to UTF-8 or ASCII");
}

void refuse_unless_text(const source& in) {
    refuse_utf16(in);
    if (!is_text(head_of(in))) in.fail("binary data in a text file");
}

[[nodiscard]] bool is_off_word(std::string_view word) {
    for (const std::string_view prefix : {"ST", "C", "N", "4", "n"})
        if (word.starts_with(prefix)) word.remove_prefix(prefix.size());
    return word == "OFF";
}

[[nodiscard]] bool is_obj_word(std::string_view word) {
    constexpr std::array<std::string_view, 12> words{"v", "vt", "vn", "vp", "f",      "l",
                                                     "p", "g",  "o",  "s",  "usemtl", "mtllib"};
    return std::find(words.begin(), words.end(), word) != words.end();
}

/// The comment ahead of it is often missing.
[[nodiscard]] bool is_pcd_header(text t) {
    if (t.text_done() || t.word() != "VERSION") return false;
    t.skip_line();
    if (t.text_done()) return false;
    const std::string_view next = t.word();
    return next == "FIELDS" || next == "COLUMNS";
}

[[noreturn]] void refuse_e57(const source& in) {
    in.fail("E57 is not supported; convert it first with PDAL: pdal translate in.e57 out.laz");
}

[[nodiscard]] std::optional<detected> by_magic(const source& in, std::string_view extension) {
    text t(in);
    if (t.starts_with("ply\n") || t.starts_with("ply\r") || t.starts_with("ply "))
        return detected{file_kind::ply};
    if (t.starts_with("# .PCD") || is_pcd_header(t)) return detected{file_kind::pcd};
    if (t.starts_with("LASF")) return detected{file_kind::las};
    if (t.starts_with("ASTM-E57")) refuse_e57(in);
    if (t.starts_with("glTF")) return detected{file_kind::gltf};
    if (is_binary_stl(in)) return detected{file_kind::stl_binary};
    if (t.starts_with("PK\x03\x04"))
        return extension == "zae" ? detected{file_kind::scene, "zae"}
                                  : detected{file_kind::package_3mf};
    if (!t.text_done() && is_off_word(t.word())) return detected{file_kind::off};
    return std::nullopt;
}

[[nodiscard]] bool holds_word(std::string_view head, std::string_view word) {
    const auto same = [](char a, char b) { return to_lower(a) == b; };
    return std::search(head.begin(), head.end(), word.begin(), word.end(), same) != head.end();
}

/// STL that is not binary by its size: text, maybe with zero bytes, or binary whose count is wrong.
/// Coordinates are not read from any other text.
[[nodiscard]] detected stl_kind(const source& in) {
    const std::string_view head = head_of(in);
    text t(in);
    t.skip_spaces();
    const bool worded =
        starts_with_word(t.at, t.end, "solid") || starts_with_word(t.at, t.end, "facet");
    if (worded && (is_text(head) || (holds_word(head, "facet") && holds_word(head, "vertex"))))
        return {file_kind::stl_text};
    refuse_utf16(in);
    if (is_text(head)) in.fail("neither a binary STL nor text that starts with 'solid'");
    return {file_kind::stl_binary};
}

[[nodiscard]] std::optional<file_kind> text_kind(std::string_view extension) {
    if (extension == "obj") return file_kind::obj;
    if (extension == "off") return file_kind::off;
    if (extension == "csv") return file_kind::csv;
    if (extension == "pts") return file_kind::pts;
    constexpr std::array<std::string_view, 3> tables{"xyz", "txt", "asc"};
    if (std::find(tables.begin(), tables.end(), extension) != tables.end()) return file_kind::xyz;
    return std::nullopt;
}

/// For names that say nothing: what the first line looks like.
[[nodiscard]] std::optional<detected> by_first_line(const source& in) {
    text t(in);
    if (t.text_done()) return std::nullopt;
    if (starts_with_word(t.at, t.end, "solid")) return stl_kind(in);
    if (!is_text(head_of(in))) return std::nullopt;
    if (parse_number(t.at, t.end).end != nullptr) return detected{file_kind::xyz};
    const std::string_view line = text(t).rest_of_line();
    if (find_axes(split_heading(line)))
        return detected{line.find(',') == std::string_view::npos ? file_kind::xyz : file_kind::csv};
    if (is_obj_word(t.word())) return detected{file_kind::obj};
    return std::nullopt;
}

}  // namespace

std::string_view table_name(file_kind kind) {
    if (kind == file_kind::xyz) return "xyz";
    if (kind == file_kind::pts) return "pts";
    return kind == file_kind::csv ? "csv" : "";
}

void check_chosen_columns(const source& in, const reading& how, file_kind kind) {
    if (!how.options.columns.empty() && table_name(kind).empty())
        in.fail("columns can be chosen only for XYZ, PTS and CSV");
}

detected detect(const source& in, std::string_view format, std::string_view extension) {
    if (in.size() == 0) in.fail("empty file");
    const std::string_view wanted = format.empty() ? extension : format;
    if (format.empty())
        if (auto found = by_magic(in, extension)) return *std::move(found);
    if (wanted == "ply") return {file_kind::ply};
    if (wanted == "pcd") return {file_kind::pcd};
    if (wanted == "3mf") return {file_kind::package_3mf};
    if (wanted == "glb" || wanted == "gltf" || wanted == "vrm") return {file_kind::gltf};
    if (wanted == "las" || wanted == "laz") {
        if (!text(in).starts_with("LASF")) in.fail_byte(in.begin(), "not a LAS or LAZ file");
        return {file_kind::las};
    }
    if (wanted == "e57") refuse_e57(in);
    if (wanted == "ptx")
        in.fail(
            "PTX is not supported, since each scan has its own transform; convert it first with "
            "CloudCompare: CloudCompare -O in.ptx -C_EXPORT_FMT LAS -SAVE_CLOUDS");
    if (wanted == "stl") return is_binary_stl(in) ? detected{file_kind::stl_binary} : stl_kind(in);
    if (const auto kind = text_kind(wanted)) {
        refuse_unless_text(in);
        return {*kind};
    }
    if (!wanted.empty() && scene_format(wanted)) return {file_kind::scene, std::string(wanted)};
    if (!format.empty()) in.fail("format '" + std::string(format) + "' is not supported");
    if (auto found = by_first_line(in)) return *std::move(found);
    in.fail("not in a supported format");
}

}  // namespace treeform::detail::io
