#include "tools/tf-weld/tile_outputs.hpp"

#include "tools/common/console.hpp"
#include <treeform/mesh/io_error.hpp>
#include <treeform/mesh/point_stream.hpp>
#include <treeform/tf.hpp>

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace tools {
namespace {

namespace fs = std::filesystem;

const char* const leftovers = "unfinished.json";

/// Rows of a block on their way to a file of points.
class points_out {
  public:
    points_out(const fs::path& path, const tf::mesh_file& header, std::uint64_t count,
               const tf::write_options& options)
        : writer_(path, header, count, options) {}

    void write(const tf::point_block& block, const std::vector<std::uint32_t>& rows) {
        if (rows.empty()) return;
        some_.points.clear();
        for (const std::uint32_t row : rows) some_.points.push_back(block.points[row]);
        some_.properties = tf::gather(block.properties, rows);
        writer_.write(some_);
    }
    void write(const tf::point_block& block) { writer_.write(block); }
    tf::write_result commit() { return writer_.commit(); }

  private:
    tf::point_writer writer_;
    tf::point_block some_{};
};

/// The last pass over the input: what is kept, and what else is asked for.
class giving_back {
  public:
    giving_back(job& work, const weld_request& request, const fs::path& input,
                const point_survey& survey, tile_steps& steps, tiles_welded& welded,
                const work_folder& folder)
        : work_(work),
          asked_(request.outputs),
          survey_(survey),
          steps_(steps),
          welded_(welded),
          reader_(input, work.options.format),
          head_(reader_.header()),
          outputs_(work) {
        head_.stored_as = survey.single ? tf::precision::float32 : tf::precision::float64;
        naming_outputs([&] { open_files(); });
        std::vector<fs::path> unfinished = outputs_.unfinished();
        if (map_ && !map_->folder().empty()) unfinished.push_back(map_->folder());
        json folders = json::array();
        for (const fs::path& path : unfinished) folders.push_back(fs::absolute(path).string());
        folder.store(leftovers, {{"folders", folders}});
        if (map_ || !asked_.label.empty()) {
            welded_.kept.number();
            drops_.emplace(steps.all_drops(welded));
        }
    }

    void run() {
        if (result_ || removed_ || map_) naming_outputs([&] { give_all(); });
    }

  private:
    template <class Body>
    void naming_outputs(Body&& body) {
        try {
            body();
        } catch (const tf::io_error& error) {
            throw failure(bad_output, "output", outputs_.said_of_paths(error.what()));
        }
    }

    void give_all() {
        const auto show = work_.progress("write");
        tf::point_block block;
        while (reader_.read(block, points_a_block)) {
            give(block);
            first_ += block.points.size();
            show(static_cast<double>(first_) / static_cast<double>(survey_.points));
            work_.keeper.check();
        }
        steps_.step_done();
        work_.out.end_progress();
        if (first_ != survey_.points)
            throw failure(bad_input, "changed",
                          work_.name + ": the file changed while it was read");
        finish();
    }

    void open_files() {
        const common_options& o = work_.options;
        const std::uint64_t dropped = welded_.kept.dropped();
        if (!asked_.map.empty()) {
            map_.emplace(asked_.map, o.force, work_.keeper);
            as_csv_ = map_is_csv(asked_.map);
            if (as_csv_) map_->write(map_heading);
        }
        if (!asked_.removed.empty() && !o.dry_run)
            removed_.emplace(outputs_.add(asked_.removed, o.force), removed_head(), dropped,
                             write_options_for(o, {check_points_format(asked_.removed), o.ascii}));
        path_ = o.dry_run ? std::nullopt : mesh_output(o, work_.path);
        if (!path_) return;
        const bool labelled = !asked_.label.empty();
        if (labelled) add_label_to_head();
        result_.emplace(outputs_.add(*path_, o.force || o.in_place), head_,
                        labelled ? survey_.points : survey_.points - dropped,
                        write_options_for(o, form_of(work_, head_, *path_)));
    }

    /// Of the header only the points and what they have.
    [[nodiscard]] tf::mesh_file removed_head() const {
        tf::mesh_file head;
        head.format = head_.format;
        head.stored_as = head_.stored_as;
        if (const tf::element* vertices = tf::find_element(head_.attributes, "vertex"))
            head.attributes.elements.push_back(*vertices);
        return head;
    }

    void add_label_to_head() {
        tf::element& vertices = tf::obtain_element(head_.attributes, "vertex", 0);
        if (tf::set_column(vertices, {.name = asked_.label, .type = tf::scalar_type::uint32}))
            work_.warn("replaced",
                       "property " + asked_.label + " was there before; its values are replaced");
    }

    void give(tf::point_block& block) {
        if (drops_) number(block.points.size());
        kept_.clear();
        gone_.clear();
        for (std::uint32_t row = 0; row < block.points.size(); ++row)
            (welded_.kept.keeps(first_ + row) ? kept_ : gone_).push_back(row);
        given_ += kept_.size();
        if (map_) write_map();
        if (removed_) removed_->write(block, gone_);
        if (!result_) return;
        if (asked_.label.empty()) {
            result_->write(block, kept_);
            return;
        }
        const std::vector<std::uint32_t> groups(groups_.begin(), groups_.end());
        block.properties.rows = groups.size();
        tf::set_column(block.properties, tf::make_column<std::uint32_t>(asked_.label, groups));
        result_->write(block);
    }

    /// The groups of the points of a block.
    void number(std::size_t count) {
        groups_.resize(count);
        for (std::size_t row = 0; row < count; ++row) {
            const std::uint64_t point = first_ + row;
            std::uint64_t leader = point;
            for (; !drops_->empty() && drops_->front().id == point; drops_->pop())
                leader = drops_->front().leader;
            groups_[row] = welded_.kept.number_of(welded_.border.leader_of(leader));
        }
    }

    void write_map() {
        std::string text;
        for (std::size_t row = 0; row < groups_.size(); ++row)
            put_map_row(text, first_ + row, groups_[row], as_csv_);
        map_->write(text);
    }

    void finish() {
        if (given_ != survey_.points - welded_.kept.dropped())
            throw std::logic_error("points in are not points kept and points removed");
        if (removed_)
            for (const auto& w : removed_->commit().warnings) work_.warn(w.code, w.text);
        if (result_) {
            const tf::write_result written = result_->commit();
            enter_output(work_, *path_, written,
                         asked_.label.empty() ? std::optional<std::uint64_t>(0) : std::nullopt);
            for (const auto& w : written.warnings) work_.warn(w.code, w.text);
        }
        if (map_) map_->commit();
        outputs_.commit();
    }

    job& work_;
    const weld_outputs& asked_;
    const point_survey& survey_;
    tile_steps& steps_;
    tiles_welded& welded_;
    tf::point_reader reader_;
    tf::mesh_file head_;
    pending_outputs outputs_;
    std::optional<fs::path> path_{};
    std::optional<output_file> map_{};
    bool as_csv_ = false;
    std::optional<points_out> removed_{};
    std::optional<points_out> result_{};
    std::optional<tile_steps::drops> drops_{};
    std::uint64_t first_ = 0;  ///< number of the block's first point
    std::uint64_t given_ = 0;
    std::vector<std::uint64_t> groups_{};
    std::vector<std::uint32_t> kept_{};
    std::vector<std::uint32_t> gone_{};
};

}  // namespace

void remove_leftovers(const work_folder& folder) {
    const auto stored = folder.load(leftovers);
    if (!stored) return;
    for (const json& left : stored->value("folders", json::array())) {
        const fs::path path = left.is_string() ? left.get<std::string>() : std::string();
        if (path.filename().string().starts_with(".unfinished-")) fs::remove_all(path);
    }
}

void give_back(job& work, const weld_request& request, const fs::path& input,
               const point_survey& survey, tile_steps& steps, tiles_welded& welded,
               const work_folder& folder) {
    try {
        giving_back(work, request, input, survey, steps, welded, folder).run();
    } catch (const tf::io_error& error) {
        throw failure(bad_output, "output", error.what());
    }
}

}  // namespace tools
