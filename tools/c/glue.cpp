#include <treeform/mesh/weld_stream.hpp>
#include <treeform/tree/version.hpp>

#include <tools/c/glue.hpp>

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
        say(what);
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
    } catch (const tf::stream_error& e) {
        return said(e.what(), TREEFORM_FILE);
    } catch (const std::filesystem::filesystem_error& e) {
        return said(e.what(), TREEFORM_FILE);
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

tf::box3 box(const treeform_box& b) { return {point(b.min, "min"), point(b.max, "max")}; }

tf::progress_callback progress(treeform_progress call, void* data) {
    if (!call) return {};
    return [call, data](double done) { return call(done, data) == 0; };
}

tf::process_team team(const treeform_team* of) {
    if (!of) return {};
    const auto call = &need(of->exchange, "the exchange of the team");
    if (of->rank >= of->size)
        throw std::invalid_argument("the team has " + std::to_string(of->size) +
                                    " processes; the rank is " + std::to_string(of->rank));
    const auto exchange = [=, size = of->size, data = of->data](const std::string& told) {
        std::vector<std::string> all;
        const auto hear = [](const void* bytes, std::size_t count, void* listener) {
            static_cast<std::vector<std::string>*>(listener)->emplace_back(
                static_cast<const char*>(bytes), count);
        };
        if (call(told.data(), told.size(), hear, &all, data) != 0) throw cancelled{};
        if (all.size() != size)
            throw std::invalid_argument("exchange: " + std::to_string(all.size()) + " of " +
                                        std::to_string(size) + " processes were heard");
        return all;
    };
    return {of->rank, of->size, exchange};
}

tf::progress_callback thread_progress() {
    return progress(progress_of_thread, progress_data_of_thread);
}

treeform_certificate certificate_of(const tf::certificate& kept, const char* message) {
    treeform_certificate c{};
    c.status = static_cast<treeform_status>(kept.status);
    c.message = message;
    c.meeting_count = kept.meeting_count;
    c.meeting = kept.meeting.empty() ? nullptr : kept.meeting.data()->data();
    c.meeting_at = flat(kept.meeting_at);
    c.meeting_listed = kept.meeting.size();
    c.open_count = kept.open_count;
    c.open = same<treeform_open_edge>(kept.open);
    c.open_listed = kept.open.size();
    c.boundary_edges = kept.boundary_edges;
    c.misoriented_edges = kept.misoriented_edges;
    c.max_displacement = kept.max_displacement;
    c.precision = static_cast<treeform_precision>(kept.precision);
    c.vanished_faces = kept.vanished_faces;
    c.size_before = kept.size_before;
    c.size_after = kept.size_after;
    c.size_is_volume = kept.size_is_volume;
    return c;
}

treeform_code code_of(const tf::certificate& certificate) {
    if (certificate.status == tf::status::cancelled) throw cancelled{};
    if (certificate || certificate.status == tf::status::sheet) return TREEFORM_OK;
    say(certificate.message().c_str());
    return TREEFORM_NOT_CERTIFIED;
}

tf::prepared_mesh borrow(const treeform_mesh& mesh) {
    const tf::mesh_view view = mesh.prepared->view();
    return mesh.prepared->is_cloud() ? tf::prepared_mesh::borrow_cloud(view.points)
                                     : tf::prepared_mesh::borrow(view);
}

tf::mesh_refs refs(const treeform_mesh* const* meshes, std::size_t count, const char* name) {
    std::vector<tf::mesh_ref> all;
    for (const treeform_mesh* one : array(meshes, count, name))
        all.emplace_back(*need(one, name).prepared);
    return all;
}

std::vector<tf::mesh_view> views(const treeform_mesh* const* meshes, std::size_t count,
                                 const char* name) {
    std::vector<tf::mesh_view> result;
    for (const treeform_mesh* one : array(meshes, count, name))
        result.push_back(need(one, name).prepared->view());
    return result;
}

void give(tf::mesh_file&& file, treeform_file** out) {
    auto made = make<treeform_file>();
    made->value.content = std::move(file);
    give(std::move(made), out);
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
    switch (code) {
        case TREEFORM_OK:
            return "ok";
        case TREEFORM_NOT_CERTIFIED:
            return "not certified";
        case TREEFORM_NO_PLACE:
            return "no place";
        case TREEFORM_INVALID:
            return "invalid";
        case TREEFORM_FILE:
            return "file";
        case TREEFORM_MEMORY:
            return "memory";
        case TREEFORM_RANGE:
            return "range";
        case TREEFORM_CANCELLED:
            return "cancelled";
        case TREEFORM_INTERNAL:
            return "internal";
        default:
            return "unknown";
    }
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
        glue::give(std::move(made), limit);
    });
}
