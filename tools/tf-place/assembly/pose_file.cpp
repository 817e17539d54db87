#include "tools/tf-place/assembly/pose_file.hpp"

#include "tools/shell/entries.hpp"
#include "tools/shell/exit_status.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string_view>

namespace tools {
namespace {

constexpr std::string_view blanks = " \t\r\n,";

/// Of 16 numbers, row after row. \throws std::invalid_argument
tf::transform<3> transform_of(const std::vector<double>& v) {
    if (v.size() != 16)
        throw std::invalid_argument("a matrix has 16 numbers, not " + std::to_string(v.size()));
    if (!std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); }))
        throw std::invalid_argument("a number of a matrix is not finite");
    if (v[12] != 0.0 || v[13] != 0.0 || v[14] != 0.0 || v[15] != 1.0)
        throw std::invalid_argument("the last row of a matrix must be 0 0 0 1");
    tf::transform<3> matrix;
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t j = 0; j < 4; ++j) matrix.rows[k][j] = v[4 * k + j];
    return matrix;
}

/// 16 numbers in a row, or 4 rows of 4. \throws std::invalid_argument
tf::transform<3> transform_of(const json& matrix) {
    std::vector<double> values;
    const auto add = [&](const json& one) {
        if (!one.is_number()) throw std::invalid_argument("an entry of a matrix is not a number");
        values.push_back(one.get<double>());
    };
    if (!matrix.is_array()) throw std::invalid_argument("a matrix is 16 numbers, or 4 rows of 4");
    for (const json& row : matrix)
        if (row.is_array())
            std::for_each(row.begin(), row.end(), add);
        else
            add(row);
    return transform_of(values);
}

/// An object. \throws std::invalid_argument
json object_of(const std::string& text) {
    json object = json::parse(text, nullptr, false);
    if (object.is_discarded()) throw std::invalid_argument("not valid JSON");
    if (!object.is_object())
        throw std::invalid_argument("a pose must be a JSON object: {\"name\": ...}");
    return object;
}

}  // namespace

pose_file::pose_file(const std::string& path, const std::vector<std::string>& parts)
    : part_count_(parts.size()), parts_(&parts) {
    open(path);
}

pose_file::pose_file(const std::string& path, const tf::urdf_robot& robot,
                     const std::vector<std::uint32_t>& links)
    : part_count_(links.size()), robot_(&robot), links_(&links) {
    open(path);
}

void pose_file::open(const std::string& path) {
    path_ = path == "-" ? "standard input" : path;
    if (path == "-") {
        text_.assign(std::istreambuf_iterator<char>(std::cin), {});
    } else {
        std::ifstream in(path, std::ios::binary);
        if (!in) throw failure(bad_input, "poses", path_ + ": cannot be read");
        text_.assign(std::istreambuf_iterator<char>(in), {});
    }
    const std::size_t first = text_.find_first_not_of(" \t\r\n");
    const bool object = first != std::string::npos && text_[first] == '{';
    if (!object) {
        form_ = form::matrices;
        if (robot_) fail("poses of a robot are lines of JSON: {\"joint\": value, ...}");
    } else if (text_.compare(first, 10, "{\"schema\":") == 0 ||
               text_.compare(first, 3, "{\n ") == 0) {
        begin_report();
    }
}

void pose_file::begin_report() {
    const json report = json::parse(text_, nullptr, false);
    if (!report.is_object() || !report.contains("files")) return;  // a pose that looks like one
    form_ = form::report;
    if (robot_) fail("poses of a robot need joint values, which a report does not have");
    try {
        for (const json& file : report["files"])
            if (file.contains("matrix") && !file["matrix"].is_null())
                of_report_.push_back(transform_of(file["matrix"]));
    } catch (const std::exception& error) {
        fail(error.what());
    }
    if (of_report_.empty()) fail("the report has no matrix");
}

void pose_file::fail(const std::string& why) const {
    throw failure(bad_input, "poses",
                  path_ + (line_ > 0 ? ":" + std::to_string(line_) : "") + ": " + why);
}

std::size_t pose_file::next(std::size_t most, std::vector<tf::transform<3>>& poses) {
    std::size_t count = 0;
    for (; count < most; ++count) {
        const bool more = form_ == form::lines      ? next_line(poses)
                          : form_ == form::matrices ? next_matrices(poses)
                                                    : next_of_report(poses);
        if (!more) break;
    }
    return count;
}

bool pose_file::next_line(std::vector<tf::transform<3>>& poses) {
    while (at_ < text_.size()) {
        const std::size_t end = std::min(text_.find('\n', at_), text_.size());
        const std::string line = text_.substr(at_, end - at_);
        at_ = end + 1;
        ++line_;
        if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
        try {
            robot_ ? enter_joints(line, poses) : enter_parts(line, poses);
        } catch (const std::invalid_argument& error) {
            std::string_view why = error.what();
            constexpr std::string_view whose = "treeform::link_transforms: ";
            if (why.starts_with(whose)) why.remove_prefix(whose.size());
            fail(std::string(why));
        }
        return true;
    }
    return false;
}

void pose_file::enter_parts(const std::string& line, std::vector<tf::transform<3>>& poses) const {
    std::vector<tf::transform<3>> pose(part_count_);
    const json object = object_of(line);
    for (const auto& [name, matrix] : object.items()) {
        const auto at = std::find(parts_->begin(), parts_->end(), name);
        if (at == parts_->end()) throw std::invalid_argument("no part is named " + name);
        pose[static_cast<std::size_t>(at - parts_->begin())] = transform_of(matrix);
    }
    poses.insert(poses.end(), pose.begin(), pose.end());
}

void pose_file::enter_joints(const std::string& line, std::vector<tf::transform<3>>& poses) const {
    std::map<std::string, double> values;
    const json object = object_of(line);
    for (const auto& [name, value] : object.items()) {
        if (!value.is_number())
            throw std::invalid_argument("the value of joint " + name + " is not a number");
        values[name] = value.get<double>();
    }
    const auto at = robot_->link_transforms(values);
    for (const std::uint32_t link : *links_) poses.push_back(at[link]);
}

bool pose_file::next_matrices(std::vector<tf::transform<3>>& poses) {
    std::vector<double> values;
    while (values.size() < 16 * part_count_) {
        at_ = std::min(text_.find_first_not_of(blanks, at_), text_.size());
        if (at_ == text_.size()) break;
        double value = 0.0;
        const auto [end, error] =
            std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
        if (error != std::errc()) fail("byte " + std::to_string(at_) + ": expected a number");
        values.push_back(value);
        at_ = static_cast<std::size_t>(end - text_.data());
    }
    if (values.empty()) return false;
    if (values.size() < 16 * part_count_)
        fail("the file ends within a pose: each pose has 16 numbers for each of " +
             std::to_string(part_count_) + " parts");
    try {
        for (std::size_t i = 0; i < part_count_; ++i) {
            const auto first = values.begin() + static_cast<std::ptrdiff_t>(16 * i);
            poses.push_back(transform_of(std::vector<double>(first, first + 16)));
        }
    } catch (const std::invalid_argument& error) {
        fail(error.what());
    }
    return true;
}

bool pose_file::next_of_report(std::vector<tf::transform<3>>& poses) {
    if (next_of_report_ == of_report_.size()) return false;
    const std::size_t first = poses.size();
    poses.resize(first + part_count_);
    poses[first] = of_report_[next_of_report_++];
    return true;
}

}  // namespace tools
