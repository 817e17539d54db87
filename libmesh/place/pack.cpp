#include <libmesh/base/for_numbers.hpp>
#include <libmesh/base/max_displacement.hpp>
#include <libmesh/base/prepared_ref.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/place/filling.hpp>
#include <libmesh/place/shape.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/pack.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace treeform {
namespace {

using detail::place::filling;
using detail::place::filling_style;
using detail::place::pack_shapes;

/// Tries that run at once after the first: not by the number of threads, for the same result.
constexpr unsigned tries_at_once = 8;

void check(const pack_options& o) {
    const auto refuse = [](const char* what) {
        throw std::invalid_argument(std::string("treeform::pack: ") + what);
    };
    for (std::size_t k = 0; k < 3; ++k) {
        if (!(o.size[k] >= 0.0) || (k < 2 && std::isinf(o.size[k])))
            refuse("a size of the plate is negative or not finite");
        if (!std::isfinite(o.corner[k])) refuse("the corner of the plate is not finite");
        if (!std::isfinite(o.plate_step[k])) refuse("the step between plates is not finite");
    }
    if (!(o.spacing >= 0.0) || std::isinf(o.spacing))
        refuse("the spacing is negative or not finite");
    if (o.stack && std::isinf(o.size.z)) refuse("the box to be filled has no height");
    if (o.turns == 0 || 24 % o.turns != 0) refuse("turns is not 1, 2, 3, 4, 6, 8, 12 or 24");
    if (o.plates == 0) refuse("the number of plates is 0");
    if (o.tries == 0) refuse("the number of tries is 0");
    if (!(o.seconds >= 0.0)) refuse("the time limit is negative or NaN");
}

/// What is known of a try.
struct outcome {
    unsigned number = 0;
    std::vector<std::uint32_t> order{}, left{};
    double room_left = 0.0;
    unsigned plates_used = 0;
    std::vector<packed_part> parts{};

    [[nodiscard]] auto rank() const {
        return std::tuple(left.size(), room_left, plates_used, number);
    }
};

class trying {
  public:
    trying(const pack_shapes& shapes, const pack_options& options,
           detail::base::work_progress& work)
        : shapes_(shapes), options_(options), work_(work) {
        const point3& size = options.size;
        const double plate = size.x * size.y * (options.stack ? size.z : 1.0);
        for (std::uint32_t i = 0; i < shapes.size(); ++i) {
            total_ += shapes[i].room;
            placeable_ += shapes[i].candidates.empty() ? 0 : 1;
        }
        plates_needed_ = std::max(1.0, std::ceil(0.999 * total_ / plate));
    }

    /// One try, then several at once, until there is nothing to gain.
    void run() {
        const auto begin = std::chrono::steady_clock::now();
        const auto late = [&] {
            const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
            return spent.count() >= options_.seconds;
        };
        for (unsigned first = 0; first < options_.tries && !satisfied() && !work_.cancelled();) {
            const unsigned end = first == 0 ? 1 : std::min(options_.tries, first + tries_at_once);
            known_ = best_;
            detail::base::for_numbers(end - first, 1, [&](std::size_t i) {
                if (first == 0 || !late()) make(first + static_cast<unsigned>(i));
            });
            if (first > 0 && late()) break;
            first = end;
        }
    }

    [[nodiscard]] outcome& best() { return best_; }
    [[nodiscard]] unsigned made() const { return made_; }
    [[nodiscard]] std::uint64_t pairs_measured() const { return measured_; }
    [[nodiscard]] double total() const { return total_; }

  private:
    [[nodiscard]] bool satisfied() const {
        return made_ > 0 && best_.left.empty() && best_.plates_used <= plates_needed_;
    }

    void make(unsigned number) {
        std::mt19937_64 engine(options_.seed * 1'000'003 + number);
        outcome one{.number = number, .order = order(number, engine)};
        const filling_style style = style_of(number, engine);
        filling plates(shapes_, options_, style);
        for (const std::uint32_t part : one.order) {
            const double all = static_cast<double>(options_.tries) *
                               static_cast<double>(std::max<std::size_t>(placeable_, 1));
            if (!work_.reach(0.2 + 0.8 * static_cast<double>(++puts_) / all)) return;
            plates.put(part);
            // No better than what there was before this and its neighbors.
            if (number > 0 && plates.left().size() > known_.left.size()) break;
        }
        one.left = plates.left();
        one.room_left = plates.room_left();
        one.plates_used = plates.plates_used();
        const std::lock_guard lock(mutex_);
        ++made_;
        measured_ += plates.pairs_measured();
        if (made_ > 1 && !(one.rank() < best_.rank())) return;
        one.parts = plates.take_parts();
        best_ = std::move(one);
    }

