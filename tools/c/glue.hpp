#pragma once
/// \file
/// Common to all functions of the C interface: exceptions become codes, arguments are checked, and
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

/// The base of everything that `treeform_free` deletes. Its address is the first member of every
/// returned struct.
struct owned {
    owned() = default;
    owned(const owned&) = delete;
    owned& operator=(const owned&) = delete;
    virtual ~owned() = default;
};

/// Owns the data to which the arrays of structs refer.
struct keeper : owned {
    /// Moves `what` here, and returns a reference that is valid as long as this exists.
    template <class T>
    T& keep(T what) {
        auto place = std::make_shared<T>(std::move(what));
        kept.push_back(place);
        return *place;
    }

    std::vector<std::shared_ptr<void>> kept;
};

/// A struct returned to the caller, with the data that it owns.
template <class C>
struct answer final : keeper {
    answer() { value.owner = static_cast<owned*>(this); }
    C value{};
};

template <class C>
using answer_of = std::unique_ptr<answer<C>>;

template <class C>
[[nodiscard]] answer_of<C> make() {
    return std::make_unique<answer<C>>();
}

/// Releases it to the caller.
template <class C>
treeform_code give(answer_of<C> made, C** out) {
    *out = &made.release()->value;
    return TREEFORM_OK;
}

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// Thrown if `progress` returned other than 0.
struct cancelled {};

/// \throws cancelled if the status is `cancelled`
inline void check(tf::status status) {
    if (status == tf::status::cancelled) throw cancelled{};
}

/// Sets the message of `treeform_last_error`.
void say(const char* what) noexcept;
/// The code of the exception that is being handled.
[[nodiscard]] treeform_code code_of_exception() noexcept;

/// Runs the body of a function, and converts exceptions to codes. The body may also return a code.
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

/// The caller's pointer for a result, set to null until there is one.
template <class T>
void start(T** out) {
    need(out, "the pointer to the result") = nullptr;
}

template <class T>
[[nodiscard]] std::span<T> array(T* data, std::size_t count, const char* name) {
    if (count > std::size_t{1} << 40) throw std::length_error(std::string(name) + ": too many");
    if (count != 0) (void)need(data, name);
    return {data, count};
}

[[nodiscard]] inline tf::point3 point(const double* data, const char* name) {
    (void)need(data, name);
    return {data[0], data[1], data[2]};
}
/// The transform of a matrix; the identity for null.
[[nodiscard]] inline tf::transform<3> matrix(const double* data) {
    tf::transform<3> result;
    if (data) std::memcpy(result.rows.data(), data, sizeof result.rows);
    return result;
}
/// The transform of a matrix, which must not be null and must be finite.
[[nodiscard]] tf::transform<3> finite_matrix(const double* data);
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
/// A point that is checked to be finite, as the predicates require.
[[nodiscard]] tf::point3 finite(const double* data, const char* name);
[[nodiscard]] tf::point2 finite2(const double* data, const char* name);
/// A plane; null: through the origin, perpendicular to z.
[[nodiscard]] tf::oriented_plane plane(const treeform_plane* plane);
/// Heights; if there are none, the plane itself.
[[nodiscard]] std::vector<double> heights(const double* heights, std::size_t count);
template <class T, class C>  // of the same bytes
[[nodiscard]] std::span<const T> same_as(std::span<const C> all) {
    static_assert(sizeof(C) == sizeof(T) && alignof(C) == alignof(T));
    return {reinterpret_cast<const T*>(all.data()), all.size()};
}
/// Pairs of faces of a mesh, checked to be in range.
[[nodiscard]] std::vector<tf::face_pair> pairs_of(std::size_t face_count,
                                                  const treeform_face_pair* pairs,
                                                  std::size_t count);
