#include <libmesh/io/formats.hpp>
#include <libmesh/io/las_plan.hpp>
#include <libmesh/io/vertex_columns.hpp>
#include <libmesh/io/writers.hpp>
#include <libmesh/stream/joined_parts.hpp>
#include <libmesh/stream/kept_rows.hpp>
#include <libmesh/stream/point_survey.hpp>
#include <libmesh/stream/points_out.hpp>
#include <libmesh/stream/tile_faces.hpp>
#include <treeform/mesh/point_stream.hpp>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace treeform::detail::stream {
namespace {

namespace fs = std::filesystem;

const char* const leftovers = "unfinished";

/// A device or a pipe, which is written from the front, and stays.
bool is_special(const fs::path& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    return fs::exists(status) && !fs::is_regular_file(status);
}

/// Rows on their way to a file, of which something has to be known before it is begun.
class output_survey {
  public:
    explicit output_survey(std::function<void(points_view)> take = {}) : take_(std::move(take)) {}
    /// `axes` are the coordinates whose types `head` has to be asked for.
    output_survey(const mesh_file& head, const std::array<bool, 3>& axes) : axes_(axes) {
        if (const element* e = head.attributes.find("vertex")) vertices_ = *e;
    }

    /// Whether more points can tell more of the types.
    [[nodiscard]] bool asks() const { return axes_ != outgrown_; }

    void write(const io::point_block& block, const std::vector<std::uint32_t>& rows) {
        io::point_block some;
        for (const std::uint32_t row : rows) some.points.push_back(block.points[row]);
        some.properties = block.properties.gathered(rows);
        write(some);
    }
    void write(const io::point_block& block) {
        if (take_) take_(block.points);
        if (asks()) {
            const auto outgrown = io::outgrown_axes(vertices_, block.points);
            for (std::size_t k = 0; k < 3; ++k)
                outgrown_[k] = outgrown_[k] || (axes_[k] && outgrown[k]);
        }
        single_ = single_ && fits_float32(block.points);
        extended_ = extended_ || io::has_extended_values(block.properties);
    }
    void share(const communicator& all) {
        single_ = all.sum(single_ ? 0 : 1) == 0;
        extended_ = all.sum(extended_ ? 1 : 0) > 0;
        for (bool& one : outgrown_) one = all.sum(one ? 1 : 0) > 0;
    }
    /// \pre it has seen all points
    void describe(mesh_file& head) const {
        if (!single_) head.stored_as = precision::float64;
        if (extended_) io::extend(*head.las);
    }
    /// As `write` chooses types when it has all points: each axis its own. `point_writer` keeps to
    /// that only where `stored_as` is float32, so that changes; what `write` would report is
    /// returned.
    [[nodiscard]] std::optional<precision> describe_types(mesh_file& head) const {
        if (axes_ == std::array<bool, 3>{}) return std::nullopt;
        const precision as = head.stored_as;
        element& e = head.attributes.find_or_add("vertex", 0);
        for (column& c : e.columns)
            if (io::is_axis(c) && outgrown_[io::axis_number(c.role)])
                c.type = head.stored_as == precision::float32 ? scalar_type::float32
                                                              : scalar_type::float64;
        const bool all_fit =
            io::has_single_axes(e) && std::ranges::all_of(e.columns, [&](const column& c) {
                const std::size_t k = io::is_axis(c) ? io::axis_number(c.role) : 0;
                return !io::is_axis(c) || !io::keeps_digits(c) || (axes_[k] && !outgrown_[k]);
            });
        if (all_fit) head.stored_as = precision::float32;  // or they would be written as doubles
        return as;
    }

  private:
    std::function<void(points_view)> take_;
    element vertices_{};
    std::array<bool, 3> axes_{};      ///< coordinates whose types are asked for
    std::array<bool, 3> outgrown_{};  ///< those of them that do not fit into it
    bool single_ = true;
    bool extended_ = false;
};

/// The last pass over the input.
class giving_back {
  public:
    giving_back(cancellable_progress& pace, const tile_task& task, const weld_stream_outputs& asked,
                tile_steps& steps, tiles_welded& welded, kept_rows* rows, tile_faces* faces,
                const work_folder& work, weld_stream_result& made)
        : pace_(pace),
          task_(task),
          work_(work),
          all_(steps.all()),
          asked_(asked),
          survey_(steps.survey()),
          steps_(steps),
          welded_(welded),
          rows_(rows),
          faces_(faces),
          head_(steps.source().header()),
          made_(made) {
        head_.stored_as = survey_.fits_float32 ? precision::float32 : precision::float64;
        head_.ranges = survey_.ranges;
        is_divided_ = may_divide();
        if (is_divided_) return;
        steps.gather_first(welded);
        if (rows != nullptr) rows->gather_first(welded);
    }

