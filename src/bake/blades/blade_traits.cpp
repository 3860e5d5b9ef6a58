#include "bake/blades/blade_traits.h"

#include "bake/blades/dice.h"
#include "bake/blades/ground_color.h"
#include "bake/filter/up_vector.h"
#include "bake/ground/drawn_colors.h"
#include "bake/ground/tile_region.h"
#include "bake/sample/triangle_points.h"
#include "core/math/exact_math.h"
#include "core/random.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace sward::bake {
namespace {

double within(glm::dvec2 range, double share)
{
    return range.x + share * (range.y - range.x);
}

// Unit projection of a vector into the plane perpendicular to `up`; none if it nearly vanishes.
std::optional<glm::dvec3> flattened(glm::dvec3 vector, glm::dvec3 up)
{
    const glm::dvec3 flat = vector - up * glm::dot(up, vector);
    const double squared = glm::dot(flat, flat);
    if (squared <= 1e-12 * glm::dot(vector, vector))
        return std::nullopt;
    return flat / std::sqrt(squared);
}

// Lean direction: near the clump's direction, or random without a clump.
glm::dvec3 chooseFront(const terrain::GroundMesh& ground, glm::dvec3 up, glm::dvec3 tangent,
                       const SpeciesTraits& species, const Clumps::Clump* clump, glm::dvec3 place,
                       const Dice& dice)
{
    // Share of a full turn that stays random at full clumping.
    constexpr double outwardFreedom = 0.4;
    constexpr double sharedFreedom = 0.1;
    std::optional<glm::dvec3> middle;
    double freedom = 1.0;
    if (clump != nullptr && species.facing == Facing::outward) {
        middle = flattened(place - glm::dvec3(clump->centre), up);
        freedom = outwardFreedom;
    } else if (clump != nullptr && species.facing == Facing::shared) {
        middle = flattened(clump->direction(ground), up);
        freedom = sharedFreedom;
    }
    const double spread =
        middle ? exactTwoPi * (1.0 - (1.0 - freedom) * species.clumping) : exactTwoPi;
    const glm::dvec3 ahead = middle.value_or(tangent);
    const SinCos turn = exactSinCos((dice.own(Dimension::facing) - 0.5) * spread);
    return turn.cos * ahead + turn.sin * glm::cross(up, ahead);
}

// Turns a lean direction by a share [0, 1] towards `aim`, which need not lie in the plane.
glm::dvec3 turnedTowards(glm::dvec3 front, glm::dvec3 up, glm::dvec3 aim, double share)
{
    if (share <= 0.0)
        return front;
    const std::optional<glm::dvec3> flat = flattened(aim, up);
    if (!flat)
        return front;
    return flattened(front + share * (*flat - front), up).value_or(front);
}

// Share [0, 1] of a tuft's blades that stand farther from its middle than this one, before they are
// gathered: about uniform over all blades. Centres are random, so it is exp(−πq²) with q the
// distance in spacings. (1 + πq²/4)⁻⁴ is within 0.06 of that, and the same on every CPU.
double shareOutside(const Clumps& tufts, const Clumps::Clump& tuft, glm::vec3 place)
{
    const glm::dvec3 offset = glm::dvec3(place) - glm::dvec3(tuft.centre);
    const double squared = glm::dot(offset, offset) / (tufts.spacing() * tufts.spacing());
    const double root = 1.0 / (1.0 + 0.125 * exactTwoPi * squared);
    return root * root * root * root;
}

// Turn of `axis` about the up-vector from the tangent frame that the decoder will use, in [0, 2π).
float facingOf(std::uint32_t packedUp, glm::dvec3 axis)
{
    const glm::vec3 decoded = shared::decodeOctahedral(packedUp);
    const double angle = exactAtan2(glm::dot(axis, glm::dvec3(shared::bitangentOf(decoded))),
                                    glm::dot(axis, glm::dvec3(shared::tangentOf(decoded))));
    return static_cast<float>(angle < 0.0 ? angle + exactTwoPi : angle);
}

// Barycentric weights of the second and third corner at a point of a triangle's plane.
glm::dvec2 barycentrics(glm::dvec3 p0, glm::dvec3 p1, glm::dvec3 p2, glm::dvec3 point)
{
    const glm::dvec3 normal = glm::cross(p1 - p0, p2 - p0);
    const double squared = glm::dot(normal, normal);
    if (squared <= 0.0)
        return glm::dvec2(0.0);
    const glm::dvec3 offset = point - p0;
    return {glm::clamp(glm::dot(glm::cross(offset, p2 - p0), normal) / squared, 0.0, 1.0),
            glm::clamp(glm::dot(glm::cross(p1 - p0, offset), normal) / squared, 0.0, 1.0)};
}

// Ribbon `within` of an organ, number `number` on the plant.
GrownBlade ribbonOn(const GrownBlade& grown, const field::Organ& organ, std::uint32_t within,
                    std::uint32_t number, double widening)
{
    const shared::Blade& stalk = grown.blade;
    const float share = organ.count > 1 ? float(within) / float(organ.count - 1) : 0.0f;
    const float length = stalk.height * glm::mix(organ.length.x, organ.length.y, share);
    GrownBlade ribbon{stalk, grown.packedUp, length * (1.0f + 0.3f * organ.variation)};
    ribbon.blade.width = length * organ.width * static_cast<float>(widening);
    ribbon.blade.clump = number;
    return ribbon;
}

// Dead blades at the foot of a tuft: height relative to the others, and stiffness. They rest at
// angles of 125° to 45° from upright, which is on the ground or near it.
constexpr glm::dvec2 litterHeight{0.2, 0.5};
constexpr glm::dvec2 litterStiffness{0.12, 0.38};

const std::vector<terrain::ConvexCrease> noCreases;

// Seed of the clumps of one species' tufts, independent of other species.
std::uint64_t tuftSeed(std::uint64_t seed, std::size_t slot)
{
    constexpr std::uint64_t tuftSalt = 0x74756674ULL;
    return hashBits(seed ^ tuftSalt, slot);
}

} // namespace

