#include <libmesh/stream/kept_rows.hpp>
#include <libmesh/stream/row_file.hpp>
#include <libmesh/weld/kept_values.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace treeform::detail::stream {
namespace {

constexpr std::size_t before_point = 3;  ///< numbers in a member's row
constexpr std::uint64_t rows_a_check = 65536;

point3 place_of(numbers packed) {
    const auto x = [&](std::size_t k) { return std::bit_cast<double>(packed[k]); };
    return {x(0), x(1), x(2)};
}

/// The means of points that come one by one, in the properties of the first.
class mean_point {
  public:
    explicit mean_point(const packed_points& packed) {
        for (std::size_t k = 0; k < 3; ++k) numbers_.push_back({8 * k, scalar_type::float64});
        for (const packed_points::field& f : packed.fields())
            if (f.type == scalar_type::float32 || f.type == scalar_type::float64)
                numbers_.push_back({f.byte, f.type});
    }

    void start(numbers packed) {
        first_.assign(packed.begin(), packed.end());
        for (number& n : numbers_) n.mean = {};
        add(packed);
    }
    void add(numbers packed) {
        const auto* const bytes = reinterpret_cast<const std::byte*>(packed.data());
        for (number& n : numbers_) {
            float single = 0.0F;
            double value = 0.0;
            if (n.type == scalar_type::float32) {
                std::memcpy(&single, bytes + n.byte, sizeof single);
                value = static_cast<double>(single);
            } else {
                std::memcpy(&value, bytes + n.byte, sizeof value);
            }
            n.mean.add(value);
        }
    }
    [[nodiscard]] numbers finish() {
        auto* const bytes = reinterpret_cast<std::byte*>(first_.data());
        for (const number& n : numbers_) {
            const double value = n.mean.value();
            const auto single = static_cast<float>(value);
            if (n.type == scalar_type::float32)
                std::memcpy(bytes + n.byte, &single, sizeof single);
            else
                std::memcpy(bytes + n.byte, &value, sizeof value);
        }
        return first_;
    }

  private:
    struct number {
        std::size_t byte;
        scalar_type type;
        weld::running_mean mean{};
    };
    std::vector<number> numbers_{};
    std::vector<std::uint64_t> first_{};
};

constexpr std::uint64_t points_a_check = 65536;

}  // namespace

packed_points::packed_points(const mesh_file& header) {
    std::size_t bytes = 3 * sizeof(double);
    if (const element* const vertices = header.attributes.find("vertex"))
        for (std::size_t c = 0; c < vertices->columns.size(); ++c) {
            const column& from = vertices->columns[c];
            if (from.role != column_role::data || from.list_length) continue;
            fields_.push_back({c, bytes, from.type});
            bytes += size_of(from.type);
        }
    width_ = (bytes + 7) / 8;
}

void packed_points::pack(const io::point_block& block, std::size_t point,
                         std::vector<std::uint64_t>& to) const {
    const std::size_t begin = to.size();
    to.resize(begin + width_, 0);
    for (std::size_t k = 0; k < 3; ++k)
        to[begin + k] = std::bit_cast<std::uint64_t>(block.points[point][k]);
    auto* const bytes = reinterpret_cast<std::byte*>(to.data() + begin);
    for (const field& f : fields_) {
        const std::size_t size = size_of(f.type);
        std::memcpy(bytes + f.byte, block.properties.columns[f.column].values.data() + point * size,
                    size);
    }
}

void packed_points::unpack(numbers from, io::point_block& block, std::size_t point) const {
    block.points[point] = place_of(from);
    const auto* const bytes = reinterpret_cast<const std::byte*>(from.data());
    for (const field& f : fields_) {
        const std::size_t size = size_of(f.type);
        std::memcpy(block.properties.columns[f.column].values.data() + point * size, bytes + f.byte,
                    size);
    }
}

kept_rows::kept_rows(cancellable_progress& pace, const work_folder& folder, const communicator& all,
                     const tile_task& task, tile_steps& steps, tiles_welded& w)
    : folder_(folder),
      all_(all),
      keep_(task.options.keep),
      points_(steps.survey().points),
      packed_(steps.source().header()),
      members_(folder, all, "members.of", {.width = before_point + packed_.width(), .keys = 2},
               steps.sorting_memory()),
      changes_(folder, all, "givers", 2, steps.sorting_memory() / 4),
      givers_(w.kept),
      has_all_(all.is_alone()) {
    gather(pace, steps, w);
    choose(pace);
    send_to_givers();
    w.max_displacement = all.most(longest_move(pace));
}

void kept_rows::gather(cancellable_progress& pace, tile_steps& steps, const tiles_welded& w) {
    tile_steps::leaders leaders(steps, all_, w);
    joined_points& source = steps.source();
    source.rewind(w.points);
    io::point_block block;
    std::vector<std::uint64_t> keys;
    std::vector<std::uint64_t> member;
    std::uint64_t id = w.points.first;
    while (source.read(block, points_a_block)) {
        steps.keys().choice_of(block, keys);
        for (std::size_t i = 0; i < block.points.size(); ++i, ++id) {
            const std::uint64_t leader = leaders.of(id);
            if (w.kept.keeps(id) && w.followed->keeps(id)) continue;  // alone
            member.assign({leader, id, keys[i]});
            packed_.pack(block, i, member);
            members_.put(owner_of(leader), member);
        }
        pace.check();
    }
}

