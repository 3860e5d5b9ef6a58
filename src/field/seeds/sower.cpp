#include "field/seeds/sower.h"

#include "core/math/exact_math.h"
#include "core/math/spread_bits.h"
#include "core/random.h"
#include "field/seeds/clump_tones.h"
#include "shaders/shared/sow/sown_blade.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <tuple>

namespace sward::field {
namespace {

constexpr double cellSide = 32.0; // [m]

// Lengths of the waves [m] at blade scale 1, as bake::BladeChooser and bake::WideVariation.
constexpr double heightLengths[] = {3.0, 20.0};
constexpr double driftLengths[] = {2.5, 7.0};
constexpr double colonyLengths[] = {2.0, 3.5};
constexpr double standLengths[] = {8.0, 15.0};
constexpr double wideLengths[3][2] = {{11.0, 45.0}, {7.0, 26.0}, {5.0, 17.0}};

// Seeds of the waves: heights have number 0; the others follow by species.
constexpr std::uint64_t waveSalt = 0x77617665ULL;
constexpr std::uint64_t firstDrift = 1;
constexpr std::uint64_t firstColony = firstDrift + shared::maxSpecies;
constexpr std::uint64_t firstStand = firstColony + shared::maxSpecies;
constexpr std::uint64_t wideSalt = 0x7769646556617279ULL;
constexpr std::uint64_t windNumber = 3;

// Beyond this many lattice cells from the origin the lattice stands still.
constexpr double farthestLattice = 0x1p51;

shared::SowWave waveAt(glm::dvec3 corner, double length, std::uint64_t key, std::uint32_t unitBits)
{
    shared::SowWave wave = {};
    wave.step = static_cast<std::uint64_t>(std::ldexp(1.0, 48 - int(unitBits)) / length + 0.5);
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        const double place = std::clamp(corner[axis] / length, -farthestLattice, farthestLattice);
        const double cell = std::floor(place);
        const auto origin = static_cast<std::uint32_t>(hashBits(key, std::uint64_t(axis)));
        wave.cell[axis] = static_cast<std::uint32_t>(static_cast<std::int64_t>(cell)) + origin;
        wave.fraction[axis] = static_cast<std::uint32_t>((place - cell) * 0x1p32);
    }
    return wave;
}

// Morton number of a place's octree cell.
std::uint64_t mortonOf(const glm::ivec3& place, std::uint32_t bits)
{
    std::uint64_t morton = 0;
    for (glm::length_t axis = 0; axis < 3; ++axis)
        morton |= spreadBits(static_cast<std::uint32_t>(place[axis] >> bits)) << axis;
    return morton;
}

std::uint32_t gatherBits(std::uint64_t morton, int axis)
{
    std::uint32_t x = 0;
    for (std::uint32_t bit = 0; bit < 21; ++bit)
        x |= static_cast<std::uint32_t>(morton >> (3 * bit + std::uint32_t(axis)) & 1U) << bit;
    return x;
}

// A piece and what all its candidates share.
struct Sequence {
    explicit Sequence(const SeedCell& cell, const shared::SeedPiece& piece, std::uint64_t seed)
        : a(cell.vertices[piece.corners[0]])
        , b(cell.vertices[piece.corners[1]])
        , c(cell.vertices[piece.corners[2]])
        , back(shared::sowBack(piece))
        , bits(shared::sowSequence(seed, piece.source, back))
    {
    }

    const shared::SeedVertex& a;
    const shared::SeedVertex& b;
    const shared::SeedVertex& c;
    std::uint32_t back;
    glm::uvec2 bits;
};

shared::SeedConditions conditionsAt(const SeedCell& cell, const shared::SeedPiece& piece,
                                    const shared::SowPoint& point)
{
    if ((piece.form >> 10U & 0xffffU) == 0)
        return cell.conditions[piece.records];
    const shared::SowGridPlace place = shared::sowGridPlace(piece, point);
    return shared::sowConditions(
        cell.conditions[place.records[0]], cell.conditions[place.records[1]],
        cell.conditions[place.records[2]], cell.conditions[place.records[3]], place);
}

std::uint64_t keyBitsOf(const shared::SeedPiece& piece, std::uint32_t candidate, std::uint32_t back)
{
    return std::uint64_t(piece.source) << 32U | candidate | back << 31U;
}

} // namespace

bool SowRegion::holds(glm::dvec3 place) const
{
    for (glm::length_t axis = 0; axis < 3; ++axis)
        if (!(place[axis] >= low[axis] && place[axis] < high[axis]))
            return false;
    const glm::dvec3 offset = place - centre;
    return offset.x * offset.x + offset.y * offset.y + offset.z * offset.z <= radius * radius;
}

