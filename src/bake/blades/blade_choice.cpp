#include "bake/blades/blade_choice.h"

#include "bake/blades/dice.h"
#include "bake/blades/slow_waves.h"

#include <algorithm>
#include <array>

namespace sward::bake {
namespace {

constexpr std::size_t blockSize = PlaceBlock::size;

using WavesOfSpecies = std::array<BlockOfFloats, shared::maxSpecies>;

// Chooses a species by the shares at the root. Blades of one clump are mostly of one species.
// Compound plants stand alone: they would fill the clump that they get.
std::uint32_t chooseSpecies(const Meadow& meadow, const SpeciesShares& shares, const Dice& dice)
{
    const std::uint32_t own = shares.at(dice.own(Dimension::species));
    if (dice.own(Dimension::clump) >= meadow.species[0].clumping ||
        !meadow.species[own].organs.empty())
        return own;
    SpeciesShares blades = shares;
    for (std::size_t slot = 0; slot < meadow.species.size(); ++slot)
        if (!meadow.species[slot].organs.empty()) {
            blades.total -= blades.share[slot];
            blades.share[slot] = 0.0;
        }
    return blades.at(dice.clump(Dimension::species));
}

// Lengths of the waves of height, of drifts and of colonies [m] at blade scale 1. Clumps are
// smaller than these.
constexpr double shorterHeightWave = 3.0;
constexpr double longerHeightWave = 20.0;
constexpr double shorterDrift = 2.5;
constexpr double longerDrift = 7.0;
constexpr double shorterColony = 2.0;
constexpr double longerColony = 3.5;
constexpr double shorterStand = 8.0;
constexpr double longerStand = 15.0;
// Numbers of waveSeed(): 0 is the heights', 1 + slot a species' drift.
constexpr std::uint64_t firstColony = 1 + shared::maxSpecies;
constexpr std::uint64_t firstStand = firstColony + shared::maxSpecies;

std::uint64_t waveSeed(std::uint64_t seed, std::uint64_t number)
{
    constexpr std::uint64_t waveSalt = 0x77617665ULL;
    return hashBits(seed ^ waveSalt, number);
}

// Share of a colony at a wave's height: 0 below its border, 2 above. Waves are as often low as
// high, so that its mean is 1.
double insideOf(float wave)
{
    constexpr double border = 0.2; // half its width, in heights of the wave
    const double t = std::clamp(0.5 + double(wave) / (2.0 * border), 0.0, 1.0);
    return 2.0 * t * t * (3.0 - 2.0 * t);
}

// Factor of a plant's share at each place, 0 to 4 with the mean 1: colonies some metres wide within
// wider stands. Two independent waves keep the mean of the product.
void colonies(const PlaceBlock& places, std::uint64_t seed, std::size_t slot,
              BlockOfFloats& factors)
{
    BlockOfFloats stands;
    slowWaves(places, shorterColony, longerColony, waveSeed(seed, firstColony + slot), factors);
    slowWaves(places, shorterStand, longerStand, waveSeed(seed, firstStand + slot), stands);
    for (std::size_t i = 0; i < blockSize; ++i)
        factors[i] = static_cast<float>(insideOf(factors[i]) * insideOf(stands[i]));
}

// Gives each species more room where its own waves are high, at the cost of the others, and keeps
// the total. The change is linear in waves whose mean is 0, so that shares hold on the average.
// Compound plants stand in colonies instead: they would be even specks. `waves` are those of root
// `root` of a block, and the factors of colonies().
SpeciesShares drifted(const SpeciesShares& even, const Meadow& meadow, const WavesOfSpecies& waves,
                      std::size_t root)
{
    double mean = 0.0;
    double blades = 0.0;
    for (std::size_t slot = 0; slot < meadow.species.size(); ++slot)
        if (even.share[slot] > 0.0 && meadow.species[slot].organs.empty()) {
            mean += even.share[slot] * double(waves[slot][root]);
            blades += even.share[slot];
        }
    mean = blades > 0.0 ? mean / blades : 0.0;
    // What would fall below 0 is cut off, and the others give it back: 3 % of a share at most.
    SpeciesShares result = even;
    double sum = 0.0;
    for (std::size_t slot = 0; slot < meadow.species.size(); ++slot) {
        if (even.share[slot] <= 0.0)
            continue;
        const bool isPlant = !meadow.species[slot].organs.empty();
        const double change = double(waves[slot][root]) - (isPlant ? 1.0 : mean);
        result.share[slot] *= std::max(1.0 + meadow.drifts * change, 0.0);
        sum += result.share[slot];
    }
    // Between colonies of a meadow without grass, all plants stand as they would without drifts.
    if (sum <= 0.0)
        return even;
    for (std::size_t slot = 0; slot < meadow.species.size(); ++slot)
        result.share[slot] *= even.total / sum;
    return result;
}

} // namespace

BladeChooser::BladeChooser(const terrain::GroundMesh& ground, const BakeSettings& settings,
                           double scale, const RootFilter& filter, const Clumps& clumps)
    : ground_(ground)
    , settings_(settings)
    , scale_(scale)
    , filter_(filter)
    , clumps_(clumps)
{
}

void BladeChooser::choose(std::span<const RootSample> roots, std::span<BladeChoice> choices) const
{
    for (std::size_t i = 0; i < roots.size(); i += blockSize) {
        const std::size_t count = std::min(blockSize, roots.size() - i);
        chooseBlock(roots.subspan(i, count), choices.subspan(i, count));
    }
}

void BladeChooser::chooseBlock(std::span<const RootSample> roots,
                               std::span<BladeChoice> choices) const
{
    const Meadow& meadow = settings_.meadow;
    std::array<const Clumps::Clump*, blockSize> clumps{};
    if (clumps_.size() > 0)
        clumps_.nearest(roots, std::span(clumps).first(roots.size()));

    PlaceBlock places;
    for (std::size_t i = 0; i < blockSize; ++i) {
        const glm::dvec3 place(roots[std::min(i, roots.size() - 1)].position);
        places.set(i, (ground_.origin + place) / scale_);
    }
    BlockOfFloats heights{};
    if (meadow.heightWaves > 0.0)
        slowWaves(places, shorterHeightWave, longerHeightWave, waveSeed(settings_.seed, 0),
                  heights);

    // Without habitats, the shares are the same everywhere.
    const bool isMixed = meadow.species.size() > 1;
    std::array<SpeciesShares, blockSize> shares;
    std::array<bool, shared::maxSpecies> grows{};
    for (std::size_t i = 0; i < roots.size() && isMixed; ++i) {
        shares[i] = filter_.standAt(roots[i]).shares;
        for (std::size_t slot = 0; slot < meadow.species.size(); ++slot)
            grows[slot] = grows[slot] || shares[i].share[slot] > 0.0;
    }
    const bool drifts = meadow.drifts > 0.0 && isMixed;
    WavesOfSpecies waves;
    for (std::size_t slot = 0; slot < meadow.species.size() && drifts; ++slot)
        if (grows[slot] && !meadow.species[slot].organs.empty())
            colonies(places, settings_.seed, slot, waves[slot]);
        else if (grows[slot])
            slowWaves(places, shorterDrift, longerDrift, waveSeed(settings_.seed, slot + 1),
                      waves[slot]);

    for (std::size_t i = 0; i < roots.size(); ++i) {
        choices[i] = {clumps[i], 0, heights[i]};
        if (!isMixed)
            continue;
        if (drifts && shares[i].total > 0.0)
            shares[i] = drifted(shares[i], meadow, waves, i);
        choices[i].slot = chooseSpecies(meadow, shares[i],
                                        Dice(settings_.seed, keyOf(ground_, roots[i]), clumps[i]));
    }
}

} // namespace sward::bake
