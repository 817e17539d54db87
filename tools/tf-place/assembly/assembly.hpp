#pragma once
/// \file
/// The modes of tf-place that look at all parts of an assembly: clash and check.

#include "tools/shell/command_line.hpp"
#include "tools/shell/common_options.hpp"
#include "tools/shell/exit_status.hpp"
#include "tools/shell/parse_value.hpp"
#include "tools/shell/run.hpp"
#include <treeform/mesh/clash.hpp>
#include <treeform/tf.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace tools {

struct assembly_settings {
    std::vector<std::string> ignored{};  ///< "A:B"
    distance clearance{};
    bool no_depth = false;
    std::string poses{};
    std::filesystem::path results{};
    bool first_only = false;
    std::vector<std::string> package_folders{};
};

/// The parts of all inputs, with names for people and for --ignore.
struct named_assembly {
    tf::body_set set{};
    std::vector<std::string> names{};  ///< [B] of the part; with the file's where there are several
};

/// `tf-place clash ...` or `tf-place check ...`
class assembly_command {
  public:
    explicit assembly_command(const std::string& mode);

    [[nodiscard]] const std::string& mode() const { return mode_; }
    [[nodiscard]] const command_line& line() const { return line_; }
    [[nodiscard]] int run(int argc, const char* const* argv);

  private:
    std::string mode_;
    bool clash_;
    assembly_settings settings_{};
    common_options options_{};
    command_line line_;
};

/// Reads all inputs. \throws failure (bad_input) when there is no part
[[nodiscard]] named_assembly read_assembly(job& work);

/// The pairs that --ignore names; says which of them name nothing. \throws failure (bad_usage)
[[nodiscard]] std::vector<tf::part_pair> ignored_pairs(job& work, const assembly_settings& settings,
                                                       const std::vector<std::string>& names);

/// The pairs that are not clear: those that penetrate first, the deepest ahead.
[[nodiscard]] std::vector<const tf::part_clash*> gravest_first(const tf::clash_result& r);

/// Page and picture of clashes, where they are asked for: a color for each pair.
void write_page(job& work, const named_assembly& all, const tf::clash_result& r,
                const std::string& verdict);

[[nodiscard]] exit_status clash_all(job& work, const assembly_settings& settings);
[[nodiscard]] exit_status check_all(job& work, const assembly_settings& settings);

}  // namespace tools
