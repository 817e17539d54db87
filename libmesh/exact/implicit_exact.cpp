#include <libmesh/exact/exact_place.hpp>
#include <libmesh/exact/filter.hpp>
#include <libmesh/exact/implicit_exact.hpp>
#include <libmesh/exact/lattice.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace treeform::detail::exact {
namespace {

using origin = implicit_point::origin;

/// A point of a call: how it is defined, and where its definition begins.
struct item {
    origin kind;
    std::size_t first;
};

/// Answers with the points of a call in one number type.
template <class Place, class Number>
struct located {
    const vector3<Number>* numbers;
    int unit;  ///< the numbers count 2^unit

    [[nodiscard]] Place operator()(item i) const {
        return place_of<Place>(i.kind, numbers + i.first);
    }
};

/// All given points that a call is about, and the least width that holds them.
class call {
  public:
    explicit call(predicate_counters* counters) : counters_(counters) {}

    item add(const implicit_point& p) {
        constexpr std::array<std::size_t, 5> defining = {1, 4, 5, 9, 4};
        const item result{p.radius() == 0.0 ? origin::given : p.kind(), size_};
        if (result.kind == origin::given) {
            points_[size_++] = vector_of(p.center());
            return result;
        }
        for (std::size_t i = 0; i < defining[static_cast<std::size_t>(result.kind)]; ++i)
            points_[size_++] = vector_of(p.definition()[i]);
        large_ |= result.kind == origin::planes;
        return result;
    }
    std::size_t add(const plane_points& p) {
        for (const point3* corner : {&p.a, &p.b, &p.c}) points_[size_++] = vector_of(*corner);
        return size_ - 3;
    }

    /// What `question` answers, given a `located`.
    template <class Question>
    auto answer(const Question& question) const {
        std::array<vector3<integer<1>>, most> words;
        if (int unit = 0; as_words(words, unit)) return counted<1>(question, words.data(), unit);
        lattice grid;
        for (std::size_t i = 0; i < size_; ++i)
            for (const double x : {points_[i].x, points_[i].y, points_[i].z})
                grid.add(odd_part_of(x));
        if (grid.bits() <= most_bits<2>) return answer_in_two_limbs(question, grid);
        return answer_in_any(question, grid);
    }

  private:
    static constexpr std::size_t most = 30;  ///< three times nine, and a plane
    /// See the head of exact_place.hpp.
    template <std::size_t Limbs>
    static constexpr int most_bits = 64 * static_cast<int>(Limbs) - 3;

    /// Sets the words where they hold all; most calls' do.
    bool as_words(std::array<vector3<integer<1>>, most>& words, int& unit) const {
        double largest = 0.0;
        for (std::size_t i = 0; i < size_; ++i)
            for (const double x : {points_[i].x, points_[i].y, points_[i].z})
                largest = std::abs(x) > largest ? std::abs(x) : largest;
        const word_scale scale(largest);
        if (!scale.usable()) return false;
        std::uint64_t differing = 0;
        std::uint64_t all = 0;
        for (std::size_t i = 0; i < size_; ++i) {
            words[i] = transform(points_[i], [&](double x) {
                const auto w = static_cast<std::uint64_t>(scale.word_of(x, differing).value);
                all |= w;
                return integer<1>{{w}};
            });
        }
        const int zeros = std::countr_zero(all);
        if (differing << 1 != 0 || word_scale::bits - zeros > most_bits<1>) return false;
        for (std::size_t i = 0; i < size_; ++i)
            words[i] = transform(words[i], [&](const integer<1>& w) {
                const auto value = static_cast<std::int64_t>(w.limbs[0]) >> zeros;
                return integer<1>{{static_cast<std::uint64_t>(value)}};
            });
        unit = scale.unit() + zeros;
        return true;
    }

