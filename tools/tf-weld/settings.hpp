#pragma once
/// \file
/// What a user of tf-weld asks for.

#include "tools/common/parse_value.hpp"
#include <treeform/mesh/weld_mesh.hpp>
#include <treeform/tf.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tools {

/// How points are put together.
struct weld_settings {
    distance tolerance{};
    tf::weld_rule rule = tf::weld_rule::first;
    std::vector<tf::weld_condition> same{};  ///< as typed: properties or names of groups of them
    std::vector<std::string> across{};       ///< as typed
    tf::weld_keep keep = tf::weld_keep::first;
    std::string keep_by{};
    bool borders = false;
    bool keep_manifold = false;
    bool keep_degenerate = false;
};

/// What is given back beside what the common options name.
struct weld_outputs {
    std::filesystem::path map{};
    std::filesystem::path removed{};
    std::string label{};
    bool check = false;
};

struct weld_request {
    weld_settings settings{};
    weld_outputs outputs{};
};

/// Values of options. All of them: \throws failure (bad_usage) naming option and text
[[nodiscard]] tf::weld_rule parse_rule(std::string_view text);
/// "intensity,nx=0.01"
[[nodiscard]] std::vector<tf::weld_condition> parse_same(std::string_view text);
[[nodiscard]] std::vector<std::string> parse_across(std::string_view text);
/// "first", "last", "mean", "min:P", "max:P"
void parse_keep(std::string_view text, weld_settings& settings);

/// As typed.
[[nodiscard]] std::string keep_in_words(const weld_settings& settings);
[[nodiscard]] const char* name_of(tf::weld_rule rule);

}  // namespace tools
