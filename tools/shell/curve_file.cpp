#include "tools/shell/curve_file.hpp"

#include "tools/shell/common_options.hpp"
#include "tools/shell/exit_status.hpp"
#include "tools/shell/output_file.hpp"
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <string_view>
#include <vector>

namespace tools {
namespace {

/// The 16 numbers of the only matrix of a report, as text; says why there are none.
std::string matrix_of_report(const std::string& text, std::string& why) {
    const json report = json::parse(text, nullptr, false);
    if (!report.is_object() || !report.contains("files") || !report["files"].is_array()) {
        why = "is neither a matrix nor a report";
        return {};
    }
    std::vector<json> matrices;
    const auto take = [&matrices](const json& one) {
        if (one.is_object() && one.contains("matrix") && !one["matrix"].is_null())
            matrices.push_back(one["matrix"]);
    };
    for (const json& entry : report["files"]) {
        take(entry);
        if (entry.is_object() && entry.contains("parts"))
            for (const json& part : entry["parts"]) take(part);
    }
    if (matrices.size() != 1) {
        why = "the report has " + std::to_string(matrices.size()) + " matrices; expected one";
        return {};
    }
    std::string numbers = matrices[0].dump(-1, ' ', false, json::error_handler_t::replace);
    std::erase_if(numbers, [](char c) { return c == '[' || c == ']'; });
    return numbers;
}

}  // namespace

void check_curve_path(const std::filesystem::path& path) {
    const std::string extension = extension_of(path);
    if (!path.empty() && path != "-" && extension != "ply" && extension != "obj")
        refuse(path.string() + ": curves can be written as obj or ply");
}

void write_curves(const job& work, const std::filesystem::path& path, tf::mesh_view mesh,
                  std::span<const tf::face_pair> pairs,
                  const std::vector<tf::pair_column>& numbers) {
    if (path.empty() || work.options.dry_run) return;
    output_place place(path, work.options.force);
    try {
        tf::write_curves(place.writable(), mesh, pairs, numbers, path == "-" ? "obj" : "");
    } catch (const tf::io_error& error) {
        throw failure(bad_output, "output", place.said_of_path(error.what()));
    }
    place.commit();
}

tf::transform<3> read_matrix(const std::filesystem::path& path) {
    if (path.empty()) return {};
    const auto refuse = [&](const std::string& why) {
        throw failure(bad_input, "matrix", path.string() + ": " + why);
    };
    std::ifstream in(path, std::ios::binary);
    if (!in) refuse("cannot be read");
    std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    if (text.substr(0, text.find_first_not_of(" \t\r\n") + 1).ends_with('{')) {
        std::string why;
        text = matrix_of_report(text, why);
        if (!why.empty()) refuse(why);
    }
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
    write_file(path, work.options.force, [&](output_file& file) { file.write(text); });
}

}  // namespace tools
