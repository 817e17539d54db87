#include <libmesh/base/work_progress.hpp>
#include <libmesh/place/plate.hpp>
#include <libmesh/place/shape.hpp>
#include <treeform/mesh/pack.hpp>
#include <treeform/mesh/rounding.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace treeform {
namespace {

using detail::place::cell_place;
using detail::place::footprint;
using detail::place::plate;
using detail::place::turned_part;

void check(const pack_options& o) {
    const auto refuse = [](const char* what) {
        throw std::invalid_argument(std::string("treeform::pack: ") + what);
    };
    for (std::size_t k = 0; k < 3; ++k) {
        if (!(o.size[k] >= 0.0) || (k < 2 && std::isinf(o.size[k])))
            refuse("a size of the plate is negative or not finite");
        if (!std::isfinite(o.corner[k])) refuse("the corner of the plate is not finite");
    }
    if (!(o.spacing >= 0.0) || std::isinf(o.spacing))
        refuse("the spacing is negative or not finite");
    if (o.attempts == 0) refuse("no attempt is allowed");
}

/// Number of 15 degree steps of the turns to try.
std::vector<unsigned> turns_of(plate_turns set) {
    unsigned step = 24;
    if (set == plate_turns::quarter) step = 6;
    if (set == plate_turns::eighth) step = 3;
    if (set == plate_turns::any) step = 1;
    std::vector<unsigned> turns;
    for (unsigned turn = 0; turn < 24; turn += step) turns.push_back(turn);
    return turns;
}

/// A part in one of its turns, seen from above.
struct candidate {
    unsigned turn = 0;
    double width = 0.0;
    double depth = 0.0;
    footprint cells{};
};

struct part_shape {
    std::vector<candidate> candidates{};  ///< those that are not larger than the plate
    double area = 0.0;                    ///< covered, of the first
};

/// As fine as the smallest part asks for, within limits.
double cell_length(std::span<const mesh_view> parts, const pack_options& o) {
    const double longest = std::max(o.size.x, o.size.y);
    double cell = longest / 512;
    for (const mesh_view part : parts) {
        if (part.faces.empty()) continue;
        const turned_part as_is(part, 0);
        cell = std::min(cell, std::min(as_is.size().x, as_is.size().y) / 4);
    }
    return std::max(cell, longest / 2048);
}

/// Whether a turn covers other cells than those before, as one of a box by 180 degrees does not.
bool is_new(const part_shape& s, const candidate& c) {
    return std::none_of(s.candidates.begin(), s.candidates.end(),
                        [&](const candidate& other) { return other.cells == c.cells; });
}

std::vector<part_shape> shapes_of(std::span<const mesh_view> parts, const pack_options& o,
                                  double cell, const progress_callback& progress) {
    const std::vector<unsigned> turns = turns_of(o.turns);
    std::vector<candidate> all(parts.size() * turns.size());
    detail::base::work_progress work(progress);
    std::atomic<std::size_t> begun{0};
    const double share = 1.0 / static_cast<double>(std::max<std::size_t>(all.size(), 1));
    for_chunks(all.size(), 1, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            const mesh_view part = parts[i / turns.size()];
            if (!work.reach(static_cast<double>(begun++) * share)) return;
            if (part.faces.empty()) continue;
            const turned_part there(part, turns[i % turns.size()]);
            const point3& size = there.size();
            if (!(size.x <= o.size.x && size.y <= o.size.y && size.z <= o.size.z)) continue;
            if (cell > 0.0)
                all[i] = {there.turn(), size.x, size.y,
                          detail::place::cells_covered(there.mesh(), 0.0, 0.0, cell)};
        }
    });
    std::vector<part_shape> shapes(parts.size());
    for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i].cells.cells != 0 && is_new(shapes[i / turns.size()], all[i]))
            shapes[i / turns.size()].candidates.push_back(std::move(all[i]));
    for (part_shape& s : shapes)
        if (!s.candidates.empty())
            s.area = static_cast<double>(s.candidates[0].cells.cells) * cell * cell;
    return shapes;
}

/// One filling of the plate, part by part.
class filling {
  public:
    filling(std::span<const mesh_view> parts, const std::vector<part_shape>& shapes,
            const pack_options& options, double cell, bool square)
        : parts_(parts),
          shapes_(shapes),
          options_(options),
          cell_(cell),
          plate_(options, cell, square) {}

    /// At the first free places of all its turns, and of these where it reaches least far.
    bool put(std::uint32_t part) {
        std::vector<search> searches;
        for (const candidate& c : shapes_[part].candidates) searches.push_back(begin(c));
        for_chunks(searches.size(), 1, [&](std::size_t first, std::size_t end, std::size_t) {
            for (std::size_t i = first; i < end; ++i) find(searches[i]);
        });
        // Nothing that is taken gets free again: the next part of that shape starts from here.
        for (const search& s : searches)
            searched_[s.what->cells] = s.found.value_or(cell_place{s.last.row + 1, 0});
        for (unsigned tries = 0; tries < most_tries; ++tries) {
            search* best = nullptr;
            for (search& s : searches)
                if (s.found && (best == nullptr || reach(s) < reach(*best))) best = &s;
            if (best == nullptr) return false;
            if (plate_.put(part, parts_[part], best->what->turn, *best->found)) return true;
            next(*best);
        }
        return false;
    }

