#include <libmesh/base/byte_order.hpp>
#include <libmesh/io/las_plan.hpp>
#include <libmesh/io/writers.hpp>
#include <libmesh/laz/chunk.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace treeform::detail::io {

namespace {

template <class T>
void put_at(std::vector<std::byte>& block, std::size_t at, T value) {
    base::store<std::endian::little>(reinterpret_cast<char*>(block.data() + at), value);
}

void put_text(sink& out, std::string text, std::size_t size) {
    text.resize(size, '\0');
    out.put(text);
}

void put_record(sink& out, const las_record& r, bool extended) {
    out.raw<std::endian::little>(r.reserved);
    put_text(out, r.user_id, 16);
    out.raw<std::endian::little>(r.record_id);
    if (extended)
        out.raw<std::endian::little>(std::uint64_t{r.data.size()});
    else
        out.raw<std::endian::little>(static_cast<std::uint16_t>(r.data.size()));
    put_text(out, r.description, 32);
    out.put({reinterpret_cast<const char*>(r.data.data()), r.data.size()});
}

[[nodiscard]] std::size_t size_of_records(const las_header& h) {
    std::size_t size = 0;
    for (const las_record& r : h.records) {
        if (r.data.size() > 0xffff)
            throw las_fault("the record " + r.user_id + ' ' + std::to_string(r.record_id) +
                            " has " + std::to_string(r.data.size()) +
                            " bytes; at most 65535 can be written");
        size += 54 + r.data.size();
    }
    return size;
}

/// Writes points as they come, some chunks at a time, and the header once more when all are known.
class las_writer {
  public:
    las_writer(const write_job& job, std::uint64_t count,
               std::optional<std::span<const point3>> points, bool packed)
        : job_(job),
          count_(count),
          plan_(plan_las(job, points, packed)),
          tally_(plan_),
          first_point_(plan_.header.block.size() + size_of_records(plan_.header) +
                       plan_.header.behind_records.size()) {
        if (!job.out.can_replace())
            throw las_fault("LAS and LAZ cannot be written to a pipe; name a file");
        if (first_point_ > std::numeric_limits<std::uint32_t>::max())
            throw las_fault("more than 4 GB of records before the points");
        put_block();
        for (const las_record& r : plan_.header.records) put_record(job_.out, r, false);
        const auto& behind = plan_.header.behind_records;
        job_.out.put({reinterpret_cast<const char*>(behind.data()), behind.size()});
        if (is_packed()) job_.out.raw<std::endian::little>(std::int64_t{-1});
        at_ = first_point_ + (is_packed() ? 8 : 0);
    }

    void put_points(std::span<const point3> points, const element* vertices) {
        for (std::size_t done = 0; done < points.size();) {
            const std::size_t room = at_once * laz_chunk - pending_.size() / plan_.record_size;
            const std::size_t some = std::min(room, points.size() - done);
            const std::size_t before = pending_.size();
            pending_.resize(before + some * plan_.record_size);
            put_records(points, vertices, plan_,
                        {done, some, pending_.data() + before, plan_.record_size}, number_ + done,
                        tally_);
            done += some;
            if (some == room) put_pending();
        }
        number_ += points.size();
    }

    void finish() {
        put_pending();
        const std::uint64_t end_of_points = at_;
        if (is_packed()) put_table(end_of_points);
        finish_behind_points();
    }

    /// The chunks, as numbers of 32 bits.
    std::string part_summary() {
        put_pending();
        std::string summary;
        for (const laz::chunk& c : chunks_)
            for (const std::uint32_t n : {c.points, c.bytes}) {
                std::array<char, 4> bytes;
                base::store<std::endian::little>(bytes.data(), n);
                summary.append(bytes.data(), bytes.size());
            }
        return summary;
    }

