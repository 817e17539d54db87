#include "tools/manual/help_text.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace tools {
namespace {

constexpr std::size_t text_column = 26;
constexpr std::size_t width = 79;

std::string left_column(const option_text& option) {
    const std::string& names = option.label.empty() ? option.names : option.label;
    std::string left = names.starts_with("--") ? "      " : "  ";
    left += names;
    if (!option.value.empty() && !option.value.starts_with('[')) left += ' ';
    left += option.value;
    if (left.size() < text_column) return left.append(text_column - left.size(), ' ');
    return left + "  ";
}

std::string lay_out(const option_text& option) {
    std::string out = left_column(option);
    std::size_t line_start = 0;
    for (const char c : option.text) {
        out += c;
        if (c != '\n') continue;
        line_start = out.size();
        out.append(text_column, ' ');
    }
    if (!option.fallback.empty()) {
        const std::string note = "[" + option.fallback + "]";
        if (out.size() - line_start + 2 + note.size() > width) {
            out += '\n';
            line_start = out.size();
        }
        out.append(width - note.size() - (out.size() - line_start), ' ');
        out += note;
    }
    return out + '\n';
}

/// The words of a text, as many a line as fit; the first line has less room, by `taken`.
std::string wrapped(const std::string& text, std::size_t room, std::size_t taken = 0) {
    std::string out;
    std::size_t line_start = 0;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find_first_of(" \n", at), text.size());
        const bool first = out.size() == line_start;
        const std::size_t used = out.size() - line_start + (line_start == 0 ? taken : 0);
        if (!first && used + 1 + end - at > room) {
            out += '\n';
            line_start = out.size();
        } else if (!first) {
            out += ' ';
        }
        out.append(text, at, end - at);
        at = end + 1;
    }
    return out;
}

/// What a text says to one mode. Its first clause is for all. Of the others, one that begins with
/// the name of another mode or names an option that the mode has not is left out, and "of measure,
/// ..." is what measure has instead of the first.
std::string said_to(const mode_text& mode, const std::string& text,
                    const std::vector<mode_text>& modes) {
    std::vector<std::string> clauses;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find(';', at), text.size());
        clauses.push_back(text.substr(at, end - at));
        at = end + 1 + (end + 1 < text.size() ? 1 : 0);
    }
    std::string out;
    for (const std::string& clause : clauses) {
        const bool later = &clause != &clauses.front();
        const std::string of = clause.starts_with("of ") ? clause.substr(3) : clause;
        const std::size_t end = std::min(of.find_first_of(", "), of.size());
        const bool of_some = later && std::ranges::any_of(modes, [&](const mode_text& one) {
                                 return one.name == of.substr(0, end);
                             });
        if (later && std::ranges::any_of(mode.without, [&](const std::string& option) {
                return clause.find(option + ' ') != std::string::npos;
            }))
            continue;
        const bool own = of_some && mode.name == of.substr(0, end);
        if (of_some && !own) continue;
        if (own && of.size() < clause.size())
            out = of.substr(end + 2);
        else
            out += (out.empty() ? "" : "; ") + clause;
    }
    return out;
}

std::string page(const command_text& command, const std::string& usage, const std::string& purpose,
                 const std::vector<option_group>& groups) {
    std::string text = "Usage: " + command.name + " " + usage + "\n\n" + purpose + "\n\n";
    text += lay_out(option_text{.names = command.inputs_name + "...", .text = command.inputs_text});
    for (const option_group& group : groups) text += tools::lay_out(group);
    return text + "\n";
}

/// The text of an option in the help of a mode.
std::string text_of(const mode_text& mode, const option_text& option,
                    const std::vector<mode_text>& modes) {
    std::string text = option.text;
    if (const auto only = modes_of(option, modes); !only.empty()) text.erase(0, only.size() + 2);
    const std::string own = said_to(mode, text, modes);
    const auto blanks = [](std::string one) {
        std::ranges::replace(one, '\n', ' ');
        return one;
    };
    const bool as_written = blanks(own) == blanks(option.text);
    return as_written ? option.text
                      : wrapped(own, width - text_column, left_column(option).size() - text_column);
}

