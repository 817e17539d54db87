/// \file
/// What lies along the borders of tiles. With the rule chain, each rank settles what it can of
/// its own tiles, and then what is left is brought together, by two and two.

#include <libmesh/stream/tile_steps.hpp>

#include <algorithm>
#include <span>
#include <stdexcept>
#include <utility>

namespace treeform::detail::stream {
/// The passes over borders with the rule chain, and what they leave.
class tile_steps::chain_borders {
  public:
    chain_borders(const tile_steps& steps, border_weld& border) : steps_(steps), border_(border) {
        const communicator& all = steps.communicator_;
        const std::size_t rank = all.rank();
        const share own = steps.tiles_of(rank);
        hands_on_.resize(all.size());
        pass(border, own, "border", [&] {
            std::vector<row_reader> rows;
            for (auto t = static_cast<std::size_t>(own.first); t < own.last; ++t)
                rows.push_back(steps.border_rows(steps.file(t, ".border"), steps.tiles_[t].border));
            return rows;
        });
        for (std::size_t step = 1; step < all.size(); step *= 2) {
            share_files();
            if (rank % (2 * step) != 0 || rank + step >= all.size()) {
                joined_ = {};
            } else {
                border_weld upper(steps.tolerance_, steps.keys_.agree());
                const std::size_t end = std::min(rank + 2 * step, all.size());
                const share both{own.first, steps.tiles_of(end - 1).last};
                pass(upper, both, "border." + std::to_string(step), [&] {
                    std::vector<row_reader> rows;
                    for (const std::size_t r : {rank, rank + step})
                        rows.push_back(steps.border_rows(hands_on_[r].path, hands_on_[r].count));
                    return rows;
                });
            }
            learn(rank - rank % (2 * step));
        }
    }

    [[nodiscard]] const std::vector<tiles_welded::file>& drops() const { return drops_; }

  private:
    using file = tiles_welded::file;

    /// One over what `open` opens, which is all that is known of the borders of some tiles.
    template <class Open>
    void pass(border_weld& border, const share& tiles, const std::string& name, const Open& open) {
        const bool whole = tiles.size() == steps_.tiles_.size();
        record_writer<tile_drop> dropped(path(name, ".drops"), piece);
        row_writer on(path(name, ".on"), piece);
        row_writer joined(path(name, ".joined"), piece);
        weld::tile_result out;
        each(open(), [&](const border_point& p) { border.add(p, {}, false, out); });
        for (const border_point& link : border.joined()) {
            dropped.put({link.id(), link.leader});
            if (!steps_.communicator_.is_alone()) put_rows(link, {}, joined);
        }
        if (!whole) {
            std::optional<std::uint64_t> last;
            each(open(), [&](const border_point& p) {
                if (last != p.id() && steps_.is_outer(p.at, tiles, halos_))
                    put_rows(border.handed_on(p), {}, on);
                last = p.id();
            });
        }
        drops_.push_back({path(name, ".drops"), dropped.finish_unsynced()});
        hands_on_[steps_.communicator_.rank()] = {path(name, ".on"), on.finish_unsynced()};
        joined_ = {path(name, ".joined"), joined.finish_unsynced()};
    }

    template <class Take>
    void each(std::vector<row_reader> rows, const Take& take) const {
        std::uint64_t count = 0;
        for (row_merge merge(std::move(rows), 1); !merge.empty(); merge.pop(), ++count) {
            take(take_rows(merge));
            if (count % records_a_check == 0) steps_.pace_.check();
        }
    }

    [[nodiscard]] std::filesystem::path path(const std::string& name, const char* what) const {
        return steps_.folder_.file(name + "." + std::to_string(steps_.communicator_.rank()) + what);
    }

    [[nodiscard]] std::vector<state_reader> gathered_of(const file& f) const {
        state_writer mine;
        mine.text(f.path.string());
        store_count(f.count, mine);
        return steps_.communicator_.exchange(mine);
    }
    [[nodiscard]] static file file_of(state_reader& received) {
        const std::string path = received.text();
        return {path, load_count(received)};
    }