    /// What follows the points gets its offset when all of them are there.
    std::uint64_t finish_part(const std::vector<std::string>& summaries) {
        put_pending();
        const std::uint64_t end_of_points = job_.out.size();
        at_ = first_point_ + count_ * plan_.record_size;
        if (is_packed()) {
            at_ = first_point_ + 8;
            chunks_.clear();
            for (const std::string& part : summaries)
                for (std::size_t i = 0; i + 8 <= part.size(); i += 8) {
                    const auto number = [&](std::size_t at) {
                        return base::load<std::uint32_t, std::endian::little>(part.data() + at);
                    };
                    chunks_.push_back({number(i), number(i + 4)});
                    at_ += chunks_.back().bytes;
                }
            put_table(at_);
        }
        finish_behind_points();
        return job_.out.size() - end_of_points;
    }

  private:
    static constexpr std::size_t at_once = 8;  ///< chunks

    void finish_behind_points() {
        put_extended();
        tally_.put(plan_, count_);
        const auto& block = plan_.header.block;
        job_.out.replace(0, {reinterpret_cast<const char*>(block.data()), block.size()});
        job_.result.max_displacement = std::max(job_.result.max_displacement, tally_.changes.moved);
        tally_.changes.remark(job_.result.warnings);
    }

    [[nodiscard]] bool is_packed() const { return !plan_.items.empty(); }

    /// With counts and bounds that are not known yet.
    void put_block() {
        las_header& h = plan_.header;
        std::vector<std::byte>& b = h.block;
        b[25] = static_cast<std::byte>(h.version_minor);
        put_at(b, 94, static_cast<std::uint16_t>(b.size()));
        put_at(b, 96, static_cast<std::uint32_t>(first_point_));
        put_at(b, 100, static_cast<std::uint32_t>(h.records.size()));
        b[104] = static_cast<std::byte>(h.point_format | (is_packed() ? 0x80 : 0));
        put_at(b, 105, static_cast<std::uint16_t>(plan_.record_size));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            put_at(b, 131 + 8 * axis, h.scale[axis]);
            put_at(b, 155 + 8 * axis, h.offset[axis]);
        }
        job_.out.put({reinterpret_cast<const char*>(b.data()), b.size()});
    }

    void put_pending() {
        const std::size_t size = plan_.record_size;
        const std::size_t count = pending_.size() / size;
        if (!is_packed()) {
            job_.out.put({reinterpret_cast<const char*>(pending_.data()), pending_.size()});
            at_ += pending_.size();
        } else {
            std::vector<std::vector<std::uint8_t>> packed(chunk_count(count, laz_chunk));
            for_chunks(count, laz_chunk,
                       [&](std::size_t begin, std::size_t end, std::size_t chunk) {
                           packed[chunk] =
                               laz::pack_chunk(plan_.items, static_cast<std::uint32_t>(end - begin),
                                               pending_.data() + begin * size);
                       });
            for (std::size_t i = 0; i < packed.size(); ++i) {
                const std::size_t points = std::min<std::size_t>(laz_chunk, count - i * laz_chunk);
                chunks_.push_back({static_cast<std::uint32_t>(points),
                                   static_cast<std::uint32_t>(packed[i].size())});
                job_.out.put({reinterpret_cast<const char*>(packed[i].data()), packed[i].size()});
                at_ += packed[i].size();
            }
        }
        pending_.clear();
    }

    void put_table(std::uint64_t end_of_points) {
        const auto table = laz::write_chunk_table(chunks_, false);
        job_.out.put({reinterpret_cast<const char*>(table.data()), table.size()});
        at_ += table.size();
        std::array<char, 8> place;
        base::store<std::endian::little>(place.data(), end_of_points);
        job_.out.replace(first_point_, {place.data(), place.size()});
    }

