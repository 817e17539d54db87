#include <libmesh/base/byte_order.hpp>
#include <libmesh/io/lzf.hpp>
#include <libmesh/io/number.hpp>
#include <libmesh/io/pcd_header.hpp>
#include <libmesh/io/scratch.hpp>
#include <libmesh/io/source.hpp>
#include <libmesh/io/vertex_columns.hpp>
#include <libmesh/io/writers.hpp>

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace treeform::detail::io {

namespace {

/// Columns that are written as one field: all but a COUNT of one are runs "name[0]", "name[1]", ...
struct field {
    std::string name{};
    std::size_t first = 0;  ///< number of the first column
    std::size_t count = 1;
};

/// The lengths of a compressed file have 32 bits.
[[nodiscard]] bool can_pack(std::uint64_t count, std::size_t row_size) {
    constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max();
    return count <= most / row_size && lzf_most_packed(count * row_size) <= most;
}

constexpr std::size_t bytes_of_lengths = 8;

/// Ahead of packed points.
[[nodiscard]] std::string lengths(std::size_t packed, std::size_t unpacked) {
    std::string bytes(bytes_of_lengths, '\0');
    base::store<std::endian::little>(bytes.data(), static_cast<std::uint32_t>(packed));
    base::store<std::endian::little>(bytes.data() + 4, static_cast<std::uint32_t>(unpacked));
    return bytes;
}

/// A color packed into a float is a whole number to those who read text, and stays one bit for
/// bit.
[[nodiscard]] bool is_packed_color(const column& c) {
    return c.role == column_role::data && c.type == scalar_type::float32 &&
           (c.name == "rgb" || c.name == "rgba");
}

class pcd_writer {
  public:
    /// `by_runs`: as many points will come; else those of the job's file.
    explicit pcd_writer(const write_job& job, std::optional<std::uint64_t> by_runs = {})
        : job_(job), by_runs_(by_runs), count_(by_runs.value_or(job.file.mesh.points.size())) {
        if (job.options.ascii)
            encoding_ = pcd_encoding::ascii;
        else if (job.file.format == name_of(pcd_encoding::compressed))
            encoding_ = pcd_encoding::compressed;
        choose_columns();
        group_fields();
        for (const column* c : columns_) row_size_ += size_of(c->type);
        if (encoding_ == pcd_encoding::compressed && !can_pack(count_, row_size_)) {
            encoding_ = pcd_encoding::binary;
            job.result.warnings.push_back(
                {"compression", "too many points for compression; written uncompressed"});
        }
        job.result.format = name_of(encoding_);
        put_header();
    }

    void put_points(std::span<const point3> points, const element* source) {
        if (by_runs_) check_axes(job_, is_text(), declared_, points);
        if (is_packed()) return keep(points, source);
        for (std::size_t row = 0; row < points.size(); ++row) {
            for (std::size_t i = 0; i < columns_.size(); ++i) {
                if (is_text() && i > 0) job_.out.put(' ');
                put_value(job_.out, i, points, source, row);
            }
            if (is_text()) job_.out.put('\n');
        }
    }

    [[nodiscard]] bool is_packed() const { return encoding_ == pcd_encoding::compressed; }
    void finish() {
        if (!is_packed()) return;
        scratch& all = blocks();
        const scratch packed(lzf_most_packed(all.size()), place(), "");
        const std::size_t size =
            lzf_pack({all.data(), all.size()}, packed.data(), [&](std::size_t, std::size_t) {
                all.release_memory();
                packed.release_memory();
            });
        job_.out.put(lengths(size, all.size()));
        job_.out.put({packed.data(), size});
    }

    void share_values(const detail::io::shared_values& place) {
        shared_ = place;
        kept_ = place.first_point;
        job_.out.put(lengths(0, 0));
        head_size_ = job_.out.size();
    }
    /// Packs this part's blocks. \pre all parts have put their points
    void finish_part() {
        if (!shared_) throw std::logic_error("write_pcd: parts of values that are not shared");
        const std::uint64_t size = count_ * row_size_;
        const std::uint64_t blocks = (size + lzf_block - 1) / lzf_block;
        const file_part mine{shared_->part, shared_->parts};
        const std::uint64_t end = std::min(mine.last(blocks) * lzf_block, size);
        std::vector<std::byte> block(lzf_block);
        std::string packed(lzf_most_packed(lzf_block), '\0');
        std::size_t unpacked = 0;
        for (std::uint64_t at = mine.first(blocks) * lzf_block; at < end; at += lzf_block) {
            const std::span<std::byte> some = std::span(block).first(
                static_cast<std::size_t>(std::min<std::uint64_t>(lzf_block, end - at)));
            shared_->get(at, some);
            job_.out.put(
                {packed.data(), lzf_pack({reinterpret_cast<const char*>(some.data()), some.size()},
                                         packed.data())});
            unpacked += some.size();
        }
        const auto written = static_cast<std::size_t>(job_.out.size() - head_size_);
        job_.out.replace(head_size_ - bytes_of_lengths, lengths(written, unpacked));
    }

  private:
    [[nodiscard]] bool is_text() const { return encoding_ == pcd_encoding::ascii; }
    [[nodiscard]] scratch_place place() const {
        return by_runs_ ? scratch_place::file : scratch_place::memory;
    }

    void choose_columns() {
        const std::span<const point3> all(job_.file.mesh.points);
        declared_ = declare_vertices(job_, is_text(), by_runs_ ? std::nullopt : std::optional(all));
        for (const column& c : declared_.columns) {
            if (!c.list_length) columns_.push_back(&c);
        }
    }

    void group_fields() {
        for (std::size_t i = 0; i < columns_.size(); ++i) {
            const column& c = *columns_[i];
            if (!fields_.empty() && continues(fields_.back(), c)) {
                ++fields_.back().count;
                continue;
            }
            const bool starts =
                c.name.ends_with("[0]") && c.name.size() > 3 && i + 1 < columns_.size();
            field f{.name = starts ? c.name.substr(0, c.name.size() - 3) : c.name, .first = i};
            if (starts && !continues(f, *columns_[i + 1])) f.name = c.name;
            fields_.push_back(std::move(f));
        }
    }
    [[nodiscard]] bool continues(const field& f, const column& c) const {
        return c.type == columns_[f.first]->type && c.role == column_role::data &&
               columns_[f.first]->name == f.name + "[0]" &&
               c.name == f.name + '[' + std::to_string(f.count) + ']';
    }

    void put_line(std::string_view keyword, std::string_view value) {
        job_.out.put(keyword);
        job_.out.put(value);
        job_.out.put('\n');
    }

    template <class F>
    void put_fields(std::string_view keyword, F&& word) {
        job_.out.put(keyword);
        for (const field& f : fields_) job_.out.put(' ' + word(f));
        job_.out.put('\n');
    }

    void put_header() {
        job_.out.put("# .PCD v0.7 - Point Cloud Data file format\n");
        const auto put_comment = [&](std::string line) {
            std::replace_if(line.begin(), line.end(), is_newline, ' ');
            put_line("# ", line);
        };
        std::ranges::for_each(job_.file.attributes.comments, put_comment);
        for (const std::string& line : job_.file.attributes.obj_info)
            if (!line.starts_with("num_cols ") && !line.starts_with("num_rows ") &&
                !line.starts_with("viewpoint "))
                put_comment(line);
        const auto type = [&](const field& f) {
            const column& c = *columns_[f.first];
            return is_text() && is_packed_color(c) ? std::string("U4") : type_and_size(c.type);
        };
        put_line("VERSION ", "0.7");
        put_fields("FIELDS", [](const field& f) { return f.name; });
        put_fields("SIZE", [&](const field& f) { return type(f).substr(1); });
        put_fields("TYPE", [&](const field& f) { return type(f).substr(0, 1); });
        put_fields("COUNT", [](const field& f) { return std::to_string(f.count); });
        put_shape();
        put_line("VIEWPOINT ", remark("viewpoint ").value_or("0 0 0 1 0 0 0"));
        put_line("POINTS ", std::to_string(count_));
        put_line("DATA ", is_text()                           ? "ascii"
                          : encoding_ == pcd_encoding::binary ? "binary"
                                                              : "binary_compressed");
    }

    void put_shape() {
        std::string width = std::to_string(count_);
        std::string height = "1";
        const auto columns = remark("num_cols ");
        const auto rows = remark("num_rows ");
        if (columns && rows) {
            if (is_shape(*columns, *rows)) {
                width = *columns;
                height = *rows;
            } else {
                job_.result.warnings.push_back({"organization", "the points are no longer " +
                                                                    std::string(*columns) + " by " +
                                                                    std::string(*rows)});
            }
        }
        put_line("WIDTH ", width);
        put_line("HEIGHT ", height);
    }
    [[nodiscard]] bool is_shape(std::string_view columns, std::string_view rows) const {
        const auto number = [](std::string_view word) {
            const auto n = parse_integer(word.data(), word.data() + word.size());
            const bool whole = n.end == word.data() + word.size() && n.value > 0;
            return whole && n.value < std::int64_t{1} << 31 ? static_cast<std::uint64_t>(n.value)
                                                            : 0;
        };
        return count_ > 0 && number(columns) * number(rows) == count_;
    }

    /// What follows the last line of obj_info that starts with `key`, when it is on one line.
    [[nodiscard]] std::optional<std::string_view> remark(std::string_view key) const {
        std::optional<std::string_view> found;
        for (const std::string& line : job_.file.attributes.obj_info)
            if (line.starts_with(key) && std::none_of(line.begin(), line.end(), is_newline))
                found = std::string_view(line).substr(key.size());
        return found;
    }

    /// The column with the values of the one that is declared.
    [[nodiscard]] const column& values_of(const column& c, const element* source) const {
        return with_values(declared_, source,
                           static_cast<std::size_t>(&c - declared_.columns.data()));
    }

    void put_value(sink& out, std::size_t i, std::span<const point3> points, const element* source,
                   std::size_t row) {
        const column& c = *columns_[i];
        if (c.role != column_role::data)
            return put_coordinate(out, c, job_.rounded(points[row][axis_number(c.role)]));
        const column& values = values_of(c, source);
        if (!is_text()) return put_bits<std::endian::little>(out, values, row);
        if (!is_packed_color(c)) return put_number(out, values, row);
        std::uint32_t bits = 0;
        std::memcpy(&bits, values.values.data() + row * sizeof bits, sizeof bits);
        out.number(bits);
    }

    void put_coordinate(sink& out, const column& c, double x) {
        with_type(is_text() && keeps_digits(c) ? scalar_type::float64 : c.type, [&]<class T>(T) {
            if (is_text())
                out.number(static_cast<T>(x));
            else
                out.raw<std::endian::little>(static_cast<T>(x));
        });
    }

    [[nodiscard]] scratch& blocks() {
        if (!blocks_) blocks_.emplace(count_ * row_size_, place(), "");
        return *blocks_;
    }

    /// Puts values where they will stand, all those of a field together.
    void keep(std::span<const point3> points, const element* source) {
        std::size_t ahead = 0;
        std::vector<char> values;
        for (const field& f : fields_) {
            const std::size_t size = size_of(columns_[f.first]->type);
            const std::uint64_t at = ahead * count_ + kept_ * f.count * size;
            const std::size_t bytes = points.size() * f.count * size;
            if (shared_) values.resize(bytes);
            char* const to = shared_ ? values.data() : blocks().data() + at;
            for (std::size_t i = 0; i < f.count; ++i)
                for (std::size_t row = 0; row < points.size(); ++row)
                    store_value(to + (row * f.count + i) * size, *columns_[f.first + i], points,
                                source, row);
            if (shared_) shared_->put(at, std::as_bytes(std::span(values)));
            ahead += f.count * size;
        }
        kept_ += points.size();
        if (blocks_) blocks_->release_memory();
    }
    void store_value(char* to, const column& c, std::span<const point3> points,
                     const element* source, std::size_t row) const {
        if (c.role == column_role::data) {
            const std::size_t size = size_of(c.type);
            std::memcpy(to, values_of(c, source).values.data() + row * size, size);
            if (std::endian::native == std::endian::big) std::reverse(to, to + size);
            return;
        }
        const double x = job_.rounded(points[row][axis_number(c.role)]);
        with_type(c.type,
                  [&]<class T>(T) { base::store<std::endian::little>(to, static_cast<T>(x)); });
    }

    write_job job_;
    std::optional<std::uint64_t> by_runs_;
    std::uint64_t count_;
    pcd_encoding encoding_ = pcd_encoding::binary;
    element declared_{};
    std::vector<const column*> columns_{};  ///< of `declared_`: those that are written
    std::vector<field> fields_{};
    std::size_t row_size_ = 0;
    std::optional<scratch> blocks_{};                    ///< of a compressed file
    std::optional<detail::io::shared_values> shared_{};  ///< instead, of one in parts
    std::uint64_t kept_ = 0;       ///< points in it, with those of parts ahead
    std::uint64_t head_size_ = 0;  ///< with the lengths
};

}  // namespace

bool is_packed_pcd_head(std::string_view head) {
    constexpr std::string_view end = "\nDATA binary_compressed\n";
    return head.starts_with("# .PCD") && head.size() > end.size() + bytes_of_lengths &&
           head.substr(0, head.size() - bytes_of_lengths).ends_with(end);
}

std::string join_packed_pcd_heads(const std::vector<std::string>& heads) {
    std::size_t packed = 0;
    std::size_t unpacked = 0;
    for (const std::string& head : heads) {
        const char* const at = head.data() + head.size() - bytes_of_lengths;
        packed += base::load<std::uint32_t, std::endian::little>(at);
        unpacked += base::load<std::uint32_t, std::endian::little>(at + 4);
    }
    const std::string& first = heads.front();
    return first.substr(0, first.size() - bytes_of_lengths) + lengths(packed, unpacked);
}

void write_pcd(const write_job& job) {
    pcd_writer writer(job);
    writer.put_points(job.file.mesh.points, job.vertices);
    writer.finish();
}

point_sink start_pcd_points(const write_job& job, std::uint64_t count) {
    auto writer = std::make_shared<pcd_writer>(job, count);
    point_sink sink{.rows = [writer](std::span<const point3> points, const element* vertices) {
        writer->put_points(points, vertices);
    }};
    if (!writer->is_packed()) return sink;
    sink.finish = [writer] { writer->finish(); };
    sink.share_values = [writer](const detail::io::shared_values& place) {
        writer->share_values(place);
    };
    sink.finish_part = [writer](const std::vector<std::string>&) {
        writer->finish_part();
        return std::uint64_t{0};
    };
    return sink;
}

}  // namespace treeform::detail::io
