#pragma once
/// \file
/// Common to all C headers: conventions, errors, memory, progress, threads, version.
///
/// Calls. Nearly every function returns a `treeform_code` and writes its result through its last
/// parameters. 0 is success. A positive code comes with an incomplete result, a negative code
/// without a result. `treeform_last_error` describes the error in a sentence, with the face, point,
/// option or file. An argument may be null only if its description says so. In addition, these
/// arguments may be null in all functions: `format` (it is then detected by content or extension),
/// `unit`, `progress` and `written`. Null for other arguments, numbers out of range and coordinates
/// that are not finite are reported as errors.
///
/// Memory. Free all objects that functions create (meshes, files, trees, results) with
/// `treeform_free`. Results are structs that own the arrays they point to, until they are freed.
/// The first member of a result, `owner`, is internal. You keep ownership of arrays that you pass.
/// No function uses them after its return, unless its description says that it borrows them.
///
/// Options. Structs of options begin with `struct_size`: call their `..._init` with `sizeof`, then
/// set members; null instead of options means the defaults. `{.struct_size = sizeof options}` alone
/// is not enough: it leaves zeros, which are values, not the defaults. Later versions may append
/// members to structs of options and results. This is compatible with compiled programs, since
/// these structs are passed by address and never embedded in others. All other structs
/// (`treeform_face_pair`, ...) are fixed within a major version; in version 0, within a minor
/// version.
///
/// Numbers. Coordinates are doubles, points are consecutive x, y, z; faces are three 32-bit numbers
/// of points, counter-clockwise seen from outside. The lowest of several faces, points or edges is
/// the one with the lowest number. Truth values are 0 and 1. An unset option is NaN or, for a count
/// or index, `TREEFORM_NONE`; for an enumeration, -1. A matrix has 12 numbers, the first three rows
/// of a 4x4 matrix: new = M * old. Null instead of a matrix means the identity.
///
/// Threads. Functions may be called from several threads at once. Concurrent calls may share a
/// handle if all take it as const. Results do not depend on the number of threads that the library
/// uses.

#include <stddef.h>
#include <stdint.h>

#define TREEFORM_C_VERSION_MAJOR 0
#define TREEFORM_C_VERSION_MINOR 1
#define TREEFORM_C_VERSION_PATCH 0

/// The number of a version: `#if TREEFORM_C_VERSION >= TREEFORM_C_VERSION_OF(1, 2, 0)`.
#define TREEFORM_C_VERSION_OF(major, minor, patch) ((major)*1000000 + (minor)*1000 + (patch))

/// The version of these headers.
#define TREEFORM_C_VERSION                                                    \
    TREEFORM_C_VERSION_OF(TREEFORM_C_VERSION_MAJOR, TREEFORM_C_VERSION_MINOR, \
                          TREEFORM_C_VERSION_PATCH)

#if !defined(_WIN32)
#define TREEFORM_C_SHOWN __attribute__((visibility("default")))
#elif defined(TREEFORM_C_BUILDING)
#define TREEFORM_C_SHOWN __declspec(dllexport)
#else
#define TREEFORM_C_SHOWN __declspec(dllimport)
#endif
#ifdef __cplusplus
#define TREEFORM_C_API extern "C" TREEFORM_C_SHOWN
#else
#define TREEFORM_C_API TREEFORM_C_SHOWN
#endif

/// How a call ended.
typedef int32_t treeform_code;
enum {
    TREEFORM_OK = 0,
    /// there is a result, but its certificate is not ok; `treeform_last_error` has the reason
    TREEFORM_NOT_CERTIFIED = 1,
    TREEFORM_NO_PLACE = 2,    ///< no position, not converged, or doubtful; the result says why
    TREEFORM_INVALID = -1,    ///< an invalid argument; the message names it
    TREEFORM_FILE = -2,       ///< a file cannot be read or written; the message names path and line
    TREEFORM_MEMORY = -3,     ///< not enough memory
    TREEFORM_RANGE = -4,      ///< too many elements, or numbers beyond the range of double
    TREEFORM_CANCELLED = -5,  ///< `progress` returned other than 0
    TREEFORM_INTERNAL = -6    ///< a bug of the library
};

/// No element, instead of an index.
#define TREEFORM_NONE 0xFFFFFFFFu

