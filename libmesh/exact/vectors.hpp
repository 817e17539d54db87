#pragma once
/// \file
/// Vectors over any number type, with only the operations that the polynomials of the predicates
/// need.

#include <array>
#include <cstddef>
#include <utility>

namespace treeform::detail::exact {

template <class Number>
struct vector2 {
    static constexpr std::size_t axes = 2;
    Number x, y;
};

template <class Number>
struct vector3 {
    static constexpr std::size_t axes = 3;
    Number x, y, z;
};

template <class Number>
constexpr auto operator-(const vector2<Number>& a, const vector2<Number>& b) {
    return vector2<decltype(a.x - b.x)>{a.x - b.x, a.y - b.y};
}

template <class Number>
constexpr auto operator-(const vector3<Number>& a, const vector3<Number>& b) {
    return vector3<decltype(a.x - b.x)>{a.x - b.x, a.y - b.y, a.z - b.z};
}

template <class Left, class Right>
constexpr auto cross(const vector2<Left>& a, const vector2<Right>& b) {
    return a.x * b.y - a.y * b.x;
}

template <class Left, class Right>
constexpr auto cross(const vector3<Left>& a, const vector3<Right>& b) {
    using component = decltype(a.x * b.y - a.y * b.x);
    return vector3<component>{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class Left, class Right>
constexpr auto dot(const vector3<Left>& a, const vector3<Right>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Applies `f` to each component.
template <class Number, class Function>
constexpr auto transform(const vector2<Number>& v, const Function& f) {
    return vector2<decltype(f(v.x))>{f(v.x), f(v.y)};
}

template <class Number, class Function>
constexpr auto transform(const vector3<Number>& v, const Function& f) {
    return vector3<decltype(f(v.x))>{f(v.x), f(v.y), f(v.z)};
}

template <class Vector, std::size_t Count, class Function>
constexpr auto transform(const std::array<Vector, Count>& vectors, const Function& f) {
    return [&]<std::size_t... Is>(std::index_sequence<Is...>) {
        return std::array<decltype(transform(vectors[0], f)), Count>{transform(vectors[Is], f)...};
    }
    (std::make_index_sequence<Count>{});
}

/// Calls `f` with every component of every vector, in order.
template <class Vector, std::size_t Count, class Function>
constexpr void for_each_component(const std::array<Vector, Count>& vectors, const Function& f) {
    const auto visit = [&](const Vector& v) {
        f(v.x), f(v.y);
        if constexpr (Vector::axes == 3) f(v.z);
    };
    [&]<std::size_t... Is>(std::index_sequence<Is...>) { (visit(vectors[Is]), ...); }
    (std::make_index_sequence<Count>{});
}

}  // namespace treeform::detail::exact
