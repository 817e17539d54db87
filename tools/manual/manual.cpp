#include "tools/manual/manual.hpp"

#include <algorithm>
#include <cstddef>

namespace tools {
namespace {

/// Of one command line; `modes` are those of `command` that it is for.
void add_options(const command_text& command, const std::vector<std::string>& own,
                 std::vector<offered_option>& all) {
    for (const option_group& group : command.groups)
        for (const option_text& text : group.options) {
            if (text.text.empty() || !text.names.starts_with('-')) continue;
            offered_option one{.text = text, .names = words_of(text.names), .modes = own};
            one.own = !own.empty();
            one.repeatable = text.text.find("(repeatable)") != std::string::npos;
            if (text.label.find(", ") != std::string::npos) one.names = words_of(text.label);
            for (const mode_text& mode : command.modes) {
                const auto kept = groups_for(mode, {{.options = {text}}}, command.modes);
                if (kept.empty() || mode.usage.empty()) continue;  // or not of this line
                one.modes.push_back(mode.name);
            }
            one.without_mode = own.empty() && one.modes.empty() && !mode_names(command).empty();
            const auto prefix = modes_of(text, command.modes);
            if (!prefix.empty()) one.text.text.erase(0, prefix.size() + 2);
            all.push_back(std::move(one));
        }
}

}  // namespace

std::vector<offered_option> options_of(const command_text& command) {
    std::vector<offered_option> all;
    for (const auto& [names, own] : command.own) add_options(*own, words_of(names), all);
    add_options(command, {}, all);
    return all;
}

std::vector<std::string> mode_names(const command_text& command) {
    std::vector<std::string> names;
    for (const mode_text& mode : command.modes) names.push_back(mode.name);
    return names;
}

std::string joined(const std::vector<std::string>& words, std::string_view between) {
    std::string text;
    for (const std::string& word : words) {
        if (!text.empty()) text += between;
        text += word;
    }
    return text;
}

std::optional<std::string> manual_of(const command_text& command, std::string_view kind,
                                     const std::string& version) {
    if (kind == "man") return man_page(command, version);
    if (kind == "bash") return bash_completion(command);
    if (kind == "zsh") return zsh_completion(command);
    if (kind == "fish") return fish_completion(command);
    return std::nullopt;
}

}  // namespace tools
