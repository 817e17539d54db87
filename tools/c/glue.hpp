#pragma once
/// \file
/// What all functions of the C surface share: exceptions become codes, arguments are checked, and
/// results are kept until they are freed.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/prepared_mesh.hpp>
#include <treeform/mesh/process_team.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/transform.hpp>

#include <tools/bindings/pieces.hpp>
#include <treeform.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
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

/// A struct that is handed out, and all that its arrays belong to.
template <class C>
struct answer final : owned {
    answer() { value.owner = static_cast<owned*>(this); }

    /// `what`, as long as the answer exists.
    template <class T>
    T& keep(T what) {
        auto place = std::make_shared<T>(std::move(what));
        kept.push_back(place);
        return *place;
    }

    std::vector<std::shared_ptr<void>> kept;  // outlives value
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
[[nodiscard]] tf::box3 box(const treeform_box& b);

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

/// One that is alone for null.
[[nodiscard]] tf::process_team team(const treeform_team* of);

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

/// An array of structs that are the same in C and C++.
template <class C, class T>
[[nodiscard]] const C* same(const std::vector<T>& values) {
    static_assert(sizeof(C) == sizeof(T) && alignof(C) == alignof(T));
    static_assert(std::is_standard_layout_v<C> && std::is_standard_layout_v<T>);
    static_assert(std::is_trivially_copyable_v<T>);
    return reinterpret_cast<const C*>(values.data());
}
[[nodiscard]] inline const double* flat(std::span<const tf::point3> values) {
    return reinterpret_cast<const double*>(values.data());
}
[[nodiscard]] inline treeform_arrays arrays(tf::mesh_view mesh) {
    return {flat(mesh.points), mesh.points.size(),
            reinterpret_cast<const std::uint32_t*>(mesh.faces.data()), mesh.faces.size()};
}
inline void copy(const tf::point3& from, double* to) {
    to[0] = from.x;
    to[1] = from.y;
    to[2] = from.z;
}
inline void copy(const tf::transform<3>& from, double* to) {
    std::memcpy(to, from.rows.data(), sizeof from.rows);
}
[[nodiscard]] inline treeform_search_effort copied(const tf::search_effort& e) {
    return {e.pairs, e.bound, e.cut};
}
[[nodiscard]] inline treeform_box copied(const tf::box3& b) {
    treeform_box result;
    copy(b.min, result.min);
    copy(b.max, result.max);
    return result;
}

/// [strings] for a struct; `owner` keeps the pointers, the strings stay where they are.
template <class C>
[[nodiscard]] const char* const* words(answer<C>& owner, const std::vector<std::string>& strings) {
    std::vector<const char*> pointers;
    for (const std::string& one : strings) pointers.push_back(one.c_str());
    return owner.keep(std::move(pointers)).data();
}

[[nodiscard]] treeform_certificate certificate_of(const tf::certificate& kept, const char* message);

template <class C>
[[nodiscard]] const treeform_certificate* keep(answer<C>& owner, const tf::certificate& from) {
    const tf::certificate& kept = owner.keep(from);
    const std::string& message = owner.keep(from.message());
    return &owner.keep(certificate_of(kept, message.c_str()));
}

template <class C>
[[nodiscard]] const treeform_warning* keep(answer<C>& owner,
                                           const std::vector<tf::io_warning>& from) {
    const std::vector<tf::io_warning>& kept = owner.keep(from);
    std::vector<treeform_warning> warnings;
    for (const tf::io_warning& one : kept) warnings.push_back({one.code.c_str(), one.text.c_str()});
    return owner.keep(std::move(warnings)).data();
}

/// The code of a result with this certificate.
///
/// \throws cancelled where that is how it ended
[[nodiscard]] treeform_code code_of(const tf::certificate& certificate);

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
/// `ask(mesh, begin, end)` for pieces of `count` questions; a piece that is not all of them finds the
/// indexes that the first one has built.
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

/// A file within a result.
template <class C>
[[nodiscard]] const treeform_file* keep(answer<C>& owner, tf::mesh_file&& file) {
    return &owner.keep(treeform_file{nullptr, std::move(file)});
}
void give(tf::mesh_file&& file, treeform_file** out);

}  // namespace glue
