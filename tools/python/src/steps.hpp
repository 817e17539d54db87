#pragma once
/// \file
/// Work in steps in a folder, each step a job.

#include "bindings.hpp"

namespace binding {

/// The communicator for a Python object with rank, size and exchange; for None, one of a single
/// process. Copies can be destroyed without the interpreter's lock as long as the first one lives.
inline treeform::communicator communicator_of(const py::object& communicator) {
    treeform::communicator made;
    if (communicator.is_none()) return made;
    made.rank = communicator.attr("rank").cast<std::size_t>();
    made.size = communicator.attr("size").cast<std::size_t>();
    made.exchange = [all = std::make_shared<py::object>(communicator.attr("exchange"))](
                        const std::string& sent) {
        std::vector<std::string> received;
        with_lock([&] { received = (*all)(py::bytes(sent)).cast<std::vector<std::string>>(); });
        return received;
    };
    return made;
}

/// Tells a communicator when this process begins to work, and when it ends, even if the caller of
/// an interrupted job no longer waits.
class at_work {
  public:
    explicit at_work(const py::object& communicator) : all_(communicator) {
        if (!all_.is_none()) all_.attr("begin")();
    }
    at_work(const at_work&) = delete;
    at_work& operator=(const at_work&) = delete;
    ~at_work() {
        try {
            if (!all_.is_none()) all_.attr("end")();
        } catch (py::error_already_set& error) {
            error.discard_as_unraisable("treeform");
        }
    }

  private:
    const py::object& all_;
};

/// Reports the progress of the current step.
class step_progress {
  public:
    /// The callback for options of the library.
    bool operator()(std::string_view, double share) const { return !report_ || report_(share); }

    void begin(treeform::progress_callback report) { report_ = std::move(report); }

  private:
    treeform::progress_callback report_;
};

/// A `Work` for several Python threads: one step at a time. An interrupted step, too, ends before
/// the next one begins.
template <class Work>
class work_in_steps {
  public:
    /// `make(progress)` creates the work, with options that refer to `progress`.
    template <class Make>
    explicit work_in_steps(Make&& make) : work_(make(progress_)) {}

    /// What `body(work)` returns, without the interpreter's lock.
    ///
    /// \throws std::invalid_argument after `close`
    template <class Body>
    auto step(Body&& body) {
        return run([&](const treeform::progress_callback& report) {
            const std::lock_guard one_at_a_time(mutex_);
            if (!work_) throw std::invalid_argument("the folder has been closed");
            progress_.begin(report);
            return body(*work_);
        });
    }

    /// Unlocks the folder for others.
    void close() {
        without_lock([&] {
            const std::lock_guard one_at_a_time(mutex_);
            work_.reset();
        });
    }

  private:
    step_progress progress_;
    std::mutex mutex_;
    std::optional<Work> work_;
};

/// A method of `Work` as a step. A status is ignored, since the job reports the error.
template <class Work, class Of, class Result, class... Arguments>
auto step_of(Result (Of::*method)(Arguments...)) {
    return [method](work_in_steps<Work>& all, const std::remove_cvref_t<Arguments>&... given) {
        const auto body = [&](Work& one) {
            if constexpr (!std::is_void_v<Result>)
                return (one.*method)(given...);
            else
                return (one.*method)(given...), true;
        };
        if constexpr (std::is_void_v<Result> || std::is_same_v<Result, tf::status>)
            static_cast<void>(all.step(body));
        else if constexpr (requires(Result made) { object(of_result{}, std::move(made)); })
            return as_python(all.step(body));
        else
            return all.step(body);
    };
}

/// The class for a `Work`, with the common steps and `finish`.
template <class Work, class Finish>
void add_steps(py::module_& module, const char* name, const Finish& finish) {
    py::class_<work_in_steps<Work>> made(module, name);
    made.def("scatter", step_of<Work>(&Work::scatter))
        .def("tiles", step_of<Work>(&Work::tiles))
        .def("unfinished", step_of<Work>(&Work::unfinished))
        .def("do_tile", step_of<Work>(&Work::do_tile))
        .def("finish", step_of<Work>(finish))
        .def("remove_folder", step_of<Work>(&Work::remove_folder))
        .def("close", &work_in_steps<Work>::close);
    make_jobs(made, {"scatter", "do_tile", "finish"}, job_kind::writes);
}

}  // namespace binding
