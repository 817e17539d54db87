#include <libmesh/base/point_faces.hpp>
#include <libmesh/base/prepared_slots.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/parallel.hpp>

#include <array>
#include <atomic>
#include <utility>

namespace treeform {

struct prepared_mesh::state {
    struct slot {
        detail::once filled;
        std::shared_ptr<const void> index;
    };

    mesh owned{};
    detail::once made_faces{};
    std::vector<face> point_faces{};  // of a cloud, once a query needs them
    std::array<slot, static_cast<std::size_t>(detail::base::slot_name::count)> places{};
    std::atomic<std::uint64_t> built{0};
};

prepared_mesh::prepared_mesh() : state_(std::make_shared<state>()) {}
prepared_mesh::~prepared_mesh() = default;

prepared_mesh::prepared_mesh(mesh&& owned) : prepared_mesh() {
    state_->owned = std::move(owned);
    view_ = state_->owned;
    cloud_ = mesh_ref(view_).is_cloud();
}

prepared_mesh prepared_mesh::borrow(mesh_view view) {
    prepared_mesh result = detail::base::prepared_slots::of_faces(view);
    result.cloud_ = mesh_ref(view).is_cloud();
    return result;
}

prepared_mesh detail::base::prepared_slots::of_faces(mesh_view view) {
    prepared_mesh result;
    result.view_ = view;
    return result;
}

mesh_view prepared_mesh::view_of_cloud() const {
    state_->made_faces.call(
        [&] { state_->point_faces = detail::base::point_faces(view_.points.size()); });
    return {view_.points, state_->point_faces};
}

prepared_mesh::prepared_mesh(prepared_mesh&& other) noexcept
    : view_(std::exchange(other.view_, {})),
      cloud_(other.cloud_),
      state_(std::move(other.state_)) {}

prepared_mesh& prepared_mesh::operator=(prepared_mesh&& other) noexcept {
    view_ = std::exchange(other.view_, {});
    cloud_ = other.cloud_;
    state_ = std::move(other.state_);
    return *this;
}

std::uint64_t prepared_mesh::indexes_built() const { return state_->built.load(); }

prepared_mesh detail::base::prepared_slots::shared(const prepared_mesh& mesh) {
    prepared_mesh result;
    result.view_ = mesh.view_;
    result.cloud_ = mesh.cloud_;
    result.state_ = mesh.state_;
    return result;
}

const void* detail::base::prepared_slots::get(const prepared_mesh& mesh, slot_name name,
                                              function_ref<std::shared_ptr<const void>()> build) {
    auto& kept = mesh.state_->places[static_cast<std::size_t>(name)];
    kept.filled.call([&] {
        kept.index = build();
        mesh.state_->built.fetch_add(1, std::memory_order_relaxed);
    });
    return kept.index.get();
}

}  // namespace treeform
