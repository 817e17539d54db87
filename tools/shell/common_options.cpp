#include "tools/shell/common_options.hpp"

#include "tools/manual/manual.hpp"
#include "tools/shell/exit_status.hpp"
#include "tools/shell/file_names.hpp"
#include "tools/shell/parse_value.hpp"
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace tools {
namespace {

namespace fs = std::filesystem;

bool offers(const common_options& o, const std::string& format) {
    return std::find(o.mesh_formats.begin(), o.mesh_formats.end(), format) != o.mesh_formats.end();
}

void add_output_options(command_line& line, common_options& o, const common_features& features) {
    if (features.output_formats.empty()) return;
    if (features.one_result) {
        for (const char* const name : {"--output-dir", "--suffix"})
            line.refuse(name, true, "all inputs together give one result; use -o");
        line.refuse("--in-place", false, "all inputs together give one result; use -o");
        return;
    }
    line.option({"--output-dir", "DIR",
                 "write one result for each INPUT, STEM+SUFFIX.EXT;\nDIR is created if needed"},
                [&o](std::string_view value) { o.output_dir = value; });
    line.option(o.suffix, {"--suffix", "TEXT", "SUFFIX of the names in --output-dir", o.suffix});
    line.flag(o.in_place, {.names = "--in-place",
                           .text = "replace each INPUT (write a new file, then rename it)"});
}

void add_format_options(command_line& line, common_options& o, const common_features& features) {
    line.option(o.format, {"--format", "EXT", "format of the inputs", "content, then extension"});
    if (features.output_formats.empty()) return;
    line.option(o.output_format,
                {"--output-format", "EXT", joined(features.output_formats, " "), "extension of -o"},
                features.output_formats);
    line.flag(o.ascii, {.names = "--ascii",
                        .text = "text or binary, if the format has both",
                        .fallback = "binary",
                        .label = "--ascii, --binary"});
    line.flag(o.binary, {.names = "--binary"});
    line.option(o.precision,
                {"--precision", "P", "of written coordinates: float | double | keep", "keep"},
                {"float", "double", "keep"});
}

/// What --view takes: the views, and all of a drawing.
std::vector<const char*> view_words() {
    std::vector<const char*> words(view_names.begin(), view_names.end());
    words.push_back("all");
    return words;
}

/// "iso,top": all is iso and the three of a drawing.
std::vector<view> parse_views(std::string_view text) {
    std::vector<view> views;
    while (true) {
        const std::size_t comma = text.find(',');
        const std::size_t word = parse_choice("--view", text.substr(0, comma), view_words());
        if (word < view_names.size())
            views.push_back(static_cast<view>(word));
        else
            views.insert(views.end(), {view::iso, view::top, view::front, view::right});
        if (views.size() > 16) refuse("--view: expected at most 16 views");
        if (comma == std::string_view::npos) return views;
        text.remove_prefix(comma + 1);
    }
}

/// "1600x1200"
void parse_picture_size(std::string_view text, picture_options& target) {
    const std::size_t cross = text.find('x');
    if (cross == std::string_view::npos)
        refuse("--png-size " + std::string(text) + ": expected WxH, such as 1600x1200");
    target.width = parse_count("--png-size", text.substr(0, cross));
    target.height = parse_count("--png-size", text.substr(cross + 1));
    for (const std::size_t side : {target.width, target.height})
        if (side < least_side || side > most_side)
            refuse("--png-size " + std::string(text) + ": expected sides of " +
                   std::to_string(least_side) + " to " + std::to_string(most_side) + " pixels");
}

void add_picture_options(command_line& line, common_options& o) {
    line.output(o.html, {"--html", "FILE", "self-contained HTML page with a 3D view"});
    line.output(o.png, {"--png", "FILE",
                        "a picture in the colors of the page; needs no\n"
                        "display and no browser"});
    line.option({"--view", "V,...",
                 "views in --png: iso top bottom front back left right;\n"
                 "several are drawn side by side; all is\n"
                 "iso,top,front,right",
                 "iso"},
                [&o](std::string_view value) { o.picture.views = parse_views(value); });
    line.option({"--png-size", "WxH", "size of --png in pixels", "1600x1200"},
                [&o](std::string_view value) { parse_picture_size(value, o.picture); });
}

void add_run_options(command_line& line, common_options& o) {
    line.option({"-j, --threads", "N", "worker threads; results do not depend on N", "all"},
                [&o](std::string_view value) {
                    const std::uint64_t count = parse_count("--threads", value);
                    if (count < 1 || count > 1024) refuse("--threads: expected 1 to 1024");
                    o.threads = static_cast<unsigned>(count);
                });
    line.option({"--memory", "SIZE", "memory limit, such as 4G or 512M; none: no limit",
                 "memory free at the start"},
                [&o](std::string_view value) {
                    o.all_memory = value == "none";
                    o.memory = o.all_memory ? 0 : parse_size("--memory", value);
                });
    line.option({"--timeout", "SEC", "stop after SEC seconds", "no limit"},
                [&o](std::string_view value) { o.timeout = parse_seconds("--timeout", value); });
    line.flag(o.progress, {.names = "--progress",
                           .text = "progress on stderr",
                           .fallback = "only if stderr is a terminal"});
    line.option(o.color,
                {"--color", "WHEN",
                 "auto | always | never; auto: on a terminal, unless\nNO_COLOR is set", "auto"},
                {"auto", "always", "never"});
    line.flag(o.quiet, {.names = "-q, --quiet", .text = "errors only"});
    line.repeatable_flag(o.verbose,
                         {.names = "-v, --verbose", .text = "print details (repeatable)"});
    line.option(o.log, {"--log", "FILE", "also append messages of stderr to FILE"});
    line.flag(o.exit_zero, {.names = "--exit-zero", .text = "exit status 0 instead of 1"});
    line.mention({.names = "-h, --help", .text = "this text"});
    line.mention({.names = "--version", .text = "version and build"});
}

/// Of files in folders, and for completion; any of them may be read also when others are meant.
std::vector<std::string> extensions_of(const common_options& o) {
    std::vector<std::string> all{"stl", "obj", "ply", "off", "3mf", "glb", "gltf"};
    if (o.takes_points)
        for (const char* const more : {"pcd", "las", "laz", "xyz", "csv", "pts", "asc"})
            all.emplace_back(more);
    return all;
}

/// A byte is enough for a reader to say that there is none for the format.
void check_format(const common_options& o) {
    if (o.format.empty()) return;
    constexpr std::byte blank{' '};
    try {
        static_cast<void>(tf::read(std::span(&blank, 1), "--format", o.format));
    } catch (const tf::io_error& error) {
        const std::string text = error.what();
        if (text.ends_with("' is not supported")) refuse(text);
    }
}

void check_outputs(const command_line& line, const common_options& o) {
    const std::vector<fs::path> outputs = line.outputs();
    if (std::count(outputs.begin(), outputs.end(), "-") > 1)
        refuse("only one output can go to standard output");
    if (o.inputs.size() < 2 || o.joined) return;
    for (const fs::path& path : outputs)
        if (path != o.report)
            refuse(path.string() + ": one output file for " + std::to_string(o.inputs.size()) +
                   " inputs; only -r takes several inputs; --output-dir writes a mesh for each");
}

void check_in_place(const common_options& o) {
    if (!o.in_place) return;
    if (!o.output.empty() || !o.output_dir.empty())
        refuse("--in-place excludes -o and --output-dir");
    if (o.joined) refuse("--in-place: several inputs cannot become one file; use -o");
    if (!o.output_format.empty()) refuse("--in-place keeps the format; --output-format needs -o");
    if (std::count(o.inputs.begin(), o.inputs.end(), "-") > 0)
        refuse("--in-place: standard input cannot be replaced; use -o");
}

void check_output_folder(const common_options& o) {
    if (o.output_dir.empty()) return;
    if (!o.output.empty()) refuse("-o and --output-dir exclude each other");
    if (o.joined) refuse("--output-dir: all inputs together give one result; use -o");
    if (o.suffix.find('/') != std::string::npos) refuse("--suffix: no / allowed");
}

/// What is written beside the inputs that --in-place replaces.
std::vector<fs::path> written_files(const command_line& line, const common_options& o) {
    std::vector<fs::path> files = line.outputs();
    std::erase(files, "-");
    if (!o.log.empty()) files.emplace_back(o.log);
    if (!o.output_dir.empty())
        for (const auto& input : o.inputs) files.push_back(*mesh_output(o, input));
    return files;
}

}  // namespace

void add_common_options(command_line& line, common_options& target,
                        const common_features& features) {
    common_options& o = target;
    o.mesh_formats = features.output_formats;
    add_output_options(line, o, features);
    line.flag(
        o.force,
        {.names = "-f, --force", .text = "overwrite existing files", .fallback = "refuse, exit 4"});
    if (!features.output_formats.empty())
        line.flag(o.dry_run, {.names = "-n, --dry-run",
                              .text = "compute, but write no mesh (reports are written)"});
    add_format_options(line, o, features);
    line.option(
        o.unit,
        {"--units", "U", "unit of the inputs: mm cm m in ft; STL, OBJ, PLY and\nOFF carry none",
         "what a 3MF declares"},
        {"mm", "cm", "m", "in", "ft"});
    line.output(o.report, {"-r, --report", "FILE", "JSON report; \"-\" = stdout"});
    if (features.page) add_picture_options(line, o);
    add_run_options(line, o);
    const std::vector<std::string> read = extensions_of(o);
    line.offer_inputs(read);
    line.offer("--format", read);
    line.offer("--fixed", read);
    line.offer("--output", features.output_formats);
    line.offer("--report", {"json"});
    line.offer("--html", {"html"});
    line.offer("--png", {"png"});
    const std::vector<const char*> views = view_words();
    line.offer("--view", {views.begin(), views.end()});
    line.offer("--curves", {"obj", "ply"});
    line.offer("--pairs", {"csv"});
    line.offer("--map", {"csv"});
}

void list_folders(common_options& o) {
    const auto first = o.inputs.begin();
    const bool word = std::count(o.words.begin(), o.words.end(), *first) > 0;
    const auto files = files_of({first + (word ? 1 : 0), o.inputs.end()}, extensions_of(o));
    o.inputs.resize(word ? 1 : 0);
    o.inputs.insert(o.inputs.end(), files.begin(), files.end());
}

void check_common_options(const command_line& line, const common_options& options) {
    if (options.ascii && options.binary) refuse("--ascii and --binary exclude each other");
    if (options.quiet && (options.verbose > 0 || options.progress))
        refuse("-q excludes -v and --progress");
    const auto from_standard_input = [](const std::vector<std::string>& names) {
        return std::count(names.begin(), names.end(), "-");
    };
    if (from_standard_input(options.inputs) + from_standard_input(options.also_read) > 1)
        refuse("standard input can be read only once");
    if (options.log == "-") refuse("--log -: messages go to stderr anyway; expected a FILE");
    if (options.output == "-" && options.output_format.empty())
        refuse("-o - needs --output-format");
    if (!options.output.empty()) static_cast<void>(mesh_format(options, options.output));
    for (const char* name : {"--view", "--png-size"})
        if (options.png.empty() && line.given(name)) refuse(std::string(name) + " needs --png");
    if (const std::string format = extension_of(options.png); !format.empty() && format != "png")
        refuse(options.png.string() + ": a picture is written as png");
    check_format(options);
    check_outputs(line, options);
    check_output_folder(options);
    check_in_place(options);
}

void check_files(const command_line& line, const common_options& options) {
    file_names read;
    for (const auto& input : options.inputs)
        if (input != "-" && !read.add(input) && options.in_place)
            refuse(input + " is given twice; --in-place replaces a file once");
    for (const auto& other : options.also_read)
        if (options.in_place && read.holds(other))
            refuse(other + " is also read for other inputs; --in-place may not replace it");
    for (const auto& other : options.also_read)
        if (other != "-") read.add(other);
    file_names written;
    for (const fs::path& path : written_files(line, options)) {
        if (read.holds(path)) refuse(path.string() + " is an input; no output may replace it");
        if (!written.add(path)) refuse(path.string() + " is given for two outputs");
    }
}

void require_output(const command_line& line, const common_options& options,
                    const std::string& instead) {
    if (wants_mesh(options) || options.dry_run || !line.outputs().empty()) return;
    const std::string& last = options.inputs.back();
    std::error_code ignored;
    if (options.inputs.size() > 1 && last != "-" && !fs::exists(last, ignored))
        refuse(last + ": no such file; to write the result there, type -o " + last);
    refuse("no output: -o FILE writes the result, " + instead);
}

bool wants_mesh(const common_options& options) {
    return !options.output.empty() || !options.output_dir.empty() || options.in_place;
}

std::string stem_of(const std::string& input) {
    return input == "-" ? "stdin" : fs::path(input).stem().string();
}

std::optional<std::filesystem::path> mesh_output(const common_options& options,
                                                 const std::string& input) {
    if (!options.output.empty()) return options.output;
    if (options.in_place) return input;
    if (options.output_dir.empty()) return std::nullopt;
    std::string format =
        options.output_format.empty() ? extension_of(input) : options.output_format;
    if (!offers(options, format)) format = options.mesh_formats.front();
    return options.output_dir / (stem_of(input) + options.suffix + "." + format);
}

std::string mesh_format(const common_options& options, const fs::path& path) {
    std::string format = options.output_format.empty() ? extension_of(path) : options.output_format;
    if (format == "txt" || format == "asc") format = "xyz";
    if (!offers(options, format))
        refuse(path.string() + ": the mesh can be written as " + joined(options.mesh_formats, " "));
    return format;
}

std::string extension_of(const std::filesystem::path& path) {
    std::string text = path.extension().string();
    if (!text.empty()) text.erase(0, 1);
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

}  // namespace tools
