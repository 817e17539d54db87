#pragma once
/// \file
/// The attributes of a mesh.

#include "base.hpp"

namespace binding {

/// Pairs of a new name and the name in the file.
using name_pairs = std::vector<std::pair<std::string, std::string>>;

/// Everything in a file besides points and faces: a `mesh_file` without its mesh. Copies share it
/// until one of them is changed, so a copy can be used without the interpreter's lock.
class file_data {
  public:
    file_data() : file_(std::make_shared<treeform::mesh_file>()) {}
    explicit file_data(treeform::mesh_file file)
        : file_(std::make_shared<treeform::mesh_file>(std::move(file))) {}

    [[nodiscard]] const treeform::mesh_file& file() const { return *file_; }
    /// For changes.
    [[nodiscard]] treeform::mesh_file& own() {
        if (file_.use_count() != 1) file_ = std::make_shared<treeform::mesh_file>(*file_);
        std::atomic_thread_fence(std::memory_order_acquire);  // after the last reader
        return *file_;
    }

  private:
    std::shared_ptr<treeform::mesh_file> file_;
};

}  // namespace binding
