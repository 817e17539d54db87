#include "tools/manual/manual.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>
#include <vector>

namespace tools {
namespace {

/// As it stands, to troff.
std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '\\')
            out += "\\e";
        else if (c == '-')
            out += "\\-";
        else if (c == '\'')
            out += "\\(aq";
        else
            out += c;
    }
    return out;
}

std::vector<std::string> split(const std::string& text, const std::string& between) {
    std::vector<std::string> parts;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find(between, at), text.size());
        if (end > at) parts.push_back(text.substr(at, end - at));
        at = end + between.size();
    }
    return parts;
}

/// Lines that are to be filled; none begins with a sign that troff takes for its own.
std::string filled(const std::string& text) {
    std::string out;
    for (const std::string& line : split(text, "\n")) {
        const std::string shown =
            escaped(line.substr(std::min(line.find_first_not_of(' '), line.size())));
        out += (shown.starts_with('.') ? "\\&" : "") + shown + "\n";
    }
    return out;
}

/// Lines that stay as they are.
std::string kept(const std::string& text) {
    std::string out = ".nf\n";
    for (const std::string& line : split(text, "\n"))
        out += (line.starts_with('.') ? "\\&" : "") + escaped(line) + "\n";
    return out + ".fi\n";
}

bool is_table(const std::string& paragraph) {
    return paragraph.find("\n  ") != std::string::npos || paragraph.starts_with("  ");
}

std::string capitals(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

/// Its paragraphs; "Examples:" and "Exit status:" under headings by `macro`, .SH or .SS.
std::string epilogue(const std::string& text, const std::string& macro, bool headings_only) {
    std::string out;
    for (const std::string& paragraph : split(text, "\n\n")) {
        const bool examples = paragraph.starts_with("Examples:\n");
        const bool status = paragraph.starts_with("Exit status: ");
        if (examples)
            out += macro + " EXAMPLES\n" + kept(paragraph.substr(10));
        else if (status)
            out += macro + " EXIT STATUS\n" + filled(paragraph.substr(13));
        else if (!headings_only)
            out += ".PP\n" + (is_table(paragraph) ? kept(paragraph) : filled(paragraph));
    }
    return out;
}

/// Paragraphs ahead of the first heading.
std::string description(const std::string& text) {
    return epilogue(text.substr(0, std::min(text.find("Examples:\n"), text.find("Exit status: "))),
                    ".SH", false);
}

std::string entry(const option_text& option) {
    const std::string& names = option.label.empty() ? option.names : option.label;
    std::string out = ".TP\n\\fB" + escaped(names) + "\\fR";
    if (!option.value.empty()) out += " \\fI" + escaped(option.value) + "\\fR";
    out += "\n" + filled(option.text);
    if (!option.fallback.empty()) out += "[" + escaped(option.fallback) + "]\n";
    return out;
}

bool is_of_modes(const option_group& group, const command_text& command) {
    return !group.options.empty() && !command.modes.empty() &&
           group.options.front().names == command.modes.front().name;
}

std::string options(const command_text& command) {
    std::string out = entry({.names = command.inputs_name + "...", .text = command.inputs_text});
    for (const option_group& group : command.groups) {
        if (is_of_modes(group, command)) continue;
        if (!group.title.empty()) out += ".SS " + escaped(group.title) + "\n";
        for (const option_text& option : group.options)
            if (!option.text.empty()) out += entry(option);
    }
    return out;
}

std::string modes(const command_text& command) {
    std::string out;
    for (const mode_text& mode : command.modes) {
        out += ".SS " + escaped(mode.name) + "\n";
        if (mode.usage.empty()) {  // a command line of its own, below
            out += filled(mode.text.substr(0, mode.text.find(": ")) + ": see below");
            continue;
        }
        out += ".B " + escaped(command.name + " " + mode.usage) + "\n.PP\n" + filled(mode.text);
        for (const std::string& paragraph : split(mode.more, "\n\n"))
            out += ".PP\n" + (paragraph.starts_with("Examples:\n") ? kept(paragraph.substr(10))
                                                                   : filled(paragraph));
    }
    return out;
}

/// "find where to put ...": up to the end of the first sentence.
std::string name_line(const std::string& purpose) {
    std::string text = purpose.substr(0, std::min(purpose.find(". "), purpose.find(".\n")));
    if (text.ends_with('.')) text.pop_back();
    std::replace(text.begin(), text.end(), '\n', ' ');
    text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
    return text;
}

}  // namespace

std::string man_page(const command_text& command, const std::string& version) {
    std::string out = ".TH " + escaped(capitals(command.name)) + " 1 \"\" \"" + escaped(version) +
                      "\" \"User Commands\"\n.SH NAME\n" + escaped(command.name) + " \\- " +
                      escaped(name_line(command.purpose)) + "\n.SH SYNOPSIS\n.B " +
                      escaped(command.name + " " + command.usage) + "\n";
    for (const auto& [mode, own] : command.own)
        out += ".br\n.B " + escaped(own->name + " " + own->usage) + "\n";
    out += ".SH DESCRIPTION\n" + filled(command.purpose) + description(command.epilogue);
    if (!command.modes.empty())
        out += ".SH " + std::string(command.needs_mode ? "MODES" : "OPERATIONS") + "\n" +
               modes(command);
    out += ".SH OPTIONS\n" + options(command);
    for (const auto& [mode, own] : command.own)
        out += ".SH " + escaped(capitals(command.name + " " + mode)) + "\n.B " +
               escaped(own->name + " " + own->usage) + "\n.PP\n" + filled(own->purpose) +
               description(own->epilogue) + ".SS Options\n" + options(*own) +
               epilogue(own->epilogue, ".SS", true);
    return out + epilogue(command.epilogue, ".SH", true);
}

}  // namespace tools
