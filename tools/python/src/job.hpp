#pragma once
/// \file
/// Runs what takes long on a helper thread, while the thread that called it lets Python's other
/// threads run, looks for signals (Ctrl-C) and reports progress.

#include "base.hpp"

namespace binding {

/// Few elements: done at once. `writes`: long work, too, that leaves a file of its own behind where
/// it is not ended in its turn.
enum class job_kind : std::uint8_t { by_elements, long_work, writes };

/// Makes the function or method `name` of `scope` a job. It then also takes `progress`: None, or a
/// function that is called with the share of the work that is done.
///
/// A job runs on a helper thread, unless its arguments are few elements and it is `by_elements`:
/// handing it over would take longer. It is asked to stop when `progress` returns False or raises,
/// or when a signal's handler raises, as that of Ctrl-C does; a result that is there is returned
/// all the same where `progress` returns False. The caller then gets what was raised: at once, even
/// where the job takes some time to notice.
void make_job(const py::object& scope, const char* name, job_kind kind = job_kind::by_elements);

/// The same of several.
void make_jobs(const py::object& scope, std::initializer_list<const char*> names,
               job_kind kind = job_kind::by_elements);

/// Adds a function that is a job.
template <class Function>
void add_job(py::module_& module, const char* name, Function* function,
             job_kind kind = job_kind::by_elements) {
    module.def(name, function);
    make_job(module, name, kind);
}

/// The job that runs on this thread: `progress_callback` for it; empty where there is none.
treeform::progress_callback report_of_job();

/// For jobs, before what cannot be taken back: false where the job is to stop. After that,
/// `progress` no longer stops it.
bool commit_job();

/// Whether the job that runs on this thread is to stop; null where there is none.
const std::atomic<bool>* stop_of_job();

/// Does `body` without the interpreter's lock.
void without_lock(const std::function<void()>& body);

/// Does `body` with the interpreter's lock, within work that goes on without it.
void with_lock(const std::function<void()>& body);

/// What `body(progress_callback)` returns. It runs without the interpreter's lock and must not
/// touch Python.
template <class Body>
auto run(Body&& body) {
    using result = std::invoke_result_t<Body&, const treeform::progress_callback&>;
    std::optional<result> made;
    without_lock([&] { made.emplace(body(report_of_job())); });
    return std::move(*made);
}

/// `body(begin, end)` for pieces of `count` elements, without the interpreter's lock, for work that
/// cannot be asked to stop: `tools::in_pieces`.
void run_pieces(std::size_t count, const std::function<void(std::size_t, std::size_t)>& body);

/// What `find(begin, end)` returns for such pieces, one after the other.
template <class Find>
auto in_pieces(std::size_t count, const Find& find) {
    decltype(find(count, count)) all;
    all.reserve(count);
    run_pieces(count, [&](std::size_t begin, std::size_t end) {
        auto found = find(begin, end);
        std::ranges::move(found, std::back_inserter(all));
    });
    return all;
}

/// For jobs: makes objects that take long to make, as `build(type, arguments...)`.
py::object build(const py::object& type, const py::args& arguments);

/// Ends all jobs, for this thread to end the process. From then on no other thread gets the
/// interpreter's lock. Again until no job writes, and for a while as long as there are others.
enum class still : int { nothing, works, writes };
int end();

/// Where jobs still work when the process ends, it ends without what they may use being freed.
void leave_jobs_at_the_end();

/// `progress` has returned False.
class cancelled {};

}  // namespace binding