/// The error of the last call of this thread that did not return `TREEFORM_OK`; never null. The
/// text is valid until the next such call of this thread.
TREEFORM_C_API const char* treeform_last_error(void);

/// The name of a code, for logs: "invalid", "file", ...; "unknown" for other numbers.
TREEFORM_C_API const char* treeform_code_name(treeform_code code);

/// Frees an object that a function of this library created: a mesh, a file, a tree, a result. Does
/// nothing for null. Arrays of the object are freed, too.
TREEFORM_C_API void treeform_free(void* what);

/// Called from time to time with the completed share of the work, in [0, 1] and never decreasing,
/// and with the `progress_data` of the options. Returning other than 0 cancels: the call ends with
/// `TREEFORM_CANCELLED`. It is called from one thread at a time, not always the caller's.
typedef int (*treeform_progress)(double done, void* data);

/// Sets the progress callback for long calls of this thread without a progress option:
/// `treeform_find_features`, queries of many points, rays, boxes or positions, and all pairs of
/// points. Null, the default: none. A cancelled call has filled its arrays only partly.
///
/// Other calls without a progress option cannot be stopped. They read or write one file, process
/// one or two meshes once, or build one tree: for a million faces or points, less than half a
/// second on two cores.
TREEFORM_C_API void treeform_set_progress(treeform_progress progress, void* data);

/// Receives the bytes sent by one process of a communicator: `bytes` [count].
typedef void (*treeform_receive)(const void* bytes, size_t count, void* listener);

/// Processes that share one job in a common folder, such as those that mpirun starts. All must make
/// the same calls with the same options; outputs are written to the paths of rank 0.
typedef struct treeform_communicator {
    size_t rank;
    size_t size;
    /// Collective: sends `sent` [count] to all processes, and calls `receive(bytes, count,
    /// listener)` for each process in the order of ranks, with the bytes it sent. A nonzero return
    /// value, required if a process failed, ends the call with `TREEFORM_CANCELLED`.
    int (*exchange)(const void* sent, size_t count, treeform_receive receive, void* listener,
                    void* data);
    void* data;
} treeform_communicator;

/// The version of the library that is loaded, comparable with `TREEFORM_C_VERSION`.
TREEFORM_C_API int32_t treeform_version(void);

/// The same as text: "0.1.0".
TREEFORM_C_API const char* treeform_version_string(void);

/// Number of threads that a call may use at present.
TREEFORM_C_API uint32_t treeform_thread_count(void);

/// As long as a limit exists, calls of the whole process use at most that many threads.
typedef struct treeform_thread_limit treeform_thread_limit;
/// 0 threads means all. Nested limits can only lower the number.
TREEFORM_C_API treeform_code treeform_limit_threads(uint32_t threads,
                                                    treeform_thread_limit** limit);

// made of the headers of C++:
//   precision vertex_identity
/// The floating-point format of coordinates.
typedef int32_t treeform_precision;
enum {
    /// 32-bit floats, as in binary STL
    TREEFORM_FLOAT32 = 0,
    /// doubles
    TREEFORM_FLOAT64 = 1
};

/// Which corners of faces are the same vertex. This decides whether a mesh is closed, and which of
/// its faces are neighbors.
typedef int32_t treeform_vertex_identity;
enum {
    /// corners with equal coordinates; suits files that repeat points (STL)
    TREEFORM_BY_COORDINATES = 0,
    /// corners with the same point number
    TREEFORM_BY_INDEX = 1
};
// end

/// Arrays of points and faces that another object owns.
typedef struct treeform_arrays {
    const double* points;  ///< [point_count][3]
    size_t point_count;
    const uint32_t* faces;  ///< [face_count][3]
    size_t face_count;
} treeform_arrays;

/// A closed axis-aligned box.
typedef struct treeform_box {
    double min[3];
    double max[3];
} treeform_box;

// made of the headers of C++:
//   operand_element indices strings status certificate search_effort
/// A vertex or face of an operand: its number within that operand.
typedef struct treeform_operand_element {
    uint32_t operand;
    uint32_t index;
} treeform_operand_element;

/// A list of numbers.
typedef struct treeform_indices {
    void* owner;
    const uint32_t* values;  ///< [count]
    size_t count;
} treeform_indices;

/// A list of strings.
typedef struct treeform_strings {
    void* owner;
    const char* const* values;  ///< [count]
    size_t count;
} treeform_strings;