/// What stands ahead of `end`; it is taken off the text, with `end`.
std::string taken(std::string_view& text, std::string_view end) {
    const std::size_t at = text.find(end);
    const std::string front(text.substr(0, at));
    text.remove_prefix(at + end.size());
    return front;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> sections_of(std::string_view help) {
    std::vector<std::pair<std::string, std::string>> all;
    while (!help.empty()) {
        const std::string line = taken(help, "\n");
        if (line.starts_with('['))
            all.emplace_back(line.substr(1, line.size() - 2), std::string());
        else
            all.back().second += line + "\n";
    }
    for (auto& [name, text] : all) text.erase(text.find_last_not_of('\n') + 2);
    return all;
}

mode_text mode_of(std::string name, std::string_view section) {
    mode_text made{.name = std::move(name), .text = taken(section, "\nusage ")};
    made.usage = taken(section, "\n");
    if (section.starts_with("without ")) {
        std::string_view options = section.substr(0, section.find('\n'));
        section.remove_prefix(options.size() + 1);
        options.remove_prefix(options.find(' ') + 1);
        while (options.find(' ') != std::string_view::npos)
            made.without.push_back(taken(options, " "));
        made.without.emplace_back(options);
    }
    made.more = section;
    return made;
}

std::vector<std::string> words_of(std::string_view list) {
    std::vector<std::string> words;
    for (std::size_t at = 0; at <= list.size();) {
        const std::size_t end = std::min(list.find(',', at), list.size());
        words.emplace_back(list.substr(at, end - at));
        at = end + (list.substr(end).starts_with(", ") ? 2 : 1);
    }
    return words;
}

std::string_view modes_of(const option_text& option, const std::vector<mode_text>& modes) {
    const std::string_view text = option.text;
    const std::size_t colon = text.find(": ");
    if (colon == std::string_view::npos) return {};
    const bool all_modes = std::ranges::all_of(words_of(text.substr(0, colon)), [&](auto& word) {
        return std::ranges::any_of(modes, [&](auto& mode) { return mode.name == word; });
    });
    return all_modes ? text.substr(0, colon) : std::string_view();
}

std::vector<option_group> groups_for(const mode_text& mode, const std::vector<option_group>& groups,
                                     const std::vector<mode_text>& modes) {
    const auto is_mode = [&](const option_text& option) {
        return std::ranges::any_of(modes, [&](auto& one) { return one.name == option.names; });
    };
    const auto left_out = [&](const option_text& option) {
        const std::string_view only = modes_of(option, modes);
        const auto names = words_of(option.names);
        return is_mode(option) ||
               (!only.empty() && std::ranges::count(words_of(only), mode.name) == 0) ||
               std::ranges::count(mode.without, names.back()) > 0;
    };
    std::vector<option_group> kept;
    for (option_group group : groups) {
        std::erase_if(group.options, left_out);
        for (option_text& option : group.options) option.text = text_of(mode, option, modes);
        if (!group.options.empty()) kept.push_back(std::move(group));
    }
    return kept;
}

std::string lay_out(const option_group& group) {
    std::string out = group.title.empty() ? std::string() : group.title + ":\n";
    for (const option_text& option : group.options)
        if (!option.text.empty()) out += lay_out(option);
    return out;
}

std::string help_of(const command_text& c, std::string_view word) {
    for (const auto& [names, own] : c.own)
        if (std::ranges::count(words_of(names), word) > 0) return help_of(*own);
    const auto at = std::ranges::find_if(c.modes, [&](auto& mode) { return mode.name == word; });
    if (at == c.modes.end()) return page(c, c.usage, c.purpose, c.groups) + c.epilogue;
    std::string purpose = wrapped(at->text + ".", width);
    purpose[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(purpose[0])));
    const std::string text =
        page(c, at->usage, purpose, groups_for(*at, c.groups, c.modes)) + at->more;
    if (at->more.find("\nExit status: ") != std::string::npos) return text;
    return text + "\n" +
           c.epilogue.substr(std::min(c.epilogue.find("Exit status:"), c.epilogue.size()));
}

}  // namespace tools
