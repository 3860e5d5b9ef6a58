#pragma once

#include "bake/ground/root_sample.h"
#include "bake/sample/triangle_points.h"
#include "bake/seeds/seed_places.h"
#include "core/bounds.h"
#include "shaders/shared/sow/seeds.h"
#include "terrain/ground_mesh.h"

#include <array>
#include <cstdint>

namespace sward::bake {

/// The numbers of a part and its candidates at a density [1/m²]; without corners, conditions, bits
/// and creases. Throws Error{input} if a triangle has too many.
shared::SeedPiece pieceOf(const terrain::GroundMesh& ground, std::uint64_t seed, double density,
                          const SeedPart& part);

/// Entries of a part at a density [1/m²]. Throws Error{input} as pieceOf() does.
std::uint32_t entriesOf(const terrain::GroundMesh& ground, std::uint64_t seed, double density,
                        const SeedPart& part, const shared::SeedPiece& piece);

/// Box of a part relative to the ground's origin [m].
DAabb boxOfPart(const terrain::GroundMesh& ground, const SeedPart& part);

/// The root at barycentrics (b, c) of a part's side.
RootSample rootAt(const SeedPart& part, const TrianglePoints& points, double b, double c,
                  std::uint32_t number);

/// The root at these shares of the way along s and v of a part. `s`: rangeOfS() of it.
RootSample rootOn(const SeedPart& part, const TrianglePoints& points,
                  const std::array<std::uint32_t, 2>& s, double alongS, double alongV,
                  std::uint32_t number);

} // namespace sward::bake
