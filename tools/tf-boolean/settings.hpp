#pragma once
/// \file
/// What a user of tf-boolean asks for.

#include "tools/shell/change_limits.hpp"
#include "tools/shell/common_options.hpp"
#include "tools/shell/parse_value.hpp"
#include <treeform/mesh/boolean.hpp>
#include <treeform/tf.hpp>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tools {

inline constexpr std::array<const char*, 5> operations{"union", "intersection", "difference",
                                                       "symmetric-difference", "split"};

struct boolean_settings {
    std::string operation{};                  ///< the word, as typed; empty where there is none
    std::string expression{};                 ///< of --expr
    std::vector<std::string> names{};         ///< of parts that it has; empty: it has letters
    std::vector<std::string> matrix_texts{};  ///< of --matrix, "N:FILE"
    std::vector<std::filesystem::path> matrix_files{};  ///< by input; empty: it is not moved
    tf::fill_rule fill_rule = tf::fill_rule::nonzero;
    bool check = false;
    bool accept_open = false;
    bool repair = false;
    bool keep_cuts = false;
    bool simplify = false;
    double min_volume = 0.0;  ///< of parts of the result
    bool min_volume_given = false;
    std::optional<distance> gap{};
    tools::change_limits limits{};
    bool max_move_given = false;
    std::string source = "source";  ///< properties SOURCE_mesh, SOURCE_face
    bool source_given = false;
    bool no_attributes = false;
    std::filesystem::path curves{};

    [[nodiscard]] bool splits() const { return operation == "split"; }
    /// The operation as reports have it: the word, or the formula.
    [[nodiscard]] const std::string& name() const {
        return expression.empty() ? operation : expression;
    }
};

[[nodiscard]] const char* name_of(tf::fill_rule rule);

/// Whether files of this format can tell which face each one comes from.
[[nodiscard]] bool holds_sources(const std::string& format);

/// Takes the operation from the words of the command line, the first of which it is unless --expr
/// or --check makes do without, and refuses what makes no sense. \throws failure (bad_usage)
void settle_words(boolean_settings& settings, common_options& options);

/// Refuses the first of `names` that is not the letter of an operand, and says which letters are.
/// \throws failure (bad_usage)
void refuse_unknown(const std::vector<std::string>& names, std::size_t operands);

/// \throws failure (bad_usage) when the formula cannot be read
[[nodiscard]] tf::boolean_expression formula_of(const boolean_settings& settings,
                                                std::size_t operands);

}  // namespace tools
