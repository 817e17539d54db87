#include <libmesh/base/byte_order.hpp>
#include <libmesh/io/las_grid_choice.hpp>
#include <libmesh/io/las_plan.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/version.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace treeform::detail::io {

namespace {

[[nodiscard]] std::size_t block_size(unsigned minor) {
    return minor == 4 ? 375 : minor == 3 ? 235 : 227;
}

[[nodiscard]] bool is_named(const las_record& r, std::string_view user_id) {
    return r.user_id.c_str() == user_id;
}

/// Records that would not be true of the file that is written: how points were packed, and in which
/// order they lay.
void drop_untrue(std::vector<las_record>& records, std::vector<io_warning>& warnings) {
    const auto is_copc = [](const las_record& r) { return is_named(r, "copc"); };
    if (std::ranges::any_of(records, is_copc) &&
        std::ranges::count(warnings, "copc", &io_warning::code) == 0)
        warnings.push_back({"copc", "the index of a COPC file is left out"});
    std::erase_if(records,
                  [&](const las_record& r) { return is_copc(r) || is_named(r, "laszip encoded"); });
}

template <class T>
void append_number(std::vector<std::byte>& to, T value) {
    std::array<char, sizeof(T)> bytes;
    base::store<std::endian::little>(bytes.data(), value);
    const auto* const first = reinterpret_cast<const std::byte*>(bytes.data());
    to.insert(to.end(), first, first + bytes.size());
}

[[nodiscard]] las_record packing_record(std::span<const laz::item> items) {
    las_record r{.user_id = "laszip encoded", .record_id = 22204, .description = "treeform"};
    append_number<std::uint16_t>(r.data, laz::is_layered(items) ? 3 : 2);
    append_number<std::uint16_t>(r.data, 0);  // the coder
    r.data.insert(r.data.end(), {std::byte{3}, std::byte{4}});
    append_number<std::uint16_t>(r.data, 3);  // the version of LASzip whose format this is
    append_number<std::uint32_t>(r.data, 0);
    append_number<std::uint32_t>(r.data, laz_chunk);
    append_number<std::int64_t>(r.data, -1);
    append_number<std::int64_t>(r.data, -1);
    append_number(r.data, static_cast<std::uint16_t>(items.size()));
    for (const laz::item& i : items) {
        append_number(r.data, static_cast<std::uint16_t>(i.type));
        append_number(r.data, i.size);
        append_number(r.data, i.version);
    }
    return r;
}

class las_planner {
  public:
    las_planner(const write_job& job, std::optional<std::span<const point3>> points)
        : job_(job), points_(points), vertices_(job.vertices) {
        if (vertices_ == nullptr) return;
        for (const column& c : vertices_->columns) {
            if (c.role == column_role::data && !c.list_length) columns_.push_back(&c);
        }
        used_.assign(columns_.size(), false);
    }

    las_plan plan(bool packed) {
        start_header();
        plan_.header.point_format = static_cast<std::uint8_t>(las_format_of(features()));
        plan_.dimensions = las_dimensions(plan_.header.point_format);
        for (const las_dimension& d : plan_.dimensions) {
            auto column = take(d.name);
            if (!column && d.name == "scan_angle") column = take("scan_angle_rank");
            plan_.column_of.push_back(column);
            if (!column && !was_las() && is_return(d)) plan_.single_returns.push_back(d);
        }
        plan_.record_size = las_record_size(plan_.header.point_format);
        add_extra();
        fit_version();
        plan_.grid = {plan_.header.scale, plan_.header.offset};
        if (packed) {
            plan_.items = laz::items_of(plan_.header.point_format, plan_.record_size);
            plan_.header.records.push_back(packing_record(plan_.items));
        }
        return std::move(plan_);
    }

  private:
    void start_header() {
        las_header& h = plan_.header;
        const las_grid_wish wish = las_grid_wish_of(job_.options);
        if (job_.file.las) {
            h = *job_.file.las;
            wish.put(h);
            drop_untrue(h.records, job_.result.warnings);
            drop_untrue(h.extended_records, job_.result.warnings);
            return;
        }
        if (!points_)
            throw las_fault(
                "writing LAS in runs needs scale and offset: set "
                "mesh_file::las of the header");
        choose_las_grid(h, *points_, wish);
    }

    [[nodiscard]] bool was_las() const { return job_.file.las && !job_.file.las->block.empty(); }
    [[nodiscard]] static bool is_return(const las_dimension& d) {
        return d.name == "return_number" || d.name == "number_of_returns";
    }