BladeGrower::BladeGrower(const terrain::GroundMesh& ground, const BakeSettings& settings,
                         const Whole& whole, const RootFilter& filter,
                         const terrain::SurfaceQuery* query,
                         const terrain::SurfaceFeatures* features)
    : ground_(ground)
    , settings_(settings)
    , scale_(whole.scale)
    , widthScale_(whole.scale * whole.widening)
    , filter_(filter)
    , query_(query)
    , colorsAreMask_(masksByVertexColor(settings))
    , baseColors_(drawnBaseColors(ground, colorsAreMask_))
    , fitsOverhangs_(settings.meadow.fitsOverhangs &&
                     (settings.exposureRays > 0 || settings.clearance > 0.0))
    , paths_(ground, settings, filter, features, whole.scale)
    , creases_(features != nullptr ? features->creases : noCreases,
               creaseReach(settings.meadow, whole.scale), settings.meadow.edges.creaseBlend)
    , clumps_(ground, clumpSpacing(settings.meadow.clumpSize * whole.scale, whole.area),
              settings.seed)
    , variation_(ground, settings, whole.scale, clumps_, query)
    , chooser_(ground, settings, whole.scale, filter, clumps_)
    , tufts_(settings.meadow.species.size())
{
    for (std::size_t slot = 0; query != nullptr && slot < tufts_.size(); ++slot)
        if (const double spacing = settings.meadow.species[slot].tuftSpacing * scale_;
            spacing > 0.0)
            tufts_[slot].emplace(ground, clumpSpacing(spacing, whole.area),
                                 tuftSeed(settings.seed, slot));
}

