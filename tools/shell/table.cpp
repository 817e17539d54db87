#include "tools/shell/table.hpp"

#include "tools/shell/console.hpp"
#include "tools/shell/run.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace tools {
namespace {

using row = std::vector<std::string>;

std::string in_words(const json& number) {
    if (number.is_boolean()) return number.get<bool>() ? "yes" : "no";
    if (number.is_number_float()) return brief(number.get<double>());
    return number.is_number() ? grouped(number.get<std::uint64_t>()) : "-";
}

json number_at(const json& entry, const std::string& key) {
    const json::json_pointer at(key);
    return entry.contains(at) ? entry[at] : json(nullptr);
}

std::string verdict(const json& entry) {
    const int status = entry["exit"].get<int>();
    if (status == 0) return "ok";
    return status == 1 ? "found, or not done" : entry["error"]["code"].get<std::string>();
}

/// Columns of a terminal, by the code points of UTF-8: an ideograph takes two, an accent that is
/// put on the letter before it none.
std::size_t shown_width(const std::string& text) {
    static constexpr std::array<std::array<char32_t, 2>, 8> wide{{{0x1100, 0x115f},
                                                                  {0x2e80, 0xa4cf},
                                                                  {0xac00, 0xd7a3},
                                                                  {0xf900, 0xfaff},
                                                                  {0xff00, 0xff60},
                                                                  {0xffe0, 0xffe6},
                                                                  {0x1f300, 0x1faff},
                                                                  {0x20000, 0x3fffd}}};
    std::size_t width = 0;
    for (std::size_t at = 0; at < text.size();) {
        const auto first = static_cast<unsigned char>(text[at++]);
        char32_t code = first < 0xc0 ? first : first < 0xe0 ? first & 0x1fU : first & 0x0fU;
        for (; at < text.size() && (static_cast<unsigned char>(text[at]) & 0xc0U) == 0x80U; ++at)
            code = code << 6U | (static_cast<unsigned char>(text[at]) & 0x3fU);
        if (code >= 0x300 && code <= 0x36f) continue;
        width += std::ranges::any_of(
                     wide, [&](const auto& range) { return code >= range[0] && code <= range[1]; })
                     ? 2
                     : 1;
    }
    return width;
}

/// Names to the left, numbers to the right; the last column as it is.
std::string line_of(const row& cells, const std::vector<std::size_t>& widths) {
    std::string line;
    for (std::size_t i = 0; i + 1 < cells.size(); ++i) {
        const std::string gap(widths[i] - shown_width(cells[i]), ' ');
        line += i == 0 ? cells[i] + gap : gap + cells[i];
        line += "  ";
    }
    return line + cells.back();
}

row totals(const json& files, const std::vector<table_column>& columns) {
    row total{counted(files.size(), "file", "files")};
    for (const table_column& column : columns) {
        std::uint64_t sum = 0;
        bool any = false;
        for (const json& entry : files)
            if (const json number = number_at(entry, column.key); number.is_number_unsigned()) {
                sum += number.get<std::uint64_t>();
                any = true;
            }
        total.push_back(!column.summed ? "" : any ? grouped(sum) : "-");
    }
    std::array<std::size_t, 3> by_verdict{};
    for (const json& entry : files)
        ++by_verdict[static_cast<std::size_t>(std::min(entry["exit"].get<int>(), 2))];
    std::string text = grouped(by_verdict[0]) + " ok";
    if (by_verdict[1] > 0) text += ", " + grouped(by_verdict[1]) + " found, or not done";
    if (by_verdict[2] > 0) text += ", " + counted(by_verdict[2], "error", "errors");
    total.push_back(text);
    return total;
}

}  // namespace

std::string table_of(const json& files, const std::vector<table_column>& columns) {
    std::vector<row> rows{{"file"}};
    for (const table_column& column : columns) rows[0].push_back(column.title);
    rows[0].emplace_back("");
    for (const json& entry : files) {
        row one{name_of_input(entry["input"].get<std::string>())};
        for (const table_column& column : columns)
            one.push_back(in_words(number_at(entry, column.key)));
        one.push_back(verdict(entry));
        rows.push_back(std::move(one));
    }
    rows.push_back(totals(files, columns));
    std::vector<std::size_t> widths(rows[0].size(), 0);
    for (const row& one : rows)
        for (std::size_t i = 0; i < one.size(); ++i)
            widths[i] = std::max(widths[i], shown_width(one[i]));
    std::string text;
    for (const row& one : rows) {
        text += (text.empty() ? "" : "\n") + line_of(one, widths);
        text.erase(text.find_last_not_of(' ') + 1);
    }
    return text;
}

}  // namespace tools
