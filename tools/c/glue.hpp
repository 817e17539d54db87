#pragma once
/// \file
/// What all functions of the C surface share: exceptions become codes, arguments are checked, and
/// results are kept until they are freed.

#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/section.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/mesh/slide.hpp>
#include <treeform/mesh/time_of_impact.hpp>
#include <treeform/mesh/weld_options.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/parallel.hpp>

#include <tools/bindings/pieces.hpp>
#include <treeform.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace glue {

namespace tf = treeform;

/// What `treeform_free` deletes: its address is the first member of all that is handed out.
struct owned {
    owned() = default;
    owned(const owned&) = delete;
    owned& operator=(const owned&) = delete;
    virtual ~owned() = default;
};

/// Keeps what the arrays of structs belong to.
struct keeper : owned {
    /// `what`, as long as this exists.
    template <class T>
    T& keep(T what) {
        auto place = std::make_shared<T>(std::move(what));
        kept.push_back(place);
        return *place;
    }

    std::vector<std::shared_ptr<void>> kept;
};

/// A struct that is handed out.
template <class C>
struct answer final : keeper {
    answer() { value.owner = static_cast<owned*>(this); }
    C value{};
};

template <class C>
[[nodiscard]] std::unique_ptr<answer<C>> make() {
    return std::make_unique<answer<C>>();
}

/// Hands it out.
template <class C>
void give(std::unique_ptr<answer<C>> made, C** out) {
    *out = &made.release()->value;
}

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// `progress` asked to stop.
struct cancelled {};

/// \throws cancelled where that is how it ended
inline void check(tf::status status) {
    if (status == tf::status::cancelled) throw cancelled{};
}

/// Says what is wrong, for `treeform_last_error`.
void say(const char* what) noexcept;
/// The code of the exception that is being handled.
[[nodiscard]] treeform_code code_of_exception() noexcept;

/// Runs the body of a function; exceptions become codes. The body may return a code of its own.
template <class Body>
[[nodiscard]] treeform_code guard(const Body& body) noexcept {
    try {
        if constexpr (std::is_void_v<decltype(body())>) {
            body();
            return TREEFORM_OK;
        } else {
            return body();
        }
    } catch (...) {
        return code_of_exception();
    }
}

// ---- arguments ----

template <class T>
[[nodiscard]] T& need(T* what, const char* name) {
    if (!what) throw std::invalid_argument(std::string(name) + " is null");
    return *what;
}

/// The place for a result, which is null until there is one.
template <class T>
void start(T** out) {
    need(out, "the place for the result") = nullptr;
}

template <class T>
[[nodiscard]] std::span<T> array(T* data, std::size_t count, const char* name) {
    if (count > std::size_t{1} << 40) throw std::length_error(std::string(name) + ": too many");
    if (count != 0) (void)need(data, name);
    return {data, count};
}

/// Three doubles are a point, three numbers a face: the arrays are used as they are.
[[nodiscard]] inline tf::points_view points(const double* data, std::size_t count,
                                            const char* name) {
    static_assert(sizeof(tf::point3) == 3 * sizeof(double));
    (void)array(data, count, name);
    return {reinterpret_cast<const tf::point3*>(data), count};
}
[[nodiscard]] inline std::span<const tf::face> faces(const std::uint32_t* data, std::size_t count,
                                                     const char* name) {
    static_assert(sizeof(tf::face) == 3 * sizeof(std::uint32_t));
    (void)array(data, count, name);
    return {reinterpret_cast<const tf::face*>(data), count};
}
[[nodiscard]] inline tf::point3 point(const double* data, const char* name) {
    (void)need(data, name);
    return {data[0], data[1], data[2]};
}
/// The identity for null.
[[nodiscard]] inline tf::transform<3> matrix(const double* data) {
    tf::transform<3> result;
    if (data) std::memcpy(result.rows.data(), data, sizeof result.rows);
    return result;
}
[[nodiscard]] inline std::optional<double> given(double value) {
    return std::isnan(value) ? std::nullopt : std::optional(value);
}
[[nodiscard]] inline std::string text(const char* what) { return what ? what : ""; }
[[nodiscard]] std::vector<std::string> texts(const char* const* what, std::size_t count,
                                             const char* name);
