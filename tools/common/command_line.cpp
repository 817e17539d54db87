#include "tools/common/command_line.hpp"

#include "tools/common/exit_status.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>
#include <cstdio>

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
    : name_(std::move(name)),
      usage_(std::move(usage)),
      purpose_(std::move(purpose)),
      parser_(std::make_unique<parser>()) {
    parser_->app.set_help_flag("-h,--help", "");
}

command_line::~command_line() = default;

std::string command_line::names_of(const option_text& text) const {
    std::string names = text.names;
    std::erase(names, ' ');
    return text.aliases.empty() ? names : names + "," + text.aliases;
}

void command_line::mention(option_text text) {
    if (groups_.empty()) groups_.emplace_back();
    groups_.back().options.push_back(std::move(text));
}

void command_line::mode(mode_text text) {
    mention({.names = text.names, .text = text.text});
    modes_.push_back(std::move(text));
}

void command_line::mode(mode_text text, const command_line& own) {
    own_lines_.emplace_back(text.names, &own);
    mode(std::move(text));
}

void command_line::group(std::string title) { groups_.push_back({.title = std::move(title)}); }

void command_line::flag(bool& target, option_text text) {
    parser_->app.add_flag(names_of(text), target);
    mention(std::move(text));
}

void command_line::repeatable_flag(int& target, option_text text) {
    parser_->app.add_flag(names_of(text), target);
    mention(std::move(text));
}

void command_line::option(std::string& target, option_text text) {
    option(std::move(text), [&target](std::string_view value) { target = value; });
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

void command_line::flag_with_value(option_text text, std::span<const char* const> words,
                                   const std::string& bare,
                                   std::function<void(std::size_t)> accept) {
    const std::string name = long_name(text);
    for (const char* word : words) values_apart_.emplace_back(name, word);
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
    parser_->app
        .add_option_function<std::string>(
            std::move(name),
            [accept = std::move(accept)](const std::string& value) { accept(value); })
        ->required();
}

void command_line::inputs(std::vector<std::string>& target, std::string text, std::string name) {
    parser_->app.add_option(name, target)->required();
    inputs_name_ = std::move(name);
    inputs_text_ = std::move(text);
}

void command_line::epilogue(std::string text) { epilogue_ = std::move(text); }

void command_line::version_text(const std::string& text) {
    parser_->app.set_version_flag("--version", text);
}

bool command_line::given(const std::string& name) const { return parser_->app.count(name) > 0; }

command_line::outcome command_line::parse(int argc, const char* const* argv) {
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
            return std::ranges::any_of(modes_, [&](auto& mode) { return is_named(mode, word); });
        };
        const char* const* const at = std::find_if(argv + 1, argv + argc, is_mode);
        std::fputs((at == argv + argc ? help() : help(*at)).c_str(), stdout);
        return outcome::help_shown;
    } catch (const CLI::CallForVersion& version) {
        std::puts(version.what());
        return outcome::help_shown;
    } catch (const CLI::ParseError& error) {
        throw failure(bad_usage, "usage", std::string(error.what()) + " (see --help)");
    }
    return outcome::run;
}

std::string command_line::help() const { return help(usage_, purpose_, groups_) + epilogue_; }

std::string command_line::help(std::string_view word) const {
    for (const auto& [names, own] : own_lines_)
        if (std::ranges::count(words_of(names), word) > 0) return own->help();
    const auto at = std::ranges::find_if(modes_, [&](auto& mode) { return is_named(mode, word); });
    if (at == modes_.end()) return help();
    std::string purpose = at->text + ".";
    purpose[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(purpose[0])));
    return help(at->usage, purpose, groups_for(*at, groups_, modes_)) + at->more + "\n" +
           epilogue_.substr(std::min(epilogue_.find("Exit status:"), epilogue_.size()));
}

std::string command_line::help(const std::string& usage, const std::string& purpose,
                               const std::vector<option_group>& groups) const {
    std::string text = "Usage: " + name_ + " " + usage + "\n\n" + purpose + "\n\n";
    text +=
        lay_out(option_group{.options = {{.names = inputs_name_ + "...", .text = inputs_text_}}});
    for (const option_group& group : groups) text += lay_out(group);
    return text + "\n";
}

std::vector<std::filesystem::path> command_line::outputs() const {
    std::vector<std::filesystem::path> given;
    for (const auto* path : outputs_)
        if (!path->empty()) given.push_back(*path);
    return given;
}

}  // namespace tools
