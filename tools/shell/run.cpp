#include "tools/shell/run.hpp"

#include "tools/shell/abrupt_exit.hpp"
#include "tools/shell/common_options.hpp"
#include "tools/shell/console.hpp"
#include "tools/shell/entries.hpp"
#include "tools/shell/guard.hpp"
#include "tools/shell/output_file.hpp"
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/version.hpp>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace tools {
namespace {

using row = std::vector<std::string>;

std::string in_words(const json& number) {
    if (number.is_boolean()) return number.get<bool>() ? "yes" : "no";
    if (number.is_number_float()) return brief(number.get<double>());
    return number.is_number() ? grouped(number.get<std::uint64_t>()) : "-";
}

json number_at(const json& entry, const std::string& key) {
    const json::json_pointer at(key);
    return entry.contains(at) ? entry[at] : json(nullptr);
}

std::string verdict(const json& entry) {
    const int status = entry["exit"].get<int>();
    if (status == 0) return "ok";
    return status == 1 ? "found, or not done" : entry["error"]["code"].get<std::string>();
}

/// Columns of a terminal, by the code points of UTF-8: an ideograph takes two, an accent that is
/// put on the letter before it none.
std::size_t shown_width(const std::string& text) {
    static constexpr std::array<std::array<char32_t, 2>, 8> wide{{{0x1100, 0x115f},
                                                                  {0x2e80, 0xa4cf},
                                                                  {0xac00, 0xd7a3},
                                                                  {0xf900, 0xfaff},
                                                                  {0xff00, 0xff60},
                                                                  {0xffe0, 0xffe6},
                                                                  {0x1f300, 0x1faff},
                                                                  {0x20000, 0x3fffd}}};
    std::size_t width = 0;
    for (std::size_t at = 0; at < text.size();) {
        const auto first = static_cast<unsigned char>(text[at++]);
        char32_t code = first < 0xc0 ? first : first < 0xe0 ? first & 0x1fU : first & 0x0fU;
        for (; at < text.size() && (static_cast<unsigned char>(text[at]) & 0xc0U) == 0x80U; ++at)
            code = code << 6U | (static_cast<unsigned char>(text[at]) & 0x3fU);
        if (code >= 0x300 && code <= 0x36f) continue;
        width += std::ranges::any_of(
                     wide, [&](const auto& range) { return code >= range[0] && code <= range[1]; })
                     ? 2
                     : 1;
    }
    return width;
}

/// Names to the left, numbers to the right; the last column as it is.
std::string line_of(const row& cells, const std::vector<std::size_t>& widths) {
    std::string line;
    for (std::size_t i = 0; i + 1 < cells.size(); ++i) {
        const std::string gap(widths[i] - shown_width(cells[i]), ' ');
        line += i == 0 ? cells[i] + gap : gap + cells[i];
        line += "  ";
    }
    return line + cells.back();
}

row totals(const json& files, const std::vector<table_column>& columns) {
    row total{counted(files.size(), "file", "files")};
    for (const table_column& column : columns) {
        std::uint64_t sum = 0;
        bool any = false;
        for (const json& entry : files)
            if (const json number = number_at(entry, column.key); number.is_number_unsigned()) {
                sum += number.get<std::uint64_t>();
                any = true;
            }
        total.push_back(!column.summed ? "" : any ? grouped(sum) : "-");
    }
    std::array<std::size_t, 3> by_verdict{};
    for (const json& entry : files)
        ++by_verdict[static_cast<std::size_t>(std::min(entry["exit"].get<int>(), 2))];
    std::string text = grouped(by_verdict[0]) + " ok";
    if (by_verdict[1] > 0) text += ", " + grouped(by_verdict[1]) + " found, or not done";
    if (by_verdict[2] > 0) text += ", " + counted(by_verdict[2], "error", "errors");
    total.push_back(text);
    return total;
}

/// A line for each of `files`, entries of a report, with numbers one below the other, and one with
/// their totals.
std::string table_of(const json& files, const std::vector<table_column>& columns) {
    std::vector<row> rows{{"file"}};
    for (const table_column& column : columns) rows[0].push_back(column.title);
    rows[0].emplace_back("");
    for (const json& entry : files) {
        row one{name_of_input(entry["input"].get<std::string>())};
        for (const table_column& column : columns)
            one.push_back(in_words(number_at(entry, column.key)));
        one.push_back(verdict(entry));
        rows.push_back(std::move(one));
    }
    rows.push_back(totals(files, columns));
    std::vector<std::size_t> widths(rows[0].size(), 0);
    for (const row& one : rows)
        for (std::size_t i = 0; i < one.size(); ++i)
            widths[i] = std::max(widths[i], shown_width(one[i]));
    std::string text;
    for (const row& one : rows) {
        text += (text.empty() ? "" : "\n") + line_of(one, widths);
        text.erase(text.find_last_not_of(' ') + 1);
    }
    return text;
}

struct outcome {
    exit_status status = done;
    std::string code;
    std::string text;
};

/// Calls `body` and names what went wrong, if anything did.
outcome attempt(const std::function<exit_status()>& body) {
    try {
        return {body(), {}, {}};
    } catch (const failure& error) {
        return {error.status(), error.code(), error.what()};
    } catch (const tf::io_error& error) {
        return {bad_input, "read", error.what()};
    } catch (const std::bad_alloc&) {
        return {stopped, "memory", "out of memory"};
    } catch (const std::system_error& error) {
        if (error.code() != std::errc::resource_unavailable_try_again)
            return {bug, "bug", std::string("internal error: ") + error.what()};
        return {stopped, "memory", "no memory for a thread"};
    } catch (const std::exception& error) {
        // TBB says so in words only.
        if (std::string_view(error.what()).starts_with("pthread_create has failed"))
            return {stopped, "memory", "no memory for a thread"};
        return {bug, "bug", std::string("internal error: ") + error.what()};
    }
}

std::string version_text(const std::string& tool) {
    std::string text = tool + " (treeform) " + tf::version_string();
#if defined(__clang__)
    text += "\nbuilt with clang " __clang_version__;
#else
    text += "\nbuilt with g++ " __VERSION__;
#endif
#ifdef NDEBUG
    text += ", release";
#else
    text += ", assertions on";
#endif
    return text + (TREEFORM_STATIC_TOOLS ? "\nstatic build: plain threads, no assimp, no MPI" : "");
}

void configure(console& out, const common_options& options, const command_line& line) {
    const level most = options.quiet          ? level::error
                       : options.verbose > 1  ? level::debug
                       : options.verbose == 1 ? level::info
                                              : level::warning;
    out.color(options.color);
    out.configure(most, options.progress || (!options.quiet && isatty(STDERR_FILENO) == 1));
    for (const auto& path : line.outputs())
        if (path == "-") out.result_to_stderr();
    if (!options.log.empty()) out.log_to(options.log);
}

json head(const command_line& line, const common_options& options, int argc,
          const char* const* argv) {
    json report;
    report["schema"] = line.name() + "-report/1";
    report["tool"] = line.name();
    report["version"] = tf::version_string();
    report["command"] = std::vector<std::string>(argv, argv + argc);
    report["exit"] = nullptr;
    report["unit"] = options.unit;
    report["files"] = json::array();
    return report;
}

/// As mpirun of Open MPI tells its processes.
bool is_one_of_many() {
    const char* const size = std::getenv("OMPI_COMM_WORLD_SIZE");
    return size != nullptr && std::string_view(size) != "1";
}

/// Each would do the same, and they would write one output; the first one says so.
exit_status refuse_many(console& out) {
    const char* const rank = std::getenv("OMPI_COMM_WORLD_RANK");
    if (rank != nullptr && std::string_view(rank) != "0") return done;
    out.error("does not run under mpirun, where all processes would do the same work");
    return bad_usage;
}

limits limits_of(const common_options& options) {
    limits bounds{.seconds = options.timeout, .memory = options.memory};
    bounds.beside_others = is_one_of_many();
    bounds.as_free = options.memory == 0 && !options.all_memory;
    if (bounds.as_free) bounds.memory = usable_memory();
    return bounds;
}

std::string in_hundredths(double seconds) {
    char text[32];
    return {text,
            std::to_chars(text, text + sizeof text, seconds, std::chars_format::fixed, 2).ptr};
}

/// Where the time went: "0.84 s: reading 0.21, geometry 0.55 (65 %), writing 0.08". What is neither
/// reading nor writing is geometry.
std::string times_in_words(const std::map<std::string, double>& seconds, double whole) {
    double reading = 0.0;
    double geometry = 0.0;
    double writing = 0.0;
    for (const auto& [step, time] : seconds)
        (step == "read" ? reading : step == "write" ? writing : geometry) += time;
    const double share = whole > 0.0 ? std::min(1.0, geometry / whole) : 0.0;
    return in_hundredths(whole) + " s: reading " + in_hundredths(reading) + ", geometry " +
           in_hundredths(geometry) + " (" + std::to_string(std::lround(100.0 * share)) +
           " %), writing " + in_hundredths(writing);
}

class session {
  public:
    session(common_options& options, console& out, guard& keeper)
        : options_(options), out_(out), keeper_(keeper) {}

    exit_status work(const std::vector<std::string>& steps, json& report,
                     const std::function<exit_status(job&)>& body) {
        const auto began = std::chrono::steady_clock::now();
        for (const auto& step : steps) seconds_[step] = 0.0;
        exit_status worst = done;
        bool halted = false;
        std::set<std::string> units;
        const std::vector<std::string> inputs =
            options_.joined ? std::vector<std::string>{options_.inputs.front()} : options_.inputs;
        for (const std::string& input : inputs) {
            job one(input, options_, out_, keeper_, seconds_);
            const outcome result =
                halted ? outcome{stopped, "not-started", name_of_input(input) + ": not started"}
                       : attempt([&] {
                             keeper_.check();
                             const exit_status status = body(one);
                             for (const auto& file : one.last_outputs) file->commit();
                             return status;
                         });
            finish(one, result);
            halted = halted || result.status == stopped;
            worst = worse(worst, result.status);
            report["files"].push_back(std::move(one.entry));
            if (!one.unit().empty()) units.insert(one.unit());
        }
        if (units.size() == 1) report["unit"] = *units.begin();
        json& times = report["seconds"] = json::object();
        for (const auto& step : steps) times[step] = seconds_[step];
        if (inputs.size() > 1) out_.table(table_of(report["files"], options_.table));
        const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - began;
        out_.info(times_in_words(seconds_, whole.count()));
        return worst;
    }

  private:
    void finish(job& one, const outcome& result) {
        out_.end_progress();
        one.entry["exit"] = static_cast<int>(result.status);
        if (result.text.empty()) return;
        const bool says_how_much = result.text.find("--memory") != std::string::npos ||
                                   result.text.find("would be enough") != std::string::npos;
        const bool by_limit = result.code == "memory" && !says_how_much;
        const std::string text = by_limit ? keeper_.want_of_memory() : result.text;
        one.entry["error"] = {{"code", result.code}, {"text", text}};
        const bool named = text.find(name_of_input(one.path)) != std::string::npos;
        const std::string said = named ? text : one.name + ": " + text;
        if (options_.failed) options_.failed(said);
        out_.error(said);
        if (by_limit) set_words_for_memory({});
    }

    common_options& options_;
    console& out_;
    guard& keeper_;
    std::map<std::string, double> seconds_;
};

int run_parsed(command_line& line, common_options& options, const std::vector<std::string>& steps,
               int argc, const char* const* argv, const std::function<exit_status(job&)>& body,
               console& out) {
    configure(out, options, line);
    guard keeper(limits_of(options));
    const tf::thread_scope threads(options.threads);
    if (!options.report.empty()) check_output(options.report, options.force);

    json report = head(line, options, argc, argv);
    session all(options, out, keeper);
    exit_status status = all.work(steps, report, body);
    if (status == found && options.exit_zero) status = done;
    report["exit"] = static_cast<int>(status);
    report["threads"] = tf::thread_count();
    report["peak_rss"] = peak_memory();
    if (!options.report.empty()) {
        output_file file(options.report, options.force);
        file.write(report_text(report));
        file.commit();
    }
    return status;
}

}  // namespace

int run(command_line& line, common_options& options, const std::vector<std::string>& steps,
        int argc, const char* const* argv, const std::function<void()>& check_options,
        const std::function<exit_status(job&)>& body) {
    console out(line.name());
    out.color("auto");  // for what is said of a command line that makes no sense
    if (!options.in_team && is_one_of_many()) return refuse_many(out);
    const outcome result = attempt([&] {
        line.version_text(version_text(line.name()));
        if (line.parse(argc, argv) == command_line::outcome::help_shown) return done;
        list_folders(options);
        check_common_options(line, options);
        check_options();
        check_files(line, options);
        std::error_code ignored;  // where it cannot be made, each file that goes there says so
        if (!options.output_dir.empty() && !options.dry_run)
            std::filesystem::create_directories(options.output_dir, ignored);
        return static_cast<exit_status>(run_parsed(line, options, steps, argc, argv, body, out));
    });
    if (!result.text.empty()) {
        if (options.failed) options.failed(result.text);
        out.error(result.text);
    }
    return result.status;
}

}  // namespace tools
