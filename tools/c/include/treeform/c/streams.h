#ifndef TREEFORM_C_STREAMS_H
#define TREEFORM_C_STREAMS_H
/// \file
/// Clouds larger than memory: welded from file to file, read and written block by block.

#include <treeform/c/weld.h>

#ifdef __cplusplus
extern "C" {
#endif

/// How to weld from file to file.
typedef struct treeform_weld_stream_options {
    size_t size;
    double tolerance;
    int32_t relative;  ///< `tolerance` is a share of the diagonal of the cloud's box
    treeform_weld_rule rule;
    const treeform_weld_condition* same;
    size_t same_count;
    treeform_weld_keep keep;
    const char* keep_by;
    treeform_weld_order order;
    const char* order_by;
    int32_t as_las;            ///< round to the steps of the first file before anything is decided
    uint64_t memory;           ///< bytes that the process may take; 0: `treeform_default_memory`
    const char* folder;        ///< for the tiles; null: the input's name and ".tiles"
    uint64_t points_per_tile;  ///< 0: as the memory allows
    const char* format;        ///< of the inputs; null: by content
    const char* removed;       ///< write the dropped points to this file; or null
    const char* label;         ///< write all points, with their group in this property; or null
    int32_t withhold;          ///< write all points, with the flag "withheld" of LAS
    /// Called with the new numbers of the next input points, from the first to the last; or null.
    void (*map)(const uint64_t* numbers, size_t count, void* data);
    void* map_data;
    const treeform_write_options* write;  ///< how to write the output; or null
    treeform_progress progress;           ///< its share starts anew with each step
    void* progress_data;
    const treeform_communicator* communicator;  ///< null: this process alone
    int32_t keep_seams;         ///< of a mesh, as in `treeform_weld_options`, as are the next three
    const char* const* across;  ///< [across_count]
    size_t across_count;
    int32_t keep_degenerate;
    const treeform_named_column* columns;  ///< [column_count] as in `treeform_read_options`
    size_t column_count;
    int32_t
        mixed;  ///< join LAS of other reference systems or time types, which are then the first's
} treeform_weld_stream_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_weld_stream_options_init(treeform_weld_stream_options* options,
                                                      size_t size);

// made of <mesh/weld_stream.hpp>:
//   weld_stream_result
/// What was welded and written.
typedef struct treeform_weld_stream_result {
    void* owner;
    uint64_t points;
    uint64_t non_finite;      ///< points left as they are
    double tolerance;         ///< as a length
    uint64_t kept;            ///< points
    uint64_t groups;          ///< groups of two points or more
    double max_displacement;  ///< the furthest that a point moved
    uint64_t tiles;
    uint64_t finished_tiles;  ///< by an earlier run
    const char* format;       ///< of the output
    uint64_t still_within;    ///< points that would be merged if the output were welded
    int32_t still_within_known;
    uint64_t faces;  ///< that are kept, as stored; and cut into triangles
    uint64_t triangles;
    uint64_t collapsed;  ///< as in `weld_statistics`, and so are the next four
    uint64_t degenerate;
    uint64_t nonmanifold_before;
    uint64_t nonmanifold_after;
    uint64_t flipped;
} treeform_weld_stream_result;
// end

/// Welds the cloud in the files `inputs` [count] (PLY, PCD, LAS, LAZ, PTS, XYZ, CSV), or the mesh
/// in one file (PLY, binary STL), and writes `output`, whole or not at all: the same bytes as
/// `treeform_weld_file` would lead to. The folder stays when the process is killed, and the same
/// call goes on from there.
TREEFORM_C_API treeform_code treeform_weld_stream(const char* const* inputs, size_t count,
                                                  const char* output,
                                                  const treeform_weld_stream_options* options,
                                                  treeform_weld_stream_result** result);

/// The same step by step, for many processes that see one folder: one calls `scatter`; then each
/// calls `tile` for its share of the tiles; and when all have ended, one calls `finish` and
/// `remove_folder`. A tile that is finished is not welded again.
typedef struct treeform_shared_weld treeform_shared_weld;
/// Begins, and has a hold on the folder until it is freed: all processes give the same inputs and
/// options. What options say of outputs is for `finish`; `communicator` is not for this.
TREEFORM_C_API treeform_code treeform_shared_weld_create(
    const char* const* inputs, size_t count, const treeform_weld_stream_options* options,
    treeform_shared_weld** weld);
/// Gives each tile its points, unless they have them; `tiles` is their number.
TREEFORM_C_API treeform_code treeform_shared_weld_scatter(treeform_shared_weld* weld,
                                                          size_t* tiles);
/// Welds a tile, unless that is done.
TREEFORM_C_API treeform_code treeform_shared_weld_tile(treeform_shared_weld* weld, size_t tile);
/// Welds what lies along the borders of tiles, when all are welded and the others have let go of
/// the folder, and writes `output`, whole or not at all.
TREEFORM_C_API treeform_code treeform_shared_weld_finish(treeform_shared_weld* weld,
                                                         const char* output,
                                                         treeform_weld_stream_result** result);
/// Removes the folder.
TREEFORM_C_API treeform_code treeform_shared_weld_remove_folder(treeform_shared_weld* weld);

/// The memory limit when none is given: three quarters of the machine's, in bytes.
TREEFORM_C_API uint64_t treeform_default_memory(void);

/// About how many bytes it takes to weld `points` points with the properties of the file in memory.
TREEFORM_C_API treeform_code treeform_memory_to_weld(const treeform_file* file, uint64_t points,
                                                     uint64_t* bytes);

/// The least memory with which they can be welded in tiles.
TREEFORM_C_API treeform_code treeform_memory_to_stream(const treeform_file* file, uint64_t points,
                                                       uint64_t* bytes);

/// Reads points from the first to the last.
typedef struct treeform_point_reader treeform_point_reader;

/// Opens a file of points and reads its header. `format` may be null.
TREEFORM_C_API treeform_code treeform_point_reader_create(const char* path, const char* format,
                                                          treeform_point_reader** reader);

/// The file without its points, and their number: `TREEFORM_OK` with `known` 0 where no header says
/// it.
TREEFORM_C_API treeform_code treeform_point_reader_header(const treeform_point_reader* reader,
                                                          treeform_file** header, uint64_t* count,
                                                          int32_t* known);

/// The next points, at most `most`, with their properties, as a file without faces; null when none
/// are left.
TREEFORM_C_API treeform_code treeform_point_reader_next(treeform_point_reader* reader, size_t most,
                                                        treeform_file** block);

/// Writes points.
typedef struct treeform_point_writer treeform_point_writer;

/// Begins a file of `count` points like `header`, perhaps with columns added.
TREEFORM_C_API treeform_code treeform_point_writer_create(const char* path,
                                                          const treeform_file* header,
                                                          uint64_t count,
                                                          const treeform_write_options* options,
                                                          treeform_point_writer** writer);

/// Writes the points of a block.
TREEFORM_C_API treeform_code treeform_point_writer_write(treeform_point_writer* writer,
                                                         const treeform_file* block);

/// Finishes the file; without this call, none stays. `written` may be null.
TREEFORM_C_API treeform_code treeform_point_writer_commit(treeform_point_writer* writer,
                                                          treeform_written** written);

#ifdef __cplusplus
}
#endif
#endif
