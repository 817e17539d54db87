#include <libmesh/base/add_to_box.hpp>
#include <libmesh/stream/point_survey.hpp>
#include <treeform/mesh/point_stream.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace treeform::detail::stream {
namespace {

/// Of points numbered from 0, those whose number is hashed to zeros at the end: as many zeros as
/// it takes to have room for them. Patterns in a file do not show in it.
class sampler {
  public:
    void consider(std::uint64_t id, const point3& p) {
        const std::uint64_t mixed = mix(id);
        if ((mixed & mask_) != 0) return;
        chosen_.emplace_back(mixed, p);
        if (chosen_.size() < most) return;
        mask_ = 2 * mask_ + 1;
        std::erase_if(chosen_, [&](const auto& c) { return (c.first & mask_) != 0; });
    }
    [[nodiscard]] double share() const { return 1.0 / (static_cast<double>(mask_) + 1.0); }
    /// Heaps of equal points count once, as they take no room where they are welded.
    [[nodiscard]] std::vector<point3> points() const {
        std::vector<point3> all;
        all.reserve(chosen_.size());
        for (const auto& c : chosen_) all.push_back(c.second);
        std::sort(all.begin(), all.end(), [](const point3& a, const point3& b) {
            return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
        });
        all.erase(std::unique(all.begin(), all.end()), all.end());
        return all;
    }

  private:
    static constexpr std::size_t most = std::size_t{1} << 18;

    static std::uint64_t mix(std::uint64_t h) {
        h = (h ^ h >> 30) * 0xbf58476d1ce4e5b9;
        h = (h ^ h >> 27) * 0x94d049bb133111eb;
        return h ^ h >> 31;
    }

    std::uint64_t mask_ = 0;
    std::vector<std::pair<std::uint64_t, point3>> chosen_{};
};

}  // namespace

point_survey survey(const std::filesystem::path& path, const std::string& format, pacer& pace) {
    point_reader reader(path, format);
    point_survey result;
    cloud_survey& s = result.cloud;
    sampler chosen;
    point_block block;
    while (reader.read(block, points_a_block)) {
        base::add_to_box(s.box, bounding_box(block.points));
        s.single = s.single && fits_single(block.points);
        for (const point3& p : block.points) {
            if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z))
                chosen.consider(s.points, p);
            else
                ++s.non_finite;
            ++s.points;
        }
        const auto count = static_cast<double>(reader.count().value_or(s.points));
        pace.show("look", static_cast<double>(s.points) / count);
    }
    s.format = reader.header().format;
    s.warnings = reader.header().warnings;
    result.sample = chosen.points();
    result.sample_share = chosen.share();
    return result;
}

void store(const point_survey& survey, state_writer& state) {
    const cloud_survey& s = survey.cloud;
    state.number(s.points);
    state.number(s.non_finite);
    state.number(s.box ? 1 : 0);
    state.point(s.box ? s.box->min : point3{});
    state.point(s.box ? s.box->max : point3{});
    state.number(s.single ? 1 : 0);
    state.text(s.format);
    state.number(s.warnings.size());
    for (const io_warning& w : s.warnings) {
        state.text(w.code);
        state.text(w.text);
    }
}

point_survey load_survey(state_reader& state) {
    point_survey survey;
    cloud_survey& s = survey.cloud;
    s.points = state.number();
    s.non_finite = state.number();
    const bool has_box = state.number() != 0;
    const point3 min = state.point();
    const point3 max = state.point();
    if (has_box) s.box = box3{min, max};
    s.single = state.number() != 0;
    s.format = state.text();
    for (std::uint64_t left = state.number(); left > 0 && state.whole(); --left) {
        std::string code = state.text();
        s.warnings.push_back({std::move(code), state.text()});
    }
    return survey;
}

}  // namespace treeform::detail::stream
