#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/weld_stream.hpp>
#include <treeform/tree/version.hpp>

#include <tools/c/handles.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>

namespace {

// Nothing here has a destructor: glibc ends the process where there is no memory to note one.
thread_local std::array<char, 4096> last_error{};  ///< what a thread was told last, or how it began
thread_local treeform_progress progress_of_thread = nullptr;
thread_local void* progress_data_of_thread = nullptr;

}  // namespace

namespace glue {

void say(const char* what) noexcept {
    const std::size_t size = std::min(std::strlen(what), last_error.size() - 1);
    std::memmove(last_error.data(), what, size);
    last_error[size] = 0;
}

treeform_code code_of_exception() noexcept {
    const auto said = [](const char* what, treeform_code code) {
        const char* const end = std::strstr(what, ": ");  // of the name of the function in C++
        say(end && std::string_view(what).starts_with("treeform::") ? end + 2 : what);
        return code;
    };
    try {
        throw;
    } catch (const cancelled&) {
        return said("cancelled", TREEFORM_CANCELLED);
    } catch (const std::bad_alloc&) {
        return said("out of memory", TREEFORM_MEMORY);
    } catch (const tf::io_error& e) {
        return said(e.what(), TREEFORM_FILE);
    } catch (const std::filesystem::filesystem_error& e) {
        return said(e.what(), TREEFORM_FILE);
    } catch (const tf::not_certified_error& e) {
        return said(e.what(), TREEFORM_INVALID);
    } catch (const std::invalid_argument& e) {
        return said(e.what(), TREEFORM_INVALID);
    } catch (const std::out_of_range& e) {
        return said(e.what(), TREEFORM_INVALID);
    } catch (const std::length_error& e) {
        return said(e.what(), TREEFORM_RANGE);
    } catch (const std::overflow_error& e) {
        return said(e.what(), TREEFORM_RANGE);
    } catch (const std::exception& e) {
        return said(e.what(), TREEFORM_INTERNAL);
    } catch (...) {
        return said("an exception of unknown type", TREEFORM_INTERNAL);
    }
}

std::vector<std::string> texts(const char* const* what, std::size_t count, const char* name) {
    std::vector<std::string> result;
    for (const char* one : array(what, count, name)) result.emplace_back(&need(one, name));
    return result;
}

tf::point3 finite(const double* data, const char* name) {
    const tf::point3 p = point(data, name);
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        throw std::invalid_argument(std::string(name) + " is not finite");
    return p;
}

tf::point2 finite2(const double* data, const char* name) {
    (void)need(data, name);
    if (!std::isfinite(data[0]) || !std::isfinite(data[1]))
        throw std::invalid_argument(std::string(name) + " is not finite");
    return {data[0], data[1]};
}

tf::oriented_plane plane(const treeform_plane* plane) {
    if (!plane) return {};
    return {point(plane->at, "at"), point(plane->normal, "normal")};
}

tf::transform<3> finite_matrix(const double* data) {
    const tf::transform<3> by = matrix(&need(data, "matrix"));
    if (!by.finite()) throw std::invalid_argument("the matrix is not finite");
    return by;
}

name_pairs columns_of(const treeform_named_column* columns, std::size_t count, const char* what) {
    name_pairs all;
    for (const treeform_named_column& one : array(columns, count, what))
        all.emplace_back(&need(one.name, what), &need(one.source, what));
    return all;
}

std::vector<tf::weld_condition> conditions(const treeform_weld_condition* same, std::size_t count,
                                           const char* what) {
    std::vector<tf::weld_condition> result;
    for (const treeform_weld_condition& one : array(same, count, what))
        result.push_back({&need(one.property, "a property of same"), one.tolerance});
    return result;
}

std::vector<double> heights(const double* heights, std::size_t count) {
    if (!heights) return {0.0};
    const std::span<const double> all = array(heights, count, "heights");
    return {all.begin(), all.end()};
}

std::vector<tf::face_pair> pairs_of(std::size_t face_count, const treeform_face_pair* pairs,
                                    std::size_t count) {
    std::vector<tf::face_pair> result;
    for (const treeform_face_pair& one : array(pairs, count, "pairs")) {
        if (one.a >= face_count || one.b >= face_count)
            throw std::invalid_argument("pair " + std::to_string(result.size()) +
                                        " names a face that does not exist; there are " +
                                        std::to_string(face_count));
        result.push_back({one.a, one.b, choice<tf::pair_kind>(one.kind, 7, "a kind")});
    }
    return result;
}

tf::pair_kinds kinds(std::uint32_t bits) {
    if (bits > TREEFORM_ALL_KINDS)
        throw std::invalid_argument("kinds is " + std::to_string(bits) +
                                    ", which is not a sum of kinds");
    tf::pair_kinds result;
    for (std::uint32_t kind = 0; kind < tf::pair_kind_count; ++kind)
        if ((bits >> kind & 1U) != 0) result = result + static_cast<tf::pair_kind>(kind);
    return result;
}

tf::box3 box(const treeform_box& b) { return {point(b.min, "min"), point(b.max, "max")}; }

tf::progress_callback progress(treeform_progress call, void* data) {
    if (!call) return {};
    return [call, data](double done) { return call(done, data) == 0; };
}

tf::communicator communicator_of(const treeform_communicator* of) {
    if (!of) return {};
    const auto call = &need(of->exchange, "the exchange of the communicator");
    if (of->rank >= of->size)
        throw std::invalid_argument("the communicator has " + std::to_string(of->size) +
                                    " processes; the rank is " + std::to_string(of->rank));
    const auto exchange = [=, size = of->size, data = of->data](const std::string& sent) {
        std::vector<std::string> all;
        const auto receive = [](const void* bytes, std::size_t count, void* listener) {
            static_cast<std::vector<std::string>*>(listener)->emplace_back(
                static_cast<const char*>(bytes), count);
        };
        if (call(sent.data(), sent.size(), receive, &all, data) != 0) throw cancelled{};
        if (all.size() != size)
            throw std::invalid_argument("exchange: " + std::to_string(all.size()) + " of " +
                                        std::to_string(size) + " processes were received");
        return all;
    };
    return {of->rank, of->size, exchange};
}

tf::progress_callback thread_progress() {
    return progress(progress_of_thread, progress_data_of_thread);
}

treeform_code code_of(const tf::certificate& certificate) {
    if (certificate.status == tf::status::cancelled) throw cancelled{};
    if (certificate || certificate.status == tf::status::sheet) return TREEFORM_OK;
    say(certificate.message().c_str());
    return TREEFORM_NOT_CERTIFIED;
}

tf::mesh_view finite_view(const treeform_mesh* mesh) {
    const tf::mesh_view all = view(mesh);
    if (const auto bad = tf::find_invalid_faces(all).nonfinite_faces; !bad.empty())
        throw std::invalid_argument("face " + std::to_string(bad[0]) +
                                    " has a corner that is not finite");
    return all;
}

const treeform_mesh* const* handles(keeper& kept, const std::vector<tf::prepared_mesh>& row) {
    auto& handles = kept.keep(std::vector<treeform_mesh>(row.size()));
    auto& pointers = kept.keep(std::vector<const treeform_mesh*>());
    for (std::size_t i = 0; i < row.size(); ++i) {
        handles[i].prepared = &row[i];
        pointers.push_back(&handles[i]);
    }
    return pointers.data();
}

tf::mesh_ref ref(const treeform_mesh* mesh, const char* name) {
    const treeform_mesh& m = need(mesh, name);
    if (m.one_use) return view(mesh);
    return *m.prepared;
}

tf::mesh_refs refs(const treeform_mesh* const* meshes, std::size_t count, const char* name) {
    std::vector<tf::mesh_ref> all;
    for (const treeform_mesh* one : array(meshes, count, name)) all.push_back(ref(one, name));
    tf::mesh_refs result = all;  // refers to the meshes, not to `all`
    return result;
}

std::vector<tf::mesh_view> views(const treeform_mesh* const* meshes, std::size_t count,
                                 const char* name) {
    std::vector<tf::mesh_view> result;
    for (const treeform_mesh* one : array(meshes, count, name))
        result.push_back(ref(one, name).view());
    return result;
}

const char* const* words(keeper& owner, const std::vector<std::string>& strings) {
    std::vector<const char*> pointers;
    for (const std::string& one : strings) pointers.push_back(one.c_str());
    return owner.keep(std::move(pointers)).data();
}

void fill(keeper&, const tf::mesh& from, treeform_made_mesh& to) { to.mesh = arrays(from); }

void fill(keeper&, const made_mesh& from, treeform_made_mesh& to) {
    to.mesh = arrays(from.mesh);
    to.index = or_null(from.index);
    to.index_count = from.index.size();
}

const double* positions_of(keeper& kept, const std::vector<tf::curve_point>& from) {
    std::vector<tf::point3> all;
    for (const tf::curve_point& one : from) all.push_back(one.position);
    return flat(kept.keep(std::move(all)));
}

const std::vector<std::uint32_t>& faces_in_file(keeper& kept, const tf::usable_mesh& from) {
    std::vector<std::uint32_t> in_file(from.mesh.faces.size());
    for (std::uint32_t f = 0; f < in_file.size(); ++f) in_file[f] = from.face_in_file(f);
    return kept.keep(std::move(in_file));
}

const treeform_file* keep(keeper& owner, tf::mesh_file&& file) {
    return &owner.keep(treeform_file{nullptr, std::move(file)});
}

}  // namespace glue