bool SowRegion::isBounded() const
{
    for (glm::length_t axis = 0; axis < 3; ++axis)
        if (low[axis] > -unbounded || high[axis] < unbounded)
            return true;
    return radius < unbounded;
}

bool SowRegion::mayTouch(glm::dvec3 boxLow, glm::dvec3 boxHigh) const
{
    double squared = 0.0;
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        if (boxLow[axis] >= high[axis] || boxHigh[axis] < low[axis])
            return false;
        const double gap =
            std::max({boxLow[axis] - centre[axis], centre[axis] - boxHigh[axis], 0.0});
        squared += gap * gap;
    }
    return squared <= radius * radius;
}

bool SowRegion::mayTouch(const std::array<std::int32_t, 3>& cell) const
{
    const glm::dvec3 from =
        cellSide * glm::dvec3(double(cell[0]), double(cell[1]), double(cell[2]));
    return mayTouch(from, from + cellSide);
}

CellSurroundings::CellSurroundings(const SeedCell& cell, const Sower& sower)
    : waves(sower.wavesAt(cell.cell))
    , ground(sower.groundAt(cell.cell))
    , clumps(cell, sower.meadow(), ground, [this] {
        shared::SowWaves table = {};
        table.at = waves.data();
        return table;
    }())
{
    boxes.reserve(cell.pieces.size());
    for (const shared::SeedPiece& piece : cell.pieces) {
        Box box{glm::ivec3(std::numeric_limits<int>::max()),
                glm::ivec3(std::numeric_limits<int>::min())};
        for (const std::uint32_t corner : piece.corners) {
            const shared::SeedVertex& vertex = cell.vertices[corner];
            box.low = glm::min(box.low, glm::ivec3(vertex.x, vertex.y, vertex.z));
            box.high = glm::max(box.high, glm::ivec3(vertex.x, vertex.y, vertex.z));
        }
        boxes.push_back(box);
        if (piece.count > 0)
            heightScale = std::min(heightScale, shared::sowHeightScale(piece));
    }
}

// An accepted candidate, in the order in which it is laid out.
struct Sower::Ranked {
    std::uint64_t patch; ///< level, then Morton number
    float rank;
    std::uint32_t piece;
    std::uint64_t key;
};

Sower::Sower(const SeedMeadow& meadow, std::span<const Species> species, glm::dvec3 origin)
    : scale_(meadow.scale)
    , origin_(origin)
    , up_(meadow.up)
    , isRadial_(meadow.isRadial)
    , tones_(toneWords())
{
    constexpr std::uint64_t clumpSalt = 0x636c756d70ULL;
    meadow_.seed = meadow.seed;
    meadow_.clumpKey = hashBits(meadow.seed, clumpSalt);
    meadow_.clumpReach =
        static_cast<std::int64_t>(std::ldexp(1.5 * meadow.clumpSpacing, int(meadow.unitBits)));
    meadow_.unitBits = meadow.unitBits;
    meadow_.levels = meadow.levels;
    meadow_.speciesCount = static_cast<std::uint32_t>(meadow.species.size());
    meadow_.isMixed = meadow.isMixed ? 1 : 0;
    meadow_.heightWaves = meadow.heightWaves;
    meadow_.drifts = meadow.drifts;
    meadow_.sparseHeight = meadow.sparseHeight;
    meadow_.wideVariation = meadow.wideVariation;
    const SinCos wind =
        exactSinCos(exactTwoPi * uniform(hashBits(meadow.seed ^ wideSalt, windNumber), 0, 0));
    meadow_.windX = static_cast<float>(wind.cos);
    meadow_.windZ = static_cast<float>(wind.sin);
    meadow_.creaseReach = meadow.creaseReach;
    meadow_.creaseBlend = meadow.creaseBlend;
    meadow_.vertical = meadow.vertical;
    meadow_.metresPerUnit = std::ldexp(1.0f, -int(meadow.unitBits));
    meadow_.room = meadow.highest;
    meadow_.heightsPerMetre = 255.0f / meadow.highest;
    meadow_.widthsPerMetre = 63.0f / meadow.widest;
    species_ = meadow.species;
    meadow_.species.at = species_.data();
    for (std::size_t slot = 0; slot < meadow.species.size(); ++slot) {
        std::vector<shared::SowRibbon>& ribbons = ribbons_.emplace_back();
        for (const Organ& organ : species[slot].organs)
            for (std::uint32_t i = 0; i < organ.count; ++i) {
                const float along = organ.count > 1 ? float(i) / float(organ.count - 1) : 0.0f;
                ribbons.push_back(
                    {organ.length.x * (1.0f - along) + organ.length.y * along, organ.width,
                     std::max(organ.length.x, organ.length.y) * (1.0f + 0.3f * organ.variation)});
            }
        species_[slot].ribbons = static_cast<std::uint32_t>(ribbons.size());
    }
}

