#pragma once
/// \file
/// Runs what takes long on a helper thread, while the thread that called it lets Python's other
/// threads run, looks for signals (Ctrl-C) and reports progress.

#include <treeform/tree/parallel.hpp>

#include <pybind11/pybind11.h>

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

namespace binding {

namespace py = pybind11;

/// `run` for a body that returns nothing.
void run_job(const py::object& progress, std::size_t elements,
             const std::function<void(const treeform::progress_callback&)>& body);

/// Elements of what may take long, however little there is.
inline constexpr std::size_t long_work = std::numeric_limits<std::size_t>::max();

/// What `body(progress_callback)` returns. It runs without the interpreter's lock and must not touch
/// Python. `elements` says how much there is to do: what is little runs on the calling thread, as
/// handing it over would take longer.
///
/// `progress` is None, or is called with the share of the work that is done. The job is asked to stop
/// when that returns False or raises, or when a signal's handler raises, as that of Ctrl-C does.
///
/// \throws what the handler or `progress` has raised, `cancelled` where it returned False, what
///         `body` throws
template <class Body>
auto run(const py::object& progress, std::size_t elements, Body&& body) {
    using result = std::invoke_result_t<Body&, const treeform::progress_callback&>;
    std::optional<result> made;
    run_job(progress, elements,
            [&](const treeform::progress_callback& report) { made.emplace(body(report)); });
    return std::move(*made);
}

/// The same in pieces of `piece` elements, for work that cannot be asked to stop: `body(begin, end)`.
void run_pieces(const py::object& progress, std::size_t count, std::size_t piece,
                const std::function<void(std::size_t, std::size_t)>& body);

/// `progress` has returned False.
class cancelled {};

}  // namespace binding
