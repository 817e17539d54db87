#include "tools/shell/command_line.hpp"

#include "tools/manual/manual.hpp"
#include "tools/shell/exit_status.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <stdexcept>

namespace tools {

struct command_line::parser {
    CLI::App app;
};

namespace {

/// The last one: "--tolerance" of "-t, --tolerance".
std::string long_name(const option_text& text) {
    return text.names.substr(text.names.rfind(' ') + 1);
}

}  // namespace

command_line::command_line(std::string name, std::string usage, std::string purpose)
    : text_{.name = std::move(name), .usage = std::move(usage), .purpose = std::move(purpose)},
      parser_(std::make_unique<parser>()) {
    parser_->app.set_help_flag("-h,--help", "")->disable_flag_override();
}

command_line::~command_line() = default;

std::string command_line::names_of(const option_text& text) const {
    std::string names = text.names;
    std::erase(names, ' ');
    return text.aliases.empty() ? names : names + "," + text.aliases;
}

void command_line::mention(option_text text) {
    if (text_.groups.empty()) text_.groups.emplace_back();
    text_.groups.back().options.push_back(std::move(text));
}

void command_line::mode(mode_text text) {
    mention({.names = text.name, .text = text.text});
    text_.modes.push_back(std::move(text));
}

void command_line::mode(mode_text text, const command_line& own) {
    text_.own.emplace_back(text.name, &own.text_);
    mode(std::move(text));
}

void command_line::describe(std::string_view help) {
    for (auto& [names, text] : sections_of(help))
        if (names == "epilogue")
            epilogue(text);
        else
            mode(mode_of(names, text));
}

void command_line::refuse_others(const std::string& mode) const {
    const auto at = std::ranges::find_if(text_.modes, [&](auto& one) { return one.name == mode; });
    std::vector<std::string> mine;
    for (const option_group& group : groups_for(*at, text_.groups, text_.modes))
        for (const option_text& one : group.options) mine.push_back(one.names);
    for (const option_group& group : text_.groups)
        for (const option_text& one : group.options)
            if (one.names.starts_with('-') && given(long_name(one)) &&
                std::ranges::count(mine, one.names) == 0)
                tools::refuse(long_name(one) + " is not for " + mode);
}

void command_line::group(std::string title) { text_.groups.push_back({.title = std::move(title)}); }

void command_line::flag(bool& target, option_text text) {
    parser_->app.add_flag(names_of(text), target)->disable_flag_override();
    mention(std::move(text));
}

void command_line::repeatable_flag(int& target, option_text text) {
    parser_->app.add_flag(names_of(text), target)->disable_flag_override();
    mention(std::move(text));
}

void command_line::option(std::string& target, option_text text) {
    option(std::move(text), [&target](std::string_view value) { target = value; });
}

void command_line::option(std::string& target, option_text text,
                          const std::vector<std::string>& words) {
    const std::string name = long_name(text);
    text.offered = words;
    option(std::move(text), [&target, name, words](std::string_view value) {
        const std::vector<const char*> list = [&] {
            std::vector<const char*> all;
            for (const std::string& word : words) all.push_back(word.c_str());
            return all;
        }();
        target = words[parse_choice(name, value, list)];
    });
}

void command_line::offer(const std::string& name, std::vector<std::string> words) {
    for (option_group& group : text_.groups)
        for (option_text& one : group.options)
            if (long_name(one) == name) one.offered = words;
}

void command_line::offer_inputs(std::vector<std::string> extensions) {
    text_.input_extensions = std::move(extensions);
}

void command_line::option(std::uint64_t& target, option_text text) {
    const std::string name = long_name(text);
    option(std::move(text),
           [&target, name](std::string_view value) { target = parse_count(name, value); });
}

void command_line::option(distance& target, option_text text) {
    const std::string name = long_name(text);
    option(std::move(text),
           [&target, name](std::string_view value) { target = parse_distance(name, value); });
}

void command_line::option(std::optional<distance>& target, option_text text) {
    const std::string name = long_name(text);
    option(std::move(text),
           [&target, name](std::string_view value) { target = parse_distance(name, value); });
}

void command_line::option(option_text text, std::function<void(std::string_view)> accept) {
    parser_->app.add_option_function<std::string>(
        names_of(text), [accept = std::move(accept)](const std::string& value) { accept(value); });
    mention(std::move(text));
}

void command_line::flag_with_value(option_text text,
                                   std::function<void(std::optional<std::string_view>)> accept) {
    static constexpr const char* bare = "true";  // what the parser makes of --name
    parser_->app.add_flag(names_of(text))->each([accept = std::move(accept)](const std::string& v) {
        accept(v == bare ? std::nullopt : std::optional<std::string_view>(v));
    });
    mention(std::move(text));
}

void command_line::flag_with_value(option_text text, std::span<const char* const> words,
                                   const std::string& bare,
                                   std::function<void(std::size_t)> accept) {
    const std::string name = long_name(text);
    for (const char* word : words) values_apart_.emplace_back(name, word);
    text.offered.assign(words.begin(), words.end());
    CLI::Option* flag = parser_->app.add_flag(names_of(text) + "{" + bare + "}");
    flag->each([accept = std::move(accept), name, words](const std::string& value) {
        accept(parse_choice(name, value, words));
    });
    mention(std::move(text));
}

void command_line::output(std::filesystem::path& target, option_text text) {
    outputs_.push_back(&target);
    // Before the call: which of its arguments is made first is up to the compiler.
    auto accept = [&target, names = text.names](std::string_view value) {
        if (value.empty()) throw failure(bad_usage, "usage", names + ": expected a file name");
        target = value;
    };
    option(std::move(text), std::move(accept));
}

void command_line::refuse(const std::string& names, bool has_value, std::string why) {
    const auto complain = [names, why = std::move(why)] {
        throw failure(bad_usage, "usage", names + " " + why);
    };
    if (has_value)
        parser_->app.add_option_function<std::string>(
            names, [complain](const std::string&) { complain(); });
    else
        parser_->app.add_flag_function(names, [complain](std::int64_t) { complain(); });
}

void command_line::repeatable_option(std::vector<std::string>& target, option_text text) {
    parser_->app.add_option(names_of(text), target)->allow_extra_args(false);
    mention(std::move(text));
}

void command_line::word(std::string name, std::function<void(std::string_view)> accept) {
    text_.needs_mode = true;
    parser_->app
        .add_option_function<std::string>(
            std::move(name),
            [accept = std::move(accept)](const std::string& value) { accept(value); })
        ->required();
}

void command_line::inputs(std::vector<std::string>& target, std::string text, std::string name) {
    parser_->app.add_option(name, target)->required();
    text_.inputs_name = std::move(name);
    text_.inputs_text = std::move(text);
}

void command_line::epilogue(std::string text) { text_.epilogue = std::move(text); }

void command_line::version_text(const std::string& text) {
    parser_->app.set_version_flag("--version", text)->disable_flag_override();
    version_ = text.substr(0, text.find('\n'));
}

bool command_line::given(const std::string& name) const { return parser_->app.count(name) > 0; }

command_line::outcome command_line::parse(int argc, const char* const* argv) {
    if (argc == 3 && std::string_view(argv[1]) == "--generate") {
        std::fputs(generated(argv[2]).c_str(), stdout);
        return outcome::help_shown;
    }
    for (int i = 2; i < argc; ++i)
        for (const auto& [name, value] : values_apart_)  // which would be inputs
            if (argv[i - 1] == name && argv[i] == value && !std::filesystem::exists(value))
                tools::refuse(std::string(name)
                                  .append(" ")
                                  .append(value)
                                  .append(": type ")
                                  .append(name)
                                  .append("=")
                                  .append(value));
    try {
        parser_->app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        const auto is_mode = [&](std::string_view word) {
            return std::ranges::any_of(text_.modes, [&](auto& mode) { return mode.name == word; });
        };
        const char* const* const at = std::find_if(argv + 1, argv + argc, is_mode);
        std::fputs(help_of(text_, at == argv + argc ? "" : *at).c_str(), stdout);
        return outcome::help_shown;
    } catch (const CLI::CallForVersion& version) {
        std::puts(version.what());
        return outcome::help_shown;
    } catch (const CLI::ArgumentMismatch& error) {
        const std::string what = error.what();  // "check was given a disallowed flag override"
        const auto name = what.find(" was given a disallowed");
        tools::refuse(name == std::string::npos ? what + " (see --help)"
                                                : "--" + what.substr(0, name) + " takes no value");
    } catch (const CLI::ParseError& error) {
        std::string modes;
        bool is_mode = !text_.needs_mode || argc < 2 || argv[1][0] == '-';
        for (const mode_text& one : text_.modes) {
            modes += (modes.empty() ? "" : ", ") + one.name;
            is_mode = is_mode || one.name == argv[1];
        }
        if (!is_mode && !modes.empty())
            tools::refuse(std::string(argv[1]) + ": not a mode; expected one of " + modes);
        throw failure(bad_usage, "usage", std::string(error.what()) + " (see --help)");
    }
    return outcome::run;
}

std::string command_line::generated(const std::string& kind) const {
    for (const option_group& group : text_.groups)  // else it would be listed, and unknown
        for (const option_text& one : group.options)
            if (one.names.starts_with('-') && !parser_->app.get_option_no_throw(long_name(one)))
                throw std::logic_error(one.names + ": is no option");
    const auto text = manual_of(text_, kind, version_);
    if (!text) tools::refuse("--generate " + kind + ": expected one of man, bash, zsh, fish");
    return *text;
}

std::vector<std::filesystem::path> command_line::outputs() const {
    std::vector<std::filesystem::path> given;
    for (const auto* path : outputs_)
        if (!path->empty()) given.push_back(*path);
    return given;
}

}  // namespace tools
