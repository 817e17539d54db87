#include "tools/common/matrix_file.hpp"

#include "tools/common/exit_status.hpp"
#include "tools/common/output_file.hpp"
#include <treeform/tf.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <string_view>

namespace tools {

tf::transform<3> read_matrix(const std::filesystem::path& path) {
    if (path.empty()) return {};
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
    std::array<char, 32> digits;
    char* const at = digits.data();
    for (const auto& row : matrix.rows)
        for (std::size_t j = 0; j < 4; ++j) {
            text.append(at, std::to_chars(at, at + 32, row[j], std::chars_format::general, 17).ptr);
            text += j == 3 ? '\n' : ' ';
        }
    return text + "0 0 0 1\n";
}

void write_matrix(const job& work, const std::filesystem::path& path, const std::string& text) {
    write_file(path, work.options.force, work.keeper, [&](output_file& file) { file.write(text); });
}

}  // namespace tools
