#pragma once
/// \file
/// Runs long calls on a helper thread. Meanwhile, the calling thread lets other Python threads run,
/// handles signals (Ctrl-C) and reports progress.

#include "base.hpp"

namespace binding {

/// `by_elements`: run on the calling thread if there are few elements. `writes`: long work that
/// would leave an incomplete file if the process ended.
enum class job_kind : std::uint8_t { by_elements, long_work, writes };

/// Makes the function or method `name` of `scope` a job. It then also takes `progress`: None, or a
/// function that is called with the completed share of the work.
///
/// A job runs on a helper thread, except if it is `by_elements` and has few elements, for which the
/// thread would cost more than the work. It is asked to stop if `progress` returns False or raises,
/// or if a signal handler raises, as for Ctrl-C. The caller gets the exception at once, even if the
/// job takes longer to stop. If the job has completed, a False of `progress` is ignored.
void make_job(const py::object& scope, const char* name, job_kind kind = job_kind::by_elements);

/// The same for several names.
void make_jobs(const py::object& scope, std::initializer_list<const char*> names,
               job_kind kind = job_kind::by_elements);

/// Adds a function that is a job.
template <class Function>
void add_job(py::module_& module, const char* name, Function* function,
             job_kind kind = job_kind::by_elements) {
    module.def(name, function);
    make_job(module, name, kind);
}

/// The progress callback of the job that runs on this thread; empty if there is none.
treeform::progress_callback report_of_job();

/// To be called by a job before an action that cannot be undone. False: the job has to stop.
/// Otherwise, it can no longer be stopped.
bool commit_job();

/// Whether the job that runs on this thread has to stop; null if there is none.
const std::atomic<bool>* stop_of_job();

/// Calls `body` without the interpreter's lock.
void without_lock(const std::function<void()>& body);

/// Calls `body` with the interpreter's lock, from work that runs without it.
void with_lock(const std::function<void()>& body);

/// What `body(progress_callback)` returns. `body` runs without the interpreter's lock, and must not
/// use Python.
template <class Body>
auto run(Body&& body) {
    using result = std::invoke_result_t<Body&, const treeform::progress_callback&>;
    std::optional<result> made;
    without_lock([&] { made.emplace(body(report_of_job())); });
    return std::move(*made);
}

/// Calls `body(begin, end)` for pieces of `count` elements, without the interpreter's lock, so that
/// work without a callback can be stopped: `tools::in_pieces`.
void run_pieces(std::size_t count, const std::function<void(std::size_t, std::size_t)>& body);

/// The concatenated results of `find(begin, end)` for such pieces.
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

/// `type(arguments...)`, as a job for objects that take long to construct.
py::object build(const py::object& type, const py::args& arguments);

/// Stops all jobs, so that this thread can end the process. From then on, no other thread gets the
/// interpreter's lock. Returns what jobs still do; to be repeated until they have ended, or for
/// some time.
enum class still : int { nothing, works, writes };
int end();

/// If jobs still run when the process ends, the memory that they use is not freed.
void leave_jobs_at_the_end();

/// `progress` returned False.
class cancelled {};

}  // namespace binding