std::vector<shared::SowWave> Sower::wavesAt(const std::array<std::int32_t, 3>& cell) const
{
    const glm::dvec3 corner =
        origin_ + cellSide * glm::dvec3(double(cell[0]), double(cell[1]), double(cell[2]));
    std::vector<shared::SowWave> waves;
    const auto add = [&](const double(&lengths)[2], std::uint64_t salt, std::uint64_t number) {
        const std::uint64_t seed = hashBits(meadow_.seed ^ salt, number);
        for (std::uint64_t i = 0; i < 2; ++i)
            waves.push_back(
                waveAt(corner, lengths[i] * scale_, hashBits(seed, i), meadow_.unitBits));
    };
    add(heightLengths, waveSalt, 0);
    for (std::uint64_t number = 0; number < std::size(wideLengths); ++number)
        add(wideLengths[number], wideSalt, number);
    for (std::uint64_t slot = 0; slot < meadow_.speciesCount; ++slot) {
        const bool isPlant = species_[slot].ribbons > 0;
        add(isPlant ? colonyLengths : driftLengths, waveSalt,
            (isPlant ? firstColony : firstDrift) + slot);
        add(standLengths, waveSalt, firstStand + slot);
    }
    return waves;
}

shared::SowGround Sower::groundAt(const std::array<std::int32_t, 3>& cell) const
{
    const glm::dvec3 corner =
        origin_ + cellSide * glm::dvec3(double(cell[0]), double(cell[1]), double(cell[2]));
    shared::SowGround ground = {};
    ground.up = glm::vec3(isRadial_ ? corner - up_ : up_);
    ground.isRadial = isRadial_ ? 1 : 0;
    return ground;
}

std::vector<Sower::Ranked> Sower::candidatesOf(const SeedCell& cell, const CellSurroundings& around,
                                               const SowRegion& region) const
{
    const double unit = std::ldexp(1.0, -int(meadow_.unitBits));
    const glm::dvec3 corner =
        cellSide * glm::dvec3(double(cell.cell[0]), double(cell.cell[1]), double(cell.cell[2]));
    const bool isBounded = region.isBounded();
    std::vector<Ranked> ranked;
    for (std::uint32_t number = 0; number < cell.pieces.size(); ++number) {
        const shared::SeedPiece& piece = cell.pieces[number];
        if (piece.count == 0)
            continue;
        const CellSurroundings::Box& box = around.boxes[number];
        if (isBounded && !region.mayTouch(corner + unit * glm::dvec3(box.low),
                                          corner + unit * glm::dvec3(box.high + 1)))
            continue;
        const Sequence sequence(cell, piece, meadow_.seed);
        const float rounding = shared::sowRounding(meadow_.seed, piece.source, sequence.back);
        const float perCandidate = shared::sowDivide(1.0f, piece.expected);
        // Ranks rise with the candidates.
        std::uint32_t first = 0;
        for (std::uint32_t end = piece.count; region.from > 0.0f && first < end;) {
            const std::uint32_t middle = first + (end - first) / 2;
            if (shared::sowRank(shared::sowCandidate(piece, middle), rounding, perCandidate) <
                region.from)
                first = middle + 1;
            else
                end = middle;
        }
        for (std::uint32_t j = first; j < piece.count; ++j) {
            const std::uint32_t candidate = shared::sowCandidate(piece, j);
            const float rank = shared::sowRank(candidate, rounding, perCandidate);
            if (rank >= region.share)
                break;
            const shared::SowPoint point = shared::sowPoint(sequence.bits, candidate);
            const glm::ivec3 place =
                shared::sowPlace(sequence.a, sequence.b, sequence.c, shared::sowWeights(point));
            if (!shared::sowInCell(place, meadow_.unitBits) ||
                (isBounded && !region.holds(corner + unit * glm::dvec3(place))))
                continue;
            const std::uint64_t key = keyBitsOf(piece, candidate, sequence.back);
            if (piece.bits != shared::noSeedBits) {
                if ((cell.words[piece.bits + j / 32] >> j % 32 & 1U) == 0)
                    continue;
            } else if (!shared::sowGrows(conditionsAt(cell, piece, point),
                                         shared::sowHash(meadow_.seed, key))) {
                continue;
            }
            const std::uint32_t level = shared::sowLevel(rank, meadow_.levels);
            ranked.push_back(
                {std::uint64_t(level) << 56U | mortonOf(place, meadow_.unitBits + 5 - level), rank,
                 number, key});
        }
    }
    std::sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) {
        return std::tie(a.patch, a.rank, a.key) < std::tie(b.patch, b.rank, b.key);
    });
    return ranked;
}

