#pragma once

#include "field/field.h"
#include "shaders/shared/wind.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace sward::render {

/// One source of wind where the world counts from, and in double precision.
struct WindSource {
    shared::WindSource source = {}; ///< its `centre` is ignored
    glm::dvec3 centre{0.0};         ///< world [m]
};

/// A source of one kind (shared::windNoise …) that blows with `strength` and its other numbers as
/// the settings file has them by default.
WindSource windSource(std::uint32_t kind);

/// The sources of a field's own breeze: waves and carried noise that share its strength.
std::vector<WindSource> sourcesOf(const field::Wind& breeze);

/// Sum of the strengths [1/s]: no more than about this blows anywhere.
float windStrength(const std::vector<WindSource>& sources);

/// Makes `strength` of windStrength(); sources that have none stay as they are.
void scaleWind(std::vector<WindSource>& sources, float strength);

/// What blows at all, as the shaders read it: relative to `origin`, kind after kind.
std::vector<shared::WindSource> blowing(const std::vector<WindSource>& sources, glm::dvec3 origin);

/// Such sources, at most shared::maxWindSources, as the shaders know them. Eddies are twice as
/// large as the finest source with a direction, but no larger than a quarter of `extent` [m], the
/// size of what is seen, and as quick as the quickest.
shared::Wind together(std::span<const shared::WindSource> sources, float extent);

} // namespace sward::render
