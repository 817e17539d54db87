#include <libmesh/base/byte_order.hpp>
#include <libmesh/io/readers.hpp>
#include <libmesh/io/reserve.hpp>

#include <array>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace treeform::detail::io {

namespace {

constexpr std::size_t header_bytes = 84;
constexpr std::size_t record_bytes = 50;
constexpr std::size_t block = 128;  // facets converted at a time; their points stay in cache

template <class T>
T little(const char* at) {
    return base::load<T, std::endian::little>(at);
}

/// Header and size disagree. A size of whole facets is believed, for many programs write the count
/// before they know it; else the header, where its facets are there and bytes follow.
std::size_t facet_count(const source& in, std::size_t stated, std::vector<io_warning>& warnings) {
    const std::size_t body = in.size() - header_bytes;
    const std::size_t whole = body / record_bytes;
    const std::string says =
        "header says " + std::to_string(stated) + " triangles, file holds " + std::to_string(whole);
    if (whole > 0 && body % record_bytes == 0) {
        warnings.push_back({"wrong-count", says + "; these were read"});
        return whole;
    }
    if (stated == 0 || whole < stated) in.fail_byte(in.begin() + 80, says + ": damaged or cut off");
    const std::size_t behind = body - stated * record_bytes;
    warnings.push_back({"trailing-bytes", std::to_string(behind) +
                                              (behind == 1 ? " byte" : " bytes") + " after the " +
                                              std::to_string(stated) +
                                              " triangles of the header not read"});
    return stated;
}

/// No more than the file holds; found before anything is allocated.
std::uint32_t facet_count(const source& in, std::vector<io_warning>& warnings) {
    if (in.size() < header_bytes)
        in.fail("shorter than the 84 bytes ahead of a binary STL, and not the text of one");
    std::size_t count = little<std::uint32_t>(in.begin() + 80);
    if (in.size() != header_bytes + count * record_bytes) count = facet_count(in, count, warnings);
    if (count > std::numeric_limits<std::uint32_t>::max() / 3)
        in.fail("more corners than 32-bit numbers can name");
    return static_cast<std::uint32_t>(count);
}

/// The 16 bits after each facet, kept only when one of them is not zero.
class facet_bits {
  public:
    void add(const std::array<std::uint16_t, block>& bits, std::size_t count, std::uint32_t any) {
        if (any != 0 && !used_) {
            used_ = true;
            bits_.assign(seen_, 0);
        }
        if (used_) bits_.insert(bits_.end(), bits.begin(), bits.begin() + static_cast<long>(count));
        seen_ += count;
    }
    void store(mesh_file& file) const {
        if (used_)
            obtain_element(file.attributes, "face", file.stored_faces)
                .columns.push_back(make_column<std::uint16_t>("stl_attribute", bits_));
    }

  private:
    bool used_ = false;
    std::size_t seen_ = 0;
    std::vector<std::uint16_t> bits_{};
};

}  // namespace

mesh_file read_stl_binary(const source& in) {
    std::vector<io_warning> warnings;
    const std::uint32_t count = facet_count(in, warnings);
    mesh_file file{.stored_faces = count,
                   .indexed = false,
                   .stored_as = precision::float32,
                   .format = "stl-binary",
                   .warnings = std::move(warnings)};
    file.attributes.header.assign(in.begin(), 80);
    reserve_large(file.mesh.points, std::size_t{count} * 3);
    reserve_large(file.mesh.faces, count);
    facet_bits bits;
    std::array<point3, 3 * block> corners;
    std::array<std::uint16_t, block> attribute{};
    const char* at = in.begin() + header_bytes;
    for (std::uint32_t done = 0; done < count;) {
        const auto size = static_cast<std::uint32_t>(std::min<std::size_t>(block, count - done));
        std::uint32_t any = 0;
        for (std::size_t i = 0; i < size; ++i, at += record_bytes) {
            for (std::size_t c = 0; c < 3; ++c) {
                const char* const xyz = at + 12 + 12 * c;
                corners[3 * i + c] = {little<float>(xyz), little<float>(xyz + 4),
                                      little<float>(xyz + 8)};
            }
            attribute[i] = little<std::uint16_t>(at + 48);
            any |= attribute[i];
        }
        file.mesh.points.insert(file.mesh.points.end(), corners.begin(),
                                corners.begin() + std::ptrdiff_t{3} * size);
        for (std::uint32_t i = 0; i < size; ++i) {
            const std::uint32_t first = 3 * (done + i);
            file.mesh.faces.push_back({first, first + 1, first + 2});
        }
        bits.add(attribute, size, any);
        done += size;
        in.release_before(at);
    }
    bits.store(file);
    return file;
}

}  // namespace treeform::detail::io
