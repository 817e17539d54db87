/// \file
/// The first look at the rows behind the points, and whose each of them is.

#include <libmesh/io/face_sink.hpp>
#include <libmesh/stream/tile_faces.hpp>

#include <algorithm>
#include <limits>
#include <utility>

namespace treeform::detail::stream {
namespace {

bool are_zeros(const element& e) {
    return std::ranges::all_of(e.columns, [](const column& c) {
        return std::ranges::all_of(c.values, [](std::byte b) { return b == std::byte{0}; });
    });
}

}  // namespace

std::size_t longest_face(const row_block& block) {
    std::size_t most = 0;
    for (std::size_t f = 0; f < block.rows.rows; ++f)
        most = std::max<std::size_t>(most, block.first_corner[f + 1] - block.first_corner[f]);
    return most;
}

bool has_rows_behind(const mesh_file& header) {
    return std::ranges::any_of(header.attributes.elements, [](const element& e) {
        return e.name != "vertex" && e.rows > 0 && !e.columns.empty();
    });
}

file_of_rows tile_faces::file() const {
    const cloud_inputs& inputs = task_.inputs;
    return {
        .path = inputs.paths.front(), .format = inputs.format, .known = steps_.source().known(0)};
}

io::point_blocks tile_faces::open() const {
    const file_of_rows of = file();
    return {of.path, {.format = std::string(of.format)}, 0, of.use, of.known};
}

void tile_faces::take_survey(cloud_survey& survey) {
    start_survey(survey);
    if (steps_.all().is_alone()) {
        survey_whole(survey);
    } else if (!share_survey(survey, survey_part(survey))) {
        start_survey(survey);
        survey_in_turn(survey);
        static_cast<void>(share_survey(survey, true));
    }
    io::remark_on_short_faces(left_out_, survey.warnings);
    if (survey.triangles > std::numeric_limits<std::uint32_t>::max())
        throw io_error(task_.inputs.paths.front().string() +
                       ": more triangles than 32-bit numbers can name");
    if (survey.disk_bytes > 0)
        survey.disk_bytes += 8 * survey.points + 48 * survey.triangles +
                             (survey.tolerance > 0.0 ? 48 * survey.points : 0);
}

void tile_faces::start_survey(cloud_survey& survey) {
    survey.faces = survey.triangles = left_out_ = 0;
    most_corners_ = 0;
    is_blank_ = is_soup_;
    parts_.clear();
}

/// Returns false where that needs all that is ahead of the part, and where it is not as it should
/// be: when all look in turn, what is wrong first is said.
bool tile_faces::survey_part(cloud_survey& survey) {
    try {
        io::point_blocks reader = open();
        parts_ = reader.row_parts(steps_.all().size());
        if (parts_.empty()) return false;
        const io::row_place& first = parts_[steps_.all().rank()];
        reader.go_to(first);
        std::uint64_t left = parts_[steps_.all().rank() + 1].row - first.row;
        row_block block;
        while (left > 0 && reader.read(block, rows_of_next(left))) {
            left -= block.rows.rows + block.left_out;
            survey_rows(block, survey);
            pace_.check();
        }
        end_survey(reader, survey);
        return left == 0;
    } catch (const io_error& error) {
        if (is_of_tiles(error)) throw;
        return false;
    }
}

void tile_faces::survey_whole(cloud_survey& survey) {
    io::point_blocks reader = open();
    for (row_block block; reader.read(block, rows_a_block); pace_.check())
        survey_rows(block, survey);
    end_survey(reader, survey);
}

void tile_faces::survey_in_turn(cloud_survey& survey) {
    parts_ = rows_in_turn(
        steps_.all(), file(),
        [&](const row_block& block) {
            survey_rows(block, survey);
            pace_.check();
        },
        [&](const io::point_blocks& reader) { end_survey(reader, survey); });
}

void tile_faces::survey_rows(const row_block& block, cloud_survey& survey) {
    if (block.rows.name != "face") return;
    survey.faces += block.rows.rows;
    left_out_ += block.left_out;
    survey.triangles += block.corners.size() - 2 * block.rows.rows;
    is_blank_ = is_blank_ && are_zeros(block.rows);
    most_corners_ = std::max(most_corners_, longest_face(block));
}

void tile_faces::end_survey(const io::point_blocks& reader, cloud_survey& survey) const {
    for (const io_warning& w : reader.header().warnings)
        if (std::ranges::find(survey.warnings, w.text, &io_warning::text) == survey.warnings.end())
            survey.warnings.push_back(w);
}

/// Sums up what all have seen; the last one knows the end of the file, and where parts begin.
/// Returns whether each has `seen` its part.
bool tile_faces::share_survey(cloud_survey& survey, bool seen) {
    state_writer mine;
    mine.numbers(seen, survey.faces, survey.triangles, left_out_, most_corners_, is_blank_,
                 parts_.size());
    store_warnings(survey.warnings, mine);
    for (const io::row_place& place : parts_) mine.numbers(place.row, place.byte);
    survey.faces = survey.triangles = left_out_ = 0;
    for (state_reader& one : steps_.all().exchange(mine)) {
        seen = one.number() != 0 && seen;
        survey.faces += one.number();
        survey.triangles += one.number();
        left_out_ += one.number();
        most_corners_ = std::max(most_corners_, static_cast<std::size_t>(one.number()));
        is_blank_ = one.number() != 0 && is_blank_;
        parts_.resize(one.whole() ? static_cast<std::size_t>(one.number()) : 0);
        survey.warnings = load_warnings(one);
        for (io::row_place& place : parts_) place = {one.number(), one.number()};
    }
    return seen;
}

}  // namespace treeform::detail::stream
