#pragma once
/// \file
/// TRUTH.csv of a folder of models: exact facts about each file, found by an exact kernel.

#include <treeform/tf.hpp>
#include <treeform/tree/aabb.hpp>

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace test {

/// One file at one precision ("exact", "double" or "f32"); cells by the name of their column.
class truth_row {
  public:
    truth_row(const std::vector<std::string>& columns, const std::vector<std::string>& cells) {
        if (cells.size() != columns.size())
            throw std::runtime_error("TRUTH.csv: a row of another length at " + cells.at(0));
        for (std::size_t i = 0; i < columns.size(); ++i) cells_[columns[i]] = cells[i];
    }

    [[nodiscard]] const std::string& text(const std::string& column) const {
        return cells_.at(column);
    }
    [[nodiscard]] std::int64_t number(const std::string& column) const {
        return parse<std::int64_t>(column, text(column));
    }
    [[nodiscard]] double real(const std::string& column) const {
        return parse<double>(column, text(column));
    }
    /// Sixteen numbers row by row, the last four of them 0 0 0 1, or "identity".
    [[nodiscard]] tf::transform<3> map(const std::string& column) const {
        tf::transform<3> map;
        if (text(column) == "identity") return map;
        std::istringstream cells(text(column));
        std::string cell;
        for (auto& row : map.rows)
            for (double& entry : row) {
                cells >> cell;
                entry = parse<double>(column, cell);
            }
        return map;
    }

  private:
    template <class Number>
    [[nodiscard]] static Number parse(const std::string& column, const std::string& cell) {
        Number value{};
        const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
        if (error != std::errc() || end != cell.data() + cell.size())
            throw std::runtime_error("TRUTH.csv: " + column + " is no number: " + cell);
        return value;
    }

    std::map<std::string, std::string> cells_;
};

/// The cells of a line; a cell in double quotes may hold commas.
inline std::vector<std::string> split_cells(const std::string& line) {
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (const char c : line) {
        if (c == '"')
            quoted = !quoted;
        else if (c == ',' && !quoted)
            cells.emplace_back();
        else if (c != '\r')
            cells.back() += c;
    }
    return cells;
}

/// \throws std::runtime_error when the file is not there or not of that form
inline std::vector<truth_row> read_truth(const std::filesystem::path& file) {
    std::ifstream in(file);
    if (!in) throw std::runtime_error("cannot read " + file.string());
    std::vector<truth_row> rows;
    std::vector<std::string> columns;
    for (std::string line; std::getline(in, line);) {
        if (line.empty() || line[0] == '#') continue;
        if (columns.empty())
            columns = split_cells(line);
        else
            rows.emplace_back(columns, split_cells(line));
    }
    return rows;
}

}  // namespace test
