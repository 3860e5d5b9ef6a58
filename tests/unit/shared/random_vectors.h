#pragma once

#include "core/random.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

namespace sward::tests {

/// Random numbers of one test, the same at every run.
class Dice {
public:
    explicit Dice(std::uint64_t seed)
        : seed_(seed)
    {
    }

    float number(float low, float high)
    {
        return low + (high - low) * static_cast<float>(uniform(seed_, count_++, 0));
    }

    glm::vec3 direction()
    {
        const float z = number(-1.0f, 1.0f);
        const float angle = number(0.0f, 6.2831853f);
        const float r = std::sqrt(std::max(1.0f - z * z, 0.0f));
        return glm::normalize(glm::vec3(r * std::cos(angle), r * std::sin(angle), z));
    }

private:
    std::uint64_t seed_;
    std::uint64_t count_ = 0;
};

} // namespace sward::tests
