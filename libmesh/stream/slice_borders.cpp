/// \file
/// What lies along the borders of tiles with the rule first, slice by slice of the ranks of points.
/// Each of a team settles what it can of its own tiles; then each in turn takes some slices of what
/// is left, and tells those behind it what their slices ask for.

#include <libmesh/stream/border_rows.hpp>
#include <libmesh/stream/tile_steps.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace treeform::detail::stream {
namespace {

constexpr std::size_t slices_of_all = weld::number_slices::most;

/// Rows that a process has for each slice; in a small cloud most slices have none.
class rows_by_slice {
  public:
    /// About `memory` bytes are held.
    rows_by_slice(const work_folder& folder, std::string name, std::size_t by, std::uint64_t memory)
        : folder_(folder),
          name_(std::move(name)),
          by_(by),
          bytes_(static_cast<std::size_t>(
              std::clamp<std::uint64_t>(memory / slices_of_all, 4096, piece))) {}

    void put(std::size_t slice, numbers row, numbers values) {
        std::optional<row_writer>& writer = writers_[slice];
        if (!writer) writer.emplace(path(folder_, name_, by_, slice), bytes_);
        writer->put(row);
        writer->put(values);
    }
    /// The slice gets no more.
    [[nodiscard]] record_count finish(std::size_t slice) {
        return writers_[slice] ? writers_[slice]->finish_unsynced() : record_count{};
    }

    /// Calls `take` with rows that a process has for a slice, some at a time, and removes them.
    template <class Take>
    static void drain(const work_folder& folder, const std::string& name, std::size_t by,
                      std::size_t slice, const record_count& count, std::size_t width,
                      const Take& take) {
        if (count.records == 0) return;
        record_reader<std::uint64_t> reader(path(folder, name, by, slice), count, piece, width);
        for (auto some = reader.next(); !some.empty(); some = reader.next()) take(some);
        std::filesystem::remove(path(folder, name, by, slice));
    }

  private:
    [[nodiscard]] static std::filesystem::path path(const work_folder& folder,
                                                    const std::string& name, std::size_t by,
                                                    std::size_t slice) {
        return folder.file(name + "." + std::to_string(by) + "." + std::to_string(slice));
    }

    const work_folder& folder_;
    std::string name_;
    std::size_t by_;
    std::size_t bytes_;
    std::array<std::optional<row_writer>, slices_of_all> writers_{};
};

}  // namespace

class tile_steps::slice_borders {
  public:
    explicit slice_borders(const tile_steps& steps) : steps_(steps), team_(steps.team_) {
        const share own = steps.tiles_of(team_.rank());
        std::vector<row_reader> rows;
        std::vector<row_reader> asked;
        for (auto t = static_cast<std::size_t>(own.first); t < own.last; ++t) {
            rows.push_back(steps.border_rows(steps.file(t, ".border"), steps.tiles_[t].border));
            asked.emplace_back(steps.file(t, ".asked"), steps.tiles_[t].asked, steps.border_width(),
                               steps.bytes_per_reader());
        }
        row_merge all_asked(std::move(asked), 1);
        pass first(*this, own, "border");
        first.over({0, slices_of_all}, row_merge(std::move(rows), 1),
                   [&](std::size_t slice, const take_asked& take) {
                       for (; !all_asked.empty(); all_asked.pop()) {
                           const asked_point a = asked_of(all_asked.front());
                           if (a.slice != slice) break;
                           take(a, all_asked.front().subspan(border_numbers));
                       }
                   });
        if (!all_asked.empty()) fail_damaged(steps.folder_.path());
        first.finish();
        if (team_.is_alone()) return;
        share_left(first);
        bring_together();
    }

    [[nodiscard]] std::vector<tiles_welded::file> drops() { return std::move(drops_); }
    [[nodiscard]] const longest_move& move() const { return move_; }

  private:
    using file = tiles_welded::file;
    using take_asked = std::function<void(const asked_point&, numbers)>;

    /// What a process hands on, slice by slice.
    struct left {
        std::vector<std::uint64_t> ends{};  ///< rows up to the end of each slice
        record_count points{};
        std::vector<record_count> asked{};
    };

    /// A border pass over some tiles.
    class pass {
      public:
        pass(slice_borders& all, const share& tiles, std::string name)
            : all_(all),
              steps_(all.steps_),
              tiles_(tiles),
              is_whole_(tiles.size() == steps_.tiles_.size()),
              name_(std::move(name)),
              inbox_(steps_.folder_, name_ + ".in", all.team_.rank(), memory()),
              asked_(steps_.folder_, name_ + ".asked", all.team_.rank(), memory()),
              dropped_(all.path(name_ + ".drops", all.team_.rank()), piece),
              points_(all.path(name_ + ".on", all.team_.rank()), piece) {}