[[nodiscard]] inline std::vector<std::filesystem::path> paths(const char* const* what,
                                                              std::size_t count, const char* name) {
    const std::vector<std::string> all = texts(what, count, name);
    return {all.begin(), all.end()};
}
/// A point that is known to be finite, as the predicates need it.
[[nodiscard]] tf::point3 finite(const double* data, const char* name);
[[nodiscard]] tf::point2 finite2(const double* data, const char* name);
/// Null: through the origin, across z.
[[nodiscard]] tf::oriented_plane plane(const treeform_plane* plane);
/// Without any, the plane itself.
[[nodiscard]] std::vector<double> heights(const double* heights, std::size_t count);
template <class T, class C>  // of the same bytes
[[nodiscard]] std::span<const T> same_as(std::span<const C> all) {
    return {reinterpret_cast<const T*>(all.data()), all.size()};
}
/// Pairs of faces of a mesh, all of them there.
[[nodiscard]] std::vector<tf::face_pair> pairs_of(std::size_t face_count,
                                                  const treeform_face_pair* pairs,
                                                  std::size_t count);
[[nodiscard]] tf::box3 box(const treeform_box& b);
/// None for null.
[[nodiscard]] inline std::optional<tf::box3> box(const treeform_box* b) {
    return b ? std::optional(box(*b)) : std::nullopt;
}
[[nodiscard]] inline std::optional<std::array<double, 3>> axes(const double* three) {
    if (!three) return std::nullopt;
    return std::array{three[0], three[1], three[2]};
}
/// Rows of equal numbers as structs of them.
template <class Row, class T>
[[nodiscard]] std::span<const Row> rows_of(const T* data, std::size_t count, const char* name) {
    static_assert(sizeof(Row) % sizeof(T) == 0 && alignof(Row) == alignof(T));
    (void)array(data, count, name);
    return {reinterpret_cast<const Row*>(data), count};
}
[[nodiscard]] tf::pair_kinds kinds(std::uint32_t bits);
/// Null, and null among them, is an error that says `what`.
[[nodiscard]] std::vector<tf::named_column> columns_of(const treeform_named_column* columns,
                                                       std::size_t count, const char* what);
[[nodiscard]] std::vector<tf::weld_condition> conditions(const treeform_weld_condition* same,
                                                         std::size_t count, const char* what);

/// One of the `count` enumerators of E, which are numbered from 0.
template <class E>
[[nodiscard]] E choice(std::int32_t value, std::int32_t count, const char* name) {
    if (value < 0 || value >= count)
        throw std::invalid_argument(std::string(name) + " is " + std::to_string(value) +
                                    ", which is none of its values");
    return static_cast<E>(value);
}
[[nodiscard]] inline tf::precision precision(treeform_precision value) {
    return choice<tf::precision>(value, 2, "precision");
}
[[nodiscard]] inline tf::vertex_identity vertices(treeform_vertices value) {
    return choice<tf::vertex_identity>(value, 2, "vertices");
}
[[nodiscard]] inline std::size_t limit(std::uint64_t value) {
    return static_cast<std::size_t>(value);
}

[[nodiscard]] tf::progress_callback progress(treeform_progress call, void* data);
template <class Options>
[[nodiscard]] tf::progress_callback progress(const Options& options) {
    return progress(options.progress, options.progress_data);
}

/// Of work in steps, whose names C does not have.
template <class Options>
[[nodiscard]] std::function<bool(std::string_view, double)> step_progress(const Options& options) {
    if (!options.progress) return {};
    return [call = options.progress, data = options.progress_data](std::string_view, double done) {
        return call(done, data) == 0;
    };
}

/// One that is alone for null.
[[nodiscard]] tf::communicator communicator_of(const treeform_communicator* of);

/// What `treeform_set_progress` has set for this thread.
[[nodiscard]] tf::progress_callback thread_progress();

/// `body(begin, end)` for pieces of `count` questions, all at once where nobody wants to know.
///
/// \throws cancelled
template <class Body>
void in_pieces(std::size_t count, const Body& body) {
    if (!thread_progress())
        body(std::size_t{0}, count);
    else if (!tools::in_pieces(count, thread_progress(), body))
        throw cancelled{};
}

/// Adds lists to others, [begin, all] as results have them; `begin` has a 0 at first.
template <class T>
void append(std::vector<std::size_t>& begin, std::vector<T>& all, std::vector<std::size_t>&& more,
            std::vector<T>&& values) {
    if (begin.size() == 1 && !more.empty()) {
        begin = std::move(more);
        all = std::move(values);
        return;
    }
    for (std::size_t i = 1; i < more.size(); ++i) begin.push_back(all.size() + more[i]);
    all.insert(all.end(), values.begin(), values.end());
}

/// Writes the defaults into the `size` bytes of a caller's struct.
template <class C>
void init(C* options, std::size_t size, C defaults) noexcept {
    if (!options || size < sizeof(std::size_t)) return;
    defaults.size = size < sizeof defaults ? size : sizeof defaults;
    std::memcpy(options, &defaults, defaults.size);
}