shared::SowMeadow Sower::meadowAt(const CellSurroundings& around) const
{
    shared::SowMeadow meadow = meadow_;
    meadow.heightsPerMetre *= around.heightScale;
    return meadow;
}

SownCell Sower::sow(const SeedCell& cell, const SowRegion& region) const
{
    return sow(cell, CellSurroundings(cell, *this), region);
}

SownCell Sower::sow(const SeedCell& cell, const CellSurroundings& around,
                    const SowRegion& region) const
{
    const std::vector<Ranked> ranked = candidatesOf(cell, around, region);
    shared::SowWaves waves = {};
    waves.at = around.waves.data();
    shared::SowWords words = {};
    words.at = cell.words.data();
    shared::SowTones tones = {};
    tones.at = tones_.data();

    const shared::SowMeadow meadow = meadowAt(around);
    SownCell result;
    result.cell = cell.cell;
    result.heightStep = 1.0f / meadow.heightsPerMetre;
    result.blades.reserve(ranked.size());
    result.keys.reserve(ranked.size());
    std::uint64_t current = 0;
    for (const Ranked& one : ranked) {
        const shared::SeedPiece& piece = cell.pieces[one.piece];
        const Sequence sequence(cell, piece, meadow_.seed);
        const auto candidate = static_cast<std::uint32_t>(one.key & 0x7fffffffU);
        const shared::SowPoint point = shared::sowPoint(sequence.bits, candidate);
        const glm::uvec2 weights = shared::sowWeights(point);
        shared::SowRoot root = {};
        root.own = shared::sowHash(meadow_.seed, one.key);
        root.hash = static_cast<std::uint32_t>(shared::sowHash(meadow_.seed + 1, one.key) & 15U);
        root.place = shared::sowPlace(sequence.a, sequence.b, sequence.c, weights);
        root.up = shared::sowUpAt(meadow_, piece, {sequence.a.up, sequence.b.up, sequence.c.up},
                                  weights, root.place, words, around.ground);
        shared::sowEdges(sequence.a, sequence.b, sequence.c, root.first, root.second);
        root.level = static_cast<std::uint32_t>(one.patch >> 56U);
        const shared::SownBlade stalk =
            shared::sowBlade(meadow, root, around.clumps.nearest(root.place, root.own),
                             conditionsAt(cell, piece, point), waves, tones);
        const std::vector<shared::SowRibbon>& ribbons = ribbons_[stalk.species];

        // Another patch, or a full one.
        if (result.patches.empty() || one.patch != current ||
            result.patches.back().count + 1 + ribbons.size() > shared::maxPatchBlades) {
            current = one.patch;
            SownPatch& patch = result.patches.emplace_back();
            patch.level = root.level;
            for (std::size_t axis = 0; axis < 3; ++axis)
                patch.place[axis] = gatherBits(one.patch & ((1ULL << 56U) - 1), int(axis));
            patch.first = static_cast<std::uint32_t>(result.blades.size());
            patch.rankLow = one.rank;
        }
        SownPatch& patch = result.patches.back();
        patch.count += 1 + static_cast<std::uint32_t>(ribbons.size());
        patch.rankHigh = one.rank;
        const BladeKey key{static_cast<std::uint32_t>(one.key >> 32U),
                           static_cast<std::uint32_t>(one.key)};
        result.blades.push_back(stalk.bits);
        result.keys.push_back(key);
        for (std::uint32_t i = 0; i < ribbons.size(); ++i) {
            result.blades.push_back(
                shared::sowRibbon(meadow, stalk, i + 1, ribbons[i].height, ribbons[i].width));
            result.keys.push_back(ribbonKey(key, i + 1));
        }
    }
    return result;
}

shared::Patch Sower::unpackingOf(const SownCell& cell, const SownPatch& patch) const
{
    shared::Patch result = {};
    const auto side = static_cast<float>(std::ldexp(cellSide, -int(patch.level)));
    for (glm::length_t axis = 0; axis < 3; ++axis)
        result.rootLow[axis] =
            static_cast<float>(cellSide * double(cell.cell[std::size_t(axis)]) +
                               double(side) * double(patch.place[std::size_t(axis)]));
    result.rootStep = side / 65535.0f;
    result.heightStep = cell.heightStep;
    result.widthStep = 1.0f / meadow_.widthsPerMetre;
    result.bladeCount = patch.count;
    result.rankLow = patch.rankLow;
    result.rankHigh = patch.rankHigh;
    return result;
}

} // namespace sward::field
