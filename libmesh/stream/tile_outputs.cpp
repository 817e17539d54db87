#include <libmesh/stream/tile_outputs.hpp>
#include <treeform/mesh/point_stream.hpp>

#include <stdexcept>
#include <utility>

namespace treeform::detail::stream {
namespace {

namespace fs = std::filesystem;

const char* const leftovers = "unfinished";

/// Rows of a block on their way to a file of points.
class points_out {
  public:
    points_out(const weld_stream_outputs::file& to, const mesh_file& header, std::uint64_t count)
        : writer_(to.path, header, count, to.options) {}

    void write(const point_block& block, const std::vector<std::uint32_t>& rows) {
        if (rows.empty()) return;
        some_.points.clear();
        for (const std::uint32_t row : rows) some_.points.push_back(block.points[row]);
        some_.properties = gather(block.properties, rows);
        writer_.write(some_);
    }
    void write(const point_block& block) { writer_.write(block); }
    write_result commit() { return writer_.commit(); }

  private:
    point_writer writer_;
    point_block some_{};
};

/// The last pass over the input.
class giving_back {
  public:
    giving_back(pacer& pace, const tile_task& task, const weld_stream_outputs& asked,
                const tile_steps& steps, tiles_welded& welded)
        : pace_(pace),
          asked_(asked),
          survey_(steps.survey()),
          steps_(steps),
          welded_(welded),
          input_(task.input),
          reader_(task.input, task.options.format),
          head_(reader_.header()) {
        head_.stored_as = survey_.single ? precision::float32 : precision::float64;
        open_files();
        if (asked_.map || !asked_.label.empty()) {
            welded_.kept.number();
            drops_.emplace(steps.all_drops(welded));
        }
    }

    [[nodiscard]] weld_stream_written run() {
        if (result_ || removed_ || asked_.map) give_all();
        return std::move(written_);
    }

  private:
    void open_files() {
        const std::uint64_t dropped = welded_.kept.dropped();
        if (asked_.removed) removed_.emplace(*asked_.removed, removed_head(), dropped);
        if (!asked_.welded) return;
        const bool labeled = !asked_.label.empty();
        if (labeled)
            written_.label_replaced =
                set_column(obtain_element(head_.attributes, "vertex", 0),
                           {.name = asked_.label, .type = scalar_type::uint32});
        result_.emplace(*asked_.welded, head_, labeled ? survey_.points : survey_.points - dropped);
    }

    /// Of the header only the points and what they have.
    [[nodiscard]] mesh_file removed_head() const {
        mesh_file head;
        head.format = head_.format;
        head.stored_as = head_.stored_as;
        if (const element* vertices = find_element(head_.attributes, "vertex"))
            head.attributes.elements.push_back(*vertices);
        return head;
    }

    void give_all() {
        point_block block;
        while (reader_.read(block, points_a_block)) {
            give(block);
            first_ += block.points.size();
            pace_.show("write", static_cast<double>(first_) / static_cast<double>(survey_.points));
        }
        steps_.step_done();
        if (first_ != survey_.points)
            throw weld_stream_error(weld_stream_error::reason::input_changed, input_,
                                    input_.string() + ": the file changed while it was read");
        if (given_ != survey_.points - welded_.kept.dropped())
            throw std::logic_error("points in are not points kept and points removed");
        if (removed_) written_.removed = removed_->commit();
        if (result_) written_.welded = result_->commit();
    }

    void give(point_block& block) {
        if (drops_) number(block.points.size());
        kept_.clear();
        gone_.clear();
        for (std::uint32_t row = 0; row < block.points.size(); ++row)
            (welded_.kept.keeps(first_ + row) ? kept_ : gone_).push_back(row);
        given_ += kept_.size();
        if (asked_.map) asked_.map(groups_);
        if (removed_) removed_->write(block, gone_);
        if (!result_) return;
        if (asked_.label.empty()) {
            result_->write(block, kept_);
            return;
        }
        const std::vector<std::uint32_t> groups(groups_.begin(), groups_.end());
        block.properties.rows = groups.size();
        set_column(block.properties, make_column<std::uint32_t>(asked_.label, groups));
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

    pacer& pace_;
    const weld_stream_outputs& asked_;
    const cloud_survey& survey_;
    const tile_steps& steps_;
    tiles_welded& welded_;
    const fs::path& input_;
    point_reader reader_;
    mesh_file head_;
    weld_stream_written written_{};
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
    auto stored = folder.load(leftovers);
    if (!stored) return;
    for (std::uint64_t left = stored->number(); left > 0 && stored->whole(); --left) {
        const fs::path path = stored->text();
        if (path.filename().string().starts_with(".unfinished-")) fs::remove_all(path);
    }
}

weld_stream_written give_back(pacer& pace, const tile_task& task,
                              const weld_stream_outputs& outputs, const tile_steps& steps,
                              tiles_welded& welded, const work_folder& folder) {
    state_writer state;
    state.number(outputs.unfinished.size());
    for (const fs::path& path : outputs.unfinished) state.text(fs::absolute(path).string());
    folder.store(leftovers, state);
    return giving_back(pace, task, outputs, steps, welded).run();
}

}  // namespace treeform::detail::stream
