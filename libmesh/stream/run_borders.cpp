/// \file
/// What lies along the borders of tiles with the rule first, in runs of slices of the ranks of
/// points: a few megabytes of rows at a time. Each rank settles what it can of its own tiles; then
/// each in turn takes some bundles of what is left, and sends the ranks behind it what their points
/// ask for.

#include <libmesh/stream/tile_steps.hpp>
#include <libmesh/weld/near_cells.hpp>

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

constexpr std::size_t bundles = weld::number_slices::bundles;

/// A file of rows, which are read some at a time.
struct rows_file {
    std::filesystem::path path{};
    record_count count{};

    /// Calls `take` with some rows at a time.
    template <class Take>
    void each(std::size_t width, const Take& take) const {
        if (count.records == 0) return;
        record_reader<std::uint64_t> reader(path, count, piece, width);
        for (auto some = reader.next(); !some.empty(); some = reader.next()) take(some);
    }
    void remove() const {
        if (count.records > 0) std::filesystem::remove(path);
    }
};

/// Rows that a process has for each bundle; in a small cloud most have none.
class rows_by_bundle {
  public:
    /// About `memory` bytes are held.
    rows_by_bundle(const work_folder& folder, std::string name, std::size_t by,
                   std::uint64_t memory)
        : folder_(folder),
          name_(std::move(name)),
          by_(by),
          bytes_(
              static_cast<std::size_t>(std::clamp<std::uint64_t>(memory / bundles, 4096, piece))) {}

    void put(std::size_t bundle, numbers row, numbers values) {
        std::optional<row_writer>& writer = writers_[bundle];
        if (!writer) writer.emplace(path(folder_, name_, by_, bundle, files_[bundle]), bytes_);
        writer->put(row);
        writer->put(values);
    }
    /// What has come since the last file of the bundle.
    [[nodiscard]] rows_file next_file(std::size_t bundle) {
        if (!writers_[bundle]) return {};
        rows_file file{path(folder_, name_, by_, bundle, files_[bundle]++),
                       writers_[bundle]->finish_unsynced()};
        writers_[bundle].reset();
        return file;
    }
    /// Of a bundle's only file, as another process knows it.
    [[nodiscard]] static rows_file file_of(const work_folder& folder, const std::string& name,
                                           std::size_t by, std::size_t bundle,
                                           const record_count& count) {
        return {path(folder, name, by, bundle, 0), count};
    }

  private:
    [[nodiscard]] static std::filesystem::path path(const work_folder& folder,
                                                    const std::string& name, std::size_t by,
                                                    std::size_t bundle, std::size_t file) {
        return folder.file(name + "." + std::to_string(by) + "." + std::to_string(bundle) +
                           (file == 0 ? "" : "." + std::to_string(file)));
    }

    const work_folder& folder_;
    std::string name_;
    std::size_t by_;
    std::size_t bytes_;
    std::array<std::optional<row_writer>, bundles> writers_{};
    std::array<std::size_t, bundles> files_{};
};

/// Rows in memory, one by one.
struct held_rows {
    numbers left;
    std::size_t width;

    [[nodiscard]] bool empty() const { return left.empty(); }
    [[nodiscard]] numbers front() const { return left.first(width); }
    void pop() { left = left.subspan(width); }
};

}  // namespace

class tile_steps::run_borders {
  public:
    explicit run_borders(const tile_steps& steps)
        : steps_(steps), communicator_(steps.communicator_) {
        const share own = steps.tiles_of(communicator_.rank());
        std::vector<row_reader> rows;
        std::vector<row_reader> asked;
        for (auto t = static_cast<std::size_t>(own.first); t < own.last; ++t) {
            rows.push_back(steps.border_rows(steps.file(t, ".border"), steps.tiles_[t].border));
            asked.emplace_back(steps.file(t, ".asked"), steps.tiles_[t].asked, steps.border_width(),
                               steps.bytes_per_reader());
        }
        row_merge all_asked(std::move(asked), 1);
        pass first(*this, own, "border");
        first.over({0, bundles}, row_merge(std::move(rows), 1),
                   [&](std::size_t bundle, const take_asked& take) {
                       for (; !all_asked.empty(); all_asked.pop()) {
                           const asked_point a = asked_of(all_asked.front());
                           if (a.bundle != bundle) break;
                           take(a, all_asked.front().subspan(border_numbers));
                       }
                   });
        if (!all_asked.empty()) fail_damaged(steps.folder_.path());
        first.finish();
        if (communicator_.is_alone()) return;
        share_left(first);
        bring_together();
    }

