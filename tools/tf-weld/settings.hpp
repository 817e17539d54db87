#pragma once
/// \file
/// What a user of tf-weld asks for.

#include "tools/shell/exit_status.hpp"
#include "tools/shell/parse_value.hpp"
#include "tools/shell/run.hpp"
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tools {

/// How points are joined.
struct weld_settings {
    distance tolerance{};
    tf::weld_options options{.keep_seams = true};  ///< except for its tolerance and progress
};

/// What is given back besides what the common options name.
struct weld_outputs {
    std::filesystem::path map{};
    std::filesystem::path removed{};
    std::string label{};
    bool withhold = false;
    bool check = false;

    [[nodiscard]] bool drops_nothing() const { return withhold || !label.empty(); }
};

struct weld_request {
    weld_settings settings{};
    weld_outputs outputs{};
    bool mixed = false;  ///< as in `tf::join`
};

/// Values of options. All of them: \throws failure (bad_usage) naming option and text
/// "first", "chain"
void parse_rule(std::string_view text, tf::weld_options& options);
/// "intensity,nx=0.01"
[[nodiscard]] std::vector<tf::weld_condition> parse_same(std::string_view text);
[[nodiscard]] std::vector<std::string> parse_ignored_seams(std::string_view text);
/// "x=E,y=N,z=H"; `option` is named where it is none
[[nodiscard]] name_pairs parse_names(std::string_view option, std::string_view text);
/// "P,..."
[[nodiscard]] std::vector<std::string> parse_properties(std::string_view option,
                                                        std::string_view text);
/// "0.001" or "0.01,0.01,0.001"
[[nodiscard]] std::array<double, 3> parse_axes(std::string_view option, std::string_view text);
/// "first", "last", "mean", "min:P", "max:P"
void parse_keep(std::string_view text, tf::weld_options& options);

/// "P", "min:P", "max:P"
void parse_order(std::string_view text, tf::weld_options& options);

/// As typed; an order of "P" is "min:P", and none "file".
[[nodiscard]] std::string order_in_words(const tf::weld_options& options);
[[nodiscard]] std::string keep_in_words(const tf::weld_options& options);
[[nodiscard]] const char* rule_in_words(const tf::weld_options& options);

/// That points have the properties that --drop and --rename name. \throws failure (bad_input)
void check_properties(const job& work, const tf::mesh_file& file);

/// What is wrong with a property that an option names; `known` are those of the input.
[[nodiscard]] failure property_failure(const tf::weld_property_error& error,
                                       const tf::attributes& known);

}  // namespace tools