    void run() {
        const bool asked = asked_.welded || asked_.removed || wants_map();
        if (!asked || (!is_divided_ && !all_.is_root())) return;
        add_columns();
        survey_outputs();
        if (asked_.removed && !removed_head_.las && is_las(*asked_.removed)) survey_removed();
        open_files();
        give_all();
    }

  private:
    /// Whether each rank writes what is assigned to it.
    [[nodiscard]] bool may_divide() const {
        const element* const vertices = head_.attributes.find("vertex");
        const bool has_lists =
            vertices != nullptr && std::ranges::any_of(vertices->columns, [](const column& c) {
                return c.list_length.has_value();
            });
        const auto has_parts = [&](const std::optional<output_path>& to) {
            if (!to) return true;
            if (to->first == "-" || is_special(to->first)) return false;
            mesh_file head = removed_head();  // parts of points, whatever is behind them
            if (!head.las) head.las.emplace();
            const point_writer writer(part("none"), head, 0, points_out::options_of(*to));
            return writer.has_parts() && !(has_lists && writer.part_granularity() > 1);
        };
        return !all_.is_alone() && !asked_.map && has_parts(asked_.welded) &&
               has_parts(asked_.removed);
    }
    [[nodiscard]] bool wants_map() const { return asked_.map || !asked_.map_path.empty(); }
    [[nodiscard]] bool wants_numbers() const { return wants_map() || !asked_.label.empty(); }
    [[nodiscard]] fs::path part(const char* name) const {
        return work_.file(name + ("." + std::to_string(all_.rank())));
    }
    [[nodiscard]] bool drops_nothing() const { return asked_.withhold || !asked_.label.empty(); }
    /// Whether coordinates of `welded` are not those of points.
    [[nodiscard]] bool has_means() const { return task_.options.keep == weld_keep::mean; }

    void open_files() {
        const std::uint64_t dropped = welded_.dropped;
        const communicator* const parts = is_divided_ ? &all_ : nullptr;
        if (!asked_.map_path.empty()) map_.emplace(asked_.map_path, parts, part("map"));
        const std::uint64_t mine = welded_.points.size();
        if (asked_.removed) {
            removed_.emplace(*asked_.removed, removed_head_, dropped, parts, part("removed"));
            removed_->start_part(work_, removed_head_, "removed",
                                 rows_ != nullptr ? rows_->dropped() : welded_.kept.dropped());
        }
        if (asked_.welded)
            result_.emplace(*asked_.welded, head_,
                            drops_nothing() ? survey_.points : survey_.points - dropped, parts,
                            part("welded"),
                            faces_ == nullptr ? 0 : faces_->most_corners(drops_nothing()));
        if (result_)
            result_->start_part(work_, head_, "welded",
                                drops_nothing() ? mine : mine - welded_.kept.dropped());
    }

    /// What the outputs have that the input has not.
    void add_columns() {
        removed_head_ = removed_head();
        if (!asked_.welded) return;
        if (faces_ != nullptr) faces_->describe(head_, drops_nothing());
        if (has_means() && !rows_->single()) head_.stored_as = precision::float64;
        if (!asked_.label.empty())
            made_.label_replaced = head_.attributes.find_or_add("vertex", 0)
                                       .set({.name = asked_.label, .type = scalar_type::uint32});
        if (asked_.withhold)
            head_.attributes.find_or_add("vertex", 0)
                .set({.name = "withheld", .type = scalar_type::uint8});
    }

    /// Of the header only the points and what they have.
    [[nodiscard]] mesh_file removed_head() const {
        mesh_file head;
        head.format = head_.format;
        head.stored_as = head_.stored_as;
        head.las = head_.las;
        head.ranges = head_.ranges;
        if (const element* vertices = head_.attributes.find("vertex"))
            head.attributes.elements.push_back(*vertices);
        return head;
    }

