#pragma once
/// \file
/// The command line of a tool: what it accepts, and how --help describes it.

#include "tools/manual/help_text.hpp"
#include "tools/shell/parse_value.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tools {

class command_line {
  public:
    /// `usage` is what follows the name: "[OPTIONS] INPUT..."; `purpose` one or two lines.
    command_line(std::string name, std::string usage, std::string purpose);
    ~command_line();
    command_line(const command_line&) = delete;
    command_line& operator=(const command_line&) = delete;

    /// One of the words that may stand ahead of the inputs, with a help of its own.
    void mode(mode_text text);
    /// The same; `own` is all of its command line, and must outlive this one.
    void mode(mode_text text, const command_line& own);
    /// The modes of a help.txt, and its text at the end.
    void describe(std::string_view help);
    /// \throws failure (bad_usage) for an option that was given and is not for this mode
    void refuse_others(const std::string& mode) const;
    /// Options that follow are listed under `title`.
    void group(std::string title);
    void flag(bool& target, option_text text);
    /// A flag that counts how often it is given.
    void repeatable_flag(int& target, option_text text);
    void option(std::string& target, option_text text);
    /// One of `words`.
    void option(std::string& target, option_text text, const std::vector<std::string>& words);
    void option(std::uint64_t& target, option_text text);
    void option(distance& target, option_text text);
    void option(std::optional<distance>& target, option_text text);
    /// One of `words`, as the enumerator of that number.
    template <class Enum>
    void option(Enum& target, option_text text, std::span<const char* const> words) {
        const std::string name = text.names;
        text.offered.assign(words.begin(), words.end());
        option(std::move(text), [&target, words, name](std::string_view value) {
            target = static_cast<Enum>(parse_choice(name, value, words));
        });
    }
    /// `accept` parses the value; what it throws ends the run.
    void option(option_text text, std::function<void(std::string_view)> accept);
    /// An option whose value follows "=" if there is one: --name or --name=VALUE. `accept` gets the
    /// value, nothing of the first.
    void flag_with_value(option_text text,
                         std::function<void(std::optional<std::string_view>)> accept);
    /// The same, where it is one of `words`; `bare` is meant by --name. `accept` gets its number.
    void flag_with_value(option_text text, std::span<const char* const> words,
                         const std::string& bare, std::function<void(std::size_t)> accept);
    /// The value is the name of a file to write; "-" is standard output.
    void output(std::filesystem::path& target, option_text text);
    /// An option of other tools of the family that makes no sense here, and why.
    void refuse(const std::string& names, bool has_value, std::string why);
    /// An option that may be given several times, with one value each time.
    void repeatable_option(std::vector<std::string>& target, option_text text);
    /// A word that stands ahead of the inputs, such as a mode.
    void word(std::string name, std::function<void(std::string_view)> accept);
    /// `name` stands for them in the help.
    void inputs(std::vector<std::string>& target, std::string text, std::string name = "INPUT");
    /// An entry of the help without an option behind it.
    void mention(option_text text);
    /// Text at the end of the help.
    void epilogue(std::string text);
    void version_text(const std::string& text);

    /// Whether an option with this name, "--repair", was given.
    [[nodiscard]] bool given(const std::string& name) const;

    enum class outcome { run, help_shown };
    /// \throws failure (bad_usage) for anything that is not as described
    outcome parse(int argc, const char* const* argv);

    /// What completion offers for the value of the option: words, or the extensions of a FILE.
    void offer(const std::string& name, std::vector<std::string> words);
    /// The same for the inputs.
    void offer_inputs(std::vector<std::string> extensions);

    [[nodiscard]] const command_text& text() const { return text_; }
    [[nodiscard]] const std::string& name() const { return text_.name; }
    /// Files that options ask to write, where given.
    [[nodiscard]] std::vector<std::filesystem::path> outputs() const;

  private:
    struct parser;
    std::string names_of(const option_text& text) const;
    /// The manual page or completion that `kind` names. \throws failure (bad_usage) for others
    std::string generated(const std::string& kind) const;

    command_text text_;
    std::string version_;
    std::vector<const std::filesystem::path*> outputs_;
    std::vector<std::pair<std::string, std::string>> values_apart_;  ///< "--name", "VALUE"
    std::unique_ptr<parser> parser_;
};

}  // namespace tools
