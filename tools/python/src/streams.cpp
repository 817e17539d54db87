#include "bindings.hpp"
#include "steps.hpp"

namespace binding {
namespace {

/// The completed share of all steps.
double whole_share(std::string_view step, double share) {
    constexpr std::array<std::string_view, 5> steps{"survey", "scatter", "weld", "borders",
                                                    "write"};
    for (std::size_t i = 0; i < steps.size(); ++i)
        if (step == steps[i]) return (static_cast<double>(i) + share) / steps.size();
    return 0.0;
}

tf::weld_stream_outputs outputs_of(const std::filesystem::path& output, const std::string& removed,
                                   const std::string& label, bool withhold) {
    tf::weld_stream_outputs outputs;
    outputs.welded = {output, {}};
    if (!removed.empty()) outputs.removed = {removed, {}};
    outputs.label = label;
    outputs.withhold = withhold;
    return outputs;
}

py::object weld_stream(const tf::cloud_inputs& inputs, tf::weld_stream_options options,
                       const std::filesystem::path& output, const std::string& removed,
                       const std::string& label, bool withhold, const py::object& communicator) {
    options.communicator = communicator_of(communicator);
    const at_work here(communicator);
    return as_python(run([&](const tf::progress_callback& report) {
        options.progress = [&](std::string_view step, double share) {
            return !report || report(whole_share(step, share));
        };
        return tf::weld_stream(inputs, outputs_of(output, removed, label, withhold), options);
    }));
}

// ---- step by step, by many processes ----

struct weld_steps : tf::shared_weld {
    using tf::shared_weld::shared_weld;
    /// The number of tiles.
    [[nodiscard]] std::size_t scatter() {
        return tf::shared_weld::scatter() == tf::status::ok ? tiles() : 0;
    }
    [[nodiscard]] tf::status do_tile(std::size_t tile) { return weld_tile(tile); }
    [[nodiscard]] tf::weld_stream_result finish(const std::filesystem::path& output,
                                                const std::string& removed,
                                                const std::string& label, bool withhold) {
        return tf::shared_weld::finish(outputs_of(output, removed, label, withhold));
    }
};

using weld_in_steps = work_in_steps<weld_steps>;

std::unique_ptr<weld_in_steps> weld_of(const tf::cloud_inputs& inputs,
                                       tf::weld_stream_options options) {
    return run([&](const tf::progress_callback&) {
        return std::make_unique<weld_in_steps>([&](const step_progress& progress) {
            options.progress = std::ref(progress);
            return weld_steps(inputs, options);
        });
    });
}

}  // namespace

void add_streams(py::module_& module) {
    add_job(module, "weld_stream", &weld_stream, job_kind::writes);  // -> WeldStreamResult
    add_steps<weld_steps>(module, "WeldInSteps", &weld_steps::finish);
    add_job(module, "weld_of", &weld_of, job_kind::long_work);
}

}  // namespace binding
