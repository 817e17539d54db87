#include "bench/peers/fcl_models.hpp"

#include "bench/peers/versions.hpp"

#include <fcl/config.h>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <limits>

namespace treeform::bench {
namespace {

struct arrays {
    std::vector<fcl::Vector3d> points;
    std::vector<fcl::Triangle> triangles;
};

arrays arrays_of(const mesh& mesh) {
    arrays result;
    for (const point3& p : mesh.points) result.points.emplace_back(p.x, p.y, p.z);
    for (const face& f : mesh.faces) result.triangles.emplace_back(f[0], f[1], f[2]);
    return result;
}

template <class Volume>
std::shared_ptr<fcl::BVHModel<Volume>> model_of(const arrays& given) {
    auto model = std::make_shared<fcl::BVHModel<Volume>>();
    model->beginModel(static_cast<int>(given.triangles.size()),
                      static_cast<int>(given.points.size()));
    model->addSubModel(given.points, given.triangles);
    model->endModel();
    return model;
}

template <class Volume>
job build_job(const mesh& mesh) {
    const auto given = std::make_shared<const arrays>(arrays_of(mesh));
    return make_job([given] { return model_of<Volume>(*given); });
}

fcl::Transform3d placed(const transform<3>& pose) {
    fcl::Transform3d result = fcl::Transform3d::Identity();
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
            result(row, column) =
                pose.rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
    return result;
}

template <class Volume>
class pair_of final : public fcl_pair {
  public:
    pair_of(const mesh& a, const mesh& b)
        : a_(model_of<Volume>(arrays_of(a))), b_(model_of<Volume>(arrays_of(b))) {}

    bool collide(const transform<3>& pose) const override { return contacts(pose, 1) != 0; }
    std::size_t intersect(const transform<3>& pose) const override {
        return contacts(pose, static_cast<std::size_t>(std::numeric_limits<int>::max()));
    }
    double distance(const transform<3>& pose) const override {
        const fcl::DistanceRequestd request;
        fcl::DistanceResultd result;
        return fcl::distance(a_.get(), fcl::Transform3d::Identity(), b_.get(), placed(pose),
                             request, result);
    }

  private:
    std::size_t contacts(const transform<3>& pose, std::size_t most) const {
        const fcl::CollisionRequestd request(most, false);
        fcl::CollisionResultd result;
        fcl::collide(a_.get(), fcl::Transform3d::Identity(), b_.get(), placed(pose), request,
                     result);
        return result.numContacts();
    }

    std::shared_ptr<fcl::BVHModel<Volume>> a_, b_;
};

}  // namespace

job fcl_build(const mesh& mesh, fcl_volume volume) {
    switch (volume) {
        case fcl_volume::aabb:
            return build_job<fcl::AABBd>(mesh);
        case fcl_volume::rss:
            return build_job<fcl::RSSd>(mesh);
        case fcl_volume::obbrss:
            break;
    }
    return build_job<fcl::OBBRSSd>(mesh);
}

std::shared_ptr<const fcl_pair> fcl_pair_of(const mesh& a, const mesh& b, fcl_volume volume) {
    switch (volume) {
        case fcl_volume::aabb:
            return std::make_shared<pair_of<fcl::AABBd>>(a, b);
        case fcl_volume::rss:
            return std::make_shared<pair_of<fcl::RSSd>>(a, b);
        case fcl_volume::obbrss:
            break;
    }
    return std::make_shared<pair_of<fcl::OBBRSSd>>(a, b);
}

std::string fcl_name() { return "FCL " FCL_VERSION; }

}  // namespace treeform::bench
