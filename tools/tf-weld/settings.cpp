#include "tools/tf-weld/settings.hpp"

#include "tools/shell/exit_status.hpp"
#include <treeform/tf.hpp>

#include <array>

namespace tools {
namespace {

std::vector<std::string_view> split(std::string_view option, std::string_view text) {
    std::vector<std::string_view> parts;
    while (true) {
        const std::size_t comma = text.find(',');
        parts.push_back(text.substr(0, comma));
        if (parts.back().empty())
            refuse(std::string(option) + ": expected names of properties, separated by commas");
        if (comma == std::string_view::npos) return parts;
        text.remove_prefix(comma + 1);
    }
}

tf::weld_condition parse_condition(std::string_view text) {
    const std::size_t equals = text.rfind('=');
    if (equals == std::string_view::npos) return {.property = std::string(text)};
    const double tolerance = parse_number("--same", text.substr(equals + 1));
    if (equals == 0 || tolerance < 0.0)
        refuse("--same " + std::string(text) + ": expected NAME or NAME=TOL, TOL 0 or more");
    return {.property = std::string(text.substr(0, equals)), .tolerance = tolerance};
}

std::string known_properties(const tf::attributes& known) {
    std::string names;
    if (const tf::element* const vertices = known.find("vertex"))
        for (const tf::column& c : vertices->columns)
            if (c.role == tf::column_role::data) names += (names.empty() ? "" : ", ") + c.name;
    return names.empty() ? "the points have only x, y, z" : "the points have " + names;
}

}  // namespace

name_pairs parse_names(std::string_view option, std::string_view text) {
    name_pairs names;
    for (const auto part : split(option, text)) {
        const std::size_t equals = part.find('=');
        if (equals == std::string_view::npos || equals == 0 || equals + 1 == part.size())
            refuse(std::string(option) + " " + std::string(part) + ": expected A=B");
        names.emplace_back(part.substr(0, equals), part.substr(equals + 1));
    }
    return names;
}

std::vector<std::string> parse_properties(std::string_view option, std::string_view text) {
    const auto parts = split(option, text);
    return {parts.begin(), parts.end()};
}

std::array<double, 3> parse_axes(std::string_view option, std::string_view text) {
    const auto parts = split(option, text);
    if (parts.size() != 1 && parts.size() != 3)
        refuse(std::string(option) + " " + std::string(text) + ": expected one number or three");
    std::array<double, 3> axes{};
    for (std::size_t k = 0; k < 3; ++k)
        axes[k] = parse_number(std::string(option), parts[parts.size() == 1 ? 0 : k]);
    return axes;
}

void check_properties(const job& work, const tf::mesh_file& file) {
    const tf::element* const vertices = file.attributes.find("vertex");
    const auto has = [&](const std::string& name) {
        const tf::column* const c = vertices == nullptr ? nullptr : vertices->find(name);
        return c != nullptr && c->role == tf::column_role::data;
    };
    const auto check = [&](const std::string& option, const std::string& name) {
        if (!has(name))
            throw failure(
                bad_input, "property",
                option + " " + name + ": no such property; " + known_properties(file.attributes));
    };
    const tf::corner_values& corners = file.attributes.corners;
    for (const std::string& name : work.options.drop)
        if (!(vertices != nullptr && !vertices->columns_called(name).empty()) &&
            !(name == "normal" && !corners.normal_of_corner.empty()) &&
            !(name == "uv" && !corners.texture_of_corner.empty()))
            check("--drop", name);
    for (const auto& [name, source] : work.options.rename) {
        check("--rename", source);
        if (has(name) || name == "x" || name == "y" || name == "z")
            throw failure(
                bad_input, "property",
                "--rename " + source + "=" + name + ": the property " + name + " already exists");
    }
}

void parse_rule(std::string_view text, tf::weld_options& options) {
    if (text != "first" && text != "chain")
        refuse("--rule " + std::string(text) + ": expected first or chain");
    options.chain = text == "chain";
}

std::vector<tf::weld_condition> parse_same(std::string_view text) {
    std::vector<tf::weld_condition> conditions;
    for (const auto part : split("--same", text)) conditions.push_back(parse_condition(part));
    return conditions;
}

std::vector<std::string> parse_ignored_seams(std::string_view text) {
    const auto parts = split("--ignore-seams", text);
    return {parts.begin(), parts.end()};
}

void parse_keep(std::string_view text, tf::weld_options& options) {
    using enum tf::weld_keep;
    options.keep_by.clear();
    if (text == "first" || text == "last" || text == "mean") {
        options.keep = text == "first" ? first : text == "last" ? last : mean;
        return;
    }
    const bool least = text.starts_with("min:");
    if (text.size() < 5 || !(least || text.starts_with("max:")))
        refuse("--keep " + std::string(text) + ": expected first, last, mean, min:P or max:P");
    options.keep = least ? lowest : highest;
    options.keep_by = text.substr(4);
}

void parse_order(std::string_view text, tf::weld_options& options) {
    const bool highest = text.starts_with("max:");
    const std::string_view name = highest || text.starts_with("min:") ? text.substr(4) : text;
    if (name.empty())
        refuse("--order " + std::string(text) + ": expected P, min:P or max:P for a property P");
    options.order_by = name;
    options.highest_first = highest;
}

std::string order_in_words(const tf::weld_options& options) {
    if (options.order_by.empty()) return "file";
    return (options.highest_first ? "max:" : "min:") + options.order_by;
}

std::string keep_in_words(const tf::weld_options& options) {
    constexpr std::array words{"first", "last", "mean", "min:", "max:"};
    return words[static_cast<std::size_t>(options.keep)] + options.keep_by;
}

const char* rule_in_words(const tf::weld_options& options) {
    return options.chain ? "chain" : "first";
}

failure property_failure(const tf::weld_property_error& error, const tf::attributes& known) {
    const std::string option = error.option() == "keep_by"         ? "--keep "
                               : error.option() == "order_by"      ? "--order "
                               : error.option() == "ignored_seams" ? "--ignore-seams "
                                                                   : "--" + error.option() + " ";
    const std::string why =
        error.reason().empty() ? "no such property; " + known_properties(known) : error.reason();
    return {bad_input, "property", option + error.name() + ": " + why};
}

}  // namespace tools