/// The outcome of an operation that makes a mesh.
typedef int32_t treeform_status;
enum {
    /// everything that the operation guarantees was verified
    TREEFORM_STATUS_OK = 0,
    /// an operand is not closed; `open_edges` lists where; no mesh is returned
    TREEFORM_STATUS_OPEN_INPUT = 1,
    /// the mesh has a border, as requested; all other guarantees hold
    TREEFORM_STATUS_SHEET = 2,
    /// more volume or area was lost than the options allow
    TREEFORM_STATUS_EXCESSIVE_LOSS = 3,
    /// with equal coordinates joined, an edge has more than two faces, or a vertex more than one
    /// fan
    TREEFORM_STATUS_NOT_MANIFOLD = 4,
    /// faces still meet in the returned coordinates; `meeting` lists them
    TREEFORM_STATUS_NOT_CERTIFIED = 5,
    /// no face is left: the result is thinner than the coordinates can represent, or its faces
    /// cancel each other out
    TREEFORM_STATUS_VANISHED = 6,
    /// a coordinate of the result overflows the requested precision
    TREEFORM_STATUS_OUT_OF_RANGE = 7,
    /// a placement found no position; `treeform_placement::outcome` has the reason
    TREEFORM_STATUS_NO_PLACEMENT = 8,
    /// stopped by `progress`; there is no result
    TREEFORM_STATUS_CANCELLED = 9
};
/// The name of a value, as in reports: "ok"; "unknown" for others.
TREEFORM_C_API const char* treeform_status_name(treeform_status value);

/// The outcome of checking the mesh that an operation (`treeform_boolean`, `treeform_repair`,
/// `treeform_slide`, `treeform_pack`, ...) returns or places. The check is exact, on the returned
/// coordinates.
typedef struct treeform_certificate {
    void* owner;
    treeform_status status;
    const char* message;  ///< the outcome as a clause for people, without a full stop
    /// Number of pairs of faces that meet beyond common corners and edges. A face paired with
    /// itself means that this face is degenerate, or that the outside of the solid is behind it.
    /// `meeting` lists the first 100.
    uint64_t meeting_count;
    const uint32_t* meeting;   ///< [meeting_listed][2]
    const double* meeting_at;  ///< a corner of the first face of each pair in `meeting`
    size_t meeting_listed;
    /// Number of edges whose signed face count is not zero. Where edges overlap, their pieces are
    /// counted. `open_edges` and `open_faces` list the first 100.
    uint64_t open_count;
    size_t open_listed;
    /// The open edges counted in the operands, after joining equal coordinates: `boundary_edges`
    /// have an odd number of faces (the surface ends there), `misoriented_edges` an even number of
    /// inconsistently oriented faces. Both are 0 if a vertex lies inside such an edge, since edges
    /// may then match piece by piece.
    uint64_t boundary_edges;
    uint64_t misoriented_edges;
    /// The largest change of a coordinate by rounding, from the exact position of the vertex; for
    /// vertices added or removed to repair what rounding did, from the nearest point of the exact
    /// surface. Measured on the result: intermediate moves do not add up.
    double max_displacement;
    treeform_precision precision;  ///< of the coordinates
    /// For status `TREEFORM_STATUS_VANISHED`: number of faces of the exact result, all too thin
    /// for the coordinates; 0 if it had no faces.
    uint64_t vanished_faces;
    /// for status `TREEFORM_STATUS_EXCESSIVE_LOSS`: volume or area before
    double size_before;
    double size_after;       ///< the same after
    int32_t size_is_volume;  ///< `size_before` and `size_after` are volumes, not areas
    /// [open_listed][2][3] Ends of the open part of each edge; rounded if the edge is cut.
    const double* open_edges;
    /// One face at each edge in `open_edges`. Functions of one mesh, such as `treeform_repair`,
    /// name no operand.
    const treeform_operand_element* open_faces;
} treeform_certificate;

/// The work of a bounded search, in pairs of faces tested. It depends on the input alone. A result
/// is valid even if the bound was reached.
typedef struct treeform_search_effort {
    uint64_t pairs;  ///< pairs of faces tested; a pair in motion counts as two
    uint64_t bound;  ///< the limit of `pairs`
    /// Number of candidates skipped because testing one would take more than 1/32 of the bound, or
    /// more than the rest of it. If not 0, a better result may exist.
    uint64_t skipped_candidates;
} treeform_search_effort;
// end
