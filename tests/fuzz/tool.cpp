/// \file
/// What each tool promises for any file: it ends with a status that its help names and leaves its
/// inputs as they were and nothing but its outputs, all of them where all is done; they are whole,
/// and what bounds a solid does so in the numbers written. Once more over older files it makes the
/// same bytes; with too little room on the disk, or ended by a signal at any time, it leaves those
/// or the older ones, and the same status says that it left those.
///
/// The content chooses the command line, and how the second run is stopped. When a promise does not
/// hold, the folder of the run stays, and the message says what was run.

#include "tool.hpp"

#include "bytes.hpp"
#include <treeform/mesh/attribute_sources.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <nlohmann/json.hpp>
#include <support/stress_random.hpp>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <ranges>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

int tool_main(int argc, char** argv);  // the tool's own, which the build renames

namespace {

namespace fs = std::filesystem;
using tf::fuzz::kept_promise;
using clock_type = std::chrono::steady_clock;
using files = std::map<std::string, std::string>;  // by name, with what is in them
constexpr const char* older = "older";
constexpr const char* cube =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n"
    "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";

std::string content_of(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void write(const fs::path& path, std::string_view content) {
    std::ofstream out(path, std::ios::binary);
    out.write(content.data(), static_cast<std::streamsize>(content.size()));
}

/// FNV-1a.
std::uint64_t hash_of(std::string_view content) {
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const char c : content) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    return hash;
}

const char* extension_of(std::string_view content) {
    const auto has = [&](std::string_view word) { return content.find(word) != content.npos; };
    if (content.starts_with("ply")) return "ply";
    if (content.starts_with("glTF")) return "glb";
    if (content.starts_with("PK")) return "3mf";
    if (content.substr(0, 40).find("OFF") != content.npos) return "off";
    if (has("\nDATA ")) return "pcd";
    if (content.starts_with("v ") || has("\nv ") || has("\nf ")) return "obj";
    if (has("facet") || has(std::string_view("\0\0", 2))) return "stl";
    return has(",") ? "csv" : "xyz";
}

/// A folder of its own, and the command lines with it in place of @. The tools are not heard.
class workshop {
  public:
    workshop() {
        std::string name = (fs::temp_directory_path() / "treeform-fuzz-XXXXXX").string();
        tf::fuzz::require(mkdtemp(name.data()) != nullptr, "a folder for temporary files");
        folder_ = name;
        stdout = stderr = std::fopen("/dev/null", "w");
    }
    ~workshop() {
        std::error_code ignored;
        fs::remove_all(folder_, ignored);
    }
    workshop(const workshop&) = delete;
    workshop& operator=(const workshop&) = delete;

    [[nodiscard]] fs::path path(const std::string& name) const { return folder_ / name; }

    /// All there is.
    [[nodiscard]] files content() const {
        files all;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder_))
            all[entry.path().filename().string()] =
                entry.is_directory() ? std::string() : content_of(entry.path());
        return all;
    }

    void clear() const {
        for (const fs::directory_entry& entry : fs::directory_iterator(folder_))
            fs::remove_all(entry.path());
    }

  private:
    fs::path folder_;
};

class tool_test {
  public:
    tool_test(const workshop& shop, std::string_view content)
        : shop_(shop), random_(hash_of(content)) {
        const auto all = tf::fuzz::tool_commands();
        command_ = all[random_.below(all.size())];
        const std::string name = std::string("in.") + extension_of(content);
        inputs_ = {{name, std::string(content)}, {"other.obj", cube}};
        for (const auto& [input, bytes] : inputs_) write(shop.path(input), bytes);
        std::istringstream words(command_.words);
        line_ = {"tool", "-q", "-f"};
        for (std::string word; words >> word;) {
            if (word == "@in") word = "@" + name;
            if (word == "@other") word = "@other.obj";
            if (word.front() == '@') {
                word.erase(0, 1);
                if (!inputs_.contains(word)) outputs_.push_back(word);
                word = shop.path(word).string();
            }
            line_.push_back(word);
        }
    }

    void run() {
        const auto start = clock_type::now();
        const int status = tool();
        const std::chrono::duration<double> spent = clock_type::now() - start;
        const files whole = outputs();
        check_status(status, whole);
        check_outputs(whole);
        if (whole.empty()) return;
        for (const auto& [name, content] : whole) write(shop_.path(name), older);
        switch (random_.below(8)) {
            case 0:
                check_again(status, whole);
                break;
            case 1:
                check_signal(SIGKILL, spent.count(), status, whole);
                break;
            case 2:
                check_signal(SIGTERM, spent.count(), status, whole);
                break;
            default:
                check_room(status, whole);
        }
    }

    void require(bool holds, const std::string& what) const {
        if (holds) return;
        std::string text = what + ":";
        for (const std::string& word : line_) text += " " + word;
        text += "\n";
        static_cast<void>(::write(STDERR_FILENO, text.data(), text.size()) > 0);
        std::abort();
    }

  private:
    static bool is_work_folder(const std::string& name) { return name == "tiles"; }

    /// All there is but the inputs, which are as they were.
    [[nodiscard]] files outputs() const {
        files all = shop_.content();
        for (const auto& [name, content] : inputs_) {
            const auto found = all.find(name);
            require(found != all.end() && found->second == content, "changed " + name);
            all.erase(found);
        }
        return all;
    }

