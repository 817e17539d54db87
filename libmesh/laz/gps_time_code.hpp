#pragma once
/// \file
/// GPS times: the bits of a double as an integer, coded as multiples of the usual step, in up to
/// four interleaved sequences.
///
/// \source Isenburg, LASzip (2013), "GPS time"; LASzip for LAS 1.4, Specification Document

#include <libmesh/laz/entropy.hpp>
#include <libmesh/laz/integer_code.hpp>

#include <array>
#include <cstdint>

namespace treeform::detail::laz {

/// `may_repeat`: whether a repeated time has a code of its own (formats 1 to 5), or is known from
/// elsewhere (formats 6 to 10).
class gps_time_code {
  public:
    gps_time_code(bool may_repeat, std::uint64_t first)
        : repeat_codes_(may_repeat ? 1 : 0),
          multiple_(most + least + 5 + repeat_codes_),
          first_step_(5 + repeat_codes_) {
        sequences_[0].time = first;
    }

    template <class Coder>
    std::uint64_t code(Coder& c, std::uint64_t time) {
        // In valid data, a code "another sequence" is followed by a code of a different kind.
        for (int hops = 0; hops < 8; ++hops) {
            const bool stepped = sequences_[now_].step != 0;
            const answer a = stepped ? by_multiple(c, time) : by_first_step(c, time);
            if (a == answer::done) return sequences_[now_].time;
        }
        throw damaged("compressed GPS times are damaged");
    }

  private:
    enum class answer : std::uint8_t { done, other_sequence };
    struct sequence {
        std::uint64_t time = 0;
        std::int32_t step = 0;
        int unusual = 0;  ///< consecutive steps that were not a multiple of `step`
    };
    static constexpr int most = 500;  ///< largest multiple
    static constexpr int least = 10;  ///< largest multiple backwards

    /// Whether the step from the last time of a sequence to `time` fits into 32 bits.
    [[nodiscard]] static bool near(const sequence& s, std::uint64_t time) {
        const auto by = static_cast<std::int64_t>(time - s.time);
        return by == static_cast<std::int32_t>(static_cast<std::uint32_t>(by));
    }
    [[nodiscard]] static std::int32_t step_to(const sequence& s, std::uint64_t time) {
        return static_cast<std::int32_t>(static_cast<std::uint32_t>(time - s.time));
    }
    static void move(sequence& s, std::int32_t by) {
        s.time += static_cast<std::uint64_t>(std::int64_t{by});
    }
    /// The offset (1 to 3) to the next other sequence that is near `time`; 0 if there is none.
    [[nodiscard]] unsigned near_sequence(std::uint64_t time) const {
        for (unsigned i = 1; i < 4; ++i)
            if (near(sequences_[(now_ + i) & 3], time)) return i;
        return 0;
    }

    /// The codes are: same time, a step, a new sequence, another sequence.
    template <class Coder>
    answer by_first_step(Coder& c, std::uint64_t time) {
        sequence& s = sequences_[now_];
        const unsigned step = repeat_codes_;
        unsigned code = 0;
        if constexpr (Coder::writes) {
            if (repeat_codes_ != 0 && time == s.time)
                code = 0;
            else if (near(s, time))
                code = step;
            else
                code = step + 1 + near_sequence(time);
        }
        code = c.symbol(first_step_, code);
        if (code < step) return answer::done;
        if (code == step) {
            s.step = steps_.code(c, 0, step_to(s, time), 0);
            s.unusual = 0;
            move(s, s.step);
            return answer::done;
        }
        if (code == step + 1) return new_sequence(c, time);
        return hop(code - step - 1);
    }

    /// The codes are: a multiple 0 to 500, a multiple -1 to -10, same time, a new sequence, another
    /// sequence.
    template <class Coder>
    answer by_multiple(Coder& c, std::uint64_t time) {
        sequence& s = sequences_[now_];
        constexpr unsigned multiples = most + least + 1;
        const unsigned fresh = multiples + repeat_codes_;
        unsigned code = 0;
        if constexpr (Coder::writes) {
            if (repeat_codes_ != 0 && time == s.time)
                code = multiples;
            else if (near(s, time))
                code = code_of(nearest_multiple(step_to(s, time), s.step));
            else
                code = fresh + near_sequence(time);
        }
        code = c.symbol(multiple_, code);
        if (code == fresh) return new_sequence(c, time);
        if (code > fresh) return hop(code - fresh);
        if (code == multiples) return answer::done;
        const int multiple = code <= most ? static_cast<int>(code) : most - static_cast<int>(code);
        const std::int32_t by =
            steps_.code(c, product(multiple, s.step), step_to(s, time), context_of(multiple));
        if (multiple == 1)
            s.unusual = 0;
        else if ((multiple == 0 || multiple == most || multiple == -least) && ++s.unusual > 3) {
            s.step = by;
            s.unusual = 0;
        }
        move(s, by);
        return answer::done;
    }

    template <class Coder>
    answer new_sequence(Coder& c, std::uint64_t time) {
        const auto high = [](std::uint64_t t) {
            return static_cast<std::int32_t>(static_cast<std::uint32_t>(t >> 32));
        };
        const auto top =
            static_cast<std::uint32_t>(steps_.code(c, high(sequences_[now_].time), high(time), 8));
        newest_ = now_ = (newest_ + 1) & 3;
        const std::uint32_t low = c.bits(32, static_cast<std::uint32_t>(time));
        sequences_[now_] = {std::uint64_t{top} << 32 | low, 0, 0};
        return answer::done;
    }

    [[nodiscard]] answer hop(unsigned ahead) {
        now_ = (now_ + ahead) & 3;
        return answer::other_sequence;
    }

    [[nodiscard]] static int nearest_multiple(std::int32_t by, std::int32_t step) {
        const std::int64_t b = by;
        const std::int64_t s = step;
        const std::int64_t half = (s < 0 ? -s : s) / 2;
        const std::int64_t m = (b < 0 ? b - half : b + half) / s;
        return static_cast<int>(m > most ? most : m < -least ? -least : m);
    }
    [[nodiscard]] static unsigned code_of(int multiple) {
        return static_cast<unsigned>(multiple >= 0 ? multiple : most - multiple);
    }
    [[nodiscard]] static unsigned context_of(int multiple) {
        if (multiple == 1) return 1;
        if (multiple == 0) return 7;
        if (multiple == most) return 4;
        if (multiple == -least) return 6;
        return multiple < 0 ? 5 : multiple < 10 ? 2 : 3;
    }

    std::array<sequence, 4> sequences_{};
    unsigned now_ = 0;
    unsigned newest_ = 0;
    unsigned repeat_codes_;
    symbol_model multiple_;
    symbol_model first_step_;
    integer_code steps_{32, 9};
};

}  // namespace treeform::detail::laz
