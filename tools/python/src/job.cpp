#include "bindings.hpp"
#include "tools/bindings/pieces.hpp"

#include <pthread.h>
#include <unistd.h>

namespace binding {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds between_looks{15};
constexpr milliseconds to_notice{50};  ///< how long to wait for a job that was asked to stop
constexpr std::size_t little = 4096;

/// Threads that have released the interpreter's lock and will want it back, or soon will.
std::atomic<int> outside{0};
/// Jobs that write files.
std::atomic<int> writing{0};
/// The thread that ends the process, once it does.
std::atomic<std::thread::id> ender{};

bool process_ends() {
    const std::thread::id one = ender;
    return one != std::thread::id() && one != std::this_thread::get_id();
}

/// Takes the interpreter's lock back. At the end of the process, the interpreter would end the
/// thread by unwinding its stack, which aborts in C++; so the thread sleeps forever instead.
void come_back(PyThreadState* state) {
    if (process_ends()) {
        --outside;
        while (true) ::pause();
    }
    PyEval_RestoreThread(state);
    --outside;
}

/// Releases the interpreter's lock of this thread during its lifetime.
class without_interpreter {
  public:
    without_interpreter() { leave(); }
    without_interpreter(const without_interpreter&) = delete;
    without_interpreter& operator=(const without_interpreter&) = delete;
    ~without_interpreter() { enter(); }

    void leave() {
        ++outside;
        state_ = PyEval_SaveThread();
        before_ = std::exchange(innermost, this);
    }
    void enter() {
        innermost = before_;
        come_back(state_);
    }

    static thread_local without_interpreter* innermost;

  private:
    PyThreadState* state_ = nullptr;
    without_interpreter* before_ = nullptr;
};
thread_local without_interpreter* without_interpreter::innermost = nullptr;

/// A call and its result. Its Python objects are only used with the interpreter's lock.
struct job {
    py::object function;
    py::object arguments;
    py::object result;
    std::exception_ptr failure;

    std::atomic<double> share{0.0};
    std::atomic<bool> stop{false};

    std::mutex mutex;
    bool committed = false;  ///< it can no longer be stopped
    std::condition_variable ended_now;
    bool ended = false;
    bool writes = false;

    /// A result that was not taken is freed with the interpreter's lock, or leaked at the end.
    ~job() {
        if (!function && !result && !failure) return;
        ++outside;
        if (process_ends()) {
            for (py::object* one : {&function, &arguments, &result}) (void)one->release();
            (void)new std::exception_ptr(std::move(failure));
        } else {
            const py::gil_scoped_acquire lock;
            function = arguments = result = py::object();
            failure = nullptr;
        }
        --outside;
    }

    /// Asks it to stop; false if it is too late.
    bool call_back() {
        const std::lock_guard lock(mutex);
        stop = !committed;
        return stop;
    }
    bool commit() {
        const std::lock_guard lock(mutex);
        return committed = !stop;
    }

    [[nodiscard]] bool has_ended_within(milliseconds time) {
        std::unique_lock lock(mutex);
        return ended_now.wait_for(lock, time, [this] { return ended; });
    }
};

thread_local job* current = nullptr;

class helper;

/// The idle helpers, and the running jobs.
class helpers {
  public:
    helper& take();
    void release(helper& one) {
        const std::lock_guard lock(mutex_);
        idle_.push_back(&one);
    }

    void begins(const std::shared_ptr<job>& one) {
        const std::lock_guard lock(mutex_);
        std::erase_if(jobs_, [](const auto& old) { return old.expired(); });
        jobs_.push_back(one);
    }
    void stop_all() {
        const std::lock_guard lock(mutex_);
        for (const auto& one : jobs_)
            if (const std::shared_ptr<job> still = one.lock()) still->call_back();
    }

  private:
    std::mutex mutex_;
    std::vector<helper*> idle_;
    std::vector<std::weak_ptr<job>> jobs_;
};

/// The helpers of this process; a fork has none of the threads of its parent.
std::atomic<helpers*> all_helpers = [] {
    pthread_atfork(nullptr, nullptr, [] {
        all_helpers = new helpers;
        outside = 0;
        writing = 0;
    });
    return new helpers;
}();

/// A thread that waits for jobs. It is never joined.
class helper {
  public:
    helper() {
        std::thread([this] { serve(); }).detach();
    }

    void start(const std::shared_ptr<job>& next) {
        ++outside;
        if (next->writes) ++writing;
        all_helpers.load()->begins(next);
        {
            const std::lock_guard lock(mutex_);
            next_ = next;
        }
        wake_.notify_one();
    }

  private:
    [[noreturn]] void serve() {
        PyThreadState* const here = first_state();
        while (true) {
            std::shared_ptr<job> mine;
            {
                std::unique_lock lock(mutex_);
                wake_.wait(lock, [this] { return next_ != nullptr; });
                mine = std::move(next_);
            }
            current = mine.get();
            come_back(here);
            call(*mine);
            PyEval_SaveThread();
            current = nullptr;
            all_helpers.load()->release(*this);
            const std::lock_guard lock(mine->mutex);
            mine->ended = true;
            mine->ended_now.notify_one();
        }
    }

    static PyThreadState* first_state() {
        PyGILState_Ensure();
        return PyEval_SaveThread();
    }

    /// The result of a stopped job may not be taken: it is freed here, with the lock.
    static void call(job& mine) {
        try {
            mine.result = mine.function(*py::reinterpret_borrow<py::args>(mine.arguments));
        } catch (...) {
            mine.failure = std::current_exception();
        }
        if (mine.writes) --writing;
        mine.function = mine.arguments = py::object();
        if (!mine.stop) return;
        mine.result = py::object();
        mine.failure = nullptr;
    }

