#pragma once
/// \file
/// Work in a folder that is done step by step, as a job each.

#include "bindings.hpp"

namespace binding {

/// The communicator of (rank, size, exchange) as Python has it, or one that is alone for None. Its
/// copies may go without the interpreter's lock as long as the first one stays.
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

/// Tells a communicator that this process is at work, and when no more, however that ends: a call
/// that was interrupted may have been left by then.
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

/// What reports the progress of the step that is done now.
class step_progress {
  public:
    /// As options of the library take it.
    bool operator()(std::string_view, double share) const { return !report_ || report_(share); }

    void begin(treeform::progress_callback report) { report_ = std::move(report); }

  private:
    treeform::progress_callback report_;
};

/// A `Work` that Python's threads share: one step after the other. Also a step that nobody waits
/// for any more ends before the next one begins.
template <class Work>
class work_in_steps {
  public:
    /// `make(progress)` makes the work; its options refer to `progress`.
    template <class Make>
    explicit work_in_steps(Make&& make) : work_(make(progress_)) {}

    /// What `body(work)` returns, without the interpreter's lock.
    ///
    /// \throws std::invalid_argument after `close`
    template <class Body>
    auto step(Body&& body) {
        return run([&](const treeform::progress_callback& report) {
            const std::lock_guard one_at_a_time(mutex_);
            if (!work_) throw std::invalid_argument("closed: it has let go of the folder");
            progress_.begin(report);
            return body(*work_);
        });
    }

    /// Lets others have the folder.
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

/// A method of `Work` as a step; a status is not looked at, for the job says what went wrong.
template <class Work, class Of, class Result, class... Arguments>
auto step_of(Result (Of::*method)(Arguments...)) {
    return [method](work_in_steps<Work>& all, const std::remove_cvref_t<Arguments>&... given) {
        if constexpr (std::is_void_v<Result>)
            all.step([&](Work& one) {
                (one.*method)(given...);
                return true;
            });
        else if constexpr (std::is_same_v<Result, tf::status>)
            all.step([&](Work& one) { return (one.*method)(given...); });
        else if constexpr (requires(Result made) { object(of_result{}, std::move(made)); })
            return as_python(all.step([&](Work& one) { return (one.*method)(given...); }));
        else
            return all.step([&](Work& one) { return (one.*method)(given...); });
    };
}

/// The class of a `Work`: steps that all have, and `finish`.
template <class Work, class Finish>
auto add_steps(py::module_& module, const char* name, const Finish& finish) {
    py::class_<work_in_steps<Work>> made(module, name);
    made.def("scatter", step_of<Work>(&Work::scatter))
        .def("tiles", step_of<Work>(&Work::tiles))
        .def("do_tile", step_of<Work>(&Work::do_tile))
        .def("finish", step_of<Work>(finish))
        .def("remove_folder", step_of<Work>(&Work::remove_folder))
        .def("close", &work_in_steps<Work>::close);
    make_jobs(made, {"scatter", "do_tile", "finish"}, job_kind::writes);
    return made;
}

}  // namespace binding
