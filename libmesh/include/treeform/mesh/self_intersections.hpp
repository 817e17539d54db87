#pragma once
/// \file
/// Self-intersections: pairs of faces that meet, and their regions; also in files beyond memory.

#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace treeform {

/// How two faces meet, one kind a pair. A shared corner is a corner of both (`vertex_identity`).
enum class pair_kind : std::uint8_t {
    crossing,   ///< no shared corner; the interiors pass through each other
    overlap,    ///< at most one shared corner; coplanar, with a common area
    fold,       ///< a shared edge; coplanar, on the same side of it
    duplicate,  ///< the same three corners, in either orientation
    pierce,     ///< one shared corner; the interiors pass through each other
    touching,   ///< contact without crossing: a point or a segment on the rim of one face
    degenerate  ///< the faces meet, and one of them has no area
};
inline constexpr std::size_t pair_kind_count = 7;
template <>
inline constexpr auto detail::names_of<pair_kind> =
    std::array{"crossing", "overlap", "fold", "duplicate", "pierce", "touching", "degenerate"};

/// A set of kinds: `pair_kinds::all - pair_kind::touching`.
class pair_kinds {
  public:
    static const pair_kinds all;

    constexpr pair_kinds() = default;    ///< none
    constexpr pair_kinds(pair_kind one)  // NOLINT: meant to be implicit
        : bits_(1U << static_cast<unsigned>(one)) {}

    [[nodiscard]] constexpr bool contains(pair_kind one) const {
        return (bits_ & pair_kinds(one).bits_) != 0;
    }
    friend constexpr pair_kinds operator+(pair_kinds a, pair_kinds b) {
        return of(a.bits_ | b.bits_);
    }
    friend constexpr pair_kinds operator-(pair_kinds a, pair_kinds b) {
        return of(a.bits_ & ~b.bits_);
    }
    friend constexpr bool operator==(pair_kinds, pair_kinds) = default;

  private:
    static constexpr pair_kinds of(unsigned bits) {
        pair_kinds result;
        result.bits_ = bits;
        return result;
    }

    unsigned bits_ = 0;
};
inline constexpr pair_kinds pair_kinds::all = pair_kinds::of((1U << pair_kind_count) - 1);

/// Two faces that meet.
struct face_pair {
    std::uint32_t a = 0;  ///< the lower face number
    std::uint32_t b = 0;
    pair_kind kind = pair_kind::crossing;  ///< how they meet
    friend auto operator<=>(const face_pair&, const face_pair&) = default;
};

/// Which pairs to search for, and the positions of meshes. Each function ignores the options that
/// do not concern it.
struct face_pair_options {
    /// For `self_intersections`: which corners count as shared.
    vertex_identity vertices = vertex_identity::by_coordinates;
    /// `mesh_intersections`: applied to `a` first (`transform_b`: to `b`). The answer is exact for
    /// the moved corners, which are rounded to double. A prepared mesh is not changed.
    transform<3> transform_a{};
    transform<3> transform_b{};
    bool first_only = false;  ///< only the first pair; the same on any number of threads
    /// kinds to find; other pairs are neither counted nor listed
    pair_kinds kinds = pair_kinds::all;
    /// `self_intersections`: [F] component of each face, for `between` and `within`; or empty.
    std::span<const std::uint32_t> component_of_face{};
    bool between = false;  ///< only pairs of faces of different components
    bool within = false;   ///< only pairs of faces of one component
    /// list at most this many pairs, the lowest; all are counted
    std::size_t limit = static_cast<std::size_t>(-1);
    progress_callback progress{};
};

/// Pairs of faces that meet.
struct face_pair_result {
    /// ascending by (a, b); for two meshes, `a` is a face of the first
    std::vector<face_pair> pairs;
    counts_by<pair_kind, pair_kind_count> counts{};  ///< by kind
    std::uint64_t box_pairs = 0;      ///< pairs of faces whose boxes overlap, as moved
    std::uint64_t exact_pairs = 0;    ///< box pairs that the filter left undecided
    predicate_counters predicates{};  ///< predicate calls for the undecided pairs
    double tree_seconds = 0.0;        ///< for one mesh: time to build the tree
    double pair_seconds = 0.0;        ///< time to find and decide pairs
    treeform::status status = treeform::status::ok;  ///< or `cancelled`
};

/// All pairs of faces that meet where they should not: in a point that is neither a shared corner
/// nor on a shared edge. A mesh that repeats its vertices, as an STL does, gives the same pairs as
/// one that does not (`face_pair_options::vertices`).
///
/// Exact on the coordinates as given. A degenerate face (collinear corners) is treated as the
/// segment or point that it is; its pairs have a kind of their own.
///
/// \pre    every corner is less than `mesh.points.size()`, every coordinate is finite
/// \throws std::invalid_argument naming a face with a corner out of range, or a point that is not
///         finite; if `component_of_face` does not have one entry for each face; for `between`
///         together with `within`
/// \cost   O(F log F + B) time for the B pairs whose boxes overlap, about 100 bytes a face
/// \same   on any number of threads
/// \source candidate pairs: Sajovic, Knez and Korez, tf::tree, section III-C
[[nodiscard]] TREEFORM_API face_pair_result
self_intersections(const mesh_ref& mesh, const face_pair_options& options = {});

/// A connected set of faces that meet.
struct intersection_region {
    std::vector<std::uint32_t> faces;  ///< ascending
    point3 min;                        ///< box of these faces
    point3 max;
    std::vector<std::uint32_t> pairs{};  ///< numbers of its pairs in the list of pairs, ascending