    /// All know where to find what each hands on.
    void share_files() {
        std::vector<state_reader> received = gathered_of(hands_on_[steps_.communicator_.rank()]);
        for (std::size_t r = 0; r < received.size(); ++r) hands_on_[r] = file_of(received[r]);
    }

    /// Takes what has been joined by the pass that was over the own tiles, too.
    void learn(std::size_t by) {
        std::vector<state_reader> received = gathered_of(joined_);
        const file joined = file_of(received[by]);
        if (joined.path.empty()) return;
        for (row_reader rows(joined.path, joined.count, border_numbers, piece); !rows.empty();
             rows.pop())
            border_.join(take_rows(rows));
    }

    const tile_steps& steps_;
    border_weld& border_;
    std::vector<file> hands_on_{};  ///< of the last pass of each
    std::vector<file> drops_{};
    file joined_{};  ///< by the last pass
    std::vector<std::uint32_t> halos_{};
};

tiles_welded tile_steps::weld_borders() {
    tiles_welded w(tolerance_, keys_.agree());
    longest_move longest;
    pace_.show("borders", 0.0);
    if (!by_chain())
        w.drops = weld_borders_in_runs(longest);
    else
        w.drops = chain_borders(*this, w.border).drops();
    const share own = tiles_of(communicator_.rank());
    for (auto t = static_cast<std::size_t>(own.first); t < own.last; ++t) {
        w.drops.push_back({file(t, ".drops"), tiles_[t].drops});
        longest.consider(tiles_[t].move);
        record_reader<tile_member> members(file(t, ".members"), tiles_[t].members, piece);
        for (auto some = members.next(); !some.empty(); some = members.next()) {
            for (const tile_member& m : some) w.border.measure(m, longest);
            pace_.check();
        }
    }
    w.points = assigned_to(communicator_.rank());
    kept_points kept(w.points.size(), w.points.first);
    kept_points followed = kept;
    if (!communicator_.is_alone()) distribute(w, followed);
    follow(w, kept, followed);
    if (kept.shares_a_drop(followed))
        throw std::logic_error("a point belongs to one that was dropped");
    sum_up(w, kept, followed, longest);
    w.kept = has_order() ? number_kept_by_all(w.points, kept) : std::move(kept);
    if (task_.options.keep != weld_keep::first) w.followed.emplace(std::move(followed));
    step_done();
    return w;
}

/// Whether a tile other than these has the point, be it in its halo.
bool tile_steps::is_outer(const point3& p, const share& tiles,
                          std::vector<std::uint32_t>& halos) const {
    return !tiles.has(cuts_->find(p, halos)) ||
           !std::ranges::all_of(halos, [&](std::uint32_t t) { return tiles.has(t); });
}

/// By rank, and by number.
share tile_steps::assigned_to(std::size_t rank) const {
    return communicator_.share_of(survey_.cloud.points, rank);
}

/// Each receives its points: the dropped ones, and those that others follow.
void tile_steps::distribute(tiles_welded& w, kept_points& followed) const {
    const std::size_t size = communicator_.size();
    const auto path = [&](const char* what, std::size_t from, std::size_t to) {
        return folder_.file(what + std::to_string(from) + "." + std::to_string(to));
    };
    const std::size_t bytes = std::min<std::size_t>(piece, task_.options.memory / 16 / size);
    std::vector<record_writer<tile_drop>> drops;
    std::vector<row_writer> followed_by;
    for (std::size_t r = 0; r < size; ++r) {
        drops.emplace_back(path("drops.", communicator_.rank(), r), bytes);
        followed_by.emplace_back(path("leaders.", communicator_.rank(), r), bytes);
    }
    std::vector<std::uint64_t> ends;
    for (std::size_t r = 0; r < size; ++r) ends.push_back(assigned_to(r).last);
    const auto owner = [&](std::uint64_t point) {
        return static_cast<std::size_t>(std::ranges::upper_bound(ends, point) - ends.begin());
    };
    std::optional<std::uint64_t> last;
    std::uint64_t count = 0;
    for (row_merge all = sorted_drops(w.drops); !all.empty(); all.pop(), ++count) {
        const tile_drop d{all.front()[0], w.border.leader_of(all.front()[1])};
        drops[owner(d.id)].put(d);
        if (last != d.leader) followed_by[owner(d.leader)].put(d.leader);
        last = d.leader;
        if (count % records_a_check == 0) pace_.check();
    }
    state_writer mine;
    for (std::size_t r = 0; r < size; ++r) {
        store_count(drops[r].finish_unsynced(), mine);
        store_count(followed_by[r].finish_unsynced(), mine);
    }
    w.drops.clear();
    w.sent.resize(size);
    std::vector<state_reader> received = communicator_.exchange(mine);
    for (std::size_t from = 0; from < size; ++from)
        for (std::size_t to = 0; to < size; ++to) {
            w.sent[from].push_back({path("drops.", from, to), load_count(received[from])});
            const record_count named = load_count(received[from]);
            if (to != communicator_.rank()) continue;
            w.drops.push_back(w.sent[from][to]);
            record_reader<std::uint64_t> all(path("leaders.", from, to), named, piece);
            for (auto some = all.next(); !some.empty(); some = all.next())
                for (const std::uint64_t leader : some) followed.drop(leader);
        }
}

void tile_steps::follow(const tiles_welded& w, kept_points& kept, kept_points& followed) const {
    const bool has_all = w.points.size() == survey_.cloud.points;
    for (const tiles_welded::file& from : w.drops) {
        record_reader<tile_drop> reader(from.path, from.count, piece);
        for (auto drops = reader.next(); !drops.empty(); drops = reader.next()) {
            for (const tile_drop& d : drops) {
                kept.drop(d.id);
                if (has_all) followed.drop(w.border.leader_of(d.leader));
            }
            pace_.check();
        }
    }
}

void tile_steps::sum_up(tiles_welded& w, const kept_points& kept, const kept_points& followed,
                        longest_move longest) const {
    state_writer mine;
    mine.numbers(kept.dropped(), followed.dropped());
    mine.point(longest.from());
    mine.point(longest.to());
    for (state_reader& one : communicator_.exchange(mine)) {
        w.dropped += one.number();
        w.groups += one.number();
        const point3 from = one.point();
        longest.consider(from, one.point());
    }
    w.max_displacement = longest.length();
}

void tile_steps::gather_first(tiles_welded& w) const {
    if (communicator_.is_alone()) return;
    w.drops.clear();
    const std::uint64_t count = survey_.cloud.points;
    w.points = communicator_.is_root() ? share{0, count} : share{count, count};
    w.kept = kept_points(w.points.size(), w.points.first);
    if (!communicator_.is_root()) return;
    for (const auto& from : w.sent) w.drops.insert(w.drops.end(), from.begin(), from.end());
    kept_points followed = w.kept;
    follow(w, w.kept, followed);
    if (w.followed) w.followed.emplace(std::move(followed));
    if (has_order()) w.kept = number_kept(w.kept);
}

row_reader tile_steps::border_rows(const std::filesystem::path& path, const record_count& count,
                                   const share& some) const {
    return {path, count, border_width(), bytes_per_reader(), some};
}

row_merge tile_steps::sorted_drops(const std::vector<tiles_welded::file>& files) const {
    std::vector<row_reader> readers;
    for (const tiles_welded::file& f : files)
        readers.emplace_back(f.path, record_count{2 * f.count.records, f.count.digest}, 2,
                             bytes_per_reader());
    return {std::move(readers), 1};
}

}  // namespace treeform::detail::stream