        /// \pre `rows` are those of the slices, and `each_asked(slice, take)` gives what is asked
        /// for of its points
        template <class EachAsked>
        void over(const share& slices, row_merge rows, const EachAsked& each_asked) {
            for (auto slice = static_cast<std::size_t>(slices.first); slice < slices.last;
                 ++slice) {
                border_weld border(steps_.tolerance_, steps_.keys_.agree(), all_.slices_);
                receive(slice, border);
                for (; !rows.empty(); rows.pop()) {
                    if (all_.slices_.of(rows.front()[0] >> 2) != slice) break;
                    const border_point p = take_rows(rows);
                    border.add(p, rows.front().subspan(border_numbers), is_outer(p.at), out_);
                    write();
                }
                left_.ends.push_back(rows_written_);
                each_asked(slice, [&](const asked_point& a, numbers values) {
                    hand_over(border, a, values);
                });
                for (bool more = true; more; write()) more = border.finish(out_);
            }
            if (!rows.empty()) fail_damaged(steps_.folder_.path());
        }
        /// What others have for these slices is there, too.
        void add_inbox(std::size_t slice, std::size_t by, const record_count& count) {
            received_[slice].emplace_back(by, count);
        }
        [[nodiscard]] record_count finish_inbox(std::size_t slice) { return inbox_.finish(slice); }
        void finish() {
            all_.drops_.push_back(
                {all_.path(name_ + ".drops", all_.team_.rank()), dropped_.finish_unsynced()});
            all_.move_.consider(out_.move);
            left_.points = points_.finish_unsynced();
            for (std::size_t slice = 0; slice < slices_of_all; ++slice)
                left_.asked.push_back(asked_.finish(slice));
        }
        [[nodiscard]] const left& handed_on() const { return left_; }

      private:
        [[nodiscard]] std::uint64_t memory() const { return steps_.task_.options.memory / 32; }
        [[nodiscard]] bool is_outer(const point3& p) {
            return !is_whole_ && steps_.is_outer(p, tiles_, halos_);
        }

        /// Each point once, in order.
        void receive(std::size_t slice, border_weld& border) {
            add_inbox(slice, all_.team_.rank(), inbox_.finish(slice));
            const std::size_t width = steps_.border_width();
            std::vector<std::uint64_t> rows;
            for (const auto& [by, count] : received_[slice])
                rows_by_slice::drain(
                    steps_.folder_, name_ + ".in", by, slice, count, width,
                    [&](numbers some) { rows.insert(rows.end(), some.begin(), some.end()); });
            std::vector<std::size_t> order(rows.size() / width);
            std::iota(order.begin(), order.end(), std::size_t{0});
            const auto tag = [&](std::size_t i) { return rows[i * width]; };
            std::ranges::sort(order, {}, tag);
            for (std::size_t i = 0; i < order.size(); ++i) {
                const auto row = std::span(rows).subspan(order[i] * width, width);
                for (; i + 1 < order.size() && tag(order[i + 1]) == row[0]; ++i)
                    row[4] |= rows[order[i + 1] * width + 4];
                border.receive({row[0], point_of(row), row[4], {}}, row.subspan(border_numbers));
            }
        }

        void hand_over(border_weld& border, const asked_point& asked, numbers values) {
            border.hand_over(asked, values, known_);
            for (const border_point& p : known_)
                for (std::size_t slice = 0; slice < slices_of_all; ++slice)
                    if (weld::number_slices::has(asked.asked_by, slice))
                        inbox_.put(slice, row_of(p.tag, p.at, p.leader), values);
            known_.clear();
            if (is_outer(asked.at)) asked_.put(asked.slice, row_of(asked), values);
            check();
        }

        void write() {
            dropped_.put(out_.dropped);
            out_.dropped.clear();
            rows_written_ += put_border(out_, points_);
            put_asked(out_, [&](const asked_point& a, numbers values) {
                asked_.put(a.slice, row_of(a), values);
            });
            check();
        }
        void check() {
            if (++records_ % records_a_check == 0) steps_.pace_.check();
        }