    /// Calls `take` with each block, which `first_` is the number of the first point of, until it
    /// returns false.
    template <class Take>
    void each_block(const Take& take) {
        joined_points& source = steps_.source();
        const share& mine = welded_.points;
        source.rewind(is_divided_ ? mine : share{});
        if (rows_ != nullptr) rows_->rewind();
        if (wants_numbers())
            numbers_.emplace(pace_, work_, is_divided_ ? all_ : lone_, steps_, welded_);
        first_ = mine.first;
        given_ = 0;
        io::point_block block;
        while (source.read(block, points_a_block)) {
            if (!take(block)) return;
            first_ += block.points.size();
        }
        const fs::path& input = task_.inputs.paths.front();
        if (first_ != mine.last)
            throw io_error(io_error::kind::input_changed, input,
                           input.string() + ": the file changed while it was read");
        if (given_ != mine.size() - welded_.kept.dropped())
            throw std::logic_error("points in are not points kept and points removed");
    }

    /// What makes of LAS another format, and of coordinates other types, as far as it is not known.
    void survey_outputs() {
        const bool of_las = task_.options.as_las && las_is_asked();
        output_survey welded(head_, axes_asked(asked_.welded, head_, has_means()));
        output_survey removed(removed_head_, axes_asked(asked_.removed, removed_head_, false));
        if (!of_las && !welded.asks() && !removed.asks()) return;
        each_block([&](io::point_block& block) {
            give(block, asked_.welded ? &welded : nullptr, asked_.removed ? &removed : nullptr);
            pace_.check();
            return of_las || welded.asks() || removed.asks();
        });
        if (is_divided_) welded.share(all_);
        if (is_divided_) removed.share(all_);
        if (of_las) welded.describe(head_);
        if (of_las) removed.describe(removed_head_);
        welded_as_ = welded.describe_types(head_);
        removed_as_ = removed.describe_types(removed_head_);
    }

    /// Coordinates with declared types that points may have outgrown: by their digits in text, as
    /// means, rounded to the steps of LAS, or in another file.
    [[nodiscard]] std::array<bool, 3> axes_asked(const std::optional<output_path>& to,
                                                 const mesh_file& head, bool means) const {
        std::array<bool, 3> asked{};
        const element* const vertices = head.attributes.find("vertex");
        if (!to || vertices == nullptr) return asked;
        const write_options options = points_out::options_of(*to);
        const io::known_format& format = io::find_format(to->first, options);
        const bool has_types = format.extension == "ply" || format.extension == "pcd";
        if (!has_types || options.precision) return asked;
        means = means || task_.options.as_las;
        for (const column& c : vertices->columns) {
            if (!io::is_axis(c) || c.type == scalar_type::float64) continue;
            if (io::keeps_digits(c) && io::writes_text(format, options)) continue;
            const bool may_be_long =
                io::keeps_digits(c) ? !survey_.fits_float32 : survey_.sources.size() > 1;
            asked[io::axis_number(c.role)] = means || may_be_long;
        }
        return asked;
    }

    [[nodiscard]] bool las_is_asked() const {
        const auto may_extend = [](const mesh_file& head) {
            const element* const vertices = head.attributes.find("vertex");
            return vertices != nullptr && !io::is_extended(*head.las) &&
                   std::ranges::any_of(vertices->columns, [](const column& c) {
                       return c.name == "classification" || c.name == "return_number" ||
                              c.name == "number_of_returns";
                   });
        };
        const bool all_las = std::ranges::all_of(
            survey_.sources, [](const auto& one) { return one.format.starts_with("la"); });
        return survey_.fits_float32 || (!all_las && may_extend(head_));
    }

    [[nodiscard]] static bool is_las(const output_path& to) {
        const std::string format = points_out::options_of(to).format;
        return format == "las" || format == "laz";
    }

    /// The steps of LAS that hold the dropped points, where no other file has any.
    void survey_removed() {
        const communicator& all = is_divided_ ? all_ : lone_;
        output_survey seen;
        const auto each = [&](const std::function<void(points_view)>& take) {
            seen = output_survey(take);
            each_block([&](io::point_block& block) {
                give(block, static_cast<output_survey*>(nullptr), &seen);
                pace_.check();
                return true;
            });
        };
        removed_head_.las = las_grid_of(
            each, all, {asked_.removed->second.las_scale, asked_.removed->second.las_offset});
        seen.share(all);
        seen.describe(removed_head_);
    }

