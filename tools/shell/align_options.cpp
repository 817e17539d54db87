#include "tools/shell/align_options.hpp"

#include "tools/shell/console.hpp"
#include "tools/shell/exit_status.hpp"
#include "tools/shell/made/report_fields.hpp"
#include "tools/shell/parse_value.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace tools {
namespace {

/// By `align_method`, and by whether it is robust.
constexpr std::array<const char*, 4> metrics{"plane", "point", "auto", "planes"};
constexpr std::array<const char*, 2> weights{"equal", "welsch"};

unsigned parse_number_of(std::string_view option, std::string_view text, std::uint64_t least) {
    const std::uint64_t count = parse_count(option, text);
    if (count < least || count > 1'000'000)
        refuse(std::string(option) + " " + std::string(text) + ": expected " +
               std::to_string(least) + " to 1000000");
    return static_cast<unsigned>(count);
}

void accept_bounds(tf::align_options& options, std::string_view text) {
    const std::vector<double> bounds = parse_numbers("--scale", text, 2);
    if (!(bounds[0] > 0.0 && bounds[0] <= bounds[1]))
        refuse("--scale=" + std::string(text) + ": expected MIN,MAX, above 0 and in this order");
    options.least_scale = bounds[0];
    options.most_scale = bounds[1];
}

}  // namespace

void add_align_options(command_line& line, tf::align_options& options) {
    tf::align_options& o = options;
    const auto overlap = [&o](std::string_view option, std::string_view text, double share) {
        if (!(share > 0.0 && share <= 1.0))
            refuse(std::string(option) + " " + std::string(text) + ": expected a share up to 1");
        o.overlap = share;
    };
    line.option({"--overlap", "F",
                 "align: share of MOVING that has a partner; each step\n"
                 "ignores the rest, which is furthest away",
                 "1"},
                [overlap](std::string_view text) {
                    overlap("--overlap", text, parse_number("--overlap", text));
                });
    line.option({"--trim", "F", "align: share to ignore: 1 - overlap", "0"},
                [overlap](std::string_view text) {
                    overlap("--trim", text, 1.0 - parse_share("--trim", text));
                });
    line.option(o.robust,
                {"--weights", "W",
                 "align: welsch | equal. welsch gives distant pairs less\n"
                 "weight, so up to half of MOVING may lack a partner",
                 "welsch"},
                weights);
    line.option(o.method,
                {"--metric", "M",
                 "align: what distances are measured to: plane (of the\n"
                 "fixed surface) | point | planes (of both clouds) |\n"
                 "auto (planes for a fixed cloud, else plane)",
                 "auto"},
                metrics);
    line.option({"--starts", "N",
                 "align: try N starts: the present position, the\n"
                 "principal axes (4), then rotations in all directions",
                 "1"},
                [&o](std::string_view text) { o.starts = parse_number_of("--starts", text, 1); });
    line.option({"--iterations", "N", "align: largest number of steps from each start", "100"},
                [&o](std::string_view text) {
                    o.max_iterations = parse_number_of("--iterations", text, 0);
                });
    line.option(
        {"--align-tolerance", "F",
         "align: converged if 5 steps in a row lower the cost by\n"
         "less than this share of it",
         "1e-6"},
        [&o](std::string_view text) { o.tolerance = parse_share("--align-tolerance", text); });
    line.flag_with_value({.names = "--scale",
                          .text = "align: allow uniform scale, from MIN to MAX if given",
                          .label = "--scale[=MIN,MAX]"},
                         [&o](std::optional<std::string_view> text) {
                             o.scale = true;
                             if (text) accept_bounds(o, *text);
                         });
}

std::span<const char* const> align_option_names() {
    static constexpr std::array<const char*, 8> names{
        "--overlap", "--trim",       "--weights",         "--metric",
        "--starts",  "--iterations", "--align-tolerance", "--scale"};
    return names;
}

json align_entry(const tf::align_result& r) {
    json entry = fit_entry(r);
    entry["undetermined"] = r.undetermined();
    return entry;
}

}  // namespace tools
