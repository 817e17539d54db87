#pragma once
/// \file
/// Clouds larger than memory: welding from file to file, reading and writing in blocks.

#include <treeform/c/weld.h>

// made of the headers of C++:
//   weld_stream_options
/// Options of `treeform_weld_stream` and `treeform_shared_weld`.
typedef struct treeform_weld_stream_options {
    size_t struct_size;
    double tolerance;  ///< as in `treeform_weld_options`
    /// whether `tolerance` is a fraction of the diagonal of the bounding box
    int32_t relative;
    int32_t chain;  ///< as in `treeform_weld_options`
    /// [same_count] this and the next four: as in `treeform_weld_options`
    const treeform_weld_condition* same;
    size_t same_count;
    /// values other than `TREEFORM_KEEP_FIRST` need points without list properties
    treeform_weld_keep keep;
    const char* keep_by;
    const char* order_by;
    int32_t highest_first;
    /// Round coordinates and their means as LAS stores them before comparing them: to the scale
    /// and offset of the first file if it is LAS, else to those that `treeform_file_round_to_las`
    /// chooses.
    int32_t as_las;
    uint64_t memory;           ///< limit of the process, in bytes; 0: `treeform_default_memory`
    const char* folder;        ///< for the tiles; empty: the input's name and ".tiles"
    uint64_t points_per_tile;  ///< approximate limit; 0: as the memory allows
    const char* format;        ///< format of the inputs; null: by content
    const char* removed;       ///< write the dropped points to this file; or null
    /// write all points, with their group in this property; or null
    const char* label;
    int32_t withhold;  ///< write all points, with the flag "withheld" of LAS
    /// Called with the new numbers of consecutive input points, from the first point to the last;
    /// or null.
    void (*map)(const uint64_t* numbers, size_t count, void* data);
    void* map_data;
    const treeform_write_options* write;  ///< how to write the output; or null
    treeform_progress progress;
    void* progress_data;
    const treeform_communicator* communicator;  ///< or null
    /// this and the next two: for a mesh, as in `treeform_weld_options`
    int32_t keep_seams;
    const char* const* ignored_seams;  ///< [ignored_seam_count]
    size_t ignored_seam_count;
    int32_t keep_degenerate;
    /// [column_count] as in `treeform_read_options`
    const treeform_named_column* columns;
    size_t column_count;
    /// join LAS files of different coordinate systems or time types; the output then has the
    /// system and type of the first
    int32_t mixed;
} treeform_weld_stream_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_weld_stream_options_init(treeform_weld_stream_options* options,
                                                      size_t size);
// end

// made of the headers of C++:
//   weld_stream_result weld_stream()
/// The result of `treeform_weld_stream`.
typedef struct treeform_weld_stream_result {
    void* owner;
    uint64_t points;
    /// points with a NaN or infinite coordinate, left as they are
    uint64_t non_finite;
    double tolerance;         ///< the tolerance as a length
    uint64_t kept;            ///< points
    uint64_t groups;          ///< groups of two points or more
    double max_displacement;  ///< upper bound of the distance that a point moved
    uint64_t tiles;
    uint64_t finished_tiles;  ///< tiles finished by an earlier run
    const char* format;       ///< format of the output
    uint64_t mergeable;       ///< number of points that welding the output again would merge
    int32_t mergeable_known;
    uint64_t faces;               ///< kept faces, as stored
    uint64_t triangles;           ///< triangles of these faces
    uint64_t collapsed;           ///< faces that repeat a corner only after the weld
    uint64_t degenerate;          ///< faces that repeated a corner before
    uint64_t nonmanifold_before;  ///< edges of more than two faces
    uint64_t nonmanifold_after;
    uint64_t flipped;  ///< kept faces whose normal turned by more than a right angle
} treeform_weld_stream_result;

/// Welds the cloud in the files `inputs` [count] (PLY, PCD, LAS, LAZ, PTS, XYZ, CSV), or the mesh
/// in one file (PLY, binary STL), and writes `output`, completely or not at all: the same bytes as
/// by `treeform_weld_file`. If the process is killed, the folder stays, and the same call resumes
/// there.
TREEFORM_C_API treeform_code treeform_weld_stream(const char* const* inputs, size_t count,
                                                  const char* output,
                                                  const treeform_weld_stream_options* options,
                                                  treeform_weld_stream_result** result);
// end

