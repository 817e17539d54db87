#include <libmesh/attributes/known_columns.hpp>
#include <libmesh/io/formats.hpp>
#include <libmesh/io/sink.hpp>
#include <libmesh/io/vertex_columns.hpp>
#include <treeform/mesh/point_stream.hpp>

#include <algorithm>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace treeform {

namespace {

[[noreturn]] void refuse_block(const std::string& what) {
    throw std::invalid_argument("point_writer: " + what);
}

/// The header as a file without points; elements behind them count their rows.
[[nodiscard]] mesh_file without_values(const mesh_file& header) {
    mesh_file head;
    head.format = header.format;
    head.stored_as = header.stored_as;
    head.attributes.texture_files = header.attributes.texture_files;
    head.attributes.comments = header.attributes.comments;
    head.attributes.obj_info = header.attributes.obj_info;
    head.las = header.las;
    head.ranges = header.ranges;
    bool has_vertices = header.attributes.find("vertex") == nullptr;
    for (const element& e : header.attributes.elements) {
        has_vertices = has_vertices || e.name == "vertex";
        if (!has_vertices && e.rows > 0)
            refuse_block("rows of " + e.name + " cannot precede the points");
        element& mine = head.attributes.elements.emplace_back();
        detail::io::restart(mine, e);
        detail::io::check_columns(mine);
        if (e.name != "vertex") mine.rows = e.rows;
    }
    return head;
}

/// Whether it is written behind the points.
[[nodiscard]] bool is_behind(const element& e) {
    return e.name != "vertex" && e.rows > 0 && (e.name == "face" || !e.columns.empty());
}

/// True when the columns are those of the header's element "vertex". Coordinates have no values in
/// theirs, which may be of any type.
[[nodiscard]] bool same_columns(const element& given, const element* declared) {
    const std::size_t count = declared == nullptr ? 0 : declared->columns.size();
    return given.columns.size() == count &&
           std::equal(given.columns.begin(), given.columns.end(),
                      declared == nullptr ? given.columns.begin() : declared->columns.begin(),
                      [](const column& a, const column& b) {
                          return a.name == b.name && a.role == b.role &&
                                 (a.type == b.type || detail::io::is_axis(a)) &&
                                 a.list_length == b.list_length;
                      });
}

}  // namespace

struct point_writer::state {
    state(const std::filesystem::path& path, const mesh_file& header, std::uint64_t points,
          const write_options& wanted, std::size_t most_corners)
        : count(points), options(wanted), head(without_values(header)) {
        const detail::io::known_format& format = detail::io::find_format(path, options);
        if (format.start == nullptr)
            throw io_error(path.string() +
                           ": only PLY, OBJ, PCD, LAS, LAZ, XYZ and CSV are written in blocks");
        std::ranges::copy_if(head.attributes.elements, std::back_inserter(behind), is_behind);
        result.format =
            detail::io::writes_text(format, options) ? format.text_name : format.binary_name;
        result.written_as = options.precision.value_or(head.stored_as);
        translate(format);
        file.emplace(path);
        out.emplace(file->descriptor(), file->name());
        rows = format.start({.file = head,
                             .options = options,
                             .result = result,
                             .out = *out,
                             .most_corners = most_corners,
                             .vertices = head.attributes.find("vertex")},
                            count);
        for (io_warning& w :
             detail::io::left_out(format, head, head.attributes.find("vertex"), false))
            result.warnings.push_back(std::move(w));
        if (!behind.empty() && !rows.behind)
            throw io_error(path.string() +
                           ": of faces and other elements, only PLY and OBJ are written in blocks");
        head_size = out->size();
    }

    /// What blocks have, and what is written of it.
    void translate(const detail::io::known_format& format) {
        const auto at = std::ranges::find(head.attributes.elements, "vertex", &element::name);
        if (at == head.attributes.elements.end()) return;
        given = *at;
        translation.emplace(*given,
                            options.keep_names ? std::string(format.extension) : head.format,
                            format.extension, head.ranges, options.drop, options.rename);
        result.warnings = translation->warnings();
        if (translation->changes()) *at = translation->apply(*given);
    }

    void check(points_view points, const element& properties) const {
        if (points_end || points.size() > count - written)
            refuse_block("more points than were announced");
        if (properties.rows != points.size())
            refuse_block("the number of rows differs from the number of points");
        if (!same_columns(properties, given ? &*given : nullptr))
            refuse_block("the columns are not those of the header");
        detail::io::check_columns(properties);
        if (result.written_as != precision::float32 || options.precision || fits_float32(points))
            return;
        std::size_t i = 0;
        while (fits_float32(points.subspan(i, 1))) ++i;
        refuse_point({i, "a coordinate is not a float32 value, as the header declares"});
    }

    [[noreturn]] void refuse_point(const detail::io::unfit_point& unfit) const {
        throw std::invalid_argument(file->name() + ": point " +
                                    std::to_string(written + unfit.point) + ": " + unfit.reason +
                                    "; choose the option precision");
    }

