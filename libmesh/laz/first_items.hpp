#pragma once
/// \file
/// The items of formats 0 to 3 in version 1, as packed by LASzip until 2011. The library reads
/// them; only tests write them.
///
/// \source Isenburg, LASzip: Lossless Compression of LiDAR Data, PE&RS 79 (2013)

#include <libmesh/laz/entropy.hpp>
#include <libmesh/laz/integer_code.hpp>
#include <libmesh/laz/items.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

namespace treeform::detail::laz {

class first_point_item {
  public:
    static constexpr std::size_t size = 20;

    explicit first_point_item(const std::uint8_t* first) { std::memcpy(last_.data(), first, size); }

    template <class Coder>
    void code(Coder& c, std::uint8_t* p) {
        const auto step = [&](std::size_t at, integer_code& code,
                              std::array<std::int32_t, 3>& steps, unsigned context) {
            const std::int32_t was = get32(last_.data() + at);
            const std::int32_t by =
                code.code(c, middle(steps), difference(get32(p + at), was), context);
            put32(p + at, sum(was, by));
            steps[oldest_] = by;
        };
        step(0, x_, x_steps_, 0);
        step(4, y_, y_steps_, std::min(x_.last_size(), 19u));
        oldest_ = (oldest_ + 1) % 3;
        const unsigned size_xy = (x_.last_size() + y_.last_size()) / 2;
        put32(p + 8, z_.code(c, get32(last_.data() + 8), get32(p + 8), std::min(size_xy, 19u)));
        others(c, p, size_xy);
        std::memcpy(last_.data(), p, size);
    }

  private:
    static constexpr std::size_t intensity = 12, flags = 14, classification = 15, angle = 16,
                                 user = 17, source = 18;

    [[nodiscard]] static std::int32_t middle(const std::array<std::int32_t, 3>& s) {
        return std::max(std::min(s[0], s[1]), std::min(std::max(s[0], s[1]), s[2]));
    }

    template <class Coder>
    void others(Coder& c, std::uint8_t* p, unsigned size_xy) {
        const auto differs = [&](std::size_t at) { return p[at] != last_[at] ? 1u : 0u; };
        unsigned changed = 0;
        if constexpr (Coder::writes)
            changed = (differs(intensity) | differs(intensity + 1)) << 5 | differs(flags) << 4 |
                      differs(classification) << 3 | differs(angle) << 2 | differs(user) << 1 |
                      differs(source) | differs(source + 1);
        changed = c.symbol(changed_, changed);
        const auto word = [&](unsigned bit, std::size_t at, integer_code& code) {
            const std::uint16_t was = get16(last_.data() + at);
            put16(p + at, (changed & bit) != 0
                              ? static_cast<std::uint32_t>(code.code(c, was, get16(p + at)))
                              : was);
        };
        const auto byte = [&](unsigned bit, std::size_t at, std::vector<symbol_model>& models) {
            p[at] = (changed & bit) != 0
                        ? low_byte(static_cast<int>(c.symbol(models[last_[at]], p[at])))
                        : last_[at];
        };
        word(32, intensity, intensities_);
        byte(16, flags, flags_);
        byte(8, classification, classes_);
        p[angle] = (changed & 4) != 0
                       ? low_byte(angles_.code(c, last_[angle], p[angle], size_xy < 3 ? 1 : 0))
                       : last_[angle];
        byte(2, user, users_);
        word(1, source, sources_);
    }

    std::array<std::uint8_t, size> last_{};
    std::array<std::int32_t, 3> x_steps_{};
    std::array<std::int32_t, 3> y_steps_{};
    std::size_t oldest_ = 0;
    symbol_model changed_{64};
    std::vector<symbol_model> flags_ = models(256, 256);
    std::vector<symbol_model> classes_ = models(256, 256);
    std::vector<symbol_model> users_ = models(256, 256);
    integer_code intensities_{16, 1};
    integer_code angles_{8, 2};
    integer_code sources_{16, 1};
    integer_code x_{32, 1};
    integer_code y_{32, 20};
    integer_code z_{32, 20};
};

/// GPS times in one sequence, coded as multiples of the last step.
class first_gps_time_item {
  public:
    static constexpr std::size_t size = 8;

    explicit first_gps_time_item(const std::uint8_t* first) : time_(get64(first)) {}

    template <class Coder>
    void code(Coder& c, std::uint8_t* p) {
        const std::uint64_t is = get64(p);
        // The encoder stores times uncompressed: only tests write this version.
        const bool same = is == time_;
        if (step_ == 0) {
            const unsigned code = c.symbol(first_step_, same ? 0 : 2);
            if (code == 1) move(step_ = steps_.code(c, 0, 0, 0));
            if (code == 2) time_ = bits64(c, is);
        } else {
            const unsigned code = c.symbol(multiple_, same ? most + 2 : most + 1);
            if (code <= most) by_multiple(c, static_cast<int>(code));
            if (code == most + 1) time_ = bits64(c, is);
        }
        put64(p, time_);
    }

  private:
    static constexpr unsigned most = 509;  ///< largest multiple

    void move(std::int32_t by) { time_ += static_cast<std::uint64_t>(std::int64_t{by}); }

    template <class Coder>
    void by_multiple(Coder& c, int multiple) {
        const bool zero = multiple == 0;
        const unsigned context = multiple == 1   ? 1
                                 : zero          ? 2
                                 : multiple < 10 ? 3
                                 : multiple < 50 ? 4
                                                 : 5;
        const std::int32_t by =
            steps_.code(c, zero ? step_ / 4 : product(multiple, step_), 0, context);
        if (multiple == 1) {
            step_ = by;
            unusual_ = 0;
        } else if ((zero || multiple == static_cast<int>(most)) && ++unusual_ > 3) {
            step_ = by;
            unusual_ = 0;
        }
        move(by);
    }

    std::uint64_t time_;
    std::int32_t step_ = 0;
    int unusual_ = 0;  ///< consecutive steps that were not a multiple of `step_`
    symbol_model multiple_{most + 3};
    symbol_model first_step_{3};
    integer_code steps_{32, 6};
};

class first_color_item {
  public:
    static constexpr std::size_t size = 6;

    explicit first_color_item(const std::uint8_t* first) { std::memcpy(last_.data(), first, size); }

    template <class Coder>
    void code(Coder& c, std::uint8_t* p) {
        unsigned changed = 0;
        if constexpr (Coder::writes)
            for (unsigned i = 0; i < size; ++i)
                if (p[i] != last_[i]) changed |= 1u << i;
        changed = c.symbol(changed_, changed);
        for (unsigned i = 0; i < size; ++i) {
            p[i] =
                (changed >> i & 1u) != 0 ? low_byte(bytes_.code(c, last_[i], p[i], i)) : last_[i];
            last_[i] = p[i];
        }
    }

  private:
    std::array<std::uint8_t, size> last_{};
    symbol_model changed_{64};
    integer_code bytes_{8, 6};
};

}  // namespace treeform::detail::laz
