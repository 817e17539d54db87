#include <libmesh/base/byte_order.hpp>
#include <libmesh/io/las_dimensions.hpp>
#include <libmesh/io/point_rows.hpp>
#include <libmesh/io/readers.hpp>
#include <libmesh/io/scratch.hpp>
#include <libmesh/io/vertex_columns.hpp>
#include <libmesh/laz/chunk.hpp>
#include <libmesh/laz/entropy.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <utility>

namespace treeform::detail::io {

namespace {

/// No point takes less than this share of a byte: each has symbols that are never quite certain.
constexpr std::uint64_t most_points_a_byte = 4096;

/// Where a chunk lies in the file.
struct placed_chunk {
    const char* first = nullptr;
    std::size_t bytes = 0;
    std::uint32_t points = 0;
};

[[nodiscard]] std::span<const std::uint8_t> bytes_from(const char* first, const char* end) {
    return {reinterpret_cast<const std::uint8_t*>(first), static_cast<std::size_t>(end - first)};
}

/// The table stands behind the chunks. Its place is in eight bytes ahead of them, or at the end of
/// the file, where a writer could not go back.
[[nodiscard]] const char* find_table(const source& in, const las_file& file) {
    const auto place = [](const char* at) {
        return base::load<std::int64_t, std::endian::little>(at);
    };
    const char* const first = in.begin() + file.first_point;
    if (in.size() < file.first_point + 8) in.fail_byte(in.end(), "the file ends before the points");
    std::int64_t byte = place(first);
    if (byte == -1) byte = place(in.end() - 8);
    if (byte < static_cast<std::int64_t>(file.first_point) + 8 ||
        byte > static_cast<std::int64_t>(in.size()))
        in.fail_byte(first, "the chunk table is missing: the file was not written completely");
    return in.begin() + byte;
}

[[nodiscard]] std::vector<placed_chunk> find_chunks(const source& in, const las_file& file) {
    const las_packing& packing = *file.packing;
    if (!packing.chunked) {
        const char* const first = in.begin() + file.first_point;
        if (file.count == 0) return {};
        if (file.count > std::numeric_limits<std::uint32_t>::max())
            in.fail("more points in one chunk than 32-bit numbers can count");
        return {{first, static_cast<std::size_t>(in.end() - first),
                 static_cast<std::uint32_t>(file.count)}};
    }
    const char* const table = find_table(in, file);
    const char* at = in.begin() + file.first_point + 8;
    const auto room = static_cast<std::size_t>(table - at);
    std::vector<laz::chunk> chunks;
    try {
        chunks = laz::read_chunk_table(bytes_from(table, in.end()), packing.sizes_vary(),
                                       room / file.record_size);
    } catch (const laz::damaged& fault) {
        in.fail_byte(table, fault.what());
    }
    std::vector<placed_chunk> placed;
    std::uint64_t left = file.count;
    for (const laz::chunk& c : chunks) {
        const std::uint64_t points =
            packing.sizes_vary() ? c.points : std::min<std::uint64_t>(packing.chunk_size, left);
        if (c.bytes > static_cast<std::size_t>(table - at) || points > left)
            in.fail_byte(table, "the chunk table is damaged");
        if (points > 0) placed.push_back({at, c.bytes, static_cast<std::uint32_t>(points)});
        at += c.bytes;
        left -= points;
    }
    if (left > 0)
        in.fail_byte(table, "the header announces " + std::to_string(file.count) +
                                " points, but the chunks have " +
                                std::to_string(file.count - left));
    return placed;
}

/// Records of packed points, some chunks at a time: these are unpacked in parallel.
class chunk_run {
  public:
    chunk_run(const source& in, const las_file& file)
        : in_(in),
          items_(file.packing->items),
          size_(file.record_size),
          chunks_(find_chunks(in, file)) {}

    /// Passes over the chunks ahead of that of a point; returns how many points they have.
    [[nodiscard]] std::uint64_t pass_over(std::uint64_t point) {
        std::uint64_t passed = 0;
        for (; next_ < chunks_.size() && passed + chunks_[next_].points <= point; ++next_)
            passed += chunks_[next_].points;
        return passed;
    }

