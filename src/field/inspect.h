#pragma once

#include "field/field.h"
#include "field/seeds/compare_seeds.h"

#include <glm/mat4x4.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace sward::field {

/// Statistics of a field for users and programs.
struct Summary {
    std::uint64_t blades = 0;              ///< of the field, without those on stalks
    std::uint64_t ribbons = 0;             ///< on the stalks of compound plants
    std::uint64_t patches = 0;             ///< of its tree
    std::uint64_t leaves = 0;              ///< patches without children
    int levels = 0;                        ///< of the tree
    double bladesPerLeaf = 0.0;            ///< mean
    Aabb bounds;                           ///< of blades and ground, relative to the origin [m]
    double heightLow = 0;                  ///< [m]
    double heightMean = 0;                 ///< [m]
    double heightHigh = 0;                 ///< [m]
    double widthMean = 0;                  ///< [m]
    std::vector<std::uint64_t> perSpecies; ///< blades of each, without those on stalks
    std::uint64_t groundTriangles = 0;     ///< of all levels of detail
};
Summary summarise(const FieldView& field);

/// Differences of two fields after `transform` (world to world) is applied to the first.
struct Comparison {
    std::uint64_t matched = 0;            ///< blades in both, by their keys
    std::uint64_t onlyFirst = 0;          ///< blades without a match
    std::uint64_t onlySecond = 0;         ///< blades without a match
    double largestRootDistance = 0.0;     ///< [m] over matched blades, minus the packing error
    double largestUpAngle = 0.0;          ///< [rad]
    double largestFacingAngle = 0.0;      ///< [rad] between width axes in world space
    double largestHeightDifference = 0.0; ///< relative
    double largestWidthDifference = 0.0;  ///< relative
    std::uint64_t traitsDiffer = 0;   ///< matched blades that differ by more than the packing error
    SeedComparison seeds;             ///< zero cells if no field has any
    bool comparesSeeds = true;        ///< false: `transform` moves them to other cells
    std::vector<std::string> reasons; ///< empty: equal within `tolerance` and the packing errors
};

enum class Match { order, id };

/// Compares blade by blade, paired by file order or by id. Roots may differ by `tolerance` [m],
/// measured on the packed roots; up, facing, height, width and stiffness by twice their packing
/// errors (facing also by the error of up). Exposure and tint come from rays and images and are not
/// compared. `transform` must be a rotation with uniform scale. Unless it is the identity, 1 blade
/// in 10 000 may be missing per side, and 1 in 10 000 may have other traits. Reason: a transform
/// changes last bits of places and areas. These decide whether a triangle gets one blade more, or
/// which of two equally distant clumps owns a blade. Seeds must be equal number by number; under a
/// transform they are not compared, since cells do not turn.
Comparison compare(const FieldView& first, const FieldView& second, const glm::dmat4& transform,
                   Match match, double tolerance);

} // namespace sward::field
