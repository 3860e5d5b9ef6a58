#pragma once

#include "field/field.h"
#include "shaders/shared/wind.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sward::render {

/// How fast the pattern of a source moves in the world.
struct WindPace {
    glm::dvec3 direction{0.0}; ///< unit, world space
    double perSecond = 0.0;    ///< [1/s] sizes of the source
};

/// A source of wind in world space and double precision.
struct WindSource {
    shared::WindSource source = {}; ///< its `centre` is unused
    glm::dvec3 centre{0.0};         ///< world [m]

    /// That of the world's source, after inField(): fields whose placements round it differently
    /// would drift apart over years. Unset: that of `source`.
    std::optional<WindPace> pace{};
};

/// Smallest size of a source [m]: a zero size of a wave or gust would divide by zero.
inline constexpr float smallestWindSize = 1e-3f;

/// Where a field's places lie in the world that the wind blows through: world = position + scale ·
/// rotation · place. Fields of one world share waves, gusts and noise whatever their frames.
struct WindFrame {
    glm::dvec3 position{0.0};                ///< world [m]
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0}; ///< unit
    double scale = 1.0;                      ///< > 0
};

/// Patterns repeat after this distance along the world's axes [m]: beyond it single precision would
/// show steps.
inline constexpr double windPeriod = 131072.0;

/// The lattice of a field with that `origin` in its own places.
shared::WindLattice latticeOf(glm::dvec3 origin, const WindFrame& frame);

/// A source of one kind (shared::windNoise …) with the given `strength` and the settings file's
/// defaults otherwise.
WindSource windSource(std::uint32_t kind);

/// The sources of a field's own breeze: waves and advected noise that share its strength.
std::vector<WindSource> sourcesOf(const field::Wind& breeze);

/// Sum of the strengths [1/s]: approximate upper bound of the wind anywhere.
float windStrength(const std::vector<WindSource>& sources);

/// Scales sources so that windStrength() is `strength`. Sources without strength stay.
void scaleWind(std::vector<WindSource>& sources, float strength);

/// The sources with non-zero strength, sorted by kind.
std::vector<WindSource> withStrength(std::span<const WindSource> sources);

/// The sources with non-zero strength in shader form: relative to `origin`, sorted by kind.
std::vector<shared::WindSource> blowing(const std::vector<WindSource>& sources, glm::dvec3 origin,
                                        const WindFrame& frame = {});

/// Combines at most shared::maxWindSources such sources for shaders. Eddies are twice as large as
/// the finest source with a direction, but at most a quarter of `extent` [m], the size of the
/// visible content; their speed is the fastest source's. The wind is that of time 0: moveTo() in
/// wind_phase.h moves it on.
shared::Wind together(std::span<const shared::WindSource> sources, float extent,
                      const shared::WindLattice& lattice = latticeOf(glm::dvec3(0.0), {}));

} // namespace sward::render