/// Of points of equal keys the first is kept, as by `kept_points`.
void kept_rows::choose(cancellable_progress& pace) {
    row_writer rows(path(all_.rank()), piece);
    mean_point mean(packed_);
    std::vector<std::uint64_t> best;
    const auto finish = [&] {
        if (best.empty()) return;
        const numbers point =
            keep_ == weld_keep::mean ? mean.finish() : numbers(best).subspan(before_point);
        if (best[0] != best[1]) {
            givers_.drop(best[0]);
            changes_.put(owner_of(best[1]), numbers(best).first(2));
        }
        const point3 at = place_of(point);
        single_ = single_ && fits_float32({&at, 1});
        rows.put(best[0]);
        rows.put(point);
    };
    std::uint64_t count = 0;
    for (row_merge all = members_.sorted(); !all.empty(); all.pop()) {
        const numbers member = all.front();
        const numbers point = member.subspan(before_point);
        if (best.empty() || best[0] != member[0]) {
            finish();
            best.assign(member.begin(), member.end());
            if (keep_ == weld_keep::mean) mean.start(point);
        } else if (keep_ == weld_keep::mean) {
            mean.add(point);
        } else if (keep_ == weld_keep::last || member[2] < best[2]) {
            best.assign(member.begin(), member.end());
        }
        if (++count % rows_a_check == 0) pace.check();
    }
    finish();
    share_rows(rows.finish_unsynced());
}

void kept_rows::share_rows(const record_count& mine) {
    state_writer sent;
    store_count(mine, sent);
    sent.number(single_ ? 1 : 0);
    for (state_reader& one : all_.exchange(sent)) {
        counts_.push_back(load_count(one));
        single_ = one.number() != 0 && single_;
    }
}

void kept_rows::send_to_givers() {
    changes_.send();
    for (row_reader& from : changes_.received())
        for (; !from.empty(); from.pop()) givers_.keep(from.front()[1]);
}

void kept_rows::gather_first(const tiles_welded& w) {
    if (has_all_) return;
    next_.reset();
    has_all_ = all_.is_root();
    if (!has_all_) return;
    givers_ = w.kept;
    for (row_reader& from : changes_.received_by_all())
        for (; !from.empty(); from.pop()) {
            givers_.drop(from.front()[0]);
            givers_.keep(from.front()[1]);
        }
}

double kept_rows::longest_move(cancellable_progress& pace) {
    weld::longest_move longest;
    rewind();
    std::uint64_t count = 0;
    for (row_merge all = members_.sorted(); !all.empty(); all.pop()) {
        const numbers member = all.front();
        while (next_->front()[0] != member[0]) next_->pop();
        longest.consider(place_of(member.subspan(before_point)),
                         place_of(next_->front().subspan(1)));
        if (++count % rows_a_check == 0) pace.check();
    }
    return longest.length();
}

std::filesystem::path kept_rows::path(std::size_t rank) const {
    return folder_.file("kept.rows." + std::to_string(rank));
}

void kept_rows::rewind() {
    std::vector<row_reader> readers;
    for (std::size_t r = 0; r < counts_.size(); ++r)
        if (has_all_ || r == all_.rank())
            readers.emplace_back(path(r), counts_[r], 1 + packed_.width(), piece);
    next_.emplace(std::move(readers), 1);
}

void kept_rows::replace(io::point_block& block, std::size_t point) {
    if (next_->empty()) throw std::logic_error("a group without what is kept of it");
    packed_.unpack(next_->front().subspan(1), block, point);
    next_->pop();
}

new_numbers::new_numbers(cancellable_progress& pace, const work_folder& folder,
                         const communicator& all, tile_steps& steps, tiles_welded& welded)
    : welded_(welded), leaders_(steps, all, welded) {
    welded.kept.number();
    if (!all.is_alone()) ask_others(pace, folder, all, steps);
}

/// The rank that a point is assigned to knows its number: it is asked for those of the points that
/// belong to it.
void new_numbers::ask_others(cancellable_progress& pace, const work_folder& folder,
                             const communicator& all, const tile_steps& steps) {
    const share& mine = welded_.points;
    state_writer kept;
    kept.number(mine.size() - welded_.kept.dropped());
    std::vector<state_reader> received = all.exchange(kept);
    for (std::size_t r = 0; r < all.rank(); ++r) before_ += received[r].number();
    const std::uint64_t points = steps.survey().points;
    const std::uint64_t memory = steps.sorting_memory() / 2;
    all_to_all asked(folder, all, "asked", 2, memory);
    for (std::uint64_t point = mine.first; point < mine.last; ++point) {
        if (point % points_a_check == 0) pace.check();
        if (welded_.kept.keeps(point)) continue;
        const std::uint64_t leader = leaders_.of(point);
        asked.put(all.owner_of(leader, points), std::array{point, leader});
    }
    asked.send();
    all_to_all answers(folder, all, "answers", 2, memory);
    for (row_merge rows(asked.received(), 1); !rows.empty(); rows.pop()) {
        const std::uint64_t point = rows.front()[0];
        const std::uint64_t number = before_ + welded_.kept.number_of(rows.front()[1]);
        answers.put(all.owner_of(point, points), std::array{point, number});
    }
    asked.remove_received();
    answers.send();
    of_dropped_.emplace(answers.received(), 1);
}

std::uint64_t new_numbers::of(std::uint64_t point) {
    if (welded_.kept.keeps(point)) return before_ + welded_.kept.number_of(point);
    if (!of_dropped_) return welded_.kept.number_of(leaders_.of(point));
    const std::uint64_t number = of_dropped_->front()[1];
    of_dropped_->pop();
    return number;
}

}  // namespace treeform::detail::stream