    [[nodiscard]] std::vector<tiles_welded::file> drops() { return std::move(drops_); }
    [[nodiscard]] const longest_move& move() const { return move_; }

  private:
    using file = tiles_welded::file;
    using take_asked = std::function<void(const asked_point&, numbers)>;

    /// What a process hands on.
    struct left {
        std::array<std::uint64_t, bundles> ends{};  ///< rows up to the end of each bundle
        record_count points{};
        std::array<record_count, bundles> asked{};
    };

    /// A border pass over some tiles.
    class pass {
      public:
        pass(run_borders& all, const share& tiles, std::string name)
            : all_(all),
              steps_(all.steps_),
              tiles_(tiles),
              is_whole_(tiles.size() == steps_.tiles_.size()),
              name_(std::move(name)),
              inbox_(rows("in")),
              asked_(rows("asked")),
              again_(rows("again")),
              dropped_(all.path(name_ + ".drops", all.communicator_.rank()), piece),
              points_(all.path(name_ + ".on", all.communicator_.rank()), piece) {}

        /// \pre `rows` are those of the bundles, and `each_asked(bundle, take)` gives, once, what
        /// is asked for of its points
        template <class EachAsked>
        void over(const share& some, row_merge rows, const EachAsked& each_asked) {
            const weld::number_slices& slices = all_.slices_;
            const std::uint64_t end = slices.bundle_begin(some.last);
            for (share run{slices.bundle_begin(some.first), 0}; run.first < end;
                 run.first = run.last) {
                run.last = hold(rows, {run.first, end});
                border_weld border(steps_.tolerance_, steps_.keys_.agree(), slices);
                receive(run, border);
                for (held_rows left = held(); !left.empty(); left.pop()) {
                    const border_point p = take_rows(left);
                    border.add(p, left.front().subspan(border_numbers), is_outer(p.at), out_);
                    write();
                    left_.ends[slices.bundle_of(p.id())] = rows_written_;
                }
                held_.clear();
                hand_over(run, border, each_asked);
                for (bool more = true; more; write()) more = border.finish(out_);
                all_.show(run.last);
            }
            if (!rows.empty()) fail_damaged(steps_.folder_.path());
        }
        /// What others have for these bundles is there, too.
        void add_inbox(std::size_t bundle, std::size_t by, const record_count& count) {
            received_[bundle].push_back(
                rows_by_bundle::file_of(steps_.folder_, name_ + ".in", by, bundle, count));
        }
        [[nodiscard]] record_count finish_inbox(std::size_t bundle) {
            return inbox_.next_file(bundle).count;
        }
        void finish() {
            all_.drops_.push_back({all_.path(name_ + ".drops", all_.communicator_.rank()),
                                   dropped_.finish_unsynced()});
            all_.move_.consider(out_.move);
            ++all_.passes_;
            left_.points = points_.finish_unsynced();
            std::uint64_t end = 0;
            for (std::size_t bundle = 0; bundle < bundles; ++bundle) {
                left_.ends[bundle] = end = std::max(end, left_.ends[bundle]);
                left_.asked[bundle] = asked_.next_file(bundle).count;
            }
        }
        [[nodiscard]] const left& handed_on() const { return left_; }

      private:
        [[nodiscard]] rows_by_bundle rows(const char* what) const {
            return {steps_.folder_, name_ + "." + what, all_.communicator_.rank(),
                    steps_.task_.options.memory / 32};
        }
        [[nodiscard]] bool is_outer(const point3& p) {
            return !is_whole_ && steps_.is_outer(p, tiles_, halos_);
        }
        [[nodiscard]] held_rows held() const { return {held_, steps_.border_width()}; }

        /// Rows of whole slices, one at least, and more while there is room: welding them takes
        /// some ten times as much, and many leave the caches. Returns where those begin that are
        /// left.
        [[nodiscard]] std::uint64_t hold(row_merge& rows, const share& of) {
            const weld::number_slices& slices = all_.slices_;
            const std::uint64_t room =
                std::min<std::uint64_t>(steps_.task_.options.memory / 32, 8 * piece) /
                sizeof(std::uint64_t);
            std::uint64_t next = 0;  // slice
            for (; !rows.empty(); rows.pop()) {
                const std::uint64_t id = rows.front()[0] >> 2;
                if (id < of.first || id >= of.last) break;
                if (slices.slice_of(id) >= next) {
                    if (held_.size() > room) return slices.slice_begin(slices.slice_of(id));
                    next = slices.slice_of(id) + 1;
                }
                held_.insert(held_.end(), rows.front().begin(), rows.front().end());
            }
            return of.last;
        }

