/// \file
/// dirty_models CLEAN FOLDER: every kind of dirt of tests/support/dirt.hpp, put on a clean solid,
/// as FOLDER/KIND.stl; for run.sh, which asks other programs to mend them, too.

#include <treeform/mesh/read.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <support/dirt.hpp>

#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fputs("dirty_models CLEAN FOLDER\n", stderr);
        return 2;
    }
    constexpr std::size_t size = 1;
    try {
        const tf::mesh clean = tf::read(argv[1]).mesh;
        for (std::size_t kind = 0; kind < test::dirt_kinds; ++kind) {
            test::random source(kind + 1);
            const auto of = static_cast<test::dirt_kind>(kind);
            const std::filesystem::path path =
                std::filesystem::path(argv[2]) / (std::string(test::name_of(of)) + ".stl");
            tf::write(path, test::soil(clean, of, size, source).mesh);
        }
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "dirty_models: %s\n", failure.what());
        return 1;
    }
    return 0;
}