/// The caller's options, with defaults where the struct is shorter than ours.
template <class C>
[[nodiscard]] C chosen(const C* options, void (*init)(C*, std::size_t)) {
    C all{};
    init(&all, sizeof all);
    if (!options) return all;
    if (options->size < sizeof(std::size_t) || options->size > sizeof all)
        throw std::invalid_argument("options of " + std::to_string(options->size) +
                                    " bytes: call the init function of their struct first");
    std::memcpy(&all, options, options->size);
    return all;
}

// ---- results ----

/// A struct, or an array of structs, that are the same in C and C++.
template <class C, class T>
[[nodiscard]] const C* same(const std::vector<T>& values) {
    static_assert(sizeof(C) == sizeof(T) && alignof(C) == alignof(T));
    static_assert(std::is_standard_layout_v<C> && std::is_standard_layout_v<T>);
    static_assert(std::is_trivially_copyable_v<T>);
    return reinterpret_cast<const C*>(values.data());
}
template <class C, class T>
[[nodiscard]] C same(const T& value) {
    static_assert(sizeof(C) == sizeof(T) && std::is_trivially_copyable_v<T>);
    C made;
    std::memcpy(&made, &value, sizeof made);
    return made;
}
/// The numbers of rows, one after the other.
[[nodiscard]] inline const double* flat(std::span<const tf::point3> values) {
    return reinterpret_cast<const double*>(values.data());
}
[[nodiscard]] inline const double* flat(std::span<const tf::point2> values) {
    return reinterpret_cast<const double*>(values.data());
}
template <class T, std::size_t N>
[[nodiscard]] const T* flat(const std::vector<std::array<T, N>>& values) {
    return values.empty() ? nullptr : values.data()->data();
}
template <class T>
[[nodiscard]] const T* or_null(const std::vector<T>& values) {
    return values.empty() ? nullptr : values.data();
}
[[nodiscard]] inline treeform_arrays arrays(tf::mesh_view mesh) {
    return {flat(mesh.points), mesh.points.size(),
            reinterpret_cast<const std::uint32_t*>(mesh.faces.data()), mesh.faces.size()};
}
inline constexpr tf::point3 nowhere{not_known, not_known, not_known};
inline void copy(const tf::point3& from, double* to) {
    to[0] = from.x;
    to[1] = from.y;
    to[2] = from.z;
}
inline void copy(const tf::transform<3>& from, double* to) {
    std::memcpy(to, from.rows.data(), sizeof from.rows);
}
inline void copy(const std::array<double, 3>& from, double* to) {
    std::memcpy(to, from.data(), sizeof from);
}
inline void copy(const std::array<std::array<double, 3>, 3>& from, double* to) {
    std::memcpy(to, from.data(), sizeof from);
}
[[nodiscard]] inline treeform_box copied(const tf::box3& b) {
    treeform_box result;
    copy(b.min, result.min);
    copy(b.max, result.max);
    return result;
}

/// [strings] for a struct; `owner` keeps the pointers, the strings stay where they are.
[[nodiscard]] const char* const* words(keeper& owner, const std::vector<std::string>& strings);

/// A struct of C of one of C++ that stays.
template <class C, class T>
[[nodiscard]] C& filled(keeper& owner, const T& from) {
    C made{};
    fill(owner, from, made);
    return owner.keep(made);
}
/// The same of many.
template <class C, class T>
[[nodiscard]] const C* list(keeper& owner, const std::vector<T>& from) {
    std::vector<C> made(from.size());
    for (std::size_t i = 0; i < from.size(); ++i) fill(owner, from[i], made[i]);
    return owner.keep(std::move(made)).data();
}

/// One, or none, as a list.
template <class T>
[[nodiscard]] std::vector<T> as_list(std::optional<T>&& one) {
    std::vector<T> made;
    if (one) made.push_back(std::move(*one));
    return made;
}
/// The code of a result with this certificate.
///
/// \throws cancelled where that is how it ended
[[nodiscard]] treeform_code code_of(const tf::certificate& certificate);

/// Hands out what a function of C++ returned; nothing for an optional that is empty.
///
/// \throws cancelled where that is how it ended
template <class C, class T>
[[nodiscard]] treeform_code give(T&& found, C** out) {
    auto made = make<C>();
    const auto& kept = made->keep(std::forward<T>(found));
    treeform_code code = TREEFORM_OK;
    if constexpr (requires { kept.certificate; }) code = code_of(kept.certificate);
    if constexpr (requires { kept.status; }) check(kept.status);
    if constexpr (requires { kept.relation.status; }) check(kept.relation.status);
    if constexpr (requires { kept.found.status; }) check(kept.found.status);
    fill(*made, kept, made->value);
    give(std::move(made), out);
    return code;
}
template <class C, class T>
[[nodiscard]] treeform_code give(std::optional<T>&& found, C** out) {
    return found ? give(std::move(*found), out) : TREEFORM_OK;
}

}  // namespace glue

