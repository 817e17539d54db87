#pragma once
/// \file
/// One placement of one mesh among others: the common part of `slide`, `drop`, `mate` and
/// `separate`.

#include <libmesh/base/effort.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/place/shape.hpp>
#include <libmesh/place/surroundings.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/mesh/slide.hpp>
#include <treeform/tree/detail/function_ref.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <limits>
#include <optional>
#include <span>

namespace treeform::detail::place {

/// Where the nearest mesh is looked for. What is met on the way may be all that matters.
enum class looking { everywhere, on_the_way };

class placing {
  public:
    /// `function` was called, for what is refused.
    /// \throws std::invalid_argument for invalid options or operands
    placing(const char* function, const prepared_mesh& moving, std::span<const prepared_mesh> fixed,
            const placement_options& options, looking where);

    /// Measures the start position, finds the final one by `find`, and measures that.
    template <class Find>
    [[nodiscard]] placement run(const Find& find) {
        try {
            look_at_start();
            in_range([&] { find(*this); });
            look_at_place();
            work_.reach(1.0);
            over();
        } catch (const stopped&) {
            return {.certificate = {.status = status::cancelled},
                    .outcome = placement_outcome::cancelled};
        }
        return finished();
    }

    void slide(const point3& direction);
    void mate();
    void separate();
    /// Keeps the mesh at its position, if that is representable in the output precision.
    void stay();
    void measure() { result_.outcome = placement_outcome::unchanged; }

  private:
    struct stopped {};

    void over() const {
        if (work_.cancelled()) throw stopped{};
    }
    void in_range(const function_ref<void()>& find);
    [[nodiscard]] placement finished();
    [[nodiscard]] mesh_relation relation_of(const std::optional<relation_result>& near) const;
    [[nodiscard]] double radius(double more) const;
    [[nodiscard]] bool placed() const { return result_.outcome <= placement_outcome::moved_apart; }
    void find_nearest(const shape& a, const box3& box, double radius, double begin, double end);
    void look_at_start();
    void look_at_place();
    void on_bed_at_place(mesh_view there);
    [[nodiscard]] bool stuck_at_start();
    void settle(const chosen_parts& known, const point3& motion, double time, placement_outcome end,
                bool close_in = false, base::effort* effort = nullptr);
    void lift(const point3& motion, double above);
    void leave(const chosen_parts& parts, double clearance, base::effort& effort);
    void forget_place();

    const prepared_mesh& prepared_;
    shape moving_;
    surroundings among_;
    const char* function_;
    placement_options options_;
    looking where_;
    base::work_progress work_;
    std::optional<box3> box_;
    double longest_ = std::numeric_limits<double>::infinity();
    std::size_t faces_ = 0;  ///< total number of faces
    placement result_{};
};

}  // namespace treeform::detail::place
