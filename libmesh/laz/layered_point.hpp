#pragma once
/// \file
/// The first 30 bytes of point records in formats 6 to 10, in nine layers.
///
/// \source LASzip for LAS 1.4 (native extension), Specification Document

#include <libmesh/laz/gps_time_code.hpp>
#include <libmesh/laz/items.hpp>
#include <libmesh/laz/layered_items.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

namespace treeform::detail::laz {

class layered_point {
  public:
    static constexpr std::size_t size = 30;
    static constexpr std::size_t layers = 9;

    explicit layered_point(const std::uint8_t* first) : channel_(channel_of(first)) {
        contexts_[channel_] = std::make_unique<context>(first);
    }

    /// Reads or writes the point at `p`, and returns its scanner channel: other items are predicted
    /// from the previous point of the same channel. `in` has one layer for each value.
    template <class Layer>
    unsigned code(std::array<Layer, layers>& in, std::uint8_t* p) {
        auto& c = in[0].coder();
        in[0].says(true);
        in[1].says(true);
        const change changed = read_changes(c, p);
        context& now = *contexts_[channel_];
        const bool new_time = changed.gps_time;
        const returns r = read_returns(c, p, now, changed);
        coordinates(in, p, now, r, new_time);
        read_class(in[2], p, now, r);
        read_flags(in[3], p, now);
        read_intensity(in[4], p, now, r, new_time);
        read_rest(in, p, now, changed);
        std::memcpy(now.last.data(), p, size);
        now.new_time = new_time;
        return channel_;
    }

  private:
    static constexpr std::size_t intensity = 12, counts = 14, flags = 15, classification = 16,
                                 user = 17, angle = 18, source = 20, gps_time = 22;

    struct context {
        explicit context(const std::uint8_t* first) : times(false, get64(first + gps_time)) {
            std::memcpy(last.data(), first, size);
            intensity_seen.fill(get16(first + intensity));
            z_seen.fill(get32(first + 8));
        }

        std::array<std::uint8_t, size> last{};
        /// the time of the last point differed from that of its predecessor
        bool new_time = false;
        std::array<std::uint16_t, 8> intensity_seen{};
        std::array<std::int32_t, 8> z_seen{};
        std::array<median5, 12> x_steps{};
        std::array<median5, 12> y_steps{};
        gps_time_code times;
        std::vector<symbol_model> changed = models(8, 128);
        symbol_model channel{3};
        std::vector<symbol_model> number_of_returns = models(16, 16);
        std::vector<symbol_model> return_number = models(16, 16);
        symbol_model return_step{13};
        integer_code x{32, 2};
        integer_code y{32, 22};
        integer_code z{32, 20};
        std::vector<symbol_model> classes = models(64, 256);
        std::vector<symbol_model> flag_bits = models(64, 64);
        std::vector<symbol_model> users = models(64, 256);
        integer_code intensities{16, 4};
        integer_code angles{16, 2};
        integer_code sources{16, 1};
    };
    struct change {
        bool source = false, gps_time = false, angle = false, returns = false;
        unsigned number = 0;  ///< return number: unchanged, one more, one less, other
    };
    struct returns {
        unsigned count = 0, number = 0;
        unsigned place = 0;  ///< return: single 3, first 2, last 1, intermediate 0
    };

    [[nodiscard]] static unsigned channel_of(const std::uint8_t* p) { return p[flags] >> 4 & 3u; }
    [[nodiscard]] static unsigned number_of(const std::uint8_t* p) { return p[counts] & 15u; }
    [[nodiscard]] static unsigned count_of(const std::uint8_t* p) { return p[counts] >> 4; }
    [[nodiscard]] static unsigned flags_of(const std::uint8_t* p) {
        return (p[flags] >> 2 & 0x30u) | (p[flags] & 15u);
    }

    /// The changes from `last` to `p`, except for the channel, as a symbol.
    [[nodiscard]] static unsigned symbol_of(const std::uint8_t* last, const std::uint8_t* p) {
        const auto bit = [](bool set, unsigned value) { return set ? value : 0u; };
        const unsigned step = (number_of(p) - number_of(last)) & 15u;
        return bit(get16(p + source) != get16(last + source), 32) |
               bit(get64(p + gps_time) != get64(last + gps_time), 16) |
               bit(get16(p + angle) != get16(last + angle), 8) |
               bit(count_of(p) != count_of(last), 4) |
               (step == 0    ? 0u
                : step == 1  ? 1u
                : step == 15 ? 2u
                             : 3u);
    }

    /// Also selects the context of the point's channel; a new context starts from the previous
    /// point.
    template <class Coder>
    change read_changes(Coder& c, std::uint8_t* p) {
        context& before = *contexts_[channel_];
        const std::uint8_t* const last = before.last.data();
        const unsigned first_and_last = (number_of(last) == 1 ? 1u : 0u) |
                                        (number_of(last) >= count_of(last) ? 2u : 0u) |
                                        (before.new_time ? 4u : 0u);
        unsigned changed = 0;
        if constexpr (Coder::writes) {
            const auto& other = contexts_[channel_of(p)];
            changed = symbol_of(other ? other->last.data() : last, p) |
                      (channel_of(p) != channel_ ? 64u : 0u);
        }
        changed = c.symbol(before.changed[first_and_last], changed);
        if ((changed & 64) != 0) {
            const unsigned ahead = c.symbol(before.channel, (channel_of(p) - channel_ - 1) & 3u);
            channel_ = (channel_ + ahead + 1) & 3u;
            if (!contexts_[channel_]) contexts_[channel_] = std::make_unique<context>(last);
        }
        return {(changed & 32) != 0, (changed & 16) != 0, (changed & 8) != 0, (changed & 4) != 0,
                changed & 3u};
    }

