#pragma once
/// \file
/// Files of poses: JSON lines, plain matrices, reports of tf-place.

#include <treeform/mesh/read.hpp>
#include <treeform/tf.hpp>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace tools {

/// A pose after the other, as they are asked for.
class pose_file {
  public:
    /// Poses of parts with these names, or, with a robot, of links with these numbers.
    /// \throws failure (bad_input) naming the file, the line and the reason; likewise below
    pose_file(const std::string& path, const std::vector<std::string>& parts);
    pose_file(const std::string& path, const tf::urdf_robot& robot,
              const std::vector<std::uint32_t>& links);

    /// Appends the transforms of all parts in up to `most` further poses. Returns how many.
    std::size_t next(std::size_t most, std::vector<tf::transform<3>>& poses);

  private:
    enum class form { lines, matrices, report };

    void open(const std::string& path);
    void begin_report();
    [[noreturn]] void fail(const std::string& why) const;
    [[nodiscard]] bool next_line(std::vector<tf::transform<3>>& poses);
    [[nodiscard]] bool next_matrices(std::vector<tf::transform<3>>& poses);
    [[nodiscard]] bool next_of_report(std::vector<tf::transform<3>>& poses);
    void enter_parts(const std::string& line, std::vector<tf::transform<3>>& poses) const;
    void enter_joints(const std::string& line, std::vector<tf::transform<3>>& poses) const;

    std::string path_;
    std::string text_;
    std::size_t at_ = 0;
    std::size_t line_ = 0;
    form form_ = form::lines;
    std::size_t part_count_ = 0;
    const std::vector<std::string>* parts_ = nullptr;
    const tf::urdf_robot* robot_ = nullptr;
    const std::vector<std::uint32_t>* links_ = nullptr;
    std::vector<tf::transform<3>> of_report_{};
    std::size_t next_of_report_ = 0;
};

}  // namespace tools
