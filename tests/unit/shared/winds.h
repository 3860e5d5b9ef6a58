#pragma once

#include "shaders/shared/physics.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

namespace sward::tests {

/// Sources of wind on the CPU, and the colliders of a frame.
class EnvironmentTables {
public:
    explicit EnvironmentTables(std::vector<shared::WindSource> sources = {},
                               std::vector<shared::Collider> colliders = {})
        : sources_(std::move(sources))
        , colliders_(std::move(colliders))
    {
        std::stable_sort(sources_.begin(), sources_.end(),
                         [](const auto& a, const auto& b) { return a.kind < b.kind; });
        for (shared::WindSource& source : sources_)
            source = shared::preparedSource(source);
    }
    EnvironmentTables(const EnvironmentTables&) = delete;
    EnvironmentTables& operator=(const EnvironmentTables&) = delete;

    shared::Wind wind() const
    {
        shared::Wind wind = {};
        wind.lattice.x = {1.0f, 0.0f, 0.0f};
        wind.lattice.y = {0.0f, 1.0f, 0.0f};
        wind.lattice.z = {0.0f, 0.0f, 1.0f};
        wind.eddySize = 5.0f;
        wind.eddySpeed = 2.5f;
        std::copy(sources_.begin(), sources_.end(), wind.sources);
        std::fill(std::begin(wind.phases), std::end(wind.phases), shared::windPhaseAtZero());
        bool alike = !sources_.empty();
        for (const shared::WindSource& source : sources_) {
            wind.counts += 1u << (4u * source.kind);
            wind.sum += source.strength;
            alike = alike && shared::blowsLike(sources_.front(), source);
        }
        if (alike)
            wind.counts |= shared::windsAlike;
        return wind;
    }

    shared::Environment environment(shared::Gravity gravity, float recovery) const
    {
        shared::Environment environment = {};
        environment.gravity = gravity;
        environment.recovery = recovery;
        environment.wind = wind();
        environment.colliderCount = static_cast<std::uint32_t>(colliders_.size());
        environment.colliders.at = colliders_.data();
        return environment;
    }

    /// All colliders.
    shared::ColliderMask everyCollider() const
    {
        shared::ColliderMask mask = shared::noColliders();
        for (std::size_t i = 0; i < colliders_.size(); ++i)
            mask.words[i / 32] |= 1u << (i % 32);
        return mask;
    }

private:
    std::vector<shared::WindSource> sources_;
    std::vector<shared::Collider> colliders_;
};

/// A source of one kind with plausible numbers, blowing along (0.6, 0, 0.8).
inline shared::WindSource windSourceOf(std::uint32_t kind, float strength)
{
    shared::WindSource source = {};
    source.kind = kind;
    source.direction = {0.6f, 0.0f, 0.8f};
    source.strength = strength;
    source.size = kind == shared::windRadial || kind == shared::windSwirl ? 40.0f : 5.0f;
    source.speed = 3.0f;
    source.rate = 1.3f;
    source.turn = 0.2f;
    source.alignment = 1.0f;
    return source;
}

} // namespace sward::tests
