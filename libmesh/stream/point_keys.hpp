#pragma once
/// \file
/// Computes the values of points that the order, the conditions and the choice of kept points use,
/// block by block.

#include <libmesh/weld/vertex_values.hpp>
#include <treeform/mesh/point_stream.hpp>
#include <treeform/mesh/weld_stream.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace treeform::detail::stream {

class point_keys {
  public:
    /// \throws weld_property_error for a property that `header` does not have in a usable form,
    ///         std::invalid_argument as `weld`
    point_keys(const mesh_file& header, const weld_stream_options& options);

    /// The conditions on the values.
    [[nodiscard]] const weld::agreement& agree() const { return agree_; }
    [[nodiscard]] const std::vector<weld_condition>& conditions() const { return conditions_; }

    /// Writes the values of all points, point after point, to `to`.
    void values_of(io::point_block& block, std::vector<std::uint64_t>& to) const;
    /// Writes one key for each point: smaller for points that come earlier in the order, or are
    /// preferred; 0 without a property.
    void order_of(io::point_block& block, std::vector<std::uint64_t>& to) const;
    void choice_of(io::point_block& block, std::vector<std::uint64_t>& to) const;

  private:
    struct key_column {
        std::string property{};
        bool lowest = true;
    };
    static void take(io::point_block& block, const key_column& p, std::vector<std::uint64_t>& to);

    std::vector<weld_condition> conditions_{};
    weld::agreement agree_{};
    key_column order_{};
    key_column choice_{};
};

}  // namespace treeform::detail::stream
