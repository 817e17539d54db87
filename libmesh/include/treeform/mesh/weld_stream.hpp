#pragma once
/// \file
/// Clouds larger than memory, welded from file to file.
///
///     tf::weld_stream("scan.ply", "thin.ply", {.tolerance = 0.5});
///
/// The cloud is read three times: to look at it (its box, how many points, a sample that says where
/// to cut), to give each tile its points, and to write what is kept. Tiles lie in a folder on the
/// disk, which outlives the process: the same call goes on where an earlier one was ended. What
/// comes out is to the byte what `weld` of the whole cloud gives.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/weld_options.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tree/detail/export.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace treeform {

struct weld_stream_options {
    double tolerance = 0.0;  ///< as in `weld_options`
    bool relative = false;   ///< `tolerance` is a share of the diagonal of the cloud's box
    weld_rule rule = weld_rule::first;
    std::string format{};               ///< of the input, as for `read`
    std::uint64_t memory = 0;           ///< bytes that the process may take; 0: `default_memory`
    std::filesystem::path folder{};     ///< for the tiles; empty: the input's name and ".tiles"
    std::uint64_t points_per_tile = 0;  ///< at most, about; 0: as the memory allows
    /// Told the step ("look", "scatter", "weld", "write") and its share done; false cancels.
    std::function<bool(std::string_view, double)> progress{};
    /// Called after each step that an interrupted run need not do again.
    std::function<void()> step_done{};
};

/// What is known of a cloud before it is welded.
struct cloud_survey {
    std::uint64_t points = 0;
    std::uint64_t non_finite = 0;  ///< points with a NaN or infinite coordinate; all are kept
    std::optional<box3> box{};     ///< of the finite points
    bool single = true;            ///< float32 holds every coordinate
    std::string format{};          ///< "ply-binary", ...
    std::vector<io_warning> warnings{};
    double tolerance = 0.0;  ///< as a length
    std::size_t tiles = 0;
    std::size_t finished_tiles = 0;  ///< by an earlier run
    bool continued = false;          ///< what an earlier run has left is of use
    bool started_anew = false;       ///< something was left, but by another task or not whole
    std::vector<std::filesystem::path> damaged{};  ///< files left that are not what was written
    std::uint64_t disk_bytes = 0;  ///< that the tiles will take, about; 0 when they are there
    std::optional<std::uint64_t> disk_bytes_free{};
};

struct weld_stream_counts {
    std::uint64_t kept = 0;
    std::uint64_t groups = 0;       ///< of two points or more
    double max_displacement = 0.0;  ///< the least double that is no less than any move
};

/// What is written; each part may be left out.
struct weld_stream_outputs {
    struct file {
        std::filesystem::path path{};
        write_options options{};
    };
    std::optional<file> welded{};
    std::optional<file> removed{};  ///< the dropped points
    /// Then `welded` gets all points, and this property (uint32) with the group of each.
    std::string label{};
    /// Given the new numbers of the next points of the input, front to back.
    std::function<void(std::span<const std::uint64_t>)> map{};
    /// Folders, with names that begin with ".unfinished-", which the caller removes after `write`.
    /// Should the process be killed before, the next run removes them.
    std::vector<std::filesystem::path> unfinished{};
};

struct weld_stream_written {
    std::optional<write_result> welded{};
    std::optional<write_result> removed{};
    bool label_replaced = false;  ///< a property of that name was there before
};

struct weld_stream_result {
    cloud_survey survey{};
    weld_stream_counts counts{};
    weld_stream_written written{};
    treeform::status status = status::ok;  ///< or cancelled: nothing is written, the folder stays
};

/// What is wrong with the files that `weld_stream` works with; `what()` names the path.
class TREEFORM_API weld_stream_error : public std::runtime_error {
  public:
    enum class reason : std::uint8_t {
        folder,          ///< cannot be made or written to
        folder_in_use,   ///< by another process
        folder_foreign,  ///< holds files of others
        write,           ///< of a tile
        read,            ///< of a tile
        damaged,         ///< a tile is not what was written
        input_changed    ///< while it was welded
    };
    weld_stream_error(reason why, std::filesystem::path path, const std::string& text);

    [[nodiscard]] reason why() const { return why_; }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    reason why_;
    std::filesystem::path path_;
};

/// Welds the cloud in the file `input` (PLY without faces, PCD, XYZ, CSV), and writes what is asked
/// for. Each output appears whole or not at all.
///
/// \throws io_error when `input` cannot be read or an output not be written, weld_stream_error,
///         std::invalid_argument for a tolerance that is negative or not finite
/// \cost   O(V log V) time; memory as told, and a bit a point; on the disk 34 bytes a point
/// \same   on any number of threads, with any memory and any folder
TREEFORM_API weld_stream_result weld_stream(const std::filesystem::path& input,
                                            const weld_stream_outputs& outputs,
                                            const weld_stream_options& options);

/// The same where `output` is all that is asked for.
TREEFORM_API weld_stream_result weld_stream(const std::filesystem::path& input,
                                            const std::filesystem::path& output,
                                            const weld_stream_options& options);

/// The same step by step, for callers who have something to say or to decide in between: `look`,
/// `scatter`, `weld`, `write`, each once and in this order, as long as they return status::ok.
class TREEFORM_API stream_weld {
  public:
    /// Takes the folder, and removes what a run that was killed has left elsewhere.
    stream_weld(std::filesystem::path input, weld_stream_options options);
    ~stream_weld();
    stream_weld(stream_weld&&) noexcept;
    stream_weld& operator=(stream_weld&&) noexcept;

    /// Reads the cloud, or knows it from an earlier run, and says where it will be cut.
    [[nodiscard]] status look();
    [[nodiscard]] const cloud_survey& survey() const;
    /// Gives each tile its points.
    [[nodiscard]] status scatter();
    /// Welds the tiles that are not finished, and what lies along their borders.
    [[nodiscard]] status weld();
    [[nodiscard]] const weld_stream_counts& counts() const;
    /// Writes the outputs, each whole or not at all.
    [[nodiscard]] status write(const weld_stream_outputs& outputs);
    [[nodiscard]] const weld_stream_written& written() const;
    /// Last, when all that came of it is where it belongs.
    void remove_folder();

  private:
    struct state;
    std::unique_ptr<state> state_;
};

/// Bytes that a process may well take where nobody says how many: three quarters of the machine's.
[[nodiscard]] TREEFORM_API std::uint64_t default_memory();

/// Bytes that welding `points` points with the properties of `header` in memory takes, measured:
/// their places once, their properties twice, and what finds neighbors. An empty cloud takes some
/// 32 MB, which is not counted here.
[[nodiscard]] TREEFORM_API std::uint64_t memory_to_weld(const mesh_file& header,
                                                        std::uint64_t points);

}  // namespace treeform
