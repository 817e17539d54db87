#pragma once
/// \file
/// Welds clouds and meshes that are larger than memory, from file to file.
///
///     tf::weld_stream("scan.ply", "thin.ply", {.tolerance = 0.5});
///
/// The input is a cloud in one file or several, or a mesh. It is read three times: for a survey
/// (bounding box, number of points, and a sample from which the tiles are planned), to write the
/// points of each tile, and to write the kept points. `order_by`, a `keep` other than `first`, and
/// a mesh each need one more pass over the points; the faces of a mesh are read three times. Tiles
/// are files in a folder. If the process is killed, the folder stays, and the same call resumes
/// there. The output is byte for byte that of `weld` and `write` for the file, or for the result of
/// `concatenate_files` for several.

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

/// Options of `weld_stream` and `shared_weld`.
struct weld_stream_options {
    double tolerance = 0.0;  ///< as in `weld_options`
    /// whether `tolerance` is a fraction of the diagonal of the bounding box
    bool relative = false;
    bool chain = false;                  ///< as in `weld_options`
    std::vector<weld_condition> same{};  ///< this and the next four: as in `weld_options`
    /// values other than `first` need points without list properties
    weld_keep keep = weld_keep::first;
    std::string keep_by{};
    std::string order_by{};
    bool highest_first = false;
    bool keep_seams = false;  ///< this and the next two: for a mesh, as in `weld_options`
    std::vector<std::string> ignored_seams{};
    bool keep_degenerate = false;
    /// Round coordinates and their means as LAS stores them before comparing them: to the scale and
    /// offset of the first file if it is LAS, else to those that `round_to_las` chooses.
    bool as_las = false;
    std::optional<std::array<double, 3>> las_scale{}, las_offset{};  ///< as in `write_options`
    std::uint64_t memory = 0;           ///< limit of the process, in bytes; 0: `default_memory`
    std::filesystem::path folder{};     ///< for the tiles; empty: the input's name and ".tiles"
    std::uint64_t points_per_tile = 0;  ///< approximate limit; 0: as the memory allows
    treeform::communicator communicator{};
    /// `shared_weld`: whether other processes share the folder; ignored with a communicator of
    /// several ranks.
    bool shared = true;
    /// Called with the step ("survey", "scatter", "weld", "borders", "write") and its completed
    /// share, 0 to 1. Returning false cancels.
    std::function<bool(std::string_view, double)> progress{};
    std::function<void()> step_done{};  ///< called after each step that a restart would skip

    /// The memory limit when none is given: three quarters of the machine's memory, in bytes.
    [[nodiscard]] TREEFORM_API static std::uint64_t default_memory();

    /// Approximate memory in bytes to weld `points` points with the properties of `header` by
    /// `weld`: coordinates once, properties twice, and the index of neighbors. From measurements.
    /// The process itself takes about 32 MB more.
    [[nodiscard]] TREEFORM_API static std::uint64_t memory_to_weld(const mesh_file& header,
                                                                   std::uint64_t points);

    /// The least `memory`, in bytes, with which `points` points can be welded in tiles. If points
    /// are crowded, or with `chain`, more may be needed (`io_error::kind::memory`).
    [[nodiscard]] TREEFORM_API static std::uint64_t memory_to_stream(const mesh_file& header,
                                                                     std::uint64_t points);
};

/// What the survey of a cloud found, before welding.
struct cloud_survey {
    std::uint64_t points = 0;
    std::uint64_t faces = 0;       ///< of a mesh: faces as stored
    std::uint64_t triangles = 0;   ///< triangles of these faces
    std::uint64_t non_finite = 0;  ///< points with a NaN or infinite coordinate; all are kept
    std::optional<box3> box{};     ///< box of the finite points
    bool fits_float32 = true;      ///< float32 holds every coordinate exactly, and no file is LAS
    /// For each input file: its format, the number of its points as `rows` of the element "vertex",
    /// and `stored_as`: float32 if float32 holds all its coordinates exactly.
    std::vector<mesh_file> sources{};
    std::vector<value_range> ranges{};  ///< as `mesh_file::ranges`
    std::vector<io_warning> warnings{};
    double las_moved = 0.0;  ///< largest change of a coordinate by `as_las`
    double tolerance = 0.0;  ///< as a length
    /// conditions on single columns that the options imply
    std::vector<weld_condition> conditions{};
    std::size_t tiles = 0;
    std::size_t finished_tiles = 0;         ///< tiles finished by an earlier run
    std::vector<std::size_t> unfinished{};  ///< numbers of the tiles that are not finished
    bool continued = false;                 ///< this run resumed an earlier one
    /// the folder had another job or an incomplete one, which was discarded
    bool started_anew = false;
    /// files of the earlier run that have changed since
    std::vector<std::filesystem::path> damaged{};
    std::uint64_t disk_bytes = 0;  ///< estimated size of the tiles to write; 0 if they exist
    std::optional<std::uint64_t> disk_bytes_free{};
};

/// The outputs to write; each is optional.
struct weld_stream_outputs {
    /// The welded cloud or mesh: its path, and how to write it.
    std::optional<std::pair<std::filesystem::path, write_options>> welded{};
    /// The dropped points: the path, and how to write them.
    std::optional<std::pair<std::filesystem::path, write_options>> removed{};
    /// If set, `welded` gets all points, with the group of each in a uint32 property of this name.
    std::string label{};
    /// `welded` gets all points; dropped points get the flag "withheld" of LAS
    bool withhold = false;
    /// Called with the new numbers of consecutive input points, block by block, from the first
    /// point to the last.
    std::function<void(std::span<const std::uint64_t>)> map{};
    /// The same numbers as a text file: `map_text` returns the text for consecutive points from
    /// point `first` on. Each rank calls it for its share of the points.
    std::filesystem::path map_path{};
    std::function<std::string(std::uint64_t first, std::span<const std::uint64_t>)> map_text{};
    /// Folders that the caller will remove after `write`; their names must begin with
    /// ".unfinished-". If the process is killed before, the next run removes them.
    std::vector<std::filesystem::path> unfinished{};
};