    void check(const row_block& block) {
        const element& given = block.rows;
        const auto is_over = [&](const element& e) {  // other parts may have the rest of it
            return e.rows == 0 || (points_end && e.name != given.name);
        };
        while (!behind.empty() && is_over(behind.front())) behind.erase(behind.begin());
        if ((written != count && !points_end) || behind.empty() ||
            given.name != behind.front().name)
            refuse_block("rows of " + given.name + " are out of order");
        if (given.rows > behind.front().rows)
            refuse_block("more rows of " + given.name + " than the header announces");
        if (!same_columns(given, &behind.front()))
            refuse_block("the columns of " + given.name + " are not those of the header");
        if (given.name == "face" && block.first_corner.size() != given.rows + 1)
            refuse_block("first_corner does not match the number of faces");
        detail::io::check_columns(given);
        behind.front().rows -= given.rows;
    }
    [[nodiscard]] std::uint64_t rows_left() const {
        std::uint64_t left = 0;
        for (const element& e : behind) left += e.rows;
        return left;
    }

    std::uint64_t count;
    std::uint64_t written = 0;
    std::optional<std::uint64_t> points_end{};  ///< byte, where other points are in other parts
    std::vector<element> behind{};              ///< rows that are to come
    std::uint64_t head_size = 0;
    std::optional<element> given{};  ///< the element "vertex" of the header
    std::optional<detail::attribute::translation> translation{};
    write_options options;
    mesh_file head;
    write_result result{};
    std::optional<detail::io::output_file> file{};
    std::optional<detail::io::sink> out{};
    detail::io::point_sink rows{};
};

point_writer::point_writer(const std::filesystem::path& path, const mesh_file& header,
                           std::uint64_t count, const write_options& options,
                           std::size_t most_corners)
    : state_(std::make_unique<state>(path, header, count, options, most_corners)) {}
point_writer::~point_writer() = default;
point_writer::point_writer(point_writer&&) noexcept = default;
point_writer& point_writer::operator=(point_writer&&) noexcept = default;

void point_writer::write(points_view points, const element& properties) {
    state& s = *state_;
    s.check(points, properties);
    if (s.result.written_as == precision::float32)
        s.result.max_displacement = std::max(
            s.result.max_displacement, detail::io::largest_move(points, s.written, s.file->name()));
    try {
        if (s.given && s.translation->changes()) {
            const element rows = s.translation->apply(properties);
            s.rows.rows(points, &rows);
        } else {
            s.rows.rows(points, s.given ? &properties : nullptr);
        }
    } catch (const detail::io::unfit_point& unfit) {
        s.refuse_point(unfit);
    }
    s.written += points.size();
}

void point_writer::write(const row_block& block) {
    state_->check(block);
    state_->rows.behind(block);
}

write_result point_writer::commit() {
    state& s = *state_;
    if (s.written != s.count)
        throw io_error(s.file->name() + ": " + std::to_string(s.count) +
                       " points were announced, but " + std::to_string(s.written) +
                       " were written");
    if (s.rows_left() > 0)
        throw io_error(s.file->name() +
                       ": fewer rows after the points were written than announced");
    if (s.rows.finish) s.rows.finish();
    s.out->flush();
    s.file->commit();
    return std::move(s.result);
}

bool point_writer::has_parts() const { return !state_->rows.finish || state_->rows.finish_part; }

std::uint64_t point_writer::part_granularity() const { return state_->rows.together; }

bool point_writer::has_shared_values() const {
    return static_cast<bool>(state_->rows.share_values);
}

void point_writer::share_values(const detail::io::shared_values& place) {
    state& s = *state_;
    if (!has_shared_values() || s.written > 0)
        throw std::logic_error(s.file->name() + ": its values are not put in a shared place");
    s.rows.share_values(place);
    s.rows.finish = [name = s.file->name()] {
        throw std::logic_error(name + ": is finished by commit_part");
    };
    s.head_size = s.out->size();
}

std::uint64_t point_writer::end_part() {
    state& s = *state_;
    s.points_end = s.out->size();
    return *s.points_end - s.head_size;
}

void point_writer::skip_bytes(std::uint64_t bytes) { state_->out->skip(bytes); }

std::string point_writer::part_summary() {
    return state_->rows.part_summary ? state_->rows.part_summary() : std::string();
}

detail::io::written_part point_writer::commit_part(write_result& result,
                                                   const std::vector<std::string>& summaries) {
    state& s = *state_;
    if (!has_parts()) throw std::logic_error(s.file->name() + ": is not written in parts");
    const std::uint64_t behind = s.rows.finish_part ? s.rows.finish_part(summaries) : 0;
    s.out->flush();
    const std::uint64_t end = s.points_end.value_or(s.out->size() - behind);
    const detail::io::written_part made{s.head_size, end - s.head_size,
                                        s.out->size() - behind - end};
    s.file->commit();
    result = std::move(s.result);
    return made;
}

std::string point_writer::join_heads(const std::vector<std::string>& heads) {
    const std::string& first = heads.front();
    if (first.starts_with("LASF")) return detail::io::join_las_heads(heads);
    if (detail::io::is_packed_pcd_head(first)) return detail::io::join_packed_pcd_heads(heads);
    return first;
}

}  // namespace treeform