    [[nodiscard]] bool has(std::string_view name) const {
        return std::ranges::count(columns_, name, &column::name) > 0;
    }

    [[nodiscard]] las_features features() const {
        las_features f;
        if (job_.file.las) f = features_of(plan_.header.point_format);
        f.gps_time = f.gps_time || has("gps_time");
        f.color = f.color || (has("red") && has("green") && has("blue"));
        f.infrared = f.infrared || has("nir");
        f.wave_packet = f.wave_packet || has("wave_packet_index");
        f.extended = f.extended || has("overlap") || has("scanner_channel") ||
                     (vertices_ != nullptr && has_extended_values(*vertices_));
        return f;
    }

    /// The column of that name, which is then used.
    [[nodiscard]] std::optional<std::size_t> take(std::string_view name) {
        for (std::size_t i = 0; i < columns_.size(); ++i)
            if (!used_[i] && columns_[i]->name == name) {
                used_[i] = true;
                return i;
            }
        return std::nullopt;
    }

    void add_dimension(const std::string& name, scalar_type type, std::optional<std::size_t> column,
                       const std::optional<las_scaling>& scaling = {}) {
        plan_.dimensions.push_back(
            {.name = name, .type = type, .byte = plan_.record_size, .scaling = scaling});
        plan_.column_of.push_back(column);
        plan_.record_size += size_of(type);
    }

    /// Extra bytes that were described and are still there, then columns that are new, then bytes
    /// that nobody has described.
    void add_extra() {
        auto& records = plan_.header.records;
        const auto old = std::find_if(records.begin(), records.end(), [](const las_record& r) {
            return r.record_id == 4 && is_named(r, "LASF_Spec");
        });
        std::vector<std::byte> descriptions;
        if (old != records.end())
            for (extra_group& g : extra_groups(old->data, 0, 0xffff)) {
                const auto is_there = [&](const las_dimension& d) { return has(d.name); };
                if (std::ranges::none_of(g.values, is_there)) continue;
                for (const las_dimension& d : g.values)
                    add_dimension(d.name, d.type, take(d.name), d.scaling);
                descriptions.insert(descriptions.end(), g.description.begin(), g.description.end());
            }
        std::vector<std::size_t> undescribed;
        for (std::size_t i = 0; const auto c = take(undescribed_name(i)); ++i)
            undescribed.push_back(*c);
        for (std::size_t i = 0; i < columns_.size(); ++i) {
            if (used_[i]) continue;
            const auto more = describe_extra(columns_[i]->name, columns_[i]->type);
            descriptions.insert(descriptions.end(), more.begin(), more.end());
            add_dimension(columns_[i]->name, columns_[i]->type, i);
        }
        for (std::size_t i = 0; i < undescribed.size(); ++i)
            add_dimension(undescribed_name(i), scalar_type::uint8, undescribed[i]);
        if (old != records.end()) {
            if (old->data.size() / 192 * 192 != descriptions.size() ||
                !std::equal(descriptions.begin(), descriptions.end(), old->data.begin()))
                old->data = descriptions;
            if (old->data.empty()) records.erase(old);
        } else if (!descriptions.empty()) {
            records.push_back({.user_id = "LASF_Spec",
                               .record_id = 4,
                               .description = "Extra Bytes",
                               .data = std::move(descriptions)});
        }
        if (plan_.record_size > 0xffff)
            throw las_fault("points have " + std::to_string(plan_.record_size) +
                            " bytes; LAS allows at most 65535");
    }

    /// The least version that has the format, unless the file's is later.
    void fit_version() {
        las_header& h = plan_.header;
        const unsigned least = h.point_format >= 6 ? 4 : h.point_format >= 4 ? 3 : 0;
        const unsigned old = h.version_minor;
        if (h.block.empty()) {
            h.version_minor = static_cast<std::uint8_t>(std::max({old, least, 2u}));
            return new_block();
        }
        if (least <= old) return;
        h.version_minor = static_cast<std::uint8_t>(least);
        h.block.insert(h.block.begin() + static_cast<std::ptrdiff_t>(block_size(old)),
                       block_size(least) - block_size(old), std::byte{0});
        if (least == 4) h.block[6] |= std::byte{0x10};
    }