struct treeform_thread_limit {
    void* owner;
    std::optional<treeform::thread_scope> scope;
};

const char* treeform_last_error(void) { return last_error.data(); }

void treeform_set_progress(treeform_progress progress, void* data) {
    progress_of_thread = progress;
    progress_data_of_thread = data;
}

const char* treeform_code_name(treeform_code code) {
    constexpr std::array names{"internal", "cancelled", "range",         "memory",  "file",
                               "invalid",  "ok",        "not certified", "no place"};
    return code < TREEFORM_INTERNAL || code > TREEFORM_NO_PLACE
               ? "unknown"
               : names[static_cast<std::size_t>(code - TREEFORM_INTERNAL)];
}

void treeform_free(void* what) {
    if (what) delete static_cast<glue::owned*>(*static_cast<void**>(what));
}

static_assert(TREEFORM_C_VERSION == TREEFORM_VERSION, "base.h has the version of version.hpp");

int32_t treeform_version(void) { return treeform::version(); }

const char* treeform_version_string(void) { return treeform::version_string(); }

uint32_t treeform_thread_count(void) { return treeform::thread_count(); }

treeform_code treeform_limit_threads(uint32_t threads, treeform_thread_limit** limit) {
    return glue::guard([&] {
        glue::start(limit);
        auto made = glue::make<treeform_thread_limit>();
        made->value.scope.emplace(threads);
        return glue::give(std::move(made), limit);
    });
}

uint64_t treeform_default_memory(void) {
    std::uint64_t bytes = 0;
    const treeform_code code =
        glue::guard([&] { bytes = treeform::weld_stream_options::default_memory(); });
    return code == TREEFORM_OK ? bytes : 0;
}

int32_t treeform_reads_scenes(void) { return treeform::reads_scenes(); }