    template <class Question>
    [[gnu::noinline]] auto answer_in_two_limbs(const Question& question,
                                               const lattice& grid) const {
        std::array<vector3<integer<2>>, most> numbers;
        for (std::size_t i = 0; i < size_; ++i)
            numbers[i] = transform(points_[i],
                                   [&](double x) { return integer_on<2>(grid, odd_part_of(x)); });
        return counted<2>(question, numbers.data(), grid.lowest - 1075);
    }

    template <class Question>
    [[gnu::noinline]] auto answer_in_any(const Question& question, const lattice& grid) const {
        std::vector<vector3<dyadic>> numbers;
        numbers.reserve(size_);
        for (std::size_t i = 0; i < size_; ++i)
            numbers.push_back(transform(points_[i], [&](double x) {
                const odd_part p = odd_part_of(x);
                return p.odd == 0 ? dyadic()
                                  : dyadic(p.odd, p.negative != 0, p.lowest - grid.lowest);
            }));
        return counted<predicate_counters::widths - 1>(question, numbers.data(),
                                                       grid.lowest - 1075);
    }

    template <std::size_t WidthClass, class Question, class Number>
    [[gnu::noinline]] auto counted(const Question& question, const vector3<Number>* numbers,
                                   int unit) const {
        if (counters_) ++counters_->by_width[WidthClass];
        using places = places_of<Number>;
        if constexpr (!std::is_same_v<typename places::small, typename places::large>)
            if (!large_) return question(located<typename places::small, Number>{numbers, unit});
        return question(located<typename places::large, Number>{numbers, unit});
    }

    std::array<vector3<double>, most> points_;  // `size_` of them are set
    std::size_t size_ = 0;
    bool large_ = false;
    predicate_counters* counters_;
};

const dyadic& dyadic_of(const dyadic& a) { return a; }

template <std::size_t Limbs>
dyadic dyadic_of(const integer<Limbs>& a) {
    return dyadic((a.negative() ? integer<Limbs>{} - a : a).limbs, a.negative());
}

}  // namespace

int compare_exact(int axis, const implicit_point& a, const implicit_point& b,
                  predicate_counters* counters) {
    call about(counters);
    const item p = about.add(a);
    const item q = about.add(b);
    return about.answer([&](const auto& at) { return compare_places(axis, at(p), at(q)); });
}

bool equal_exact(const implicit_point& a, const implicit_point& b, predicate_counters* counters) {
    call about(counters);
    const item p = about.add(a);
    const item q = about.add(b);
    return about.answer([&](const auto& at) {
        const auto first = at(p);
        const auto second = at(q);
        return compare_places(0, first, second) == 0 && compare_places(1, first, second) == 0 &&
               compare_places(2, first, second) == 0;
    });
}

int orient2d_exact(int axis, const implicit_point& a, const implicit_point& b,
                   const implicit_point& c, predicate_counters* counters) {
    call about(counters);
    const item p = about.add(a);
    const item q = about.add(b);
    const item r = about.add(c);
    return about.answer(
        [&](const auto& at) { return orient2d_of_places(axis, at(p), at(q), at(r)); });
}

int side_exact(const plane_points& p, const implicit_point& d, predicate_counters* counters) {
    call about(counters);
    const std::size_t plane = about.add(p);
    const item point = about.add(d);
    return about.answer(
        [&](const auto& at) { return side_of_place(at.numbers + plane, at(point)); });
}

std::array<rounded_quotient, 3> rounded_exactly(const implicit_point& p,
                                                const float_format& format) {
    call about(nullptr);
    const item point = about.add(p);
    return about.answer([&](const auto& at) {
        const auto place = at(point);
        const dyadic& under = dyadic_of(place.under);
        if (sign_of(under) == 0)
            throw std::invalid_argument("implicit_point: no single common point");
        const auto round = [&](const auto& x) {
            return quotient(dyadic_of(x), under, at.unit, format);
        };
        return std::array{round(place.over.x), round(place.over.y), round(place.over.z)};
    });
}

}  // namespace treeform::detail::exact
