/// \file
/// Writes a cloud of any size: large_cloud POINTS FILE.ply [float]. Points of a wavy sheet in a box
/// of side 1000, in random order; every fifth is within 0.001 of one of the last million.

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <vector>

namespace {

using place = std::array<double, 3>;

class cloud {
  public:
    place next() {
        place p;
        if (recent_.size() == many && engine_() % 5 == 0) {
            p = recent_[engine_() % many];
            for (double& x : p) x += 0.0005 * (2.0 * unit() - 1.0);
        } else {
            p = {1000.0 * unit(), 1000.0 * unit(), 0.0};
            p[2] = 500.0 + 100.0 * std::sin(0.02 * p[0]) * std::cos(0.03 * p[1]) + 50.0 * unit();
        }
        if (recent_.size() < many)
            recent_.push_back(p);
        else
            recent_[count_ % many] = p;
        ++count_;
        return p;
    }

  private:
    static constexpr std::size_t many = 1000000;

    double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

    std::mt19937_64 engine_{1};
    std::vector<place> recent_{};
    std::uint64_t count_ = 0;
};

template <class T>
bool write(std::FILE* file, std::uint64_t count) {
    cloud points;
    std::vector<T> row;
    for (std::uint64_t i = 0; i < count; ++i) {
        for (const double x : points.next()) row.push_back(static_cast<T>(x));
        if (row.size() < 3 * 65536 && i + 1 < count) continue;
        if (std::fwrite(row.data(), sizeof(T), row.size(), file) != row.size()) return false;
        row.clear();
    }
    return std::fclose(file) == 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 3) {
        std::fprintf(stderr, "usage: large_cloud POINTS FILE.ply [float]\n");
        return 2;
    }
    const bool single = argc > 3 && std::strcmp(argv[3], "float") == 0;
    const std::uint64_t count = std::strtoull(argv[1], nullptr, 10);
    std::FILE* const file = std::fopen(argv[2], "wb");
    if (file == nullptr) return 1;
    const char* const type = single ? "float" : "double";
    std::fprintf(file,
                 "ply\nformat binary_little_endian 1.0\nelement vertex %llu\nproperty %s x\n"
                 "property %s y\nproperty %s z\nend_header\n",
                 static_cast<unsigned long long>(count), type, type, type);
    return (single ? write<float>(file, count) : write<double>(file, count)) ? 0 : 1;
}