/// The result of `weld_stream`.
struct weld_stream_result {
    cloud_survey survey{};
    std::uint64_t kept = 0;       ///< points
    std::uint64_t faces = 0;      ///< kept faces, as stored
    std::uint64_t triangles = 0;  ///< triangles of these faces
    weld_statistics statistics{};
    /// result of writing `weld_stream_outputs::welded`, if requested
    std::optional<write_result> welded{};
    std::optional<write_result> removed{};  ///< the same for `removed`
    bool label_replaced = false;            ///< the input had a property of that name
    double las_moved = 0.0;                 ///< largest change of a mean by `as_las`
    /// As `count_mergeable` for `welded`; none if `welded` has all points.
    std::optional<std::uint64_t> mergeable{};
    treeform::status status = status::ok;  ///< or cancelled: nothing is written, the folder stays
};

/// Welds the cloud in the files `inputs` (PLY without faces, PCD, LAS, LAZ, PTS, XYZ, CSV), and
/// writes the outputs. Each output file is written completely or not at all. A single PLY or binary
/// STL may be a mesh: then faces get their new corners, and collapsed faces are dropped, as by
/// `weld`. `welded` must then be PLY or OBJ, and an STL needs tolerance 0 or `chain`. Of several
/// ranks, each processes a share of the points and faces.
///
/// \throws io_error if an input cannot be read, an output cannot be written, or the folder cannot
///         be used; std::invalid_argument for a tolerance that is negative or not finite, and as
///         `weld`
/// \cost   O(V log V) time; memory as in the options; on the disk 34 bytes a point, 8 more for each
///         condition, 48 for `order_by`, and the size of the points in memory for a `keep` other
///         than `first`; for a mesh up to 56 more, and 48 a triangle; for a compressed PCD also its
///         unpacked points
/// \same   on any number of threads, with any memory and any folder
TREEFORM_API weld_stream_result weld_stream(const cloud_inputs& inputs,
                                            const weld_stream_outputs& outputs,
                                            const weld_stream_options& options);

/// The same for one input file and one output file, the welded cloud or mesh.
TREEFORM_API weld_stream_result weld_stream(const std::filesystem::path& input,
                                            const std::filesystem::path& output,
                                            const weld_stream_options& options);

/// `weld_stream` step by step, for many processes on one or more machines that share the folder:
/// one process calls `scatter`; then each calls `weld_tile` for its share of the tiles; after all
/// have ended, one calls `finish` and `remove_folder`. Steps are idempotent: finished tiles are
/// skipped, and two processes that weld the same tile write the same bytes. Objects of this class
/// share the lock of the folder. `scatter` (unless done) and `finish` need it exclusively: they
/// wait up to two seconds until all other objects are destroyed, then throw.
///
/// All processes must use the same inputs and options. Steps throw as `weld_stream`. They return
/// status::cancelled if `progress` returned false, else status::ok.
///
/// To report between steps, call `take_survey`, `scatter`, `weld` and `write`, once each in this
/// order, as long as they return status::ok. Without `weld_stream_options::shared`, one process
/// calls them, and `weld` welds the tiles.
class TREEFORM_API shared_weld {
  public:
    /// Creates the folder and takes a shared lock. Without `weld_stream_options::shared`, takes an
    /// exclusive lock, and removes `weld_stream_outputs::unfinished` of a killed run.
    shared_weld(cloud_inputs inputs, weld_stream_options options);
    /// The same for one file.
    shared_weld(const std::filesystem::path& input, weld_stream_options options);
    ~shared_weld();
    shared_weld(shared_weld&&) noexcept;
    shared_weld& operator=(shared_weld&&) noexcept;

    /// Writes the points of each tile, unless already done.
    [[nodiscard]] status scatter();
    /// Number of tiles.
    ///
    /// \throws io_error if no process has completed `scatter`; so do the functions below
    [[nodiscard]] std::size_t tiles();
    [[nodiscard]] std::vector<std::size_t> unfinished();  ///< tile numbers
    /// \throws std::out_of_range for a tile out of range
    [[nodiscard]] status weld_tile(std::size_t tile);
    /// Welds the points along the borders of tiles, and writes the outputs, each completely or not
    /// at all. If `result.status` is cancelled, nothing is written.
    ///
    /// \throws io_error naming tiles that are not finished, at most a hundred
    weld_stream_result finish(const weld_stream_outputs& outputs);
    /// The same for one output file, the welded cloud or mesh.
    weld_stream_result finish(const std::filesystem::path& output);
    /// Removes the folder. Call it last, when all outputs are complete.
    void remove_folder();

    /// Reads the cloud, or the stored survey of an earlier run, and plans the tiles.
    [[nodiscard]] status take_survey();
    [[nodiscard]] const cloud_survey& survey() const;
    /// Welds the points along the borders of tiles; if not `shared`, first all tiles.
    [[nodiscard]] status weld();
    /// Writes the outputs.
    [[nodiscard]] status write(const weld_stream_outputs& outputs);
    /// The result so far; cancelled if a step was.
    [[nodiscard]] weld_stream_result result() const;

  private:
    friend weld_stream_result weld_stream(const cloud_inputs&, const weld_stream_outputs&,
                                          const weld_stream_options&);
    struct state;
    std::unique_ptr<state> state_;
};

}  // namespace treeform
