#include "tools/tf-weld/point_survey.hpp"

#include <treeform/tf.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace tools {
namespace {

/// Of points numbered from 0, those whose number is hashed to zeros at the end: as many zeros as
/// it takes to have room for them. Patterns in a file do not show in it.
class sampler {
  public:
    void consider(std::uint64_t id, const tf::point3& p) {
        const std::uint64_t mixed = mix(id);
        if ((mixed & mask_) != 0) return;
        chosen_.emplace_back(mixed, p);
        if (chosen_.size() < most) return;
        mask_ = 2 * mask_ + 1;
        std::erase_if(chosen_, [&](const auto& c) { return (c.first & mask_) != 0; });
    }
    [[nodiscard]] double share() const { return 1.0 / (static_cast<double>(mask_) + 1.0); }
    /// Heaps of equal points count once, as they take no room where they are welded.
    [[nodiscard]] std::vector<tf::point3> points() const {
        std::vector<tf::point3> all;
        all.reserve(chosen_.size());
        for (const auto& c : chosen_) all.push_back(c.second);
        std::sort(all.begin(), all.end(), [](const tf::point3& a, const tf::point3& b) {
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
    std::vector<std::pair<std::uint64_t, tf::point3>> chosen_{};
};

void extend(std::optional<tf::box3>& box, const std::optional<tf::box3>& more) {
    if (!more) return;
    if (!box) {
        box = more;
        return;
    }
    for (std::size_t k = 0; k < 3; ++k) {
        box->min[k] = std::min(box->min[k], more->min[k]);
        box->max[k] = std::max(box->max[k], more->max[k]);
    }
}

json triple(const tf::point3& p) { return {p.x, p.y, p.z}; }
tf::point3 triple_from(const json& t) { return {t.at(0), t.at(1), t.at(2)}; }

}  // namespace

point_survey survey(job& work, const std::filesystem::path& path) {
    tf::point_reader reader(path, work.options.format);
    const auto show = work.progress("look");
    point_survey s;
    sampler chosen;
    tf::point_block block;
    while (reader.read(block, points_a_block)) {
        extend(s.box, tf::bounding_box(block.points));
        s.single = s.single && tf::fits_single(block.points);
        for (const tf::point3& p : block.points) {
            if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z))
                chosen.consider(s.points, p);
            else
                ++s.non_finite;
            ++s.points;
        }
        const auto count = static_cast<double>(reader.count().value_or(s.points));
        show(static_cast<double>(s.points) / count);
        work.keeper.check();
    }
    work.out.end_progress();
    s.format = reader.header().format;
    s.warnings = reader.header().warnings;
    s.sample = chosen.points();
    s.sample_share = chosen.share();
    return s;
}

json to_json(const point_survey& s) {
    json stored{{"points", s.points}, {"non_finite", s.non_finite}, {"box", nullptr},
                {"single", s.single}, {"format", s.format},         {"warnings", json::array()}};
    if (s.box) stored["box"] = {triple(s.box->min), triple(s.box->max)};
    for (const auto& w : s.warnings) stored["warnings"].push_back({w.code, w.text});
    return stored;
}

point_survey survey_from(const json& stored) {
    point_survey s;
    s.points = stored.at("points");
    s.non_finite = stored.at("non_finite");
    if (const json& box = stored.at("box"); !box.is_null())
        s.box = tf::box3{triple_from(box.at(0)), triple_from(box.at(1))};
    s.single = stored.at("single");
    s.format = stored.at("format");
    for (const json& w : stored.at("warnings")) s.warnings.push_back({w.at(0), w.at(1)});
    return s;
}

}  // namespace tools
