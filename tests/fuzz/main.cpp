/// \file
/// fuzz_TARGET [-f FIRST] [-n RUNS] [-b BYTES] [FILE|FOLDER...]: runs a fuzz target, with any
/// compiler, over the files named and those of the folders; with -n, over so many damaged copies of
/// them instead, cut at -b bytes (4096). Run r of the same files is the same each time: when it
/// ends badly, its number is printed, and `-f r -n 1` runs it again.

#include <treeform/tf.hpp>

#include <support/stress_random.hpp>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using tf::test::random_source;
using content = std::vector<std::uint8_t>;

content read(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    if (!in) throw std::runtime_error(path.string() + ": cannot be read");
    const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
    return {bytes.begin(), bytes.end()};
}

/// In the order of their names, so that a run's number means the same everywhere.
std::vector<std::filesystem::path> files_of(const std::filesystem::path& path) {
    if (!std::filesystem::is_directory(path)) return {path};
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(path))
        if (entry.is_regular_file()) files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

class damage {
  public:
    damage(const std::vector<content>& seeds, std::size_t most_bytes, std::uint64_t run)
        : seeds_(seeds), most_bytes_(most_bytes), random_(run) {}

    content next() {
        content bytes = any_seed();
        for (std::uint64_t left = random_.below(6); left > 0; --left) change(bytes);
        bytes.resize(std::min(bytes.size(), most_bytes_));
        return bytes;
    }

  private:
    const content& any_seed() { return seeds_[random_.below(seeds_.size())]; }
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_.below(n)); }
    static std::ptrdiff_t at(std::size_t i) { return static_cast<std::ptrdiff_t>(i); }

    void change(content& bytes) {
        const std::size_t from = below(bytes.size() + 1);
        const std::size_t to = std::min(bytes.size(), from + 1 + below(32));
        const auto begin = bytes.begin() + at(from);
        switch (from < bytes.size() ? below(7) : 5) {
            case 0:
                *begin = static_cast<std::uint8_t>(random_.below(256));
                break;
            case 1:
                *begin = static_cast<std::uint8_t>(*begin ^ 1U << random_.below(8));
                break;
            case 2:
                *begin = static_cast<std::uint8_t>(*begin + random_.below(7) - 3);
                break;
            case 3:
                bytes.erase(begin, bytes.begin() + at(to));
                break;
            case 4: {
                const content part(begin, bytes.begin() + at(to));
                bytes.insert(bytes.begin() + at(below(bytes.size() + 1)), part.begin(), part.end());
                break;
            }
            case 5: {  // on with another's end
                const content& other = any_seed();
                bytes.erase(begin, bytes.end());
                bytes.insert(bytes.end(), other.begin() + at(std::min(from, other.size())),
                             other.end());
                break;
            }
            default: {  // what makes numbers large, negative or none, in binary or in text
                constexpr std::array<const char*, 8> words{
                    "nan", "1e999", "-1", "4294967296", "\xff\xff\xff\xff", "\x80", "\n", " 0 "};
                for (const char* c = words[below(words.size())]; *c != '\0'; ++c)
                    bytes.insert(bytes.begin() + at(from), static_cast<std::uint8_t>(*c));
            }
        }
    }

    const std::vector<content>& seeds_;
    std::size_t most_bytes_;
    random_source random_;
};

std::uint64_t current_run = 0;

/// With what a signal handler may call.
void tell_run(int) {
    std::array<char, 20> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), current_run).ptr;
    for (const auto& [text, size] :
         {std::pair{"run ", std::ptrdiff_t{4}},
          std::pair{static_cast<const char*>(digits.data()), end - digits.data()},
          std::pair{"\n", std::ptrdiff_t{1}}})
        if (::write(STDERR_FILENO, text, static_cast<std::size_t>(size)) < 0) break;
    std::signal(SIGABRT, SIG_DFL);
    std::abort();
}

void run(int argc, char** argv) {
    std::uint64_t first = 0;
    std::uint64_t runs = 0;
    std::size_t most_bytes = 4096;
    std::vector<content> seeds;
    for (int i = 1; i < argc; ++i) {
        const std::string argument = argv[i];
        if (argument == "-f" && i + 1 < argc)
            first = std::stoull(argv[++i]);
        else if (argument == "-n" && i + 1 < argc)
            runs = std::stoull(argv[++i]);
        else if (argument == "-b" && i + 1 < argc)
            most_bytes = std::stoull(argv[++i]);
        else
            for (const auto& file : files_of(argument)) seeds.push_back(read(file));
    }
    if (runs == 0)
        for (const content& seed : seeds) LLVMFuzzerTestOneInput(seed.data(), seed.size());
    if (seeds.empty()) throw std::runtime_error("no file to begin with");
    std::signal(SIGABRT, tell_run);
    for (current_run = first; current_run < first + runs; ++current_run) {
        const content input = damage(seeds, most_bytes, current_run).next();
        LLVMFuzzerTestOneInput(input.data(), input.size());
    }
}

}  // namespace

int main(int argc, char** argv) {
    try {
        run(argc, argv);
        return 0;
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "%s\n", failure.what());
        return 2;
    }
}
