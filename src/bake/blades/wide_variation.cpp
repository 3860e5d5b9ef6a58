#include "bake/blades/wide_variation.h"

#include "bake/blades/slow_waves.h"
#include "bake/filter/up_vector.h"
#include "core/math/exact_math.h"
#include "core/random.h"
#include "field/seeds/clump_tones.h"
#include "shaders/shared/octahedral.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace sward::bake {
namespace {

// Lengths of the waves [m] at blade scale 1: of moisture, of grazed and of lain patches.
constexpr glm::dvec2 moistureWaves{11.0, 45.0};
constexpr glm::dvec2 grazedWaves{7.0, 26.0};
constexpr glm::dvec2 lainWaves{5.0, 17.0};

// Factor of the waves of moisture: their standard deviation is 0.36.
constexpr double moistureHeight = 1.3;

// Between these heights of a wave a patch begins and is complete. On the average of all places
// 0.2 of the ground is grazed.
constexpr glm::dvec2 grazedRim{0.12, 0.5};
constexpr double meanGrazed = 0.2;
constexpr glm::dvec2 lainRim{0.22, 0.6};

// Steep ground is dry: a slope of 45° by 0.5 of the range of moisture. Ground that falls from all
// sides by a seventh of the distance is moist by about as much.
constexpr double slopeDryness = 1.0;
constexpr double hollowMoisture = 3.5;
constexpr double maxHollow = 0.7;

// Distance [m] at blade scale 1 over which a hollow is measured.
constexpr double hollowRadius = 6.0;

// Grazed grass is 30 % lower than other grass, moist grass up to 12 % higher.
constexpr double grazedHeight = 0.3;
constexpr double moistHeight = 0.12;

// Parts of a clump's tone that come from its place, at moisture 1 and where it is grazed, and from
// chance.
constexpr double placeTone = 0.55;
constexpr double grazedTone = 0.25;
constexpr double chanceTone = 0.7;

// Rays end as far aside as below.
static_assert(wideVariationReach > 1.45 * hollowRadius);
static_assert(wideVariationHeight > 1.0 + moistHeight + grazedHeight * meanGrazed);

double riseOf(glm::dvec2 rim, double wave)
{
    const double t = std::clamp((wave - rim.x) / (rim.y - rim.x), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

std::uint64_t patchSeed(std::uint64_t seed, std::uint64_t number)
{
    constexpr std::uint64_t patchSalt = 0x7769646556617279ULL;
    return hashBits(seed ^ patchSalt, number);
}

// Moisture of a hollow, from the height of the ground around it: the mean of opposite places, since
// a slope is no hollow.
double hollowAt(const terrain::SurfaceQuery& query, glm::dvec3 place, glm::dvec3 up, double radius)
{
    const glm::dvec3 along(shared::tangentOf(glm::vec3(up)));
    const glm::dvec3 across = glm::cross(up, along);
    double sum = 0.0;
    int count = 0;
    for (const glm::dvec3& aside : {along, across}) {
        double heights = 0.0;
        int found = 0;
        for (const double sign : {-1.0, 1.0}) {
            const glm::dvec3 above = place + radius * (sign * aside + up);
            const auto hit = query.castThrough(above, -up, 2.0 * radius, 0.0);
            heights += hit.isHit() ? radius - hit.distance : 0.0;
            found += hit.isHit() ? 1 : 0;
        }
        if (found == 2) {
            sum += 0.5 * heights / radius;
            ++count;
        }
    }
    return count > 0 ? std::clamp(hollowMoisture * sum / count, -maxHollow, maxHollow) : 0.0;
}

// What the ground's form adds to and takes from the moisture at a place.
struct GroundForm {
    GroundForm(const terrain::GroundMesh& ground, const BakeSettings& settings, double scale,
               const terrain::SurfaceQuery* query, std::uint32_t triangle, glm::dvec3 place)
    {
        const glm::dvec3 up = settings.groundUp.at(ground.origin + place);
        const double upright = glm::dot(ground.faceNormal(triangle), up);
        dryness = slopeDryness * (1.0 - upright * upright);
        if (query != nullptr && settings.exposureRays > 0)
            hollow = hollowAt(*query, place, up, hollowRadius * scale);
    }

    double dryness = 0.0;
    double hollow = 0.0;
};

glm::dvec3 windOf(std::uint64_t seed)
{
    const SinCos turn = exactSinCos(exactTwoPi * uniform(patchSeed(seed, 3), 0, 0));
    return {turn.cos, 0.0, turn.sin};
}

} // namespace

WideVariation::WideVariation(const terrain::GroundMesh& ground, const BakeSettings& settings,
                             double scale, const Clumps& clumps, const terrain::SurfaceQuery* query)
    : ground_(ground)
    , settings_(settings)
    , clumps_(clumps)
    , amount_(settings.meadow.wideVariation)
    , wind_(windOf(settings.seed))
{
    if (amount_ <= 0.0 || clumps.size() == 0)
        return;
    byTone_ = field::clumpsByTone();
    placeOf_ = field::placesByTone();

    traits_.resize(clumps.size());
    constexpr std::size_t block = PlaceBlock::size;
    const auto wavesAt = [&](const PlaceBlock& places, glm::dvec2 lengths, std::uint64_t number) {
        BlockOfFloats waves;
        slowWaves(places, lengths.x, lengths.y, patchSeed(settings.seed, number), waves);
        return waves;
    };
    tbb::parallel_for(std::size_t(0), (traits_.size() + block - 1) / block, [&](std::size_t b) {
        const std::size_t first = b * block;
        const std::size_t count = std::min(block, traits_.size() - first);
        PlaceBlock places;
        for (std::size_t i = 0; i < block; ++i) {
            const glm::dvec3 centre(clumps[first + std::min(i, count - 1)].centre);
            places.set(i, (ground.origin + centre) / scale);
        }
        const BlockOfFloats moist = wavesAt(places, moistureWaves, 0);
        const BlockOfFloats grazed = wavesAt(places, grazedWaves, 1);
        const BlockOfFloats lain = wavesAt(places, lainWaves, 2);
        for (std::size_t i = 0; i < count; ++i) {
            const Clumps::Clump& clump = clumps[first + i];
            const GroundForm form(ground, settings, scale, query, clump.triangle,
                                  glm::dvec3(clump.centre));
            const double moisture = moistureHeight * double(moist[i]) - form.dryness + form.hollow;
            const double low = riseOf(grazedRim, double(grazed[i]));
            traits_[first + i] = {
                static_cast<float>(std::clamp(moisture, -1.0, 1.0)),
                static_cast<float>(low - meanGrazed),
                static_cast<float>(riseOf(lainRim, double(lain[i])) * (1.0 - low))};
        }
    });
}

double WideVariation::moistureOfGround(const terrain::GroundMesh& ground,
                                       const BakeSettings& settings, double scale,
                                       const terrain::SurfaceQuery* query, std::uint32_t triangle,
                                       glm::dvec3 place)
{
    const GroundForm form(ground, settings, scale, query, triangle, place);
    return form.hollow - form.dryness;
}

WideVariation::Traits WideVariation::at(const Clumps::Clump* clump) const
{
    return clump != nullptr && !traits_.empty() ? traits_[clumps_.indexOf(*clump)] : Traits();
}

glm::dvec3 WideVariation::lainTowards(const Clumps::Clump& clump) const
{
    const glm::dvec3 normal = ground_.faceNormal(clump.triangle);
    const glm::dvec3 up = settings_.groundUp.at(ground_.origin + glm::dvec3(clump.centre));
    return wind_ + 2.0 * (glm::dot(normal, up) * normal - up);
}

double WideVariation::heightFactor(const Traits& traits) const
{
    return 1.0 +
           amount_ * (moistHeight * double(traits.moisture) - grazedHeight * double(traits.grazed));
}

std::uint32_t WideVariation::clumpNumber(std::uint32_t given, const Traits& traits) const
{
    if (traits_.empty())
        return given;
    const double numbers = double(byTone_.size());
    const double own = (double(placeOf_[given]) + 0.5) / numbers;
    const double placed = 0.5 - placeTone * double(traits.moisture) +
                          grazedTone * double(traits.grazed) + chanceTone * (own - 0.5);
    const double tone = own + amount_ * (placed - own);
    return byTone_[static_cast<std::size_t>(
        std::clamp(std::floor(tone * numbers), 0.0, numbers - 1.0))];
}

} // namespace sward::bake
