#include "tools/tf-place/settings.hpp"

#include "tools/common/exit_status.hpp"
#include <treeform/tf.hpp>

#include <algorithm>
#include <array>

namespace tools {
namespace {

constexpr std::array<const char*, 8> mode_names{"drop",  "lay",     "slide",   "mate",
                                                "clear", "measure", "arrange", "fit"};

}  // namespace

place_mode parse_mode(std::string_view text) {
    if (text == "pack") return place_mode::arrange;
    if (text == "align") return place_mode::fit;
    if (text == "separate") return place_mode::clear;
    for (std::size_t i = 0; i < mode_names.size(); ++i)
        if (text == mode_names[i]) return static_cast<place_mode>(i);
    std::string list;
    for (const char* name : mode_names) list += (list.empty() ? "" : ", ") + std::string(name);
    throw failure(bad_usage, "usage", std::string(text) + ": no mode; expected one of " + list);
}

tf::plate_turns parse_turns(std::string_view text) {
    if (text == "none") return tf::plate_turns::none;
    if (text == "90") return tf::plate_turns::quarter;
    if (text == "45") return tf::plate_turns::eighth;
    if (text == "any") return tf::plate_turns::any;
    throw failure(bad_usage, "usage",
                  "--rotate " + std::string(text) + ": expected none, 90, 45 or any");
}

tf::point3 parse_size3(std::string_view text) {
    const bool flat = std::count(text.begin(), text.end(), ',') < 2;
    const auto v = parse_numbers("--size", text, flat ? 2 : 3);
    const tf::point3 size{v[0], v[1], flat ? tf::pack_options{}.size.z : v[2]};
    if (!(size.x > 0.0 && size.y > 0.0 && size.z > 0.0))
        throw failure(bad_usage, "usage",
                      "--size " + std::string(text) + ": expected lengths greater than 0");
    return size;
}

const char* name_of(place_mode mode) { return mode_names[static_cast<std::size_t>(mode)]; }

tf::point3 parse_direction(std::string_view option, std::string_view text) {
    const auto v = parse_numbers(option, text, 3);
    const tf::point3 direction{v[0], v[1], v[2]};
    if (direction == tf::point3{})
        throw failure(bad_usage, "usage",
                      std::string(option) + " " + std::string(text) + ": has no direction");
    return direction;
}

}  // namespace tools
