#include "tools/tf-boolean/settings.hpp"

#include "tools/shell/curve_file.hpp"
#include "tools/shell/exit_status.hpp"
#include <treeform/tf.hpp>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace tools {
namespace {

bool is_operation(const std::string& word) { return std::ranges::count(operations, word) > 0; }

bool may_have_parts(const std::string& input) {
    const std::string extension = extension_of(input);
    return extension != "stl" && extension != "ply" && extension != "off";
}

void take_operation(boolean_settings& s, common_options& o) {
    const std::string& first = o.inputs.front();
    if (!s.expression.empty()) {
        if (is_operation(first) && !std::filesystem::exists(first))
            refuse("--expr stands instead of " + first + ", not beside it");
        return;
    }
    if (is_operation(first)) {
        s.operation = first;
        o.inputs.erase(o.inputs.begin());
    } else if (!s.check) {
        refuse(first + ": no operation; expected one of " + listed(operations) + ", or --expr");
    }
    if (o.inputs.empty()) refuse(s.operation + ": expected an INPUT");
}

/// "2:m.txt"
void take_matrices(boolean_settings& s, common_options& o) {
    s.matrix_files.resize(o.inputs.size());
    for (const std::string& text : s.matrix_texts) {
        const std::size_t colon = text.find(':');
        if (colon == std::string::npos || colon + 1 == text.size())
            refuse("--matrix " + text + ": expected N:FILE");
        const std::uint64_t number = parse_count("--matrix", text.substr(0, colon));
        if (number < 1 || number > o.inputs.size())
            refuse("--matrix " + text + ": there " +
                   (o.inputs.size() == 1 ? std::string("is one INPUT")
                                         : "are INPUTs 1 to " + std::to_string(o.inputs.size())));
        std::filesystem::path& file = s.matrix_files[number - 1];
        if (!file.empty()) refuse("--matrix: INPUT " + std::to_string(number) + " has two");
        file = text.substr(colon + 1);
        o.also_read.push_back(file.string());
    }
}

void refuse_what_does_nothing(const boolean_settings& s, const common_options& o) {
    const bool mesh = wants_mesh(o);
    if (s.check && mesh) refuse("--check writes no mesh");
    if (s.check && s.max_move_given) refuse("--max-move: --check moves nothing");
    if (!mesh && (o.ascii || o.binary || !o.output_format.empty()))
        refuse("--output-format, --ascii and --binary need -o");
    if (s.check && o.precision != "keep") refuse("--precision: --check writes no mesh");
    if (s.splits() && s.simplify) refuse("--merge-coplanar: split keeps every piece");
    if (s.splits() && s.keep_cuts) refuse("--keep-cuts: split keeps all cuts");
    if (s.simplify && s.keep_cuts) refuse("--keep-cuts and --merge-coplanar exclude each other");
    if (s.check && (s.simplify || s.keep_cuts || s.accept_open || s.repair))
        refuse(
            "--merge-coplanar, --keep-cuts, --accept-open and --repair: --check makes no result");
    if (s.check && (s.min_volume_given || s.gap))
        refuse("--min-volume and --gap: --check makes no result");
    if (s.min_volume_given && (s.splits() || s.accept_open))
        refuse("--min-volume: parts of an open surface have no volume");
    if (s.gap && s.operation != "union") refuse("--gap: only a union fills gaps");
    if (s.gap && s.accept_open) refuse("--gap needs solids; it excludes --accept-open");
    if (s.accept_open && s.repair)
        refuse("--repair closes open surfaces; it excludes --accept-open");
    check_curve_path(s.curves);
    if (s.check && !s.curves.empty()) refuse("--curves: --check makes no result");
    if (s.splits() && s.fill_rule != tf::fill_rule::nonzero)
        refuse("--fill-rule: split keeps every piece");
    if (s.source.empty() || s.source.find_first_of(" \t\r\n") != std::string::npos)
        refuse("--source: expected a name without blanks");
    if (s.source_given && (!mesh || !holds_sources(mesh_format(o, o.output))))
        refuse("--source needs an output with properties: ply, glb");
}

/// Of operands by number: a, ..., z, aa, ...
std::string letters_of(std::size_t number) {
    std::string name;
    for (std::size_t n = number + 1; n > 0; n = (n - 1) / 26)
        name.insert(name.begin(), static_cast<char>('a' + (n - 1) % 26));
    return name;
}

}  // namespace

bool holds_sources(const std::string& format) { return format == "ply" || format == "glb"; }

void refuse_unknown(const std::vector<std::string>& names, std::size_t operands) {
    const auto is_name = [operands](const std::string& name) {
        const auto lower = [](char c) { return c | 0x20; };
        for (std::size_t i = 0; i < operands; ++i)
            if (std::ranges::equal(name, letters_of(i), {}, lower)) return true;
        return false;
    };
    const auto unknown = std::ranges::find_if_not(names, is_name);
    if (unknown == names.end()) return;
    constexpr std::size_t most = 10;
    std::string known = letters_of(0);
    for (std::size_t i = 1; i < std::min(operands, most); ++i) known += ", " + letters_of(i);
    refuse("--expr: no operand is named " + *unknown +
           (operands == 1 ? "; the only one is " : "; the names are ") + known +
           (operands > most ? ", ..." : ""));
}

const char* name_of(tf::fill_rule rule) { return fill_rules[static_cast<std::size_t>(rule)]; }

void settle_words(boolean_settings& settings, common_options& options) {
    take_operation(settings, options);
    take_matrices(settings, options);
    refuse_what_does_nothing(settings, options);
    if (settings.splits() || settings.name().empty()) return;
    try {
        static_cast<void>(formula_of(settings, options.inputs.size()));
    } catch (const failure& error) {
        try {
            settings.names = tf::boolean_expression::names_in(settings.expression);
        } catch (const std::invalid_argument&) {
        }  // which has been said in other words
        // Letters may be objects of the only INPUT.
        const bool letters =
            options.inputs.size() > 1 &&
            std::ranges::all_of(settings.names, [](auto& name) { return name.size() == 1; });
        if (settings.names.empty()) throw error;
        if (letters || std::ranges::none_of(options.inputs, may_have_parts)) {
            refuse_unknown(settings.names, options.inputs.size());
            throw error;
        }
    }
}

tf::boolean_expression formula_of(const boolean_settings& settings, std::size_t operands) {
    using tf::boolean_expression;
    if (settings.operation == "union") return boolean_expression::union_of(operands);
    if (settings.operation == "intersection") return boolean_expression::intersection_of(operands);
    if (settings.operation == "difference") return boolean_expression::difference_of(operands);
    if (settings.operation == "symmetric-difference")
        return boolean_expression::symmetric_difference_of(operands);
    try {
        if (!settings.names.empty()) return {settings.expression, settings.names};
        return {settings.expression, operands};
    } catch (const std::invalid_argument& error) {
        const std::string text = error.what();
        refuse("--expr: " + text.substr(text.find(": ") + 2));
    }
}

}  // namespace tools
