#pragma once
/// \file
/// Points, boxes and matrices as JSON.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/aabb.hpp>

#include <nlohmann/json.hpp>

#include <optional>

/// Points are lists of three numbers, boxes have two of them, matrices have four rows; what is not
/// there is null.
template <>
struct nlohmann::adl_serializer<treeform::point3> {
    template <class Json>
    static void to_json(Json& to, const treeform::point3& p) {
        to = {p.x, p.y, p.z};
    }
};
template <>
struct nlohmann::adl_serializer<treeform::box3> {
    template <class Json>
    static void to_json(Json& to, const treeform::box3& box) {
        to = {{"min", box.min}, {"max", box.max}};
    }
};
template <>
struct nlohmann::adl_serializer<treeform::transform<3>> {
    template <class Json>
    static void to_json(Json& to, const treeform::transform<3>& matrix) {
        to = matrix.rows;
        to.push_back({0.0, 0.0, 0.0, 1.0});
    }
};
template <class T>
struct nlohmann::adl_serializer<std::optional<T>> {
    template <class Json>
    static void to_json(Json& to, const std::optional<T>& value) {
        to = value ? Json(*value) : Json(nullptr);
    }
};

namespace tools {

using json = nlohmann::ordered_json;

}  // namespace tools