RootSample BladeGrower::gather(const RootSample& root, const SpeciesTraits& species,
                               const Clumps::Clump& tuft) const
{
    // Shrink the tuft's cell about its centre, which keeps the order of its blades. Then find the
    // nearest ground.
    const double spacing = species.tuftSpacing * scale_;
    const double shrink = std::min(1.0, 2.0 * species.tuftRadius * scale_ / spacing);
    const glm::dvec3 middle(tuft.centre);
    const glm::dvec3 aim = middle + shrink * (glm::dvec3(root.position) - middle);
    const auto found = query_->nearest(aim, 0.5 * spacing);
    if (found.triangle == terrain::SurfaceQuery::none || ground_.bears[found.triangle] == 0)
        return root;
    const glm::uvec3 corners = ground_.triangles[found.triangle];
    const glm::vec2 place(barycentrics(glm::dvec3(ground_.positions[corners.x]),
                                       glm::dvec3(ground_.positions[corners.y]),
                                       glm::dvec3(ground_.positions[corners.z]), found.point));
    const RootSample moved =
        TrianglePoints(ground_, found.triangle).at(place.x, place.y, root.candidate);

    // Reject moves to the other side of a surface, to bare ground, and to another 32 m cell, which
    // holds the blades that stand in it.
    constexpr double likeliest = 0.3;
    Reject ignored = Reject::mask;
    if (glm::dot(glm::dvec3(moved.normal), glm::dvec3(root.normal)) < likeliest ||
        cellOf(ground_.origin, moved.position) != cellOf(ground_.origin, root.position) ||
        filter_.paintedDensity(moved, 0.0, ignored) <= 0.0 || filter_.obstacle(moved))
        return root;
    return moved;
}

double BladeGrower::roomOver(const RootSample& root, glm::dvec3 up, double height) const
{
    // Leave a gap between the tip and the obstacle, and keep a minimum length.
    constexpr double used = 0.95;
    constexpr double minShare = 0.05;
    const glm::dvec3 place(root.position);
    const double wanted = height / used;
    if (query_ == nullptr || !fitsOverhangs_ || wanted <= settings_.clearance ||
        query_->isClear(place, up, wanted, root.triangle))
        return height;
    return std::max(used * query_->clearance(place, up, wanted, root.triangle), minShare * height);
}

void BladeGrower::choose(std::span<const RootSample> roots, std::span<BladeChoice> choices) const
{
    chooser_.choose(roots, choices);
}

std::uint32_t BladeGrower::bladesOf(const BladeChoice& choice) const
{
    return 1 + field::ribbonsOf(settings_.meadow.species[choice.slot].organs);
}

shared::Blade BladeGrower::grow(const RootSample& root, const Surroundings& around) const
{
    BladeChoice choice;
    choose({&root, 1}, {&choice, 1});
    return growBlade(root, around, choice).blade;
}

void BladeGrower::grow(const RootSample& root, const Surroundings& around,
                       const BladeChoice& choice, std::span<GrownBlade> blades) const
{
    const GrownBlade stalk = growBlade(root, around, choice);
    blades[0] = stalk;
    std::uint32_t number = 1;
    for (const field::Organ& organ : settings_.meadow.species[choice.slot].organs)
        for (std::uint32_t i = 0; i < organ.count; ++i, ++number)
            blades[number] = ribbonOn(stalk, organ, i, number, widthScale_ / scale_);
    if (blades.size() > 1)
        blades[0].blade.clump = 0;
}

