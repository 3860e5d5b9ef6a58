#pragma once

#include "bake/settings/settings.h"
#include "bake/settings/stroke.h"
#include "core/diagnostics.h"
#include "terrain/ground_mesh.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sward::bake {

/// Share of a stroke's points, or of its length, that may miss the ground without a warning.
inline constexpr double toldLoss = 0.1;

/// How much of a stroke touches ground. It is looked at in its points, and in places between them
/// that are at most a radius apart (256 between two points). A place touches ground if a triangle
/// that bears grass and faces the way of its normal is within its radius and depth.
struct StrokeContact {
    std::size_t points = 0;       ///< of the stroke
    std::size_t lostPoints = 0;   ///< that touch no ground
    std::size_t places = 0;       ///< points, and places between them
    std::vector<bool> lostPlaces; ///< which touch no ground, along the stroke; empty: none

    std::size_t lost() const;                        ///< number of lost places
    bool isLost() const { return lost() == places; } ///< it paints nothing
    /// Whether more than `toldLoss` of its points or places are lost.
    bool isWorthTelling() const;
};

/// A place of a stroke.
struct StrokePlace {
    glm::dvec3 position{0.0}; ///< [m] relative to an origin
    glm::dvec3 normal{0.0};   ///< unit, or 0: the stroke has none
    bool isPoint = true;      ///< one of the stroke's own
};

/// All places of a stroke, in its direction. `origin` must be a multiple of a millimetre.
std::vector<StrokePlace> placesOf(const Stroke& stroke, const glm::dvec3& origin);

/// Whether a surface of this unit normal is one that a place is painted on.
bool isFacedBy(const StrokePlace& place, const glm::dvec3& normal);

/// The contact of each stroke with triangles of the ground: with all, or those of `among`. Strokes
/// that would take more than some seconds count as touching.
std::vector<StrokeContact> contactsOf(const terrain::GroundMesh& ground, Sides sides,
                                      std::span<const Stroke> strokes,
                                      std::optional<std::span<const std::uint32_t>> among = {});

/// What messages call a stroke: strokes[3], with its name if it has one.
std::string nameOf(const Stroke& stroke, std::size_t index);

/// Warns of the strokes that touch no ground and of those that partly do, by their names. `place`
/// begins the message; `first` is the number of the first of them; `advice` ends it.
void warnOfContacts(std::span<const Stroke> strokes, std::span<const StrokeContact> contacts,
                    std::size_t first, const std::string& place, const std::string& advice,
                    Diagnostics& diagnostics);

} // namespace sward::bake
