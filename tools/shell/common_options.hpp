#pragma once
/// \file
/// The options that all tools share.

#include "tools/picture/view.hpp"
#include "tools/shell/command_line.hpp"
#include <treeform/mesh/read.hpp>
#include <treeform/tf.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tools {

/// A number of each entry of the report.
struct table_column {
    std::string title{};
    std::string key{};   ///< "/pairs/crossing"
    bool summed = true;  ///< whether a total makes sense
};

/// Names of columns, and what they are called in a file.
using name_pairs = std::vector<std::pair<std::string, std::string>>;

struct common_options {
    std::vector<std::string> inputs;
    bool takes_points = false;           ///< of a folder among the inputs, files of points, too
    std::vector<std::string> words;      ///< one of which may stand ahead of the inputs
    std::vector<std::string> also_read;  ///< files that are read beside the inputs, of any kind
    std::filesystem::path output;
    std::filesystem::path output_dir;
    std::string suffix;     ///< for `output_dir`
    bool in_place = false;  ///< the mesh replaces its input
    bool joined = false;    ///< all inputs are one set, and give one result
    bool force = false;
    bool dry_run = false;
    std::string format;  ///< of the inputs; empty: by content
    name_pairs columns;  ///< of tables of text
    bool drop_non_finite = false;
    std::vector<std::string> drop;  ///< columns of points that are not written
    name_pairs rename;              ///< of points that are written
    std::optional<std::array<double, 3>> las_scale;
    std::optional<std::array<double, 3>> las_offset;
    std::string output_format;  ///< empty: by extension
    bool ascii = false;
    bool binary = false;
    std::string precision = "keep";
    std::string unit = "unknown";
    std::filesystem::path report;
    std::filesystem::path html;
    std::filesystem::path png;
    picture_options picture;
    unsigned threads = 0;      ///< 0: all
    std::uint64_t memory = 0;  ///< as asked for; 0: not asked
    bool all_memory = false;   ///< --memory none
    double timeout = 0.0;
    bool progress = false;
    std::string color = "auto";
    bool in_team = false;                              ///< processes of mpirun share the work
    std::function<void(const std::string&)> failed{};  ///< receives the error that is said
    bool quiet = false;
    int verbose = 0;
    std::string log;
    bool exit_zero = false;                 ///< 0 instead of 1
    std::vector<table_column> table;        ///< of many inputs, on a terminal
    std::vector<std::string> mesh_formats;  ///< that the tool writes, the preferred one first

    /// Whether a report of some kind wants every fact.
    [[nodiscard]] bool detailed() const { return !report.empty() || shows(); }
    /// Whether a page or a picture is asked for.
    [[nodiscard]] bool shows() const { return !html.empty() || !png.empty(); }
};

/// What of the common options a tool offers.
struct common_features {
    std::vector<std::string> output_formats;  ///< extensions; empty: writes no mesh
    bool one_result = false;                  ///< of all inputs: then --output-dir makes none
    bool page = true;                         ///< --html and --png
};

/// What most tools read.
inline constexpr const char* mesh_inputs =
    "STL OBJ PLY OFF GLB/glTF 3MF files, or folders of\n"
    "them; \"-\" = stdin";

/// Adds them to `line` as a group of their own; `target` must outlive the parsing.
void add_common_options(command_line& line, common_options& target,
                        const common_features& features);

/// Replaces folders among the inputs by the files in them.
void list_folders(common_options& options);

/// What only shows when all options are known, such as options that exclude each other.
/// \throws failure (bad_usage)
void check_common_options(const command_line& line, const common_options& options);

/// That no file is written that is read, or written twice, however it is spelled. All that is read
/// must be named in `options` by now. \throws failure (bad_usage)
void check_files(const command_line& line, const common_options& options);

/// That the result goes somewhere: to a mesh, a report or another output, or that -n says it need
/// not. \throws failure (bad_usage) that also names what does without, `instead`
void require_output(const command_line& line, const common_options& options,
                    const std::string& instead = "-n only prints what it would be");

/// Whether some option asks for a mesh.
[[nodiscard]] bool wants_mesh(const common_options& options);

/// Where the mesh made from `input` goes; none when no mesh is asked for.
[[nodiscard]] std::optional<std::filesystem::path> mesh_output(const common_options& options,
                                                               const std::string& input);

/// The format in which `path` is to be written, by its extension unless --output-format says; txt
/// and asc are xyz. \throws failure (bad_usage) for one not offered
[[nodiscard]] std::string mesh_format(const common_options& options,
                                      const std::filesystem::path& path);

/// Its name without folder and extension; "stdin" of "-".
[[nodiscard]] std::string stem_of(const std::string& input);

/// The file's extension in small letters, without its dot.
[[nodiscard]] std::string extension_of(const std::filesystem::path& path);

}  // namespace tools