    void put_extended() {
        las_header& h = plan_.header;
        std::uint64_t waveforms = 0;
        const std::uint64_t first = h.extended_records.empty() ? 0 : at_;
        for (const las_record& r : h.extended_records) {
            if (r.record_id == 65535 && r.user_id.c_str() == std::string_view("LASF_Spec"))
                waveforms = at_;
            put_record(job_.out, r, true);
            at_ += 60 + r.data.size();
        }
        if (h.version_minor >= 3) put_at(h.block, 227, waveforms);
        if (h.version_minor < 4) return;
        put_at(h.block, 235, first);
        put_at(h.block, 243, static_cast<std::uint32_t>(h.extended_records.size()));
    }

    write_job job_;
    std::uint64_t count_;
    las_plan plan_;
    las_tally tally_;
    std::uint64_t first_point_;
    std::uint64_t at_ = 0;
    std::uint64_t number_ = 0;  ///< of the next point
    std::vector<std::uint8_t> pending_{};
    std::vector<laz::chunk> chunks_{};
};

/// Names the file in errors that do not know it.
template <class F>
auto with_name(const sink& out, F&& work) {
    try {
        return work();
    } catch (const las_fault& fault) {
        throw io_error(std::string(out.name()) + ": " + fault.what());
    }
}

void write_all(const write_job& job, bool packed) {
    const std::span<const point3> points(job.file.mesh.points);
    with_name(job.out, [&] {
        las_writer writer(job, points.size(), points, packed);
        writer.put_points(points, job.vertices);
        writer.finish();
    });
}

[[nodiscard]] point_sink start(const write_job& job, std::uint64_t count, bool packed) {
    const sink& out = job.out;
    const auto writer = with_name(
        out, [&] { return std::make_shared<las_writer>(job, count, std::nullopt, packed); });
    point_sink sink{.rows =
                        [writer, &out](std::span<const point3> points, const element* vertices) {
                            with_name(out, [&] { writer->put_points(points, vertices); });
                        },
                    .finish = [writer, &out] { with_name(out, [&] { writer->finish(); }); }};
    sink.finish_part = [writer, &out](const std::vector<std::string>& summaries) {
        return with_name(out, [&] { return writer->finish_part(summaries); });
    };
    if (!packed) return sink;
    sink.part_summary = [writer, &out] {
        return with_name(out, [&] { return writer->part_summary(); });
    };
    sink.together = laz_chunk;
    return sink;
}

template <class T>
T number_in(const std::string& head, std::size_t at) {
    return base::load<T, std::endian::little>(head.data() + at);
}

/// Puts what `join` makes of the numbers there into the first head.
template <class T, class Join>
void join_at(std::vector<std::string>& heads, std::size_t at, const Join& join) {
    T all = number_in<T>(heads.front(), at);
    for (const std::string& head : heads) {
        if (&head == &heads.front()) continue;
        all = join(all, number_in<T>(head, at));
    }
    base::store<std::endian::little>(heads.front().data() + at, all);
}

}  // namespace

void write_las(const write_job& job) { write_all(job, false); }
void write_laz(const write_job& job) { write_all(job, true); }

std::string join_las_heads(const std::vector<std::string>& heads) {
    std::vector<std::string> all = heads;
    for (std::size_t r = 0; r < 5; ++r) join_at<std::uint32_t>(all, 111 + 4 * r, std::plus<>());
    for (std::size_t axis = 0; axis < 3; ++axis) {
        join_at<double>(all, 179 + 16 * axis, [](double a, double b) { return std::max(a, b); });
        join_at<double>(all, 187 + 16 * axis, [](double a, double b) { return std::min(a, b); });
    }
    if (static_cast<unsigned char>(all.front()[25]) >= 4)
        for (std::size_t r = 0; r < 15; ++r)
            join_at<std::uint64_t>(all, 255 + 8 * r, std::plus<>());
    return all.front();
}

point_sink start_las_points(const write_job& job, std::uint64_t count) {
    return start(job, count, false);
}
point_sink start_laz_points(const write_job& job, std::uint64_t count) {
    return start(job, count, true);
}

}  // namespace treeform::detail::io
