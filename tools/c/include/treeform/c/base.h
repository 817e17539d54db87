#ifndef TREEFORM_C_BASE_H
#define TREEFORM_C_BASE_H
/// \file
/// What all of the C surface shares: rules, errors, memory, progress, threads, version.
///
/// Calls. Nearly every function returns a `treeform_code` and writes its answer through its last
/// parameters. 0 is success, a positive code comes with a result that is not all that was asked
/// for, a negative one comes without. `treeform_last_error` says in a sentence what was wrong, and
/// which face, point, option or file it was. No argument may be null unless its description says
/// so, and a null argument, a number out of range or a coordinate that is not finite is an error,
/// not a crash.
///
/// Memory. What a function creates (meshes, files, trees, results) is given back by
/// `treeform_free`, whatever it is. Results are structs; the arrays that they point to belong to
/// them, and stay until they are freed. The first member of a result, `owner`, is the library's.
/// Arrays that you pass are yours; a function has read them when it returns, except where it says
/// that it borrows them.
///
/// Options. Structs of options begin with their size: call their `..._init` with `sizeof`, then set
/// what you need; null in place of options means the defaults. Structs of options and results may
/// grow at their end in later versions, which old programs do not notice: they are passed by
/// address, and never within other structs. All other structs (`treeform_face_pair`, ...) stay as
/// they are within a major version; while that is 0, within a minor one.
///
/// Numbers. Coordinates are doubles, points are x, y, z one after the other; faces are three 32-bit
/// numbers of points, counter-clockwise seen from outside. Truth values are 0 and 1. An option that
/// need not be given is NaN or, of a number that counts elements, `TREEFORM_NONE`. A matrix has 12
/// numbers, three rows of four: new = M * old, so the first twelve of a 4x4 matrix by rows.
///
/// Threads. Functions may be called from any threads at once. The same handle may be given to
/// several calls at once as long as each takes it as const. Answers do not depend on how many
/// threads the library uses.

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

#if defined(_WIN32)
#if defined(TREEFORM_C_BUILDING)
#define TREEFORM_C_API __declspec(dllexport)
#else
#define TREEFORM_C_API __declspec(dllimport)
#endif
#else
#define TREEFORM_C_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

/// How a call ended.
typedef int32_t treeform_code;
enum {
    TREEFORM_OK = 0,
    /// There is a result, but its certificate does not hold: `treeform_last_error` says what does
    /// not.
    TREEFORM_NOT_CERTIFIED = 1,
    TREEFORM_NO_PLACE = 2,    ///< there is a result, and it says that there is no such place
    TREEFORM_INVALID = -1,    ///< an argument that makes no sense; the message names it
    TREEFORM_FILE = -2,       ///< a file cannot be read or written; the message names path and line
    TREEFORM_MEMORY = -3,     ///< not enough memory
    TREEFORM_RANGE = -4,      ///< too many elements, or numbers beyond the range of double
    TREEFORM_CANCELLED = -5,  ///< `progress` asked to stop
    TREEFORM_INTERNAL = -6    ///< a bug of the library
};

/// In place of a number of an element: there is none.
#define TREEFORM_NONE 0xFFFFFFFFu

/// What was wrong with the last call of this thread that did not return `TREEFORM_OK`; never null.
/// It stays until the next such call of this thread.
TREEFORM_C_API const char* treeform_last_error(void);

/// "invalid", "file", ...: the name of a code, for logs; "unknown" for a number that is none.
TREEFORM_C_API const char* treeform_code_name(treeform_code code);

/// Frees what a function of this library has created: a mesh, a file, a tree, a result. Null is
/// nothing to free. Arrays borrowed from it are gone, too.
TREEFORM_C_API void treeform_free(void* what);

/// Called now and then with the share of the work that is done, in [0, 1] and never decreasing, and
/// with the `progress_data` of the options. Returning other than 0 cancels: the call ends with
/// `TREEFORM_CANCELLED`. It is called from one thread at a time, not always the caller's.
typedef int (*treeform_progress)(double done, void* data);

/// From here on, also those calls of this thread report progress that have no progress among their
/// options and take long: `treeform_find_features`, and those that answer many questions: of points,
/// rays, boxes, positions, and all pairs of points. Null: none does, as at first. A call that is
/// cancelled has filled its arrays in part.
///
/// All other calls without progress run to their end: they read or write a file once, take one or two
/// meshes through once (a million faces or points in less than half a second on two cores), or build
/// a tree (the same).
TREEFORM_C_API void treeform_set_progress(treeform_progress progress, void* data);

/// Takes what one process of a team has told: `bytes` [count].
typedef void (*treeform_hear)(const void* bytes, size_t count, void* listener);

