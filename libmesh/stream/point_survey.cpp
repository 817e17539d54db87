#include <libmesh/attributes/known_columns.hpp>
#include <libmesh/base/add_to_box.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/words.hpp>
#include <libmesh/io/las_grid_choice.hpp>
#include <libmesh/stream/point_survey.hpp>
#include <libmesh/stream/record_file.hpp>
#include <libmesh/weld/near_cells.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>

namespace treeform::detail::stream {
namespace {

std::uint64_t mix(std::uint64_t h) {
    h = (h ^ h >> 30) * 0xbf58476d1ce4e5b9;
    h = (h ^ h >> 27) * 0x94d049bb133111eb;
    return h ^ h >> 31;
}

/// Of points with keys, those whose key is hashed to zeros at the end, one a key: as many zeros as
/// it takes to have room for them. Patterns in a file do not show in it.
class sampler {
  public:
    explicit sampler(std::size_t most) : most_(most) { chosen_.reserve(most); }

    void consider(std::uint64_t key, const point3& p) {
        const std::uint64_t mixed = mix(key);
        if ((mixed & mask_) != 0) return;
        std::uint64_t& seen = lately_[mixed >> 52];
        if (seen == mixed) return;
        seen = mixed;
        choose(mixed, p);
    }
    void store(state_writer& state) {
        leave_one_a_key();
        state.numbers(mask_, chosen_.size());
        for (const auto& [mixed, p] : chosen_) {
            state.number(mixed);
            state.point(p);
        }
    }
    /// What another one has stored.
    void take(state_reader& state) {
        mask_ = std::max(mask_, state.number());
        for (std::uint64_t left = state.number(); left > 0; --left) {
            const std::uint64_t mixed = state.number();
            choose(mixed, state.point());
        }
        leave_one_a_key();
    }
    [[nodiscard]] point_survey::part part() {
        leave_one_a_key();
        std::vector<point3> all;
        all.reserve(chosen_.size());
        for (const auto& c : chosen_) all.push_back(c.second);
        std::sort(all.begin(), all.end(), before);
        point_survey::part some{.share = 1.0 / (static_cast<double>(mask_) + 1.0)};
        for (const point3& p : all) {
            const bool is_another = some.points.empty() || some.points.back() != p;
            if (is_another) some.points.push_back(p);
            if (is_another) some.counts.push_back(0);
            ++some.counts.back();
        }
        return some;
    }

  private:
    static bool before(const point3& a, const point3& b) {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    }
    void choose(std::uint64_t mixed, const point3& p) {
        chosen_.emplace_back(mixed, p);
        if (chosen_.size() == most_) thin_out();
    }
    void leave_one_a_key() {
        std::erase_if(chosen_, [&](const auto& c) { return (c.first & mask_) != 0; });
        std::sort(chosen_.begin(), chosen_.end(), [](const auto& a, const auto& b) {
            return a.first != b.first ? a.first < b.first : before(a.second, b.second);
        });
        const auto same = [](const auto& a, const auto& b) { return a.first == b.first; };
        chosen_.erase(std::unique(chosen_.begin(), chosen_.end(), same), chosen_.end());
    }
    void thin_out() {
        leave_one_a_key();
        while (chosen_.size() > most_ / 4 * 3) {
            mask_ = 2 * mask_ + 1;
            std::erase_if(chosen_, [&](const auto& c) { return (c.first & mask_) != 0; });
        }
    }