struct treeform_mesh {
    void* owner;
    treeform::mesh arrays;                    ///< where they are not the caller's
    treeform::prepared_mesh mine;             ///< unless it is one of a set
    const treeform::prepared_mesh* prepared;  ///< `mine`, or that of a set
    const void* set;
    bool one_use;
};

struct treeform_file {
    void* owner;
    treeform::mesh_file content;
};

namespace glue {

/// `ask(mesh)` with what keeps its indexes, or with a view that does not.
template <class Ask>
[[nodiscard]] auto asked(const treeform_mesh* mesh, const Ask& ask) {
    const treeform_mesh& m = need(mesh, "mesh");
    return m.one_use ? ask(m.prepared->view()) : ask(*m.prepared);
}
template <class Ask>
[[nodiscard]] auto asked(const treeform_mesh* first, const treeform_mesh* second, const Ask& ask) {
    const treeform_mesh& a = need(first, "the first mesh");
    const treeform_mesh& b = need(second, "the second mesh");
    return a.one_use && b.one_use ? ask(a.prepared->view(), b.prepared->view())
                                  : ask(*a.prepared, *b.prepared);
}
/// `ask(mesh, begin, end)` for pieces of `count` questions; a piece that is not all of them finds
/// the indexes that the first one has built.
template <class Ask>
void asked_in_pieces(const treeform_mesh* mesh, std::size_t count, const Ask& ask) {
    if (thread_progress())
        in_pieces(count, [&, &m = *need(mesh, "mesh").prepared](
                             std::size_t begin, std::size_t end) { ask(m, begin, end); });
    else
        asked(mesh, [&](const auto& m) { ask(m, std::size_t{0}, count); });
}
template <class Ask>
void asked_in_pieces(const treeform_mesh* first, const treeform_mesh* second, std::size_t count,
                     const Ask& ask) {
    const auto& a = *need(first, "the first mesh").prepared;
    const auto& b = *need(second, "the second mesh").prepared;
    if (thread_progress())
        in_pieces(count, [&](std::size_t begin, std::size_t end) { ask(a, b, begin, end); });
    else
        asked(first, second,
              [&](const auto& x, const auto& y) { ask(x, y, std::size_t{0}, count); });
}
[[nodiscard]] inline tf::mesh_view view(const treeform_mesh* mesh) {
    return need(mesh, "mesh").prepared->view();
}

/// Another handle on the arrays of a mesh or cloud.
[[nodiscard]] tf::prepared_mesh borrow(const treeform_mesh& mesh);

[[nodiscard]] tf::mesh_refs refs(const treeform_mesh* const* meshes, std::size_t count,
                                 const char* name);
[[nodiscard]] std::vector<tf::mesh_view> views(const treeform_mesh* const* meshes,
                                               std::size_t count, const char* name);

[[nodiscard]] inline std::vector<tf::face_pair> pairs_of(const treeform_mesh* mesh,
                                                         const treeform_face_pair* pairs,
                                                         std::size_t count) {
    return pairs_of(view(mesh).faces.size(), pairs, count);
}

/// A mesh as functions take it: what keeps its indexes, or a view that does not.
[[nodiscard]] tf::mesh_ref ref(const treeform_mesh* mesh, const char* name);

/// A mesh that was made, and perhaps what its elements come from.
struct made_mesh {
    tf::mesh mesh;
    std::vector<std::uint32_t> index;
};
void fill(keeper& kept, const made_mesh& from, treeform_made_mesh& to);
void fill(keeper& kept, const tf::mesh& from, treeform_made_mesh& to);
[[nodiscard]] const double* positions_of(keeper& kept, const std::vector<tf::curve_point>& from);
/// [F] numbers in the file, counting polygons.
[[nodiscard]] const std::vector<std::uint32_t>& faces_in_file(keeper& kept,
                                                              const tf::usable_mesh& from);

/// A file within a result.
[[nodiscard]] const treeform_file* keep(keeper& owner, tf::mesh_file&& file);
treeform_code give(tf::mesh_file&& file, treeform_file** out);
treeform_code give(tf::placement&& at, treeform_placement** out);
treeform_code give(tf::turn_result&& turned, treeform_placement** out);
treeform_code give(tf::feature_mating&& mated, treeform_placement** out);
[[nodiscard]] tf::drop_options drop_options_of(const treeform_place_options* options,
                                               const double* direction);
[[nodiscard]] tf::mesh_feature feature_of(const treeform_feature* from, const char* name);
/// Nothing where `out` is null.
void give_written(tf::write_result from, treeform_written** out);

}  // namespace glue
