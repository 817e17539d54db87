#include "bindings.hpp"
#include "steps.hpp"

namespace binding {

constexpr auto& kind_words = words_of<tf::pair_kind>::all;

std::vector<tf::face_pair> pairs_of(const ids_array& pairs, const array_of<std::uint8_t>& kinds) {
    const auto numbers = rows_of<std::array<std::uint32_t, 2>>(pairs);
    const auto kind = rows_of<std::uint8_t>(kinds);
    if (kind.size() != numbers.size())
        throw std::invalid_argument("kinds: expected one for each pair");
    std::vector<tf::face_pair> all;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (kind[i] >= kind_words.size())
            throw std::invalid_argument("kinds: " + std::to_string(kind[i]) + " at " +
                                        std::to_string(i) + " is not a kind");
        all.push_back({numbers[i][0], numbers[i][1], static_cast<tf::pair_kind>(kind[i])});
    }
    return all;
}

namespace {

py::object self_intersections_of_file(const std::filesystem::path& path,
                                      tf::file_search_options options,
                                      const py::object& communicator) {
    options.communicator = communicator_of(communicator);
    const at_work here(communicator);
    return as_python(run([&](const tf::progress_callback& report) {
        options.progress = [&](std::string_view step, double share) {
            return !report || report(step == "scatter" ? share / 2 : 0.5 + share / 2);
        };
        return tf::self_intersections_of_file(path, options);
    }));
}

struct search_steps : tf::shared_search {
    using tf::shared_search::shared_search;
    /// The number of tiles.
    [[nodiscard]] std::size_t scatter() {
        return tf::shared_search::scatter() == tf::status::ok ? tiles() : 0;
    }
    [[nodiscard]] tf::status do_tile(std::size_t tile) { return search_tile(tile); }
};

using search_in_steps = work_in_steps<search_steps>;

std::unique_ptr<search_in_steps> search_of(const std::filesystem::path& path,
                                           tf::file_search_options options) {
    return run([&](const tf::progress_callback&) {
        return std::make_unique<search_in_steps>([&](const step_progress& progress) {
            options.progress = std::ref(progress);
            return search_steps(path, options);
        });
    });
}

}  // namespace

void add_intersections(py::module_& module) {
    module.attr("KINDS") = py::cast(kind_words);  // -> list[str]
    add_job(module, "self_intersections_of_file", &self_intersections_of_file,
            job_kind::long_work);  // -> FilePairs
    add_steps<search_steps>(module, "SearchInSteps", &search_steps::finish);
    add_job(module, "search_of", &search_of, job_kind::long_work);
}

}  // namespace binding
