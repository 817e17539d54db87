#include "tools/bindings/linked_files.hpp"
#include "tools/shell/run.hpp"
#include "tools/shell/sha256.hpp"
#include <treeform/mesh/read.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace tools {
namespace {

double now() {
    using clock = std::chrono::steady_clock;
    return std::chrono::duration<double>(clock::now().time_since_epoch()).count();
}

std::vector<std::byte> read_standard_input(const guard& keeper) {
    std::vector<std::byte> bytes;
    std::size_t size = 0;
    while (true) {
        keeper.check();
        constexpr std::size_t step = std::size_t{1} << 16;
        if (bytes.size() - size < step) bytes.resize(bytes.size() + bytes.size() / 2 + step);
        const ssize_t count = ::read(STDIN_FILENO, bytes.data() + size, bytes.size() - size);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) throw failure(bad_input, "read", "standard input cannot be read");
        if (count == 0) break;
        size += static_cast<std::size_t>(count);
    }
    bytes.resize(size);
    return bytes;
}

}  // namespace

std::string name_of_input(const std::string& path) { return path == "-" ? "standard input" : path; }

job::job(const std::string& input, const common_options& all_options, console& messages,
         guard& stop, std::map<std::string, double>& all_seconds)
    : path(input),
      name(name_of_input(input)),
      options(all_options),
      out(messages),
      keeper(stop),
      seconds(all_seconds) {
    entry["input"] = input;
    entry["error"] = nullptr;
    entry["warnings"] = json::array();
    if (!options.joined || options.inputs.size() < 2) return;
    name = std::to_string(options.inputs.size()) + " inputs";
    entry["input"] = nullptr;
}

tf::mesh_file job::read() {
    tf::mesh_file file = read(path, entry);
    warn(file.warnings);
    return file;
}

/// The digest, where a report wants it, is found beside the reading.
job::read_ahead job::read_one(const std::string& input) const {
    read_ahead found{.input = input};
    try {
        keeper.check();
        std::vector<std::byte> bytes;
        const bool from_pipe = input == "-";
        if (from_pipe) bytes = read_standard_input(keeper);
        std::error_code error;
        if (!from_pipe && std::filesystem::is_directory(input, error)) {
            const bool listed = std::count(options.inputs.begin(), options.inputs.end(), input) > 0;
            throw failure(bad_input, "read",
                          input + ": is a folder" +
                              (listed ? " without any file in a supported format" : ""));
        }
        constexpr std::size_t reading = 0;
        const tf::read_options how{.columns = options.columns,
                                   .drop_non_finite = options.drop_non_finite};
        tf::for_chunks(options.detailed() ? 2 : 1, 1, [&](auto, auto, std::size_t task) {
            if (task == reading)
                found.file = from_pipe ? tf::read(bytes, name_of_input(input), options.format, how)
                                       : tf::read(input, options.format, how);
            else
                found.digest = from_pipe ? sha256_of(bytes) : sha256_of_file(input);
        });
    } catch (...) {
        found.error = std::current_exception();
    }
    return found;
}

job::read_ahead job::take(const std::string& input) {
    const auto fits = [&](const read_ahead& a) { return !a.taken && a.input == input; };
    auto at = std::find_if(ahead_.begin(), ahead_.end(), fits);
    if (at == ahead_.end()) {
        const auto& all = options.inputs;
        const bool set = options.joined && all.size() > 1 && ahead_.empty() &&
                         std::count(all.begin(), all.end(), input) > 0 &&
                         std::count(all.begin(), all.end(), "-") == 0;
        if (!set) return read_one(input);
        ahead_.resize(all.size());
        tf::for_chunks(all.size(), 1, [&](std::size_t first, auto, auto) {
            ahead_[first] = read_one(all[first]);
        });
        at = std::find_if(ahead_.begin(), ahead_.end(), fits);
    }
    at->taken = true;
    return std::move(*at);
}

tf::mesh_file job::read(const std::string& input, json& about) {
    const timer whole = time("read");
    out.progress(name_of_input(input) + ": read", 0.0);
    read_ahead found = take(input);
    if (found.error) std::rethrow_exception(found.error);
    tf::mesh_file file = std::move(found.file);
    const std::string& digest = found.digest;
    has_faces_ = has_faces_ || file.stored_faces > 0;
    size_ += has_faces_ ? file.stored_faces : file.mesh.points.size();
    if (const auto output = mesh_output(options, input)) {
        keep_folder(file.attributes, input);
        link_from(*output, file.attributes);
    }
    compare_units(input, file);
    about["format"] = file.format;
    about["sha256"] = digest.empty() ? json(nullptr) : json(digest);
    about["precision_in"] = name_of(file.stored_as);
    call_ended();
    return file;
}

/// Once: numbers of different units are no lengths that go together.
void job::compare_units(const std::string& input, const tf::mesh_file& file) {
    constexpr std::string_view word = "unit ";
    for (const std::string& line : file.attributes.obj_info) {
        if (!line.starts_with(word) || unit_ == line) continue;
        if (unit_.empty()) {
            unit_ = line;
        } else if (!warned_of_units_) {
            warned_of_units_ = true;
            warn("units", name_of_input(input) + " has the " + line + ", an earlier input the " +
                              unit_ + "; numbers are not converted");
        }
    }
}

std::string job::unit() const {
    constexpr std::array<std::array<const char*, 2>, 6> names{{{"millimeter", "mm"},
                                                               {"centimeter", "cm"},
                                                               {"meter", "m"},
                                                               {"inch", "in"},
                                                               {"foot", "ft"},
                                                               {"micron", "um"}}};
    if (options.unit != "unknown") return options.unit;
    for (const auto& [name, unit] : names)
        if (!warned_of_units_ && unit_ == std::string("unit ") + name) return unit;
    return {};
}

job::timer::timer(double& sum) : sum_(sum), start_(now()) {}
job::timer::~timer() { sum_ += now() - start_; }

tf::progress_callback job::progress(std::string_view step) {
    return [this, label = name + ": " + std::string(step)](double share) {
        out.progress(label, share, size_, has_faces_ ? "faces" : "points");
        return !keeper.stop_requested();
    };
}

void job::call_ended(bool cancelled) {
    out.end_progress();
    keeper.check();
    if (cancelled) throw failure(stopped, "stopped", name + ": stopped");
}

void job::warn(const std::string& code, const std::string& text) {
    json remark{{"code", code}, {"text", text}};
    const json& said = entry["warnings"];  // perhaps the same, of another piece
    if (std::find(said.begin(), said.end(), remark) != said.end()) return;
    const auto& inputs = options.inputs;  // one of which the text may be about
    const bool named = std::any_of(inputs.begin(), inputs.end(), [&](const std::string& input) {
        return text.starts_with(name_of_input(input) + ": ");
    });
    out.warning(named ? text : name + ": " + text);
    entry["warnings"].push_back(std::move(remark));
}

void job::warn(const std::vector<tf::io_warning>& remarks, const std::string& whose) {
    for (const tf::io_warning& w : remarks) warn(w.code, whose + w.text);
}

void job::warn_of_non_finite(std::uint64_t count, const char* one, const char* many,
                             const std::string& whose) {
    if (count > 0)
        warn("non-finite",
             whose + counted(count, one, many) + " with a NaN or infinite coordinate dropped");
}

}  // namespace tools