    /// The next records, at most `most`; none at the end.
    [[nodiscard]] std::span<const char> next(std::size_t most) {
        if (taken_ == records_.size()) unpack_some();
        const std::size_t bytes = std::min((records_.size() - taken_), most * size_);
        const std::span<const char> some(records_.data() + taken_, bytes);
        taken_ += bytes;
        return some;
    }

  private:
    void unpack_some() {
        constexpr std::size_t at_once = std::size_t{1} << 23;  // bytes, or one chunk
        std::size_t end = next_;
        std::size_t points = 0;
        for (; end < chunks_.size() && (end == next_ || points * size_ < at_once); ++end) {
            const placed_chunk& c = chunks_[end];
            if (c.points > (c.bytes + 1) * most_points_a_byte)
                in_.fail_byte(c.first, "a chunk cannot have " + std::to_string(c.points) +
                                           " points in " + std::to_string(c.bytes) + " bytes");
            points += c.points;
        }
        records_.assign(points * size_, '\0');
        taken_ = 0;
        std::vector<std::size_t> begin(end - next_, 0);
        for (std::size_t i = 1; i < begin.size(); ++i)
            begin[i] = begin[i - 1] + chunks_[next_ + i - 1].points * size_;
        std::vector<std::string> faults(begin.size());
        for_chunks(begin.size(), 1, [&](std::size_t i, std::size_t, std::size_t) {
            faults[i] = unpack(chunks_[next_ + i], records_.data() + begin[i]);
        });
        for (std::size_t i = 0; i < faults.size(); ++i)
            if (!faults[i].empty()) in_.fail_byte(chunks_[next_ + i].first, faults[i]);
        if (end > next_) in_.release_before(chunks_[end - 1].first);
        next_ = end;
    }

    [[nodiscard]] std::string unpack(const placed_chunk& c, char* to) const {
        try {
            laz::unpack_chunk(items_, bytes_from(c.first, c.first + c.bytes), c.points,
                              reinterpret_cast<std::uint8_t*>(to));
        } catch (const laz::damaged& fault) {
            return fault.what();
        }
        return {};
    }

    const source& in_;
    std::vector<laz::item> items_;
    std::size_t size_;
    std::vector<placed_chunk> chunks_;
    std::size_t next_ = 0;
    std::vector<char> records_{};
    std::size_t taken_ = 0;  ///< bytes of these
};

/// What appends the rows of the records that `next(most)` gives.
template <class Next>
[[nodiscard]] auto rows_of(Next next, const las_file& file) {
    const las_grid grid{file.header.scale, file.header.offset};
    return [next, grid, size = file.record_size, dimensions = file.dimensions](
               std::vector<point3>& points, element& vertices, std::size_t most,
               std::vector<io_warning>&) mutable {
        constexpr std::size_t at_once = std::size_t{1} << 18;
        const std::span<const char> some = next(std::min(most, at_once));
        append_las_rows(vertices, points, some.size() / size, some.data(), size, grid, dimensions);
        return some.size() / size;
    };
}

}  // namespace

point_rows open_las_points(const source& in, std::uint64_t first) {
    point_rows rows;
    las_file file = open_las(in, rows.head.warnings);
    rows.count = file.count;
    if (file.packing) {
        const auto chunks = std::make_shared<chunk_run>(in, file);
        rows.left_out = chunks->pass_over(first);
        rows.append = rows_of([chunks](std::size_t most) { return chunks->next(most); }, file);
    } else {
        rows.left_out = first;
        const auto next = [&in, size = file.record_size, left = file.count - first,
                           at = in.begin() + file.first_point +
                                first * file.record_size](std::size_t most) mutable {
            const std::uint64_t count = std::min<std::uint64_t>(most, left);
            const std::span<const char> some(at, count * size);
            at += some.size();
            left -= count;
            in.release_before(some.data());
            return some;
        };
        rows.append = rows_of(next, file);
    }
    rows.head.format = file.packing ? "laz" : "las";
    rows.head.attributes.elements = {las_columns(file.dimensions)};
    rows.head.las = std::move(file.header);
    return rows;
}

mesh_file read_las(const source& in) {
    mesh_file file = read_all(in, open_las_points(in));
    file.stored_as = precision::float64;
    return file;
}

}  // namespace treeform::detail::io