GrownBlade BladeGrower::growBlade(const RootSample& root, const Surroundings& around,
                                  const BladeChoice& choice) const
{
    // A tuft counts as the clump.
    const field::BladeKey key = keyOf(ground_, root);
    const Clumps::Clump* clump = choice.clump;
    const Stand stand = filter_.standAt(root);
    const Meadow& meadow = settings_.meadow;
    const std::uint32_t slot = choice.slot;
    const SpeciesTraits& species = meadow.species[slot];
    RootSample place = root;
    double outside = 1.0; // 1: in the middle of a tuft, 0: at its rim
    bool isTuft = false;
    if (tufts_[slot])
        if (const Clumps::Clump* const tuft = tufts_[slot]->nearest(root.position)) {
            place = gather(root, species, *tuft);
            outside = shareOutside(*tufts_[slot], *tuft, root.position);
            clump = tuft;
            isTuft = true;
        }
    const Dice dice(settings_.seed, key, clump);

    const glm::uvec3 corners = ground_.triangles[place.triangle];
    const glm::dvec3 groundUp = settings_.groundUp.at(ground_.origin + glm::dvec3(place.position));
    const glm::dvec3 up = upVector(creases_.normalAt(place), groundUp, settings_.align);
    const glm::dvec3 tangent = surfaceTangent(up, glm::dvec3(ground_.positions[corners.x]),
                                              glm::dvec3(ground_.positions[corners.y]),
                                              glm::dvec3(ground_.positions[corners.z]));
    glm::dvec3 front =
        chooseFront(ground_, up, tangent, species, clump, glm::dvec3(place.position), dice);
    double stiffnessShare = dice.blended(Dimension::stiffness, 0.5 * species.clumping);

    // A tuft opens: the farther from its middle, the softer within the species' range.
    const bool isLitter = isTuft && dice.own(Dimension::litter) < species.tuftLitter;
    if (isTuft) {
        const double lean = species.tuftLean;
        front = turnedTowards(front, up, glm::dvec3(place.position) - glm::dvec3(clump->centre),
                              isLitter ? 0.45 : lean * std::sqrt(1.0 - outside));
        stiffnessShare += lean * (outside - stiffnessShare);
    }
    double stiffness = within(species.stiffness, stiffnessShare);

    // Lain patches of the meadow. Short grass stands.
    WideVariation::Traits wide = variation_.at(choice.clump);
    wide.moisture += 0.5f * (1.0f - around.exposure);
    const double lain = meadow.wideVariation * double(wide.lain);
    if (lain > 0.0)
        front = turnedTowards(front, up, variation_.lainTowards(*choice.clump), 0.5 * lain);
    stiffness *= 1.0 - 0.12 * lain;

    // Beside a path blades are trodden, but not at the foot of what stands there.
    const EdgeTraits& edges = meadow.edges;
    const auto foot = static_cast<double>(around.foot);
    const PathEdges::Edge path = paths_.at(root, stand.weight);
    const double trodden = path.nearness * (1.0 - foot) * (1.0 - stand.raised);
    front = turnedTowards(front, up, path.away, edges.pathLean * trodden);
    stiffness *= 1.0 - 0.6 * edges.pathLean * trodden;
    const PaintedLook paint = filter_.lookAt(root);
    const double lean = std::min(std::sqrt(glm::dot(paint.lean, paint.lean)), 1.0);
    front = turnedTowards(front, up, paint.lean, lean);
    stiffness *= 1.0 - 0.6 * lean;

    // Blades are lower where filter weights are low.
    const double sparse = meadow.sparseHeight;
    double height =
        paint.height * scale_ * (1.0 + meadow.heightWaves * double(choice.heightWave)) *
        (sparse + (1.0 - sparse) * stand.vigour[slot]) *
        within(species.height, dice.blended(Dimension::height, 0.7 * species.clumping)) *
        variation_.heightFactor(wide) *
        (1.0 + (edges.occluderHeight - 1.0) * foot) * (1.0 - (1.0 - edges.pathHeight) * trodden);
    if (isLitter) {
        height *= within(litterHeight, dice.own(Dimension::hash));
        stiffness = within(litterStiffness, dice.own(Dimension::stiffness));
    }
    const double dried = edges.occluderDryness * foot;
    const bool isDried =
        isLitter || dice.own(Dimension::dryness) < dried + paint.dryness * (1.0 - dried);

    GrownBlade grown;
    shared::Blade& blade = grown.blade;
    blade.root = place.position;
    blade.up = glm::vec3(up);
    grown.packedUp = shared::encodeOctahedral(blade.up);
    blade.facing = facingOf(grown.packedUp, glm::cross(front, up));
    blade.height = static_cast<float>(roomOver(place, up, height));
    blade.width =
        static_cast<float>(widthScale_ * within(species.width, dice.own(Dimension::width)));
    blade.stiffness = static_cast<float>(stiffness);
    blade.exposure = around.exposure;
    blade.species = slot;
    blade.tint = groundColor(ground_, place, baseColors_, colorsAreMask_);
    blade.clump = isDried ? shared::driedClump
                          : variation_.clumpNumber(dice.clumpNumber(), wide);
    blade.hash = dice.hash();
    return grown;
}

bool growsTufts(const Meadow& meadow)
{
    return std::any_of(meadow.species.begin(), meadow.species.end(),
                       [](const SpeciesTraits& species) { return species.tuftSpacing > 0.0; });
}

} // namespace sward::bake