        /// What bundles of the run ask for: each once, in order. Of a run without all of a bundle,
        /// what is near its own points.
        void receive(const share& run, border_weld& border) {
            const std::size_t width = steps_.border_width();
            const auto cuts_bundle = [&](std::uint64_t number) {
                return all_.slices_.bundle_begin(all_.slices_.bundle_of(number)) != number;
            };
            std::optional<weld::near_places> own;
            if (cuts_bundle(run.first) || cuts_bundle(run.last)) {
                own.emplace(weld::reach_of_open(steps_.tolerance_), held_.size() / width);
                for (held_rows left = held(); !left.empty(); left.pop())
                    own->add(point_of(left.front()));
            }
            std::vector<std::uint64_t> rows;
            each_bundle_of(run, [&](std::size_t bundle, bool is_last) {
                received_[bundle].push_back(inbox_.next_file(bundle));
                for (const rows_file& from : received_[bundle]) {
                    from.each(width, [&](numbers some) {
                        for (held_rows left{some, width}; !left.empty(); left.pop())
                            if (!own || own->may_have(point_of(left.front())))
                                rows.insert(rows.end(), left.front().begin(), left.front().end());
                    });
                    if (is_last) from.remove();
                }
                if (is_last) received_[bundle].clear();
            });
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

        /// What is asked for of a bundle of several runs, each of them is asked.
        template <class EachAsked>
        void hand_over(const share& run, border_weld& border, const EachAsked& each_asked) {
            each_bundle_of(run, [&](std::size_t bundle, bool is_last) {
                if (all_.slices_.bundle_begin(bundle) >= run.first) {
                    each_asked(bundle, [&](const asked_point& a, numbers values) {
                        hand_over(run, border, a, values);
                        if (!is_last) again_.put(bundle, row_of(a), values);
                        if (is_outer(a.at)) asked_.put(bundle, row_of(a), values);
                    });
                    asked_again_ = again_.next_file(bundle);
                    return;
                }
                const std::size_t width = steps_.border_width();
                asked_again_.each(width, [&](numbers some) {
                    for (held_rows left{some, width}; !left.empty(); left.pop())
                        hand_over(run, border, asked_of(left.front()),
                                  left.front().subspan(border_numbers));
                });
                if (is_last) asked_again_.remove();
            });
        }
        void hand_over(const share& run, border_weld& border, const asked_point& asked,
                       numbers values) {
            check();
            const std::uint64_t later = all_.slices_.from(run.last, asked.asked_by);
            if (later == 0) return;
            border.hand_over(asked, values, known_);
            for (const border_point& p : known_)
                for (std::size_t bundle = 0; bundle < bundles; ++bundle)
                    if (weld::number_slices::has(later, bundle))
                        inbox_.put(bundle, row_of(p.tag, p.at, p.leader), values);
            known_.clear();
        }

        /// Calls `take` with each bundle that the run has some of, and whether it has the last.
        template <class Take>
        void each_bundle_of(const share& run, const Take& take) const {
            const weld::number_slices& slices = all_.slices_;
            for (std::size_t b = slices.bundle_of(run.first); b <= slices.bundle_of(run.last - 1);
                 ++b)
                take(b, slices.bundle_begin(b + 1) <= run.last);
        }

        void write() {
            dropped_.put(out_.dropped);
            out_.dropped.clear();
            rows_written_ += put_border(out_, points_);
            put_asked(out_, [&](const asked_point& a, numbers values) {
                asked_.put(a.bundle, row_of(a), values);
            });
            check();
        }
        void check() {
            if (++records_ % records_a_check == 0) steps_.pace_.check();
        }

        run_borders& all_;
        const tile_steps& steps_;
        share tiles_;
        bool is_whole_;
        std::string name_;
        rows_by_bundle inbox_;  ///< what is known of what bundles ask for
        rows_by_bundle asked_;  ///< for the next pass
        rows_by_bundle again_;  ///< for the next run
        record_writer<tile_drop> dropped_;
        row_writer points_;
        std::uint64_t rows_written_ = 0;
        std::vector<std::uint64_t> held_{};  ///< rows of a run
        std::array<std::vector<rows_file>, bundles> received_{};
        rows_file asked_again_{};
        left left_{};
        weld::tile_result out_{};
        std::vector<border_point> known_{};
        std::vector<std::uint32_t> halos_{};
        std::uint64_t records_ = 0;
    };

