#pragma once
/// \file
/// Welds clouds and meshes that are larger than memory, from file to file.
///
///     tf::weld_stream("scan.ply", "thin.ply", {.tolerance = 0.5});
///
/// The cloud, in one file or several, is read three times: for a survey (its box, the number of its
/// points, a sample that says where to cut), to give each tile its points, and to write what is
/// kept; an order and a choice of what is kept read it once more, and so does a mesh, whose faces
/// are read three times. Tiles are in a folder on the disk. It stays when the process is killed,
/// and the same call goes on from there. The output is byte for byte that of `weld`, for the whole
/// cloud or what `join` makes of several.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/point_stream.hpp>
#include <treeform/mesh/weld.hpp>
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
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace treeform {

/// How to weld from file to file.
struct weld_stream_options {
    double tolerance = 0.0;  ///< as in `weld_options`
    bool relative = false;   ///< `tolerance` is a share of the diagonal of the cloud's box
    bool chain = false;      ///< as in `weld_options`
    std::vector<weld_condition> same{};  ///< as in `weld_options`, and so are the next four
    weld_keep keep = weld_keep::first;   ///< others need points without lists
    std::string keep_by{};
    std::string order_by{};
    bool highest_first = false;
    bool keep_seams = false;  ///< of a mesh, as in `weld_options`, and so are the next two
    std::vector<std::string> across{};
    bool keep_degenerate = false;
    /// Coordinates, and means of them, are rounded to the steps of the first file if it is LAS,
    /// else to those of `round_to_las`, before anything is decided of them.
    bool as_las = false;
    std::optional<std::array<double, 3>> las_scale{}, las_offset{};  ///< as in `write_options`
    std::uint64_t memory = 0;           ///< bytes that the process may take; 0: `default_memory`
    std::filesystem::path folder{};     ///< for the tiles; empty: the input's name and ".tiles"
    std::uint64_t points_per_tile = 0;  ///< at most about this many; 0: as the memory allows
    treeform::communicator communicator{};
    bool shared = false;  ///< see `shared_weld`
    /// Gets the step ("survey", "scatter", "weld", "borders", "write"), its share; false cancels.
    std::function<bool(std::string_view, double)> progress{};
    std::function<void()> step_done{};  ///< called after what an interruption does not undo

    /// The memory limit when none is given: three quarters of the machine's memory, in bytes.
    [[nodiscard]] TREEFORM_API static std::uint64_t default_memory();

    /// About how many bytes it takes to weld `points` points with the properties of `header` in
    /// memory, from measurements: coordinates once, properties twice, and the index that finds
    /// neighbors. The process itself takes some 32 MB more.
    [[nodiscard]] TREEFORM_API static std::uint64_t memory_to_weld(const mesh_file& header,
                                                                   std::uint64_t points);

    /// The least `memory` with which `points` points can be welded in tiles. Where
    /// points are crowded, and with `chain`, the limit may turn out higher
    /// (`io_error::kind::memory`).
    [[nodiscard]] TREEFORM_API static std::uint64_t memory_to_stream(const mesh_file& header,
                                                                     std::uint64_t points);
};

/// What is known of a cloud before it is welded.
struct cloud_survey {
    std::uint64_t points = 0;
    std::uint64_t faces = 0;  ///< of a mesh, as stored; and cut into triangles
    std::uint64_t triangles = 0;
    std::uint64_t non_finite = 0;  ///< points with a NaN or infinite coordinate; all are kept
    std::optional<box3> box{};     ///< of the finite points
    bool single = true;            ///< float32 holds every coordinate exactly, and no file is LAS
    /// Of each file: its format, `stored_as`, here by its values as `single`, and as many rows of
    /// the element "vertex" as it has points.
    std::vector<mesh_file> sources{};
    std::vector<value_range> ranges{};  ///< as `mesh_file::ranges`
    std::vector<io_warning> warnings{};
    double las_moved = 0.0;  ///< the furthest that a coordinate went to a step of LAS
    double tolerance = 0.0;  ///< as a length
    std::vector<weld_condition> conditions{};  ///< on single columns
    std::size_t tiles = 0;
    std::size_t finished_tiles = 0;         ///< by an earlier run
    std::vector<std::size_t> unfinished{};  ///< the others
    bool continued = false;                 ///< this run goes on from what an earlier one has left
    bool started_anew = false;              ///< what was left is of another job, or incomplete
    std::vector<std::filesystem::path> damaged{};  ///< files left by it that have changed since
    std::uint64_t disk_bytes = 0;  ///< about what the tiles will take; 0 when they are there
    std::optional<std::uint64_t> disk_bytes_free{};
};

/// What to write; each part may be left out.
struct weld_stream_outputs {
    /// The path, and how to write it.
    std::optional<std::pair<std::filesystem::path, write_options>> welded{};
    /// The same for the dropped points.
    std::optional<std::pair<std::filesystem::path, write_options>> removed{};
    /// If set, `welded` gets all points, with the group of each in a uint32 property of this name.
    std::string label{};
    bool withhold = false;  ///< `welded` gets all points, those not kept "withheld" as in LAS
    /// Called with the new numbers of the next input points, from the first to the last.
    std::function<void(std::span<const std::uint64_t>)> map{};
    /// The same as a file: `map_text` gives the text for points from `first` on. Each of a team
    /// calls it for some points.
    std::filesystem::path map_path{};
    std::function<std::string(std::uint64_t first, std::span<const std::uint64_t>)> map_text{};
    /// Folders with names that begin with ".unfinished-", which the caller removes after `write`.
    /// If the process is killed before that, the next run removes them.
    std::vector<std::filesystem::path> unfinished{};
};

/// What was welded and written.
struct weld_stream_result {
    cloud_survey survey{};
    std::uint64_t kept = 0;   ///< points
    std::uint64_t faces = 0;  ///< that are kept, as stored; and cut into triangles
    std::uint64_t triangles = 0;
    weld_statistics statistics{};
    std::optional<write_result> welded{};   ///< the output, where one was asked for
    std::optional<write_result> removed{};  ///< likewise
    bool label_replaced = false;            ///< the input had a property of that name
    double las_moved = 0.0;                 ///< the furthest that a mean went to a step of LAS
    /// As `count_mergeable` for `welded`; none when all points are in it.
    std::optional<std::uint64_t> mergeable{};
    treeform::status status = status::ok;  ///< or cancelled: nothing is written, the folder stays
};

/// Welds the cloud in the files `inputs` (PLY without faces, PCD, LAS, LAZ, PTS, XYZ, CSV), and
/// writes the outputs. Each output appears whole or not at all. One PLY or binary STL alone may
/// be a mesh: as `weld` would, faces get their new corners, and those that collapse are left out.
/// Each rank has a share of points and of faces. Meshes need `welded` as PLY or OBJ; an STL no
/// tolerance, or `chain`.
///
/// \throws io_error when an input cannot be read or an output cannot be written, or for the folder;
///         std::invalid_argument for a tolerance below 0 or not finite, and as `weld`
/// \cost   O(V log V) time; memory as the options say; 34 bytes a point on the disk, 8 more for
///         each condition, 48 for an order, and points as in memory for a choice of what is kept;
///         of a mesh up to 56 more, and 48 a triangle; the points of a compressed PCD also unpacked
/// \same   on any number of threads, with any memory and any folder
TREEFORM_API weld_stream_result weld_stream(const cloud_inputs& inputs,
                                            const weld_stream_outputs& outputs,
                                            const weld_stream_options& options);

/// The same from one file to one, the welded cloud.
TREEFORM_API weld_stream_result weld_stream(const std::filesystem::path& input,
                                            const std::filesystem::path& output,
                                            const weld_stream_options& options);

/// The same step by step, for callers who report or decide in between. Call `take_survey`,
/// `scatter`, `weld` and `write` once each, in this order, as long as they return status::ok.
///
/// Shared (`weld_stream_options::shared`), many processes do it that see the folder: one calls
/// `take_survey` and `scatter`; then each calls `weld_tile` for its share of the tiles; and when
/// all have ended, one calls `check_tiles`, `weld`, `write` and `remove_folder`. A tile that is
/// finished is not welded again, and two that weld one tile at the same time write the same. `weld`
/// takes the folder alone.
class TREEFORM_API shared_weld {
  public:
    /// Takes the folder. Who has it alone removes what a killed run has left elsewhere.
    shared_weld(cloud_inputs inputs, weld_stream_options options);
    ~shared_weld();
    shared_weld(shared_weld&&) noexcept;
    shared_weld& operator=(shared_weld&&) noexcept;

    /// Reads the cloud, or what an earlier run has kept of it, and decides where to cut it.
    [[nodiscard]] status take_survey();
    [[nodiscard]] const cloud_survey& survey() const;
    /// Gives each tile its points.
    [[nodiscard]] status scatter();
    /// Shared: knows the tiles.
    /// \throws io_error before `scatter` has ended, here or elsewhere
    void check_tiles();
    /// \throws io_error as `check_tiles`; std::out_of_range for a tile that is not there
    [[nodiscard]] status weld_tile(std::size_t tile);
    /// Welds the tiles that are not finished, and what lies along their borders.
    /// \throws io_error naming tiles that are not finished, where they are shared
    [[nodiscard]] status weld();
    /// Writes the outputs, each whole or not at all.
    [[nodiscard]] status write(const weld_stream_outputs& outputs);
    /// What is known so far; cancelled where a step was.
    [[nodiscard]] weld_stream_result result() const;
    /// Removes the folder. Call it last, when all outputs are where they belong.
    void remove_folder();

  private:
    friend weld_stream_result weld_stream(const cloud_inputs&, const weld_stream_outputs&,
                                          const weld_stream_options&);
    struct state;
    std::unique_ptr<state> state_;
};

}  // namespace treeform
