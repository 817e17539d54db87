/// \file
/// Completion for bash, zsh and fish.

#include "tools/manual/manual.hpp"

#include <algorithm>
#include <cctype>
#include <string>

namespace tools {
namespace {

const char* const about = " completion of ";
const char* const origin = ", made of what its --help says.\n";

/// In one line, up to the end of its first sentence.
std::string summary(const std::string& text) {
    std::string line = text.substr(0, text.find(": "));
    if (line.size() < 12) line = text;
    std::replace(line.begin(), line.end(), '\n', ' ');
    return line.substr(0, line.find("; "));
}

/// What a shell takes for one word without a meaning of its own.
std::string quoted(const std::string& text, const std::string& quote_inside) {
    std::string out = "'";
    for (const char c : text) {
        if (c == '\'')
            out += quote_inside;
        else
            out += c;
    }
    return out + "'";
}

std::string function_name(const std::string& tool) {
    std::string name = "_" + tool;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

/// As users write extensions: small, or large as some cameras and scanners do.
std::string in_capitals(std::string word) {
    std::transform(word.begin(), word.end(), word.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return word;
}

/// For "clash:--output", a case of bash; those of modes with command lines of their own come first.
std::string bash_values(const offered_option& one, const std::string& function) {
    std::string pattern;
    const std::vector<std::string> any{"*"};
    for (const std::string& mode : one.own ? one.modes : any)
        for (const std::string& name : one.names)
            pattern += (pattern.empty() ? "" : " | ") + mode + ":" + name;
    std::string action;
    if (one.takes_file())
        action = function + "_files " + joined(one.text.offered, " ");
    else if (one.takes_folder())
        action = function + "_files /";
    else if (!one.text.offered.empty())
        action = "mapfile -t COMPREPLY < <(compgen -W \"" + joined(one.text.offered, " ") +
                 "\" -- \"$cur\")";
    if (!action.empty()) action = "            " + action + "\n";
    return "        " + pattern + ")\n" + action + "            return ;;\n";
}

/// The names of the options of a mode; of an optional value, "--repair=split" too.
std::string bash_names(const offered_option& one) {
    std::string names = joined(one.names, " ");
    if (one.text.value.empty())
        for (const std::string& word : one.text.offered)
            names += " " + one.names.back() + "=" + word;
    return names;
}

const char* const bash_files = R"(
# Folders, and the files that end in one of the extensions named; / stands for folders alone.
FUNCTION_files() {
    local ending
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -d -- "$cur")
    (($#)) || mapfile -t COMPREPLY < <(compgen -f -- "$cur")
    [[ ${1-} == / ]] && return
    for ending; do
        mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(
            compgen -f -X "!*.$ending" -- "$cur"
            compgen -f -X "!*.${ending^^}" -- "$cur")
    done
}

FUNCTION() {
    local cur=${COMP_WORDS[COMP_CWORD]} before= mode= options= word
    ((COMP_CWORD > 0)) && before=${COMP_WORDS[COMP_CWORD - 1]}
    if [[ $cur == = ]]; then # --option=
        cur=
    elif [[ $before == = ]]; then
        before=${COMP_WORDS[COMP_CWORD - 2]}
    fi
    COMPREPLY=()
)";

const char* const bash_mode = R"(    for word in "${COMP_WORDS[@]:1:COMP_CWORD - 1}"; do
        case $word in
            MODES)
                mode=$word
                break ;;
        esac
    done
)";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    for (std::size_t at = text.find(what); at != std::string::npos;
         at = text.find(what, at + by.size()))
        text.replace(at, what.size(), by);
    return text;
}

}  // namespace

std::string bash_completion(const command_text& command) {
    const std::string function = function_name(command.name);
    const std::vector<offered_option> options = options_of(command);
    std::string text = "# bash" + std::string(about) + command.name + origin;
    text += replaced(bash_files, "FUNCTION", function);
    const std::vector<std::string> modes = mode_names(command);
    if (!modes.empty()) text += replaced(bash_mode, "MODES", joined(modes, " | "));
    text += "    case $mode:$before in\n";
    for (const offered_option& one : options)
        if (!one.text.value.empty()) text += bash_values(one, function);
    text += "    esac\n    if [[ $cur == -* ]]; then\n";
    for (const offered_option& one : options) {
        const bool all = one.modes.empty();
        if (one.without_mode)
            text += "        [[ -z $mode ]] &&\n    ";
        else if (!all)
            text += "        [[ -z $mode || $mode == @(" + joined(one.modes, "|") + ") ]] &&\n    ";
        text += "        options+=\" " + bash_names(one) + "\"\n";
    }
    text +=
        "        mapfile -t COMPREPLY < <(compgen -W \"$options\" -- \"$cur\" | sort -u)\n"
        "        return\n    fi\n";
    const std::string files = function + "_files " + joined(command.input_extensions, " ") + "\n";
    if (modes.empty())
        return text + "    " + files + "}\ncomplete -F " + function + " " + command.name + "\n";
    text += "    if [[ -z $mode ]]; then\n";
    if (!command.needs_mode) text += "        " + files;
    text += "        mapfile -t -O \"${#COMPREPLY[@]}\" COMPREPLY < <(compgen -W \"" +
            joined(modes, " ") + "\" -- \"$cur\")\n    else\n        " + files +
            "    fi\n}\ncomplete -F " + function + " " + command.name + "\n";
    return text;
}