/// A weld step by step, for many processes that share a folder: one calls `scatter`; then each
/// calls `tile` for its share of the tiles; after all have ended, one calls `finish` and
/// `remove_folder`. Finished tiles are skipped.
typedef struct treeform_shared_weld treeform_shared_weld;
// made of the headers of C++:
//   shared_weld_create() shared_weld_scatter() shared_weld_tiles() shared_weld_unfinished()
//   shared_weld_tile() shared_weld_finish() shared_weld_remove_folder()
/// Begins a weld in steps. Until it is freed, the handle holds a shared lock on the folder. Fails
/// while another handle scatters or finishes. All processes must pass the same inputs and options.
/// Options of outputs are used by `finish`; `communicator` is not used.
TREEFORM_C_API treeform_code treeform_shared_weld_create(
    const char* const* inputs, size_t count, const treeform_weld_stream_options* options,
    treeform_shared_weld** weld);

/// Writes the points of each tile, unless already done. For that, it needs to be the only handle
/// on the folder: it waits two seconds for others to be freed, then fails. `result`, which may be
/// null, is the number of tiles.
TREEFORM_C_API treeform_code treeform_shared_weld_scatter(treeform_shared_weld* weld,
                                                          size_t* result);

/// Number of tiles; an error if no process has completed `scatter`.
TREEFORM_C_API treeform_code treeform_shared_weld_tiles(treeform_shared_weld* weld, size_t* result);

/// Numbers of the tiles that are not finished.
TREEFORM_C_API treeform_code treeform_shared_weld_unfinished(treeform_shared_weld* weld,
                                                             treeform_indices** indices);

/// Welds a tile, unless it is finished.
TREEFORM_C_API treeform_code treeform_shared_weld_tile(treeform_shared_weld* weld, size_t tile);

/// Welds the points along the borders of tiles, and writes `output`, completely or not at all. All
/// tiles must be finished. From this call until it is freed, the handle must be the only one on
/// the folder; waits as `scatter` does. `result` may be null.
TREEFORM_C_API treeform_code treeform_shared_weld_finish(treeform_shared_weld* weld,
                                                         const char* output,
                                                         treeform_weld_stream_result** result);

/// Removes the folder of the tiles.
TREEFORM_C_API treeform_code treeform_shared_weld_remove_folder(treeform_shared_weld* weld);
// end

/// The default memory limit: three quarters of the machine's memory, in bytes.
TREEFORM_C_API uint64_t treeform_default_memory(void);

// made of the headers of C++:
//   memory_to_weld() memory_to_stream()
/// Approximate memory in bytes to weld `points` points, with the properties of the file, in
/// memory.
TREEFORM_C_API treeform_code treeform_memory_to_weld(const treeform_file* file, uint64_t points,
                                                     uint64_t* result);

/// The least memory in bytes with which `points` points can be welded in tiles.
TREEFORM_C_API treeform_code treeform_memory_to_stream(const treeform_file* file, uint64_t points,
                                                       uint64_t* result);
// end

/// Reads points from the first to the last.
typedef struct treeform_point_reader treeform_point_reader;

// made of the headers of C++:
//   point_reader_create() point_reader_header() point_reader_next()
/// Opens a point file and reads its header. `format` may be null.
TREEFORM_C_API treeform_code treeform_point_reader_create(const char* path, const char* format,
                                                          treeform_point_reader** reader);

/// The file without its points, and their number.
TREEFORM_C_API treeform_code treeform_point_reader_header(const treeform_point_reader* reader,
                                                          treeform_file** header, uint64_t* count);

/// Reads the next points, at most `most`, with their properties, as a file without faces; null if
/// none are left.
TREEFORM_C_API treeform_code treeform_point_reader_next(treeform_point_reader* reader, size_t most,
                                                        treeform_file** file);
// end

/// Writes points.
typedef struct treeform_point_writer treeform_point_writer;

// made of the headers of C++:
//   point_writer_create() point_writer_write() point_writer_commit()
/// Begins to write a file of `count` points with the format and columns of `header`; columns may
/// have been added.
TREEFORM_C_API treeform_code treeform_point_writer_create(const char* path,
                                                          const treeform_file* header,
                                                          uint64_t count,
                                                          const treeform_write_options* options,
                                                          treeform_point_writer** writer);

/// Writes the points of a block.
TREEFORM_C_API treeform_code treeform_point_writer_write(treeform_point_writer* writer,
                                                         const treeform_file* block);

/// Finishes the file; without this call, the file is removed. `written` may be null.
TREEFORM_C_API treeform_code treeform_point_writer_commit(treeform_point_writer* writer,
                                                          treeform_written** written);
// end