[[nodiscard]] tf::box3 box(const treeform_box& b);
/// An empty value for null.
[[nodiscard]] inline std::optional<tf::box3> box(const treeform_box* b) {
    return b ? std::optional(box(*b)) : std::nullopt;
}
[[nodiscard]] inline std::optional<tf::point3> point_if(const double* three, const char* name) {
    return three ? std::optional(point(three, name)) : std::nullopt;
}
[[nodiscard]] inline std::optional<std::array<double, 3>> axes(const double* three) {
    if (!three) return std::nullopt;
    return std::array{three[0], three[1], three[2]};
}
/// Rows of numbers, or C structs, viewed as C++ structs of the same layout.
template <class Row, class T>
[[nodiscard]] std::span<const Row> rows_of(const T* data, std::size_t count, const char* name) {
    static_assert(sizeof(Row) % sizeof(T) == 0 && alignof(Row) == alignof(T));
    (void)array(data, count, name);
    return {reinterpret_cast<const Row*>(data), count};
}
[[nodiscard]] inline tf::points_view points(const double* data, std::size_t count,
                                            const char* name) {
    return rows_of<tf::point3>(data, count, name);
}
/// Rows [count][4]: a point, and a number.
[[nodiscard]] inline std::vector<std::pair<tf::point3, double>> points_and_numbers(
    const double* data, std::size_t count, const char* name) {
    std::vector<std::pair<tf::point3, double>> all;
    for (const auto& [x, y, z, number] : rows_of<std::array<double, 4>>(data, count, name))
        all.push_back({{x, y, z}, number});
    return all;
}
[[nodiscard]] inline std::span<const tf::face> faces(const std::uint32_t* data, std::size_t count,
                                                     const char* name) {
    return rows_of<tf::face>(data, count, name);
}
[[nodiscard]] inline std::vector<std::uint32_t> numbers_of(const std::vector<std::size_t>& all) {
    return {all.begin(), all.end()};
}
/// The same, copied.
template <class Row, class T>
[[nodiscard]] std::vector<Row> copied_as(const T* data, std::size_t count, const char* name) {
    const auto all = rows_of<Row>(data, count, name);
    return {all.begin(), all.end()};
}
[[nodiscard]] tf::pair_kinds kinds(std::uint32_t bits);
using name_pairs = std::vector<std::pair<std::string, std::string>>;
/// Null, and null among the elements, is an error that names `what`.
[[nodiscard]] name_pairs columns_of(const treeform_named_column* columns, std::size_t count,
                                    const char* what);
[[nodiscard]] std::vector<tf::weld_condition> conditions(const treeform_weld_condition* same,
                                                         std::size_t count, const char* what);

/// One of the `count` enumerators of E, which are numbered from 0.
template <class E>
[[nodiscard]] E choice(std::int32_t value, std::int32_t count, const char* name) {
    if (value < 0 || value >= count)
        throw std::invalid_argument(std::string(name) + " is " + std::to_string(value) +
                                    ", which is not from 0 to " + std::to_string(count - 1));
    return static_cast<E>(value);
}
/// The name of an enumerator of E.
template <class E>
[[nodiscard]] const char* name_of(std::int32_t value) {
    const auto& names = tf::detail::names_of<E>;
    return value < 0 || value >= std::ssize(names) ? "unknown" : names[std::size_t(value)];
}
[[nodiscard]] inline std::size_t limit(std::uint64_t value) {
    return static_cast<std::size_t>(value);
}

[[nodiscard]] tf::progress_callback progress(treeform_progress call, void* data);
template <class Options>
[[nodiscard]] tf::progress_callback progress(const Options& options) {
    return progress(options.progress, options.progress_data);
}

/// Progress of work in steps, without the names of the steps.
template <class Options>
[[nodiscard]] std::function<bool(std::string_view, double)> step_progress(const Options& options) {
    if (!options.progress) return {};
    return [call = options.progress, data = options.progress_data](std::string_view, double done) {
        return call(done, data) == 0;
    };
}

/// A communicator; a single process for null.
[[nodiscard]] tf::communicator communicator_of(const treeform_communicator* of);

/// The callback that `treeform_set_progress` set for this thread.
[[nodiscard]] tf::progress_callback thread_progress();

/// Calls `body(begin, end)` for pieces of `count` queries, so that progress can be reported; for
/// all at once without a progress callback.
///
/// \throws cancelled
template <class Body>
void in_pieces(std::size_t count, const Body& body) {
    if (!thread_progress())
        body(std::size_t{0}, count);
    else if (!tools::in_pieces(count, thread_progress(), body))
        throw cancelled{};
}

/// Appends lists to [begin, all], in the layout of results; initially, `begin` is {0}.
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
    defaults.struct_size = size < sizeof defaults ? size : sizeof defaults;
    std::memcpy(options, &defaults, defaults.struct_size);
}