namespace {

/// A pattern of zsh for files.
std::string zsh_files(const std::vector<std::string>& extensions) {
    if (extensions.empty()) return "_files";
    std::vector<std::string> both = extensions;
    for (const std::string& one : extensions) both.push_back(in_capitals(one));
    return "_files -g \"*.(" + joined(both, "|") + ")(-.)\"";
}

std::string zsh_brackets(const std::string& text) {
    return replaced(replaced(replaced(text, "\\", "\\\\"), "[", "\\["), "]", "\\]");
}

/// "(-o --output)--output=[the solid]:FILE:_files", one for each name.
std::string zsh_specs(const offered_option& one) {
    std::string specs;
    for (const std::string& name : one.names) {
        const bool is_long = name.starts_with("--");
        std::string spec = one.repeatable ? "*" : "(" + joined(one.names, " ") + ")";
        spec += name;
        const bool optional = one.text.value.empty() && !one.text.offered.empty();
        if (optional)
            spec += "=-";
        else if (!one.text.value.empty())
            spec += is_long ? "=" : "+";
        spec += "[" + zsh_brackets(summary(one.text.text)) + "]";
        if (optional || !one.text.value.empty()) {
            spec += (optional ? "::" : ":") +
                    (optional ? "MODE" : replaced(one.text.value, ":", "\\:")) + ":";
            if (one.takes_file())
                spec += zsh_files(one.text.offered);
            else if (one.takes_folder())
                spec += "_files -/";
            else if (!one.text.offered.empty())
                spec += "(" + joined(one.text.offered, " ") + ")";
            else
                spec += " ";
        }
        specs += "        " + quoted(spec, "'\\''") + "\n";
    }
    return specs;
}

}  // namespace

std::string zsh_completion(const command_text& command) {
    const std::string function = function_name(command.name);
    std::string text = "#compdef " + command.name + "\n# zsh" + std::string(about) + command.name +
                       origin + "\n" + function + "() {\n    local mode\n    local -a specs\n";
    const std::vector<std::string> modes = mode_names(command);
    if (!modes.empty())
        text += "    mode=${${words[2,CURRENT-1]}[(r)(" + joined(modes, "|") + ")]}\n";
    for (const offered_option& one : options_of(command)) {
        if (one.without_mode)
            text += "    [[ -z $mode ]] &&\n    ";
        else if (!one.modes.empty())
            text += "    [[ -z $mode || $mode == (" + joined(one.modes, "|") + ") ]] &&\n    ";
        text += "    specs+=(\n" + zsh_specs(one) + "    )\n";
    }
    text += "    _arguments -s -S : $specs";
    if (!modes.empty()) {
        std::string list;
        for (const mode_text& mode : command.modes)
            list += mode.name + "\\:\"" + replaced(summary(mode.text), "\"", "") + "\" ";
        text += " \\\n        " + quoted("1:mode:((" + list + "))", "'\\''");
    }
    text +=
        " \\\n        " +
        quoted("*:" + command.inputs_name + ":" + zsh_files(command.input_extensions), "'\\''") +
        "\n}\n\n" + function + " \"$@\"\n";
    return text;
}

namespace {

std::string fish_endings(const std::vector<std::string>& extensions) {
    std::string list;
    for (const std::string& one : extensions) list += " ." + one;
    return "\"(__fish_complete_suffix" + list + ")\"";
}

std::string fish_option(const std::string& tool, const std::vector<std::string>& modes,
                        const offered_option& one) {
    std::string line = "complete -c " + tool;
    if (one.without_mode)
        line += " -n 'not __fish_seen_subcommand_from " + joined(modes, " ") + "'";
    else if (!one.modes.empty())
        line += " -n '__fish_seen_subcommand_from " + joined(one.modes, " ") + "'";
    for (const std::string& name : one.names)
        line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    if (one.takes_folder())
        line += " -x -a '(__fish_complete_directories)'";
    else if (one.takes_file())
        line += one.text.offered.empty() ? " -r -F" : " -k -x -a " + fish_endings(one.text.offered);
    else if (!one.text.value.empty())
        line += " -x";
    const bool words = !one.takes_file() && !one.text.offered.empty();
    if (words && !one.text.value.empty()) line += " -a '" + joined(one.text.offered, " ") + "'";
    return line + " -d " + quoted(summary(one.text.text), "\\'") + "\n";
}

}  // namespace

std::string fish_completion(const command_text& command) {
    std::string text = "# fish" + std::string(about) + command.name + origin;
    const std::string start = "complete -c " + command.name;
    const std::string before =
        "'not __fish_seen_subcommand_from " + joined(mode_names(command), " ") + "'";
    for (const mode_text& mode : command.modes)
        text += start + " -f -n " + before + " -a " + mode.name + " -d " +
                quoted(summary(mode.text), "\\'") + "\n";
    for (const offered_option& one : options_of(command))
        text += fish_option(command.name, mode_names(command), one);
    text += start + " -k";
    if (command.needs_mode) text += " -n 'not " + before.substr(5);
    if (command.needs_mode) text.replace(text.rfind("'not "), 5, "'");
    return text + " -x -a " + fish_endings(command.input_extensions) + "\n";
}

}  // namespace tools
