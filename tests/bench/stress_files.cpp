/// \file
/// stress_files [--size N] DIR [FAMILY...]: writes the families of hard meshes as files, up to N
/// faces (default 1000; DIR/index.csv lists them). tests/bench/run.sh --write calls it.

#include "support/stress_files.hpp"

#include <treeform/tf.hpp>

#include <cstddef>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

tf::test::stress_family family_of(const std::string& name) {
    if (const auto family = tf::test::stress_family_named(name)) return *family;
    std::string known;
    for (std::size_t f = 0; f < tf::test::stress_family_count; ++f)
        known += ' ' + std::string(name_of(static_cast<tf::test::stress_family>(f)));
    throw std::runtime_error("no family is called " + name + "; there are" + known);
}

void run(std::vector<std::string> words) {
    std::size_t most_faces = 1000;
    if (words.size() > 1 && words[0] == "--size") {
        most_faces = std::stoull(words[1]);
        words.erase(words.begin(), words.begin() + 2);
    }
    if (words.empty()) throw std::runtime_error("stress_files [--size N] DIR [FAMILY...]");
    std::vector<tf::test::stress_family> families;
    for (std::size_t i = 1; i < words.size(); ++i) families.push_back(family_of(words[i]));
    const std::size_t written = tf::test::write_stress_files(words[0], families, most_faces);
    std::printf("%zu meshes in %s\n", written, words[0].c_str());
}

}  // namespace

int main(int argc, char** argv) {
    try {
        run({argv + 1, argv + argc});
        return 0;
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "%s\n", failure.what());
        return 1;
    }
}