    /// How far the pass has come.
    void show(std::uint64_t settled) const {
        const double points = static_cast<double>(steps_.survey_.cloud.points);
        steps_.pace_.show("borders",
                          (passes_ + std::min(1.0, static_cast<double>(settled) / points)) /
                              (communicator_.is_alone() ? 1.0 : 2.0));
    }

    [[nodiscard]] std::filesystem::path path(const std::string& name, std::size_t by) const {
        return steps_.folder_.file(name + "." + std::to_string(by));
    }

    /// All know what each hands on.
    void share_left(const pass& first) {
        state_writer mine;
        store_count(first.handed_on().points, mine);
        for (const std::uint64_t end : first.handed_on().ends) mine.number(end);
        for (const record_count& count : first.handed_on().asked) store_count(count, mine);
        for (state_reader& one : communicator_.exchange(mine)) {
            left& of = left_.emplace_back();
            of.points = load_count(one);
            for (std::uint64_t& end : of.ends) end = one.number();
            for (record_count& count : of.asked) count = load_count(one);
        }
    }

    /// Bundles of a process, which have about as many rows as those of others.
    [[nodiscard]] share bundles_of(std::size_t rank) const {
        std::array<std::uint64_t, bundles> ends{};
        for (const left& of : left_)
            for (std::size_t b = 0; b < bundles; ++b) ends[b] += of.ends[b];
        share mine{0, 0};
        for (std::size_t b = 0; b < bundles; ++b) {
            const std::uint64_t twice_middle = ends[b] + (b == 0 ? 0 : ends[b - 1]);
            const auto owner = static_cast<std::size_t>(static_cast<double>(communicator_.size()) *
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
        communicator_.sequential(
            [&](state_writer& mine) {
                const share own = bundles_of(communicator_.rank());
                last.over(own, rows_of(own), [&](std::size_t bundle, const take_asked& take) {
                    each_asked(bundle, take);
                });
                for (std::size_t b = 0; b < bundles; ++b) store_count(last.finish_inbox(b), mine);
            },
            [&](state_reader received) {
                const share own = bundles_of(turn);
                for (std::size_t b = 0; b < bundles; ++b) {
                    const record_count count = load_count(received);
                    if (turn != communicator_.rank() && b >= own.last)
                        last.add_inbox(b, turn, count);
                }
                ++turn;
            });
        last.finish();
    }

    [[nodiscard]] row_merge rows_of(const share& some) const {
        std::vector<row_reader> readers;
        for (std::size_t r = 0; r < left_.size(); ++r) {
            const auto end = [&](std::uint64_t bundle) {
                return bundle == 0 ? 0 : left_[r].ends[static_cast<std::size_t>(bundle - 1)];
            };
            readers.push_back(steps_.border_rows(path("border.on", r), left_[r].points,
                                                 {end(some.first), end(some.last)}));
        }
        return {std::move(readers), 1};
    }

    void each_asked(std::size_t bundle, const take_asked& take) const {
        const std::size_t width = steps_.border_width();
        for (std::size_t r = 0; r < left_.size(); ++r) {
            const rows_file asked = rows_by_bundle::file_of(steps_.folder_, "border.asked", r,
                                                            bundle, left_[r].asked[bundle]);
            asked.each(width, [&](numbers some) {
                for (held_rows rows{some, width}; !rows.empty(); rows.pop())
                    take(asked_of(rows.front()), rows.front().subspan(border_numbers));
            });
            asked.remove();
        }
    }

    const tile_steps& steps_;
    const communicator& communicator_;
    weld::number_slices slices_{steps_.slices()};
    std::vector<left> left_{};  ///< by each rank
    std::vector<file> drops_{};
    longest_move move_{};
    int passes_ = 0;  ///< that are done
};

std::vector<tiles_welded::file> tile_steps::weld_borders_in_runs(longest_move& longest) const {
    run_borders borders(*this);
    longest.consider(borders.move());
    return borders.drops();
}

}  // namespace treeform::detail::stream