    std::size_t most_;
    std::uint64_t mask_ = 0;
    std::vector<std::pair<std::uint64_t, point3>> chosen_{};
    std::vector<std::uint64_t> lately_ = std::vector<std::uint64_t>(4096, 0);  ///< most are known
};

mesh_file source_of(std::string format) {
    mesh_file source{.stored_as = precision::float32, .format = std::move(format)};
    static_cast<void>(source.attributes.find_or_add("vertex", 0));
    return source;
}

bool is_single(const mesh_file& source) { return source.stored_as == precision::float32; }

std::uint64_t points_of(const mesh_file& source) { return source.attributes.find("vertex")->rows; }

void count_points(mesh_file& source, std::uint64_t points, bool single) {
    source.attributes.find_or_add("vertex", 0).rows += static_cast<std::size_t>(points);
    if (!single) source.stored_as = precision::float64;
}

void add_survey(cloud_survey& sum, const cloud_survey& one) {
    sum.points += one.points;
    sum.non_finite += one.non_finite;
    if (one.box) base::add_to_box(sum.box, *one.box);
    sum.las_moved = std::max(sum.las_moved, one.las_moved);
    sum.sources.resize(one.sources.size());
    for (std::size_t i = 0; i < one.sources.size(); ++i) {
        const bool is_first = sum.sources[i].format.empty();
        if (is_first) sum.sources[i] = source_of(one.sources[i].format);
        count_points(sum.sources[i], points_of(one.sources[i]), is_single(one.sources[i]));
    }
    for (const value_range& r : one.ranges) {
        const auto at = std::ranges::find(sum.ranges, r.column, &value_range::column);
        if (at == sum.ranges.end()) {
            sum.ranges.push_back(r);
            continue;
        }
        at->min = std::min(at->min, r.min);
        at->max = std::max(at->max, r.max);
        at->whole = at->whole && r.whole;
    }
    sum.warnings.insert(sum.warnings.end(), one.warnings.begin(), one.warnings.end());
}

/// What all have seen, in the place of what one has. Where some could not read, all throw what is
/// wrong first in the cloud.
void unite(const communicator& all, const std::string& failure, point_survey& survey,
           sampler& chosen, sampler& places, std::size_t most) {
    state_writer mine;
    mine.text(failure);
    store(survey, mine);
    chosen.store(mine);
    places.store(mine);
    survey.cloud = {};
    chosen = sampler(most + 1);
    places = sampler(most + 1);
    for (state_reader& one : all.exchange(mine)) {
        if (const std::string first = one.text(); !first.empty()) throw io_error(first);
        add_survey(survey.cloud, load_survey(one).cloud);
        chosen.take(one);
        places.take(one);
    }
}

using io::las_grid_choice;

void look_at_all(las_grid_choice& choice, const pass_of_points& each, const communicator& all) {
    each([&](points_view some) { choice.look(some); });
    state_writer sent;
    for (const las_grid_choice::range& r : choice.ranges()) {
        sent.real(r.low);
        sent.real(r.high);
    }
    for (state_reader& one : all.exchange(sent))
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double low = one.real();
            choice.add(axis, {low, one.real()});
        }
}

/// Whether all agree that the scales hold all points.
bool try_on_all(las_grid_choice& choice, const pass_of_points& each, const communicator& all) {
    each([&](points_view some) { choice.try_on(some); });
    state_writer sent;
    sent.number(choice.must_try_again() ? 1 : 0);
    for (const int d : choice.tried()) sent.number(static_cast<std::uint64_t>(d));
    bool agreed = true;
    las_grid_choice::digits most{};
    std::vector<las_grid_choice::digits> tried;
    for (state_reader& one : all.exchange(sent)) {
        agreed = one.number() == 0 && agreed;
        las_grid_choice::digits& of_one = tried.emplace_back();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            of_one[axis] = static_cast<int>(one.number());
            most[axis] = std::max(most[axis], of_one[axis]);
        }
    }
    for (const las_grid_choice::digits& of_one : tried) agreed = agreed && of_one == most;
    choice.start_round(most);
    return agreed;
}

}  // namespace

std::uint64_t cube_of(const point3& p, double tolerance) {
    constexpr double far = 0x1p62;
    const double scale =
        tolerance > 0.0 ? 1.74 / tolerance : std::numeric_limits<double>::infinity();
    const auto index = [&](double x) {
        const double steps = x * scale;
        if (!(std::abs(steps) < far)) return std::bit_cast<std::int64_t>(x + 0.0);
        const auto cut = static_cast<std::int64_t>(steps);
        return static_cast<double>(cut) > steps ? cut - 1 : cut;
    };
    return weld::cube_map::hash(index(p.x), index(p.y), index(p.z));
}

