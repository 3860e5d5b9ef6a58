#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sward::field {
struct Wind;
} // namespace sward::field

namespace sward::shared {
struct Wind;
struct WindLattice;
struct WindSource;
} // namespace sward::shared

namespace sward::render {

/// Kinds of sources; docs/algorithms/wind.md has their formulas.
enum WindKind : std::uint32_t {
    windNoise,   ///< a direction times value noise that moves with the wind
    windTurning, ///< a sine of the time, in a direction that may turn
    windWave,    ///< a directional wave
    windRadial,  ///< rings around a centre
    windSwirl,   ///< away from a centre and around it
    windGusts    ///< fronts that rise quickly and decay slowly
};

inline constexpr std::uint32_t windKinds = 6; ///< number of WindKind

/// What blows from a source. A kind may leave members unused.
struct WindPattern {
    glm::vec3 direction{0.0f}; ///< blowing direction (not radial, swirl); 0: along x
    /// [1/s] maximum pull on a blade across it, in its heights per second.
    float strength = 0.0f;
    /// [m] noise: grain along the wind, half of that across; turning, wave: from crest to crest;
    /// gusts: from front to front; radial, swirl: distance at which the wind ends.
    float size = 0.0f;
    float speed = 0.0f;     ///< [m/s] of noise, waves, rings and fronts
    float rate = 0.0f;      ///< [rad/s] of the sine (turning)
    float turn = 0.0f;      ///< [rad/s] of the direction about the blade's up-vector (turning)
    float alignment = 0.0f; ///< [0, 1] reduction for a blade that lies along the wind
    float lift = 0.0f;      ///< [0, 1] share that is kept of the wind along the blade's up-vector
    std::uint32_t kind = windNoise; ///< WindKind
};

/// How fast the pattern of a source moves in the world.
struct WindPace {
    glm::dvec3 direction{0.0}; ///< unit, world space
    double perSecond = 0.0;    ///< [1/s] sizes of the source
};

/// A source of wind in world space and double precision.
struct WindSource {
    WindPattern source{};   ///< what blows
    glm::dvec3 centre{0.0}; ///< world [m] (radial, swirl)

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

/// A source of one WindKind with the settings file's defaults. Throws Error{usage} for another.
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

/// Largest number of sources that blow at once.
inline constexpr std::size_t maxWindSources = 8;

/// Combines at most maxWindSources such sources for shaders. Eddies are twice as large as
/// the finest source with a direction, but at most a quarter of `extent` [m], the size of the
/// visible content; their speed is the fastest source's. The wind is that of time 0: moveTo() in
/// wind_phase.h moves it on.
shared::Wind together(std::span<const shared::WindSource> sources, float extent,
                      const shared::WindLattice& lattice);
shared::Wind together(std::span<const shared::WindSource> sources,
                      float extent); ///< in the world itself

} // namespace sward::render
