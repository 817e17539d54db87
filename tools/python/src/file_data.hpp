#pragma once
/// \file
/// What a mesh has besides points and faces.

#include "base.hpp"

namespace binding {

/// Pairs of names as Python has them: the new one, and that in the file.
using name_pairs = std::vector<std::pair<std::string, std::string>>;

/// All that a file has besides points and faces: a `mesh_file` without its mesh. Copies share it
/// until one of them is changed: a copy made with the interpreter's lock stays as it is without it.
class file_data {
  public:
    file_data() : file_(std::make_shared<treeform::mesh_file>()) {}
    explicit file_data(treeform::mesh_file file)
        : file_(std::make_shared<treeform::mesh_file>(std::move(file))) {}

    [[nodiscard]] const treeform::mesh_file& file() const { return *file_; }
    /// To be changed.
    [[nodiscard]] treeform::mesh_file& own() {
        if (file_.use_count() != 1) file_ = std::make_shared<treeform::mesh_file>(*file_);
        std::atomic_thread_fence(std::memory_order_acquire);  // behind who has read it last
        return *file_;
    }

  private:
    std::shared_ptr<treeform::mesh_file> file_;
};

}  // namespace binding