    void give_all() {
        const share& mine = welded_.points;
        each_block([&](io::point_block& block) {
            give(block, result_ ? &*result_ : nullptr, removed_ ? &*removed_ : nullptr);
            if (asked_.map) asked_.map(groups_);
            if (map_) map_->write(asked_.map_text(first_, groups_));
            pace_.show("write", static_cast<double>(first_ - mine.first + block.points.size()) /
                                    static_cast<double>(mine.size()));
            return true;
        });
        steps_.step_done();
        if (result_ && faces_ != nullptr) result_->write(*faces_, drops_nothing());
        if (removed_) made_.removed = removed_->commit();
        if (result_) made_.welded = result_->commit();
        if (welded_as_) made_.welded->written_as = *welded_as_;
        if (removed_as_) made_.removed->written_as = *removed_as_;
        if (map_) map_->commit();
        if (is_divided_) made_.las_moved = all_.most(made_.las_moved);
    }

    template <class Out>
    void give(io::point_block& block, Out* welded, Out* removed) {
        if (numbers_) number(block.points.size());
        kept_.clear();
        gone_.clear();
        for (std::uint32_t row = 0; row < block.points.size(); ++row) {
            if (welded_.kept.keeps(first_ + row)) kept_.push_back(row);
            if (!gives(first_ + row)) gone_.push_back(row);
        }
        given_ += kept_.size();
        if (removed != nullptr) removed->write(block, gone_);
        if (welded == nullptr) return;
        if (drops_nothing()) {
            mark(block);
            welded->write(block);
            return;
        }
        if (rows_ != nullptr) put_rows(block);
        welded->write(block, kept_);
    }

    [[nodiscard]] bool gives(std::uint64_t point) const {
        return rows_ != nullptr ? rows_->gives(point) : welded_.kept.keeps(point);
    }

    void put_rows(io::point_block& block) {
        for (const std::uint32_t row : kept_)
            if (!welded_.followed->keeps(first_ + row)) rows_->replace(block, row);
        if (!has_means() || !task_.options.as_las || !head_.las) return;
        mesh_file file;
        file.las = las_header{.scale = head_.las->scale, .offset = head_.las->offset};
        file.mesh.points = std::move(block.points);
        made_.las_moved = std::max(made_.las_moved, round_to_las(file));
        block.points = std::move(file.mesh.points);
    }

    /// Labels, and flags as `treeform::withhold` sets them.
    void mark(io::point_block& block) {
        block.properties.rows = block.points.size();
        if (!asked_.label.empty()) {
            const std::vector<std::uint32_t> groups(groups_.begin(), groups_.end());
            block.properties.set(column::of<std::uint32_t>(asked_.label, groups));
        }
        if (!asked_.withhold) return;
        std::vector<std::uint8_t> flags(block.points.size());
        const column* const before = block.properties.find("withheld");
        for (std::size_t i = 0; i < flags.size(); ++i)
            flags[i] = before != nullptr && !before->list_length && before->number(i) != 0.0;
        for (const std::uint32_t row : gone_) flags[row] = 1;
        block.properties.set(column::of<std::uint8_t>("withheld", flags));
    }

    /// The groups of the points of a block.
    void number(std::size_t count) {
        groups_.resize(count);
        for (std::size_t row = 0; row < count; ++row) groups_[row] = numbers_->of(first_ + row);
    }

    cancellable_progress& pace_;
    const tile_task& task_;
    const work_folder& work_;
    const communicator& all_;
    const weld_stream_outputs& asked_;
    const cloud_survey& survey_;
    tile_steps& steps_;
    tiles_welded& welded_;
    kept_rows* rows_;
    tile_faces* faces_;
    mesh_file head_;
    mesh_file removed_head_{};
    weld_stream_result& made_;
    std::optional<precision> welded_as_{};  ///< to be reported of the file, where types were chosen
    std::optional<precision> removed_as_{};
    std::optional<points_out> removed_{};
    std::optional<points_out> result_{};
    std::optional<text_out> map_{};
    std::optional<new_numbers> numbers_{};
    const communicator lone_{treeform::communicator{}};
    bool is_divided_ = false;
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

void write_outputs(cancellable_progress& pace, const tile_task& task,
                   const weld_stream_outputs& outputs, tile_steps& steps, tiles_welded& welded,
                   kept_rows* rows, tile_faces* faces, const work_folder& folder,
                   weld_stream_result& made) {
    state_writer state;
    state.number(outputs.unfinished.size());
    for (const fs::path& path : outputs.unfinished) state.text(fs::absolute(path).string());
    if (steps.all().is_root()) folder.store(leftovers, state);
    giving_back(pace, task, outputs, steps, welded, rows, faces, folder, made).run();
}

}  // namespace treeform::detail::stream
