#include "tools/tf-place/settings.hpp"

#include "tools/common/exit_status.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>

namespace tools {
namespace {

constexpr std::array<const char*, 8> mode_names{"drop",  "lay",     "slide",   "mate",
                                                "clear", "measure", "arrange", "fit"};

void put_number(std::string& text, double value) {
    std::array<char, 32> digits;
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                   std::chars_format::general, 17)
                         .ptr;
    text.append(digits.data(), static_cast<std::size_t>(end - digits.data()));
}

}  // namespace

place_mode parse_mode(std::string_view text) {
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
    const tf::point3 size{v[0], v[1], flat ? tf::arrange_options{}.size.z : v[2]};
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

tf::point3 in_range(const tf::point3& direction) {
    double largest = 0.0;
    int axes = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        largest = std::max(largest, std::abs(direction[k]));
        axes += direction[k] != 0.0;
    }
    tf::point3 scaled = direction;
    for (std::size_t k = 0; k < 3; ++k)
        if (direction[k] != 0.0)
            scaled[k] = axes == 1 ? std::copysign(1.0, direction[k])
                                  : std::ldexp(direction[k], -std::ilogb(largest));
    return scaled;
}

double length(const tf::point3& v) { return std::hypot(v.x, v.y, v.z); }

tf::transform<3> read_matrix(const std::filesystem::path& path) {
    const auto refuse = [&](const std::string& why) {
        throw failure(bad_input, "matrix", path.string() + ": " + why);
    };
    std::ifstream in(path, std::ios::binary);
    if (!in) refuse("cannot be read");
    std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    constexpr std::string_view blanks = " \t\r\n,";
    std::string_view rest = text;
    std::array<double, 16> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
        rest.remove_prefix(std::min(rest.find_first_not_of(blanks), rest.size()));
        const auto [end, error] =
            std::from_chars(rest.data(), rest.data() + rest.size(), values[i]);
        if (error != std::errc() || !std::isfinite(values[i]))
            refuse("expected 16 numbers, found " + std::to_string(i));
        rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
    }
    if (rest.find_first_not_of(blanks) != std::string_view::npos)
        refuse("expected 16 numbers, found more");
    if (values[12] != 0.0 || values[13] != 0.0 || values[14] != 0.0 || values[15] != 1.0)
        refuse("the last row of a matrix must be 0 0 0 1");
    tf::transform<3> matrix;
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t j = 0; j < 4; ++j) matrix.rows[k][j] = values[4 * k + j];
    return matrix;
}

std::string matrix_text(const tf::transform<3>& matrix) {
    std::string text;
    for (const auto& row : matrix.rows)
        for (std::size_t j = 0; j < 4; ++j) {
            put_number(text, row[j]);
            text += j == 3 ? '\n' : ' ';
        }
    return text + "0 0 0 1\n";
}

}  // namespace tools
