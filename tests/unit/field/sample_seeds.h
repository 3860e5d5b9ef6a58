#pragma once

#include "field/field.h"
#include "field/seeds/seeds.h"

#include <cstddef>
#include <cstdint>
#include <memory>

namespace sward::tests {

/// The meadow of seeds of a field with so many species.
inline field::SeedMeadow seedMeadow(std::size_t speciesCount)
{
    field::SeedMeadow meadow;
    meadow.seed = 0xfedcba9876543210ULL;
    meadow.density = 40.0;
    meadow.unitBits = 16;
    meadow.levels = 2;
    meadow.highest = 0.5f;
    meadow.widest = 0.02f;
    for (std::size_t i = 0; i < speciesCount; ++i) {
        shared::SowSpecies species = {};
        species.share = 1.0f / float(speciesCount);
        species.heightLow = 0.1f;
        species.heightRange = 0.3f;
        species.widthLow = 0.005f;
        species.widthRange = 0.01f;
        species.stiffnessLow = 0.4f;
        species.stiffnessRange = 0.2f;
        species.clumping = 0.5f;
        species.facing = std::uint32_t(i) % 3;
        meadow.species.push_back(species);
    }
    return meadow;
}

/// The seeds of a cell: a level triangle of 8 m² with a clump at either end and a crease.
inline field::SeedCell seedCell()
{
    constexpr int metre = 1 << 16;
    constexpr std::uint32_t up = 511U | 1022U << 10U | 511U << 20U;
    field::SeedCell cell;
    cell.cell = {-1, 0, 2};
    cell.vertices = {{metre, 7, metre, up}, {metre, 7, 5 * metre, up}, {5 * metre, 7, metre, up}};
    shared::SeedPiece piece = {};
    piece.corners[1] = 1;
    piece.corners[2] = 2;
    piece.source = 3;
    piece.count = 320;
    piece.expected = 320.0f;
    piece.bits = shared::noSeedBits;
    piece.creases = 1;
    cell.pieces = {piece};
    cell.clumps = {{0, 5, -8192}, {0, 9, 4096}};
    shared::SeedConditions open = {};
    open.growth = 65535U | 255U << 16U;
    open.look = 0xff203040U;
    open.size = 8192U | 255U << 16U | 255U << 24U;
    open.lean = 0x7f7f7fU;
    cell.conditions = {open};
    // A crease along the triangle's side from the first to the second corner, then a list of it.
    const auto word = [](int x) { return static_cast<std::uint32_t>(x); };
    constexpr std::uint32_t aside = 0U | 511U << 10U | 511U << 20U;
    cell.words = {0, 1, 3, word(metre), 7, word(metre), word(metre), 7, word(5 * metre), up, aside};
    return cell;
}

/// Seeds of that cell.
inline field::Seeds sampleSeeds(std::size_t speciesCount)
{
    field::Seeds seeds;
    seeds.meadow = seedMeadow(speciesCount);
    seeds.meadow.clumpSpacing = 1.0;
    field::addSeedCell(seeds, seedCell());
    return seeds;
}

/// A field with those seeds.
inline field::Field seeded(field::Field field)
{
    field.seeds = std::make_shared<const field::SharedSeeds>(sampleSeeds(field.species.size()));
    return field;
}

} // namespace sward::tests