    /// The parts by their room, then by their longest side; later with that changed at random, or
    /// as in the best try so far with those that found no place, and some others, brought forward.
    [[nodiscard]] std::vector<std::uint32_t> order(unsigned number, std::mt19937_64& engine) const {
        const auto random = [&] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
        std::vector<double> weight(shapes_.size());
        for (std::uint32_t i = 0; i < shapes_.size(); ++i) {
            const double change = random();
            weight[i] = number % 4 < 2 ? shapes_[i].room : shapes_[i].longest;
            if (number >= 4) weight[i] = shapes_[i].room * (0.5 + change);
        }
        if (number >= 4 && number % 2 == 0) {
            const std::size_t count = known_.order.size();
            for (std::size_t k = 0; k < count; ++k)
                weight[known_.order[k]] = static_cast<double>(count - k) + 4.0 * random();
            for (const std::uint32_t i : known_.left)
                weight[i] += random() * static_cast<double>(count);
        }
        std::vector<std::uint32_t> order;
        for (std::uint32_t i = 0; i < shapes_.size(); ++i)
            if (!shapes_[i].candidates.empty()) order.push_back(i);
        std::stable_sort(order.begin(), order.end(),
                         [&](auto i, auto j) { return weight[i] > weight[j]; });
        return order;
    }

    [[nodiscard]] filling_style style_of(unsigned number, std::mt19937_64& engine) const {
        filling_style style{.square = number % 2 == 1, .compact = number >= 4 && number % 8 >= 4};
        if (number >= 4 && number % 4 >= 2)
            for (std::uint32_t i = 0; i < shapes_.size(); ++i) {
                const auto turn = static_cast<std::uint32_t>(engine() >> 33);
                style.only_turn.push_back(turn % 3 == 0 ? turn / 3 : 0);
            }
        return style;
    }

    const pack_shapes& shapes_;
    const pack_options& options_;
    detail::base::work_progress& work_;
    double total_ = 0.0;
    std::size_t placeable_ = 0;
    double plates_needed_ = 1.0;
    outcome best_{}, known_{};  ///< of all; of those before the ones that run now
    unsigned made_ = 0;
    std::uint64_t measured_ = 0;
    std::atomic<std::size_t> puts_{0};
    std::mutex mutex_;
};

}  // namespace

std::string packing::message() const {
    if (!certificate) return certificate.message();
    const auto parts_in_words = [](std::size_t count) {
        return std::to_string(count) + (count == 1 ? " part" : " parts");
    };
    const std::size_t all = parts.size();
    std::string text =
        std::to_string(all - not_placed.size()) + " of " + parts_in_words(all) + " placed";
    if (plates_used > 1) text += " on " + std::to_string(plates_used) + " plates";
    if (not_placed.empty()) return text;
    return text + "; no arrangement of all was found in " + std::to_string(tries) +
           (tries == 1 ? " try" : " tries");
}

packing pack(const mesh_refs& given_parts, const pack_options& given_options) {
    pack_options options = given_options;
    if (options.size.z == 0.0) options.size.z = std::numeric_limits<double>::infinity();
    const detail::base::prepared_refs all_parts(given_parts);
    const std::span<const prepared_mesh> parts = all_parts;
    check(options);
    for (std::size_t i = 0; i < parts.size(); ++i)
        detail::place::check_operand("pack", "part " + std::to_string(i), parts[i].indexed_view());
    detail::base::work_progress work(options.progress);
    const pack_shapes shapes(parts, options, work.part(0.0, 0.2));
    trying search(shapes, options, work);
    if (!work.cancelled()) search.run();
    if (!work.reach(1.0)) return {.certificate = {.status = status::cancelled}};

    packing found;
    found.parts = std::move(search.best().parts);
    found.plates_used = search.best().plates_used;
    found.tries = search.made();
    found.pairs_measured = search.pairs_measured();
    found.bed = detail::place::not_below(options.corner.z, options.precision);
    found.certificate.precision = options.precision;
    double& moved = found.certificate.max_displacement;
    double room = 0.0;
    for (std::uint32_t i = 0; i < parts.size(); ++i) {
        const packed_part& part = found.parts[i];
        const points_view given = parts[i].indexed_view().points;
        moved = std::max(moved, detail::max_displacement(given, part.matrix, part.points));
        if (part.placed)
            room += shapes[i].room;
        else
            found.not_placed.push_back(i);
    }
    const double plate = options.size.x * options.size.y * (options.stack ? options.size.z : 1.0);
    if (found.plates_used > 0) found.density = room / (found.plates_used * plate);
    return found;
}

}  // namespace treeform