point_survey survey(joined_points& points, const communicator& all, const share& mine,
                    std::optional<double> tolerance, std::size_t most, cancellable_progress& pace) {
    point_survey result;
    cloud_survey& s = result.cloud;
    sampler chosen(std::max(most / all.size(), std::size_t{1} << 12));
    sampler places(std::max(most / all.size(), std::size_t{1} << 12));
    io::point_block block;
    for (std::size_t i = 0; i < points.files(); ++i)
        s.sources.push_back(source_of(points.format(i)));
    std::string failure;
    const auto read = [&] {
        try {
            return points.read(block, points_a_block);
        } catch (const io_error& error) {
            if (all.is_alone() || is_of_tiles(error)) throw;
            failure = error.what();
            return false;
        }
    };
    points.rewind(mine);
    while (read()) {
        base::add_to_box(s.box, bounding_box(block.points));
        attribute::look_at_ranges(block.properties, s.ranges);
        count_points(s.sources[points.file()], block.points.size(),
                     !points.file_header().las && points.is_single(block));
        for (const point3& p : block.points) {
            const std::uint64_t id = mine.first + s.points++;
            if (!base::is_finite(p)) {
                ++s.non_finite;
                continue;
            }
            chosen.consider(id, p);
            if (tolerance) places.consider(cube_of(p, *tolerance), p);
        }
        const auto count = static_cast<double>(points.count());
        pace.show("survey", static_cast<double>(s.points) / count);
    }
    s.warnings = points.warnings();
    s.las_moved = points.moved();
    if (!all.is_alone()) unite(all, failure, result, chosen, places, most);
    if (s.las_moved > 0.0)
        s.warnings.push_back(
            {"las-grid", "coordinates are rounded to the scale of the LAS file, by at most " +
                             base::brief(s.las_moved)});
    s.fits_float32 = s.fits_float32 && std::ranges::all_of(s.sources, is_single);
    result.sample = chosen.part();
    if (tolerance) result.places = places.part();
    return result;
}

void store(const point_survey& survey, state_writer& state) {
    const cloud_survey& s = survey.cloud;
    state.numbers(s.points, s.non_finite, s.box.has_value());
    state.point(s.box ? s.box->min : point3{});
    state.point(s.box ? s.box->max : point3{});
    state.number(s.fits_float32);
    state.real(s.las_moved);
    state.number(s.sources.size());
    for (const mesh_file& one : s.sources) {
        state.numbers(points_of(one), is_single(one));
        state.text(one.format);
    }
    state.number(s.ranges.size());
    for (const value_range& r : s.ranges) {
        state.text(r.column);
        state.real(r.min);
        state.real(r.max);
        state.number(r.whole);
    }
    store_warnings(s.warnings, state);
}

point_survey load_survey(state_reader& state) {
    point_survey survey;
    cloud_survey& s = survey.cloud;
    s.points = state.number();
    s.non_finite = state.number();
    const bool has_box = state.number() != 0;
    if (const box3 box{state.point(), state.point()}; has_box) s.box = box;
    s.fits_float32 = state.number() != 0;
    s.las_moved = state.real();
    for (std::uint64_t left = state.number(); left > 0 && state.whole(); --left) {
        const std::uint64_t points = state.number();
        const bool single = state.number() != 0;
        count_points(s.sources.emplace_back(source_of(state.text())), points, single);
    }
    for (std::uint64_t left = state.number(); left > 0 && state.whole(); --left)
        s.ranges.push_back({state.text(), state.real(), state.real(), state.number() != 0});
    s.warnings = load_warnings(state);
    return survey;
}

las_header las_grid_of(const pass_of_points& each, const communicator& all,
                       const io::las_grid_wish& wish) {
    las_grid_choice choice;
    look_at_all(choice, each, all);
    while (!try_on_all(choice, each, all)) {
    }
    las_header header;
    choice.put(header, wish);
    return header;
}

las_header las_grid_of(joined_points& points, const communicator& all, const share& mine,
                       cancellable_progress& pace, const io::las_grid_wish& wish) {
    const auto each = [&](const std::function<void(points_view)>& take) {
        io::point_block block;
        points.rewind(mine);
        while (points.read(block, points_a_block)) {
            take(block.points);
            pace.check();
        }
    };
    return las_grid_of(each, all, wish);
}

}  // namespace treeform::detail::stream