/// The caller's options, with defaults for members beyond the size of the caller's struct.
template <class C>
[[nodiscard]] C chosen(const C* options, void (*init)(C*, std::size_t)) {
    C all{};
    init(&all, sizeof all);
    if (!options) return all;
    if (options->struct_size < sizeof(std::size_t) || options->struct_size > sizeof all)
        throw std::invalid_argument("options of " + std::to_string(options->struct_size) +
                                    " bytes: call the init function of their struct first");
    std::memcpy(&all, options, options->struct_size);
    return all;
}

// ---- results ----

/// A struct, or an array of structs, with the same layout in C and C++.
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
/// The numbers of rows as one array, row after row.
[[nodiscard]] inline const double* flat(std::span<const tf::point3> values) {
    return reinterpret_cast<const double*>(values.data());
}
[[nodiscard]] inline const double* flat(std::span<const tf::point2> values) {
    return reinterpret_cast<const double*>(values.data());
}
[[nodiscard]] inline const double* flat(std::span<const std::array<tf::point3, 2>> values) {
    return reinterpret_cast<const double*>(values.data());
}
template <class T, std::size_t N>
requires std::is_arithmetic_v<T>
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
template <class T>  // of doubles
void copy(const T& from, double* to) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::memcpy(to, &from, sizeof from);
}
[[nodiscard]] inline treeform_box copied(const tf::box3& b) {
    treeform_box result;
    copy(b.min, result.min);
    copy(b.max, result.max);
    return result;
}

/// An array of C strings for a struct. `owner` keeps the pointers; the strings must outlive it.
[[nodiscard]] const char* const* words(keeper& owner, const std::vector<std::string>& strings);

/// The C struct of a C++ struct, which must outlive it.
template <class C, class T>
[[nodiscard]] C& filled(keeper& owner, const T& from) {
    C made{};
    fill(owner, from, made);
    return owner.keep(made);
}
/// The same for many.
template <class C, class T>
[[nodiscard]] const C* list(keeper& owner, const std::vector<T>& from) {
    std::vector<C> made(from.size());
    for (std::size_t i = 0; i < from.size(); ++i) fill(owner, from[i], made[i]);
    return owner.keep(std::move(made)).data();
}

/// An optional value as a list of one or no element.
template <class T>
[[nodiscard]] std::vector<T> as_list(std::optional<T>&& one) {
    std::vector<T> made;
    if (one) made.push_back(std::move(*one));
    return made;
}
/// Returns the result of a C++ function to the caller.
template <class C, class T>
C& hand_out(T&& found, C** out) {
    auto made = make<C>();
    fill(*made, made->keep(std::forward<T>(found)), made->value);
    return *(*out = &made.release()->value);
}
/// The C++ value of which an answer was made.
template <class T, class C>
[[nodiscard]] T& kept_in(const C& given, const char* name) {
    auto* const owner = dynamic_cast<answer<C>*>(static_cast<owned*>(given.owner));
    if (!owner) throw std::invalid_argument(std::string(name) + " was not created by this library");
    return *static_cast<T*>(owner->kept[0].get());
}

/// The code of a result with this certificate.
///
/// \throws cancelled if the status is `cancelled`
[[nodiscard]] treeform_code code_of(const tf::certificate& certificate);

/// The same; no result for an empty optional. Values that handles own become handles.
///
/// \throws cancelled if the status is `cancelled`
template <class C, class T>
[[nodiscard]] treeform_code give(T&& found, C** out) {
    treeform_code code = TREEFORM_OK;
    if constexpr (requires { found.certificate; }) code = code_of(found.certificate);
    if constexpr (requires { found.status; }) check(found.status);
    if constexpr (requires { found.found.status; }) check(found.found.status);
    if constexpr (requires { (*out)->content; }) {
        auto made = make<C>();
        made->value.content = std::forward<T>(found);
        return give(std::move(made), out);
    } else {
        hand_out(std::forward<T>(found), out);
        return code;
    }
}
template <class C, class T>
[[nodiscard]] treeform_code give(std::optional<T>&& found, C** out) {
    return found ? give(std::move(*found), out) : TREEFORM_OK;
}

}  // namespace glue