    [[nodiscard]] point3 center() const {  ///< center of the box
        return {0.5 * min.x + 0.5 * max.x, 0.5 * min.y + 0.5 * max.y, 0.5 * min.z + 0.5 * max.z};
    }
    friend bool operator==(const intersection_region&, const intersection_region&) = default;
};

/// Groups the faces in `pairs` into regions, in the order of their lowest faces. Two of these faces
/// are in one region if a pair or a shared corner links them, directly or through other faces of
/// `pairs`.
///
/// \pre    coordinates of the faces in `pairs` are finite
/// \throws std::invalid_argument naming a pair with a face out of range, or the lowest face with a
///         corner out of range
/// \cost   O(V + F + pairs) time, up to an inverse Ackermann factor; about 8 bytes a face and 4 a
///         point
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::vector<intersection_region> group_pairs(
    mesh_view mesh, std::span<const face_pair> pairs);

/// Options of `self_intersections_of_file` and `shared_search`.
struct file_search_options {
    std::optional<vertex_identity> vertices{};  ///< none: by coordinates for STL, else by index
    pair_kinds kinds = pair_kinds::all;
    std::optional<box3> box{};       ///< only faces that have a point in the box
    std::string format{};            ///< format of the input, as for `read`
    std::uint64_t memory = 0;        ///< limit in bytes; 0: three quarters of the machine's memory
    std::filesystem::path folder{};  ///< for the tiles; empty: the input's name and ".search-tiles"
    std::uint64_t faces_per_tile = 0;       ///< approximate limit; 0: as the memory allows
    treeform::communicator communicator{};  ///< not for `shared_search`
    /// Called with the step ("scatter", "pairs") and its completed share, 0 to 1. Returning false
    /// cancels.
    std::function<bool(std::string_view, double)> progress{};
    std::function<void()> step_done{};  ///< called after each step that a restart would skip
};

/// The pairs found in a file.
struct file_search_result {
    /// Only the faces that meet others, in the order of the file; `degenerate` and `non_finite`
    /// count all faces.
    usable_mesh part{};
    /// Pairs of faces of `part.mesh`. Its counters are sums over the tiles.
    face_pair_result found{};
    std::uint64_t stored_faces = 0;  ///< faces of the file
    std::uint64_t triangles = 0;     ///< triangles of these faces
    std::uint64_t searched = 0;      ///< finite triangles that meet the box
    std::uint64_t points = 0;        ///< points of the file; for STL three for each face
    std::optional<box3> bounds{};    ///< box of all finite points of the file
    mesh_file header{};              ///< format, precision and warnings; no mesh
    std::size_t tiles = 0;
    std::size_t finished_tiles = 0;  ///< tiles finished by an earlier run
    /// the folder had tiles of other options or another input, which were discarded
    bool started_anew = false;
};

/// The pairs that `self_intersections` finds in the usable part of a file, for files larger than
/// memory: binary STL, and PLY with vertices before faces. Space is cut into tiles. Each tile gets
/// a copy, on the disk, of the faces that reach into it; they must fit into memory. A pair counts
/// once: in the tile that contains the lowest corner of the intersection of its faces' boxes.
///
/// If the process is killed, the folder stays, and the same call resumes there. With several ranks,
/// rank 0 makes the tiles, all ranks search them, and rank 0 gets the result.
///
/// \throws io_error if the file cannot be read or has another format, or if the folder cannot be
///         used; std::length_error for more than 2^32 - 1 triangles
/// \cost   time as `self_intersections`; memory as in the options, plus the result; on the disk 60
///         to 100 bytes for each tile that a face reaches into, and 24 bytes for each vertex of a
///         PLY
/// \same   on any number of threads, with any memory and any folder
[[nodiscard]] TREEFORM_API file_search_result self_intersections_of_file(
    const std::filesystem::path& input, const file_search_options& options = {});

/// `self_intersections_of_file` step by step, for many processes on one or more machines that share
/// the folder: one process calls `scatter`; then each calls `search_tile` for its share of the
/// tiles; after all have ended, one calls `finish` and `remove_folder`. Steps are idempotent:
/// finished tiles are skipped, and two processes that search the same tile write the same bytes.
///
/// All processes must use the same input and options. Steps throw as `self_intersections_of_file`.
/// They return status::cancelled if `progress` returned false, else status::ok.
class TREEFORM_API shared_search {
  public:
    /// Whether the file has a format that can be searched in tiles.
    ///
    /// \throws io_error if the file cannot be read, or its header is damaged
    [[nodiscard]] static bool accepts(const std::filesystem::path& input,
                                      std::string_view format = {});

    shared_search(std::filesystem::path input, file_search_options options);
    ~shared_search();
    shared_search(shared_search&&) noexcept;
    shared_search& operator=(shared_search&&) noexcept;

    /// Writes the faces of each tile, unless already done.
    [[nodiscard]] status scatter();
    /// Number of tiles.
    ///
    /// \throws io_error if no process has completed `scatter`; so do the functions below
    [[nodiscard]] std::size_t tiles();
    [[nodiscard]] std::vector<std::size_t> unfinished();  ///< tile numbers
    /// \throws std::out_of_range for a tile out of range
    [[nodiscard]] status search_tile(std::size_t tile);
    /// Combines the results of all tiles.
    ///
    /// \throws io_error naming tiles that are not finished, at most a hundred
    [[nodiscard]] file_search_result finish();
    void remove_folder();

  private:
    struct state;
    std::unique_ptr<state> state_;
};

}  // namespace treeform