    void new_block() {
        las_header& h = plan_.header;
        h.block.assign(block_size(h.version_minor), std::byte{0});
        const auto put = [&](std::size_t at, std::string_view text) {
            for (std::size_t i = 0; i < std::min<std::size_t>(text.size(), 32); ++i)
                h.block[at + i] = static_cast<std::byte>(text[i]);
        };
        put(0, "LASF");
        h.block[24] = std::byte{1};
        put(58, "treeform " + std::to_string(TREEFORM_VERSION_MAJOR) + '.' +
                    std::to_string(TREEFORM_VERSION_MINOR) + '.' +
                    std::to_string(TREEFORM_VERSION_PATCH));
        // Formats from 6 on name their coordinate system as text, if they do.
        if (h.point_format >= 6) h.block[6] = std::byte{0x10};
    }

    const write_job& job_;
    std::optional<std::span<const point3>> points_;
    const element* vertices_;
    std::vector<const column*> columns_{};
    std::vector<bool> used_{};
    las_plan plan_{};
};

}  // namespace

las_grid_wish las_grid_wish_of(const write_options& options) {
    const auto check = [](const std::optional<std::array<double, 3>>& given, bool is_scale) {
        if (!given) return;
        for (const double x : *given)
            if (!std::isfinite(x) || (is_scale && x <= 0.0))
                throw std::invalid_argument(
                    is_scale ? "treeform::write: a scale of LAS is not greater than 0"
                             : "treeform::write: an offset of LAS is not finite");
    };
    check(options.las_scale, true);
    check(options.las_offset, false);
    return {options.las_scale, options.las_offset};
}

void choose_las_grid(las_header& header, std::span<const point3> points,
                     const las_grid_wish& wish) {
    las_grid_choice choice;
    choice.look(points);
    choice.try_on(points);
    choice.put(header, wish);
}

bool has_extended_values(const element& vertices) {
    const auto has_above = [&](std::string_view name, double most) {
        const column* const c = vertices.find(name);
        if (c == nullptr || c->role != column_role::data || c->list_length) return false;
        for (std::size_t i = 0; i < c->size(); ++i)
            if (c->number(i) > most) return true;
        return false;
    };
    return has_above("return_number", 7) || has_above("number_of_returns", 7) ||
           has_above("classification", 31);
}

bool is_extended(const las_header& header) { return features_of(header.point_format).extended; }

void extend(las_header& header) {
    las_features f = features_of(header.point_format);
    f.extended = true;
    header.point_format = static_cast<std::uint8_t>(las_format_of(f));
}

double nearest_step(const las_grid& grid, std::size_t axis, double x) {
    const double guess = std::nearbyint((x - grid.offset[axis]) / grid.scale[axis]);
    double best = guess;
    double least = std::numeric_limits<double>::infinity();
    for (const double candidate : {guess, guess - 1, guess + 1}) {
        if (!is_las_step(candidate)) continue;
        const double by = std::abs(grid.coordinate(axis, static_cast<std::int32_t>(candidate)) - x);
        if (by < least) {
            least = by;
            best = candidate;
        }
        if (by == 0.0) break;
    }
    return best;
}

las_plan plan_las(const write_job& job, std::optional<std::span<const point3>> points,
                  bool packed) {
    return las_planner(job, points).plan(packed);
}

}  // namespace treeform::detail::io

namespace treeform {

double round_to_las(mesh_file& file, const write_options& options) {
    std::vector<point3>& points = file.mesh.points;
    if (!file.las) {
        file.las.emplace();
        detail::io::choose_las_grid(*file.las, points, detail::io::las_grid_wish_of(options));
    } else {
        detail::io::las_grid_wish_of(options).put(*file.las);
    }
    const detail::io::las_grid grid{file.las->scale, file.las->offset};
    std::vector<double> moved(chunk_count(points.size(), light_grain), 0.0);
    std::vector<std::size_t> beyond(moved.size(), points.size());
    for_chunks(points.size(), light_grain,
               [&](std::size_t begin, std::size_t end, std::size_t chunk) {
                   for (std::size_t i = begin; i < end; ++i)
                       for (std::size_t axis = 0; axis < 3; ++axis) {
                           double& x = points[i][axis];
                           if (!std::isfinite(x)) continue;
                           const double step = detail::io::nearest_step(grid, axis, x);
                           if (!detail::io::is_las_step(step)) {
                               beyond[chunk] = std::min(beyond[chunk], i);
                               continue;
                           }
                           const double to = grid.coordinate(axis, static_cast<std::int32_t>(step));
                           moved[chunk] = std::max(moved[chunk], std::abs(to - x));
                           x = to;
                       }
               });
    for (const std::size_t i : beyond)
        if (i < points.size())
            throw io_error("point " + std::to_string(i) +
                           ": a coordinate needs more than 32 bits at this scale");
    return moved.empty() ? 0.0 : *std::max_element(moved.begin(), moved.end());
}

}  // namespace treeform