    [[nodiscard]] plate& result() { return plate_; }

  private:
    /// The free places of a part in one of its turns, one after the other.
    struct search {
        const candidate* what;
        cell_place inside;  ///< the last place on the plate
        cell_place last;    ///< the last that the gaps of the raster may let it be moved from
        cell_place from;
        std::uint32_t skip = 1;         ///< rows not to look beyond `inside` after the next failure
        std::uint32_t beyond_from = 0;  ///< row
        std::optional<cell_place> found{};

        [[nodiscard]] bool beyond() const {
            return found->row > inside.row || found->column > inside.column;
        }
    };

    search begin(const candidate& c) {
        const auto cells = [&](double room, double more) {
            return static_cast<std::uint32_t>(std::floor(room / cell_ + 1e-6 + more));
        };
        const double more = options_.tighten ? 3.0 : 0.0;
        const double x = options_.size.x - c.width, y = options_.size.y - c.depth;
        return {&c,
                {cells(y, 0.0), cells(x, 0.0)},
                {cells(y, more), cells(x, more)},
                searched_[c.cells]};
    }

    void find(search& s) const {
        while (true) {
            s.found = plate_.raster().first_free(s.what->cells, s.from, s.last);
            if (!s.found || !s.beyond() || s.found->row > s.inside.row ||
                s.found->row >= s.beyond_from)
                return;
            s.from = {s.found->row + 1, 0};
        }
    }

    void next(search& s) const {
        s.from = {s.found->row, s.found->column + 1};
        if (s.beyond()) {  // what cannot be moved in cannot a little further up, most likely
            s.from = {s.found->row + 1, 0};
            s.beyond_from = s.found->row + s.skip;
            s.skip *= 2;
        }
        find(s);
    }

    [[nodiscard]] std::tuple<double, double> reach(const search& s) const {
        return {s.found->row * cell_ + s.what->depth, s.found->column * cell_ + s.what->width};
    }

    static constexpr unsigned most_tries = 24;

    std::span<const mesh_view> parts_;
    const std::vector<part_shape>& shapes_;
    const pack_options& options_;
    double cell_;
    plate plate_;
    std::map<footprint, cell_place> searched_;
};

/// The parts by descending area, the first two times; later with areas changed at random.
std::vector<std::uint32_t> order_of(const std::vector<part_shape>& shapes, std::uint64_t seed,
                                    unsigned attempt) {
    std::mt19937_64 engine(seed * 1'000'003 + attempt);
    std::vector<double> weight;
    for (const part_shape& s : shapes) {
        const double change = static_cast<double>(engine() >> 11) * 0x1p-53;
        weight.push_back(attempt < 2 ? s.area : s.area * (0.5 + change));
    }
    std::vector<std::uint32_t> order;
    for (std::uint32_t i = 0; i < shapes.size(); ++i)
        if (!shapes[i].candidates.empty()) order.push_back(i);
    std::stable_sort(order.begin(), order.end(),
                     [&](auto i, auto j) { return weight[i] > weight[j]; });
    return order;
}

}  // namespace

packing pack(std::span<const mesh_view> parts, const pack_options& options) {
    check(options);
    for (std::size_t i = 0; i < parts.size(); ++i)
        detail::place::check_operand("pack", "part " + std::to_string(i), parts[i]);
    const double cell = cell_length(parts, options);
    detail::base::work_progress work(options.progress);
    const std::vector<part_shape> shapes = shapes_of(parts, options, cell, work.part(0.0, 0.2));

    packing best;
    best.bed = detail::place::not_below(options.corner.z, options.precision);
    best.certificate.precision = options.precision;
    const auto count = static_cast<double>(parts.size());
    double least_left = -1.0;
    for (unsigned attempt = 0; attempt < options.attempts && least_left != 0.0; ++attempt) {
        filling one(parts, shapes, options, cell, attempt % 2 == 1);
        double left = 0.0;
        std::size_t tried = 0;
        for (const std::uint32_t part : order_of(shapes, options.seed, attempt)) {
            const double all = static_cast<double>(options.attempts) * count;
            const double done = static_cast<double>(attempt) * count + static_cast<double>(tried++);
            if (!work.reach(0.2 + 0.8 * done / all))
                return {.certificate = {.status = status::cancelled}};
            if ((least_left < 0.0 || left < least_left) && !one.put(part))
                left += shapes[part].area;
        }
        const std::uint64_t measured = best.pairs_measured + one.result().pairs_measured();
        if (least_left < 0.0 || left < least_left) {
            least_left = left;
            best.parts = one.result().take_parts(parts);
        }
        best.pairs_measured = measured;
    }
    double& moved = best.certificate.max_displacement;
    for (std::uint32_t i = 0; i < parts.size(); ++i) {
        const packed_part& part = best.parts[i];
        moved = std::max(moved, max_displacement(parts[i].points, part.matrix, part.points));
        if (!part.placed) best.not_placed.push_back(i);
    }
    if (!work.reach(1.0)) return {.certificate = {.status = status::cancelled}};
    return best;
}

packing pack(std::span<const prepared_mesh> parts, const pack_options& options) {
    std::vector<mesh_view> views;
    for (const prepared_mesh& part : parts) views.push_back(part.view());
    return pack(views, options);
}

}  // namespace treeform
