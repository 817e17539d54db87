#pragma once
/// \file
/// What the bench measures: workloads of contests between contestants.
///
/// A workload has an id ("B1"), a file of its own named by it, and a line in workloads.cpp. It
/// lists contests; a contest is one case at one size, in which all contestants take turns. Nothing
/// is loaded before a contestant is asked to prepare, so that a process can run a single one.

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace treeform::bench {

/// How much is measured: everything, what fits in three minutes, or just enough to see it run.
enum class effort { full, quick, tiny };

/// Folder in the cache; changes whenever the same name would stand for another model.
inline constexpr const char* cache_version = "v2";

/// What the command line says of where and how much.
struct setting {
    bench::effort effort = effort::full;
    std::string models_dir;  ///< real models, laid out as TREEFORM_MODELS_DIR; may be empty
    std::string cache_dir;   ///< for models and files the bench makes; exists
    std::string only{};      ///< the contestants to measure, unjudged; empty: all, and their errors
};

/// A further value of an answer, printed and written as a row of its own.
struct figure {
    std::string unit;
    double value = 0.0;
};

/// Work that is ready to be timed: its input is given, its answer is kept until discarded.
struct job {
    std::function<void()> run;
    std::function<void()> discard = [] {};
    /// How far the last answer is from the truth; none where that is not defined.
    std::function<std::optional<double>()> error = [] { return std::optional<double>{}; };
    std::function<std::vector<figure>()> figures = [] { return std::vector<figure>{}; };
    /// What the last run took, where it is a process of its own.
    std::function<std::optional<double>()> peak_mb = [] { return std::optional<double>{}; };
};

struct contestant {
    std::string who;       ///< "treeform", "paper", or a peer with its version
    unsigned threads = 1;  ///< it may use
    std::function<job()> prepare;
};

/// How a time becomes a value.
struct unit {
    std::string name = "ms";
    double scale = 1e3;    ///< value = scale * seconds, or scale / seconds
    bool is_rate = false;  ///< more is better
};

struct contest {
    std::string name;
    std::function<std::size_t()> size;  ///< of the input; triangles, pairs, points
    bench::unit unit{};
    std::vector<contestant> contestants{};
    bool with_memory = true;  ///< whether a process of its own measures the peak of each
    int long_runs = 5;        ///< how often what takes 50 ms or more is timed
};

using contest_visitor = std::function<void(const contest&)>;

struct outcome;  // page.hpp
struct section;

struct workload {
    std::string id;
    std::string title;
    void (*contests)(const setting&, const contest_visitor&);
    /// Makes the workload's part of the page; none where the table says it all.
    section (*draw)(const std::vector<outcome>& outcomes, const std::string& machine) = nullptr;
};

/// All workloads, in the order of their ids.
[[nodiscard]] std::span<const workload> workloads();

struct no_error {
    std::optional<double> operator()(const auto&) const { return {}; }
};
struct no_figures {
    std::vector<figure> operator()(const auto&) const { return {}; }
};

/// The job that calls `run` and keeps what it returns; freeing the answer is not timed. `error`
/// takes the answer and returns a number or an optional one, `figures` takes it too.
template <class Run, class Error = no_error, class Figures = no_figures>
[[nodiscard]] job make_job(Run run, Error error = {}, Figures figures = {}) {
    const auto last = std::make_shared<std::optional<std::invoke_result_t<Run&>>>();
    return {.run = [last, run] { last->emplace(run()); },
            .discard = [last] { last->reset(); },
            .error = [last, error] { return std::optional<double>(error(**last)); },
            .figures = [last, figures] { return figures(**last); }};
}

}  // namespace treeform::bench
