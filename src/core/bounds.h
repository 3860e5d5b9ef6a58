#pragma once

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <limits>

namespace sward {

/// An axis-aligned box. Empty until a point is added: then `low` > `high`.
template <typename Vec>
struct Box {
    using Scalar = typename Vec::value_type;

    Vec low{std::numeric_limits<Scalar>::max()};
    Vec high{std::numeric_limits<Scalar>::lowest()};

    bool isEmpty() const { return low.x > high.x; }

    void add(const Vec& point)
    {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }

    void add(const Box& other)
    {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
    }

    Vec size() const { return isEmpty() ? Vec(Scalar(0)) : high - low; }
    Vec centre() const { return isEmpty() ? Vec(Scalar(0)) : (low + high) * Scalar(0.5); }
};

using Aabb = Box<glm::vec3>;
using DAabb = Box<glm::dvec3>;

} // namespace sward