    int tool() const {
        std::vector<std::string> words = line_;
        std::vector<char*> arguments;
        for (std::string& word : words) arguments.push_back(word.data());
        arguments.push_back(nullptr);
        return tool_main(static_cast<int>(words.size()), arguments.data());
    }

    void check_status(int status, const files& whole) const {
        require(status >= 0 && status <= 4,  // 2: of what the tool does not do for such files
                "ended with " + std::to_string(status));
        for (const auto& [name, content] : whole) {
            require(std::ranges::count(outputs_, name) > 0, "left " + name);
            require(status < 2 || !name.starts_with("out."), "wrote a mesh and failed");
        }
        for (const std::string& name : outputs_)
            require(status != 0 || whole.contains(name) || is_work_folder(name), "no " + name);
    }

    void check_outputs(const files& all) const {
        for (const auto& [name, content] : all) {
            if (name.ends_with(".json")) require(nlohmann::json::accept(content), "a whole report");
            if (name.starts_with("out.")) check_mesh(content, name);
        }
    }

    void check_mesh(std::string_view content, const std::string& name) const {
        tf::mesh_file file;
        try {
            file = tf::read(std::as_bytes(std::span(content)), name, {});
        } catch (const tf::io_error& error) {
            require(false, error.what());
        }
        if (command_.mesh == kept_promise::solids)
            check_parts(file);
        else if (command_.mesh != kept_promise::read)
            check_surface(file.mesh);
    }

    void check_parts(const tf::mesh_file& written) const {
        const tf::solid_defects found = tf::find_solid_defects(tf::attribute_source{&written, {}});
        require(found.degenerate == 0, "wrote a degenerate face");
        require(found.meeting_pairs == 0, "wrote faces that meet");
        require(found.boundary_edges == 0, "wrote an open edge");
    }

    void check_surface(const tf::mesh& written) const {
        const tf::mesh mesh = tf::join_equal_points(written);
        require(tf::find_invalid_faces(mesh) == tf::invalid_faces{}, "wrote a degenerate face");
        require(tf::self_intersections(mesh).pairs.empty(), "wrote faces that meet");
        if (command_.mesh != kept_promise::clean)
            require(!tf::find_open_edge(mesh), "wrote an open edge");
    }

    void check_again(int status, const files& whole) const {
        require(tool() == status, "another status");
        check_halted(whole, true, [](const std::string&) { return false; });
    }

    /// Each of the outputs is as it would be or, where the work was not `done`, as it was; no other
    /// has stayed, but what `may_stay` says.
    template <class MayStay>
    void check_halted(const files& whole, bool done, MayStay&& may_stay) const {
        const files now = outputs();
        for (const auto& [name, content] : now)
            require(whole.contains(name) || may_stay(name), "left " + name);
        for (const auto& [name, content] : whole) {
            const auto found = now.find(name);
            require(found != now.end(), "lost " + name);
            const bool complete = name.ends_with(".json")  // which says how long it took
                                      ? nlohmann::json::accept(found->second)
                                      : found->second == content;
            require(complete || (!done && found->second == older), "a part of " + name);
        }
    }

    void check_room(int status, const files& whole) {
        std::size_t most = 0;
        for (const auto& [name, content] : whole) most = std::max(most, content.size());
        rlimit before{};
        getrlimit(RLIMIT_FSIZE, &before);
        rlimit limit = before;
        limit.rlim_cur = random_.below(most + 1);
        setrlimit(RLIMIT_FSIZE, &limit);
        const int now = tool();
        setrlimit(RLIMIT_FSIZE, &before);
        require(now == status || now == 4, "on a full disk ended with " + std::to_string(now));
        check_halted(whole, now != 4, is_work_folder);
    }

    /// Sent after some part of the time that the first run took, or soon after that.
    void check_signal(int signal, double spent, int status, const files& whole) {
        const auto handler = std::signal(SIGTERM, SIG_DFL);  // libFuzzer has one
        const pid_t child = fork();
        require(child >= 0, "a process more");
        if (child == 0) _exit(tool());
        std::signal(SIGTERM, handler);
        std::this_thread::sleep_for(std::chrono::duration<double>(1.5 * random_.unit() * spent));
        kill(child, signal);
        int how = 0;
        pid_t ended = -1;
        do ended = waitpid(child, &how, 0);
        while (ended < 0 && errno == EINTR);
        require(ended == child, "the end of a process");
        if (WIFSIGNALED(how))
            require(WTERMSIG(how) == signal, "crashed when stopped");
        else
            require(WEXITSTATUS(how) == status || WEXITSTATUS(how) == 5,
                    "stopped with " + std::to_string(WEXITSTATUS(how)));
        const bool done = WIFEXITED(how) && WEXITSTATUS(how) == status;
        check_halted(whole, done, [&](const std::string& name) {
            return is_work_folder(name) || (signal == SIGKILL && name.starts_with(".unfinished-"));
        });
    }

    const workshop& shop_;
    tf::test::random_source random_;
    tf::fuzz::tool_command command_{};
    std::vector<std::string> line_;
    files inputs_;
    std::vector<std::string> outputs_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const workshop shop;
    static const tf::thread_scope one(1);  // since a forked process has no other
    const std::string content(data, data + size);
    tool_test test(shop, content);
    try {
        test.run();
        shop.clear();
    } catch (const std::exception& failure) {
        test.require(false, failure.what());
    }
    return 0;
}