    template <class Coder>
    returns read_returns(Coder& c, std::uint8_t* p, context& now, const change& changed) {
        const unsigned count_was = count_of(now.last.data());
        const unsigned was = number_of(now.last.data());
        returns r{count_was, was, 0};
        if (changed.returns) r.count = c.symbol(now.number_of_returns[count_was], count_of(p));
        if (changed.number == 1) r.number = (was + 1) & 15u;
        if (changed.number == 2) r.number = (was - 1) & 15u;
        if (changed.number == 3 && changed.gps_time)
            r.number = c.symbol(now.return_number[was], number_of(p));
        else if (changed.number == 3)
            r.number = (was + 2 + c.symbol(now.return_step, (number_of(p) - was - 2) & 15u)) & 15u;
        r.place = (r.number == 1 ? 2u : 0u) | (r.number >= r.count ? 1u : 0u);
        p[counts] = static_cast<std::uint8_t>(r.count << 4 | r.number);
        return r;
    }

    template <class Layer>
    void coordinates(std::array<Layer, layers>& in, std::uint8_t* p, context& now, const returns& r,
                     bool new_time) {
        const unsigned map = 2 * return_map_of_six(r.count, r.number) + (new_time ? 1 : 0);
        const unsigned single = r.count == 1 ? 1 : 0;
        const auto step = [&](std::size_t at, integer_code& code, median5& median,
                              unsigned by_size) {
            const std::int32_t was = get32(now.last.data() + at);
            const std::int32_t by =
                code.code(in[0].coder(), median.get(), difference(get32(p + at), was), by_size);
            put32(p + at, sum(was, by));
            median.add(by);
        };
        step(0, now.x, now.x_steps[map], single);
        const unsigned x_size = now.x.last_size();
        step(4, now.y, now.y_steps[map], single + std::min(x_size & ~1u, 20u));
        if (!in[1].is_there()) return put32(p + 8, get32(now.last.data() + 8));
        const unsigned size_xy = (x_size + now.y.last_size()) / 2;
        std::int32_t& seen = now.z_seen[return_level(r.count, r.number)];
        seen = now.z.code(in[1].coder(), seen, get32(p + 8), single + std::min(size_xy & ~1u, 18u));
        put32(p + 8, seen);
    }

    template <class Layer>
    static void read_class(Layer& in, std::uint8_t* p, context& now, const returns& r) {
        const std::uint8_t was = now.last[classification];
        in.says(p[classification] != was);
        if (!in.is_there()) {
            p[classification] = was;
            return;
        }
        symbol_model& model = now.classes[(was & 31u) << 1 | (r.place == 3 ? 1u : 0u)];
        p[classification] = low_byte(static_cast<int>(in.coder().symbol(model, p[classification])));
    }

    template <class Layer>
    void read_flags(Layer& in, std::uint8_t* p, context& now) {
        const unsigned was = flags_of(now.last.data());
        unsigned is = was;
        in.says(flags_of(p) != was);
        if (in.is_there()) is = in.coder().symbol(now.flag_bits[was], flags_of(p));
        p[flags] = static_cast<std::uint8_t>((is & 0x30u) << 2 | channel_ << 4 | (is & 15u));
    }

    template <class Layer>
    static void read_intensity(Layer& in, std::uint8_t* p, context& now, const returns& r,
                               bool new_time) {
        in.says(get16(p + intensity) != get16(now.last.data() + intensity));
        if (!in.is_there()) return put16(p + intensity, get16(now.last.data() + intensity));
        std::uint16_t& seen = now.intensity_seen[r.place << 1 | (new_time ? 1u : 0u)];
        seen = static_cast<std::uint16_t>(
            now.intensities.code(in.coder(), seen, get16(p + intensity), r.place));
        put16(p + intensity, seen);
    }

    template <class Layer>
    static void read_rest(std::array<Layer, layers>& in, std::uint8_t* p, context& now,
                          const change& changed) {
        const std::uint8_t* const last = now.last.data();
        in[5].says(changed.angle);
        std::uint16_t is = get16(last + angle);
        if (changed.angle && in[5].is_there())
            is = static_cast<std::uint16_t>(
                now.angles.code(in[5].coder(), is, get16(p + angle), changed.gps_time ? 1 : 0));
        put16(p + angle, is);

        in[6].says(p[user] != last[user]);
        const auto user_is = p[user];
        p[user] = in[6].is_there() ? low_byte(static_cast<int>(
                                         in[6].coder().symbol(now.users[last[user] / 4], user_is)))
                                   : last[user];

        in[7].says(changed.source);
        is = get16(last + source);
        if (changed.source && in[7].is_there())
            is = static_cast<std::uint16_t>(now.sources.code(in[7].coder(), is, get16(p + source)));
        put16(p + source, is);

        in[8].says(changed.gps_time);
        put64(p + gps_time, changed.gps_time && in[8].is_there()
                                ? now.times.code(in[8].coder(), get64(p + gps_time))
                                : get64(last + gps_time));
    }

    unsigned channel_;
    std::array<std::unique_ptr<context>, 4> contexts_{};
};

}  // namespace treeform::detail::laz
