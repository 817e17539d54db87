#include "tools/tf-place/placing/pack_options.hpp"

#include "tools/shell/exit_status.hpp"
#include "tools/shell/parse_value.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace tools {
namespace {

constexpr std::array<const char*, 4> sets_of_turns{"none", "90", "45", "any"};
constexpr std::array turns_of_set{1U, 4U, 8U, 24U};

constexpr std::uint64_t most_copies = 10'000;

/// "250,210" or "250,210,300", all greater than 0.
tf::point3 parse_size3(std::string_view text) {
    const bool flat = std::count(text.begin(), text.end(), ',') < 2;
    const auto v = parse_numbers("--size", text, flat ? 2 : 3);
    const tf::point3 size{v[0], v[1], flat ? tf::pack_options{}.size.z : v[2]};
    if (!(size.x > 0.0 && size.y > 0.0 && size.z > 0.0))
        refuse("--size " + std::string(text) + ": expected lengths greater than 0");
    return size;
}

unsigned parse_at_most(std::string_view option, std::string_view text, std::uint64_t most) {
    const std::uint64_t count = parse_count(option, text);
    if (count < 1 || count > most)
        refuse(std::string(option) + " " + std::string(text) + ": expected 1 to " +
               std::to_string(most));
    return static_cast<unsigned>(count);
}

}  // namespace

void add_pack_options(command_line& line, pack_settings& s) {
    tf::pack_options& o = s.pack;
    line.option({"--size", "X,Y[,Z]",
                 "pack: size of the bed; with Z, of a box that is\n"
                 "filled: parts may be above and inside one another"},
                [&o](std::string_view text) { o.size = parse_size3(text); });
    line.flag(s.flat, {"--flat", "", "pack: all parts stand on the bed; Z limits the height"});
    line.option({"--spacing", "DIST", "pack: least distance between parts", "2"},
                [&o](std::string_view text) {
                    const distance spacing = parse_distance("--spacing", text);
                    if (spacing.relative) refuse("--spacing: expected a length");
                    o.spacing = spacing.value;
                });
    line.option({"--rotate", "SET", "pack: allowed rotations: none | 90 | 45 | any", "90"},
                [&o](std::string_view text) {
                    o.turns = turns_of_set[parse_choice("--rotate", text, sets_of_turns)];
                });
    line.offer("--rotate", {sets_of_turns.begin(), sets_of_turns.end()});
    line.repeatable_option(s.counts,
                           {"--count", "FILE:N", "pack: N copies of this MOVING (repeatable)"});
    line.option(
        {"--plates", "N",
         "pack: use up to N plates, side by side along x, with\n"
         "gaps of a fifth of their length",
         "1"},
        [&o](std::string_view text) { o.plates = parse_at_most("--plates", text, 10'000); });
    line.option(
        {"--tries", "N",
         "pack: try up to N orders and rotations, until all\n"
         "parts are placed, on no more plates than their area\n"
         "requires",
         "32"},
        [&o](std::string_view text) { o.tries = parse_at_most("--tries", text, 1'000'000); });
    line.option({"--time", "SEC",
                 "pack: start no more tries after SEC seconds; the\n"
                 "result may then depend on the speed of the machine"},
                [&o](std::string_view text) { o.seconds = parse_seconds("--time", text); });
    line.option(o.seed, {"--seed", "N", "pack: random seed: same N, same result", "0"});
}

std::span<const char* const> pack_option_names() {
    static constexpr std::array<const char*, 9> names{"--size",   "--flat",  "--spacing",
                                                      "--rotate", "--count", "--plates",
                                                      "--tries",  "--time",  "--seed"};
    return names;
}

std::vector<std::uint64_t> counts_of(const pack_settings& settings,
                                     std::span<const std::string> inputs) {
    std::vector<std::uint64_t> counts(inputs.size(), 1);
    for (const std::string& text : settings.counts) {
        const std::size_t colon = text.rfind(':');
        if (colon == std::string::npos || colon == 0)
            refuse("--count " + text + ": expected FILE:N");
        const std::string file = text.substr(0, colon);
        const unsigned count =
            parse_at_most("--count " + file, std::string_view(text).substr(colon + 1), most_copies);
        bool known = false;
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            if (inputs[i] != file) continue;
            counts[i] = count;
            known = true;
        }
        if (!known) refuse("--count " + text + ": " + file + " is not a MOVING");
    }
    return counts;
}

tf::pack_options pack_options_of(const pack_settings& settings) {
    tf::pack_options options = settings.pack;
    options.stack = std::isfinite(options.size.z) && !settings.flat;
    options.plate_step = {1.2 * options.size.x, 0.0, 0.0};
    return options;
}

json packing_entry(const tf::packing& found) {
    return {{"tries", found.tries}, {"plates", found.plates_used}, {"density", found.density}};
}

}  // namespace tools