        slice_borders& all_;
        const tile_steps& steps_;
        share tiles_;
        bool is_whole_;
        std::string name_;
        rows_by_slice inbox_;  ///< what is known of what slices ask for
        rows_by_slice asked_;  ///< for the next pass
        record_writer<tile_drop> dropped_;
        row_writer points_;
        std::uint64_t rows_written_ = 0;
        /// By whom, and how much.
        std::array<std::vector<std::pair<std::size_t, record_count>>, slices_of_all> received_{};
        left left_{};
        weld::tile_result out_{};
        std::vector<border_point> known_{};
        std::vector<std::uint32_t> halos_{};
        std::uint64_t records_ = 0;
    };

    [[nodiscard]] std::filesystem::path path(const std::string& name, std::size_t by) const {
        return steps_.folder_.file(name + "." + std::to_string(by));
    }

    /// All know what each hands on.
    void share_left(const pass& first) {
        state_writer mine;
        store_count(first.handed_on().points, mine);
        for (const std::uint64_t end : first.handed_on().ends) mine.number(end);
        for (const record_count& count : first.handed_on().asked) store_count(count, mine);
        for (state_reader& one : team_.exchange(mine)) {
            left& of = left_.emplace_back();
            of.points = load_count(one);
            for (std::size_t slice = 0; slice < slices_of_all; ++slice)
                of.ends.push_back(one.number());
            for (std::size_t slice = 0; slice < slices_of_all; ++slice)
                of.asked.push_back(load_count(one));
        }
    }

    /// Slices of a process, which have about as many rows as those of others.
    [[nodiscard]] share slices_of(std::size_t rank) const {
        std::array<std::uint64_t, slices_of_all> ends{};
        for (const left& of : left_)
            for (std::size_t slice = 0; slice < slices_of_all; ++slice)
                ends[slice] += of.ends[slice];
        share mine{0, 0};
        for (std::size_t slice = 0; slice < slices_of_all; ++slice) {
            const std::uint64_t twice_middle = ends[slice] + (slice == 0 ? 0 : ends[slice - 1]);
            const auto owner = static_cast<std::size_t>(static_cast<double>(team_.size()) *
                                                        static_cast<double>(twice_middle) /
                                                        static_cast<double>(2 * ends.back() + 1));
            mine.first += owner < rank ? 1 : 0;
            mine.last += owner <= rank ? 1 : 0;
        }
        return mine;
    }

    /// The pass over what all hand on.
    void bring_together() {
        pass last(*this, {0, steps_.tiles_.size()}, "border.all");
        std::size_t turn = 0;
        team_.take_turns(
            [&](state_writer& mine) {
                const share slices = slices_of(team_.rank());
                last.over(slices, rows_of(slices), [&](std::size_t slice, const take_asked& take) {
                    each_asked(slice, take);
                });
                for (std::size_t slice = 0; slice < slices_of_all; ++slice)
                    store_count(last.finish_inbox(slice), mine);
            },
            [&](state_reader told) {
                const share slices = slices_of(turn);
                for (std::size_t slice = 0; slice < slices_of_all; ++slice) {
                    const record_count count = load_count(told);
                    if (turn != team_.rank() && slice >= slices.last)
                        last.add_inbox(slice, turn, count);
                }
                ++turn;
            });
        last.finish();
    }

    [[nodiscard]] row_merge rows_of(const share& slices) const {
        std::vector<row_reader> readers;
        for (std::size_t r = 0; r < left_.size(); ++r) {
            const auto end = [&](std::uint64_t slice) {
                return slice == 0 ? 0 : left_[r].ends[static_cast<std::size_t>(slice - 1)];
            };
            readers.push_back(steps_.border_rows(path("border.on", r), left_[r].points,
                                                 {end(slices.first), end(slices.last)}));
        }
        return {std::move(readers), 1};
    }

    void each_asked(std::size_t slice, const take_asked& take) const {
        const std::size_t width = steps_.border_width();
        for (std::size_t r = 0; r < left_.size(); ++r)
            rows_by_slice::drain(steps_.folder_, "border.asked", r, slice, left_[r].asked[slice],
                                 width, [&](numbers rows) {
                                     for (; !rows.empty(); rows = rows.subspan(width))
                                         take(asked_of(rows),
                                              rows.first(width).subspan(border_numbers));
                                 });
    }

    const tile_steps& steps_;
    const team& team_;
    weld::number_slices slices_{steps_.slices()};
    std::vector<left> left_{};  ///< by each of the team
    std::vector<file> drops_{};
    longest_move move_{};
};

std::vector<tiles_welded::file> tile_steps::weld_borders_by_slices(longest_move& longest) const {
    slice_borders borders(*this);
    longest.consider(borders.move());
    return borders.drops();
}

}  // namespace treeform::detail::stream