/// Processes that do one work together, each its share, in a folder that all see, such as those that
/// mpirun starts. All call the same with the same options; outputs are those of rank 0.
typedef struct treeform_team {
    size_t rank;
    size_t size;
    /// Gives all of them what each gives (`told` [count]): calls `hear(bytes, count, listener)` for
    /// each in the order of the ranks, with what that one told. Returning other than 0, as it must
    /// where one has failed, ends the call with `TREEFORM_CANCELLED`.
    int (*exchange)(const void* told, size_t count, treeform_hear hear, void* listener, void* data);
    void* data;
} treeform_team;

/// The version of the library that is loaded, comparable with `TREEFORM_C_VERSION`.
TREEFORM_C_API int32_t treeform_version(void);

/// The same as text: "0.1.0".
TREEFORM_C_API const char* treeform_version_string(void);

/// Number of threads that a call may use now.
TREEFORM_C_API uint32_t treeform_thread_count(void);

/// As long as a limit exists, calls of the whole process use at most that many threads.
typedef struct treeform_thread_limit treeform_thread_limit;
/// 0 threads means all. Nested limits can only lower the number.
TREEFORM_C_API treeform_code treeform_limit_threads(uint32_t threads,
                                                    treeform_thread_limit** limit);

/// Precision of coordinates.
typedef int32_t treeform_precision;
enum { TREEFORM_FLOAT32 = 0, TREEFORM_FLOAT64 = 1 };

/// Which corners of faces are the same vertex: those with equal coordinates, or with one number.
typedef int32_t treeform_vertices;
enum { TREEFORM_BY_COORDINATES = 0, TREEFORM_BY_INDEX = 1 };

/// Somebody's arrays of points and faces.
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

/// A vertex or face of an operand, by its number within that operand; both numbers are
/// `TREEFORM_NONE` where there is none.
typedef struct treeform_element {
    uint32_t operand;
    uint32_t index;
} treeform_element;

/// A list of numbers.
typedef struct treeform_indices {
    void* owner;
    const uint32_t* values;  ///< [count]
    size_t count;
} treeform_indices;

/// A list of words.
typedef struct treeform_strings {
    void* owner;
    const char* const* values;  ///< [count]
    size_t count;
} treeform_strings;

/// How an operation that makes a mesh has ended.
typedef int32_t treeform_status;
enum {
    TREEFORM_STATUS_OK = 0,              ///< all that the operation promises was checked and holds
    TREEFORM_STATUS_OPEN_INPUT = 1,      ///< an operand is not closed: see `open`
    TREEFORM_STATUS_SHEET = 2,           ///< the mesh has a border, as asked for
    TREEFORM_STATUS_EXCESSIVE_LOSS = 3,  ///< more was lost than the caller allows
    TREEFORM_STATUS_NOT_MANIFOLD = 4,    ///< an edge of more than two faces, a vertex of two fans
    TREEFORM_STATUS_NOT_CERTIFIED = 5,   ///< faces still meet: see `meeting`
    TREEFORM_STATUS_VANISHED = 6,        ///< no face is left
    TREEFORM_STATUS_OUT_OF_RANGE = 7,    ///< a coordinate is too large for the precision
    TREEFORM_STATUS_NO_PLACE = 8,        ///< of a placement
    TREEFORM_STATUS_CANCELLED = 9
};

/// A place where a surface ends.
typedef struct treeform_open_edge {
    treeform_element face;  ///< a face at the edge
    double ends[2][3];
} treeform_open_edge;

/// What was checked of the coordinates returned.
typedef struct treeform_certificate {
    void* owner;
    treeform_status status;
    const char* message;       ///< half a sentence for people
    uint64_t meeting_count;    ///< pairs of faces that meet where they should not
    const uint32_t* meeting;   ///< [meeting_listed][2] the first 100
    const double* meeting_at;  ///< [meeting_listed][3] a corner of the first face of each
    size_t meeting_listed;
    uint64_t open_count;             ///< edges where the surface ends
    const treeform_open_edge* open;  ///< [open_listed] the first 100
    size_t open_listed;
    uint64_t boundary_edges;         ///< of an odd number of faces
    uint64_t misoriented_edges;      ///< of faces that disagree
    double max_displacement;         ///< rounding moved no coordinate further than this
    treeform_precision precision;    ///< of the coordinates
    uint64_t vanished_faces;         ///< faces of the exact result, where none is left
    double size_before, size_after;  ///< of `excessive_loss`: volume, or area
    int32_t size_is_volume;
} treeform_certificate;

/// What a search that could go on has looked at, in pairs of faces, a pair in motion counting as
/// two: the same for the same input.
typedef struct treeform_search_effort {
    uint64_t pairs;
    uint64_t bound;  ///< the most that it was to look at
    uint64_t cut;    ///< questions that took too many: where there are some, something better may
                     ///< exist
} treeform_search_effort;

#ifdef __cplusplus
}
#endif
#endif