    std::mutex mutex_;
    std::condition_variable wake_;
    std::shared_ptr<job> next_;
};

helper& helpers::take() {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) return *new helper;
    helper& one = *idle_.back();
    idle_.pop_back();
    return one;
}

/// What the calling thread does while the job runs.
class watch {
  public:
    watch(std::shared_ptr<job> mine, const py::object& progress)
        : job_(std::move(mine)), progress_(progress) {}

    py::object result() {
        look(0.0);
        if (why_) std::rethrow_exception(why_);
        all_helpers.load()->take().start(job_);
        while (!has_ended_within(between_looks)) {
            look(job_->share);
            if (why_) leave();
        }
        if (!job_->failure && job_->commit()) look(1.0);
        if (why_) std::rethrow_exception(why_);
        if (job_->failure) std::rethrow_exception(std::exchange(job_->failure, nullptr));
        return std::move(job_->result);
    }

  private:
    bool has_ended_within(milliseconds time) {
        const without_interpreter others_run;
        return job_->has_ended_within(time);
    }

    /// Handles signals and reports progress.
    void look(double share) {
        try {
            if (PyErr_CheckSignals() != 0) throw py::error_already_set();
            if (progress_.is_none()) return;
            if (progress_(share).is(py::bool_(false)) && job_->call_back()) throw cancelled();
        } catch (...) {
            why_ = std::current_exception();
            job_->call_back();
        }
    }

    /// Waits shortly for a job that was asked to stop; after that, it ends in the background.
    [[noreturn]] void leave() {
        (void)has_ended_within(to_notice);
        std::rethrow_exception(why_);
    }

    std::shared_ptr<job> job_;
    const py::object& progress_;
    std::exception_ptr why_;
};

/// The size of the arguments: numbers in arrays, elements of meshes and trees.
std::size_t elements_of(py::handle argument) {
    if (py::isinstance<py::array>(argument))
        return static_cast<std::size_t>(py::reinterpret_borrow<py::array>(argument).size());
    if (py::isinstance<held_mesh>(argument)) return argument.cast<const held_mesh&>().size();
    const PySequenceMethods* const methods = Py_TYPE(argument.ptr())->tp_as_sequence;
    std::size_t sum = 0;
    if (py::isinstance<py::list>(argument) || py::isinstance<py::tuple>(argument))
        for (const py::handle one : argument) sum += elements_of(one);
    else if (methods != nullptr && methods->sq_length != nullptr)
        sum = py::len(argument);
    return sum;
}

py::object run_job(const py::object& function, const py::args& arguments,
                   const py::object& progress, job_kind kind) {
    if (ender.load() == std::this_thread::get_id()) return function(*arguments);
    const bool may_be_little = progress.is_none() && kind == job_kind::by_elements;
    if (may_be_little && elements_of(arguments) < little) return function(*arguments);
    const auto mine = std::make_shared<job>();
    mine->function = function;
    mine->arguments = arguments;
    mine->writes = kind == job_kind::writes;
    return watch(mine, progress).result();
}

}  // namespace

void make_job(const py::object& scope, const char* name, job_kind kind) {
    const py::object function = scope.attr(name);
    const auto job_of = [=](const py::args& arguments, const py::kwargs& named) {
        py::object progress =
            named.contains("progress") ? py::object(named["progress"]) : py::none();
        if (py::hasattr(progress, "update"))
            progress = py::module_::import("treeform._progress").attr("of_bar")(progress);
        return run_job(function, arguments, progress, kind);
    };
    const auto doc = function.attr("__doc__").cast<std::string>();  // lists the arguments
    const auto add = [&](const auto& place) {
        scope.attr(name) = py::cpp_function(job_of, py::name(name), place, doc.c_str());
    };
    py::isinstance<py::module_>(scope) ? add(py::scope(scope)) : add(py::is_method(scope));
}

void make_jobs(const py::object& scope, std::initializer_list<const char*> names, job_kind kind) {
    for (const char* const name : names) make_job(scope, name, kind);
}

treeform::progress_callback report_of_job() {
    if (current == nullptr) return {};
    return [mine = current](double done) {
        mine->share = done;
        return !mine->stop;
    };
}

bool commit_job() { return current == nullptr || current->commit(); }

const std::atomic<bool>* stop_of_job() { return current == nullptr ? nullptr : &current->stop; }

void without_lock(const std::function<void()>& body) {
    const without_interpreter others_run;
    body();
}

void with_lock(const std::function<void()>& body) {
    without_interpreter* const mine = without_interpreter::innermost;
    if (mine == nullptr) {
        const py::gil_scoped_acquire lock;
        return body();
    }
    struct inside {
        explicit inside(without_interpreter* of) : of_(of) { of_->enter(); }
        ~inside() { of_->leave(); }
        without_interpreter* of_;
    } const now(mine);
    body();
}

void run_pieces(std::size_t count, const std::function<void(std::size_t, std::size_t)>& body) {
    without_lock([&] { (void)tools::in_pieces(count, report_of_job(), body); });
}

py::object build(const py::object& type, const py::args& arguments) { return type(*arguments); }

int end() {
    ender = std::this_thread::get_id();
    all_helpers.load()->stop_all();
    return static_cast<int>(writing > 0   ? still::writes
                            : outside > 0 ? still::works
                                          : still::nothing);
}

void leave_jobs_at_the_end() {
#ifdef __GLIBC__
    // This skips exit handlers that were registered earlier, and destructors of static objects.
    (void)::on_exit(
        [](int status, void*) {
            if (outside == 0) return;
            (void)std::fflush(nullptr);
            ::_exit(status);
        },
        nullptr);
#endif
}

}  // namespace binding
