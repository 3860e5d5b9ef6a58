#include "bake/filter/root_filter.h"

#include "bake/filter/up_vector.h"
#include "bake/mask/map_mask.h"
#include "core/error.h"
#include "core/expect.h"
#include "core/random.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>

namespace sward::bake {
namespace {

bool hasOccluders(const terrain::GroundMesh& ground)
{
    return std::find(ground.bears.begin(), ground.bears.end(), std::uint8_t(0)) !=
           ground.bears.end();
}

bool needsSky(const BakeSettings& settings)
{
    return !settings.sky.holds(0.0, 1.0);
}

bool restricts(const SoftRange& range)
{
    return !range.holds(-unbounded, unbounded);
}

} // namespace

namespace {

// Of the whole ground, or of a part where another program knows the rest.
void readMaps(const terrain::GroundMesh& ground, const BakeSettings& settings)
{
    const auto readOf = [&](const std::vector<Mask>& masks) {
        for (const Mask& mask : masks)
            if (mask.map != nullptr)
                mask.map->read(ground);
    };
    readOf(settings.masks);
    for (const SpeciesTraits& species : settings.meadow.species)
        readOf(species.habitat.masks);
    for (const ExcludedArea& area : settings.excluded)
        if (area.map != nullptr)
            area.map->read(ground);
}

} // namespace

RootFilter::RootFilter(const terrain::GroundMesh& ground, const BakeSettings& settings,
                       const terrain::SurfaceQuery* query, const terrain::SurfaceFeatures* features,
                       double scale)
    : ground_(ground)
    , settings_(settings)
    , query_(query)
    , features_(features)
    , scale_(scale)
    , everybody_({settings.slope, settings.altitude, settings.curvature, settings.masks})
    , mix_(settings.meadow)
    , bounds_(ground, settings, features)
    , cutout_(ground, masksByVertexColor(settings))
{
    if (needsGreen(settings))
        green_.emplace(ground, scale, masksByVertexColor(settings));
    if (restricts(settings.border))
        border_.emplace(ground, features->borders, settings.border.low);
    readMaps(ground, settings);
    for (const ExcludedArea& area : settings.excluded)
        excluded_.emplace_back(area, ground.origin);
    if (query != nullptr && hasOccluders(ground))
        occluders_.emplace(ground, *query);
    if (query != nullptr && needsSky(settings))
        sky_.emplace(ground, settings, settings.rayLength * scale, *query);
    repaint(settings.strokes);

    const Habitat& everywhere = everybody_.habitat();
    needsSite_ = everywhere.needsSlope() || everywhere.needsAltitude() ||
                 everywhere.needsCurvature() || mix_.needsPlace() || restricts(settings.water) ||
                 green_.has_value();
    weighs_ = cutout_.isAny() || needsSite_ || everywhere.needsAnything() ||
              settings.minIsland > 0.0 || border_.has_value();
    needsObstacles_ = settings.clearance > 0.0 || !excluded_.empty() || occluders_.has_value() ||
                      sky_.has_value();
}

void RootFilter::repaint(const Strokes& strokes)
{
    painting_.reset();
    if (!strokes.empty())
        painting_.emplace(strokes, ground_.origin, ground_.bounds());
}

glm::dvec3 RootFilter::groundUpAt(const RootSample& root) const
{
    return settings_.groundUp.at(ground_.origin + glm::dvec3(root.position));
}

Site RootFilter::siteOf(const RootSample& root) const
{
    const glm::dvec3 place = ground_.origin + glm::dvec3(root.position);
    Site site;
    site.upright = glm::dot(glm::dvec3(root.normal), settings_.groundUp.at(place));
    site.altitude = settings_.groundUp.altitude(place);
    if (green_)
        site.green = green_->at(root);
    if (features_ != nullptr && !features_->curvature.empty()) {
        const glm::uvec3 corners = ground_.triangles[root.triangle];
        const auto b = static_cast<double>(root.barycentric.x);
        const auto c = static_cast<double>(root.barycentric.y);
        const auto at = [&](std::uint32_t vertex) { return double(features_->curvature[vertex]); };
        site.curvature = (1.0 - b - c) * at(corners.x) + b * at(corners.y) + c * at(corners.z);
        // Curvature changes sign on the back of a triangle.
        if ((root.candidate & backSide) != 0)
            site.curvature = -site.curvature;
    }
    return site;
}

double RootFilter::weighEverybody(const RootSample& root, const Site& site, double chance,
                                  Reject& reason) const
{
    if (cutout_.isAny() && cutout_.holds(root)) {
        reason = Reject::cutout;
        return 0.0;
    }
    // A too small island counts as border.
    if (settings_.minIsland > 0.0 &&
        double(features_->islandArea[root.triangle]) < settings_.minIsland) {
        reason = Reject::border;
        return 0.0;
    }
    double weight = everybody_.at(ground_, root, site, chance, reason);
    if (weight <= chance)
        return weight;
    const auto falls = [&](Reject factorsReason, double factor) {
        weight *= factor;
        if (weight > chance)
            return false;
        reason = factorsReason;
        return true;
    };
    if (falls(Reject::water, settings_.water.weight(site.altitude)))
        return weight;
    if (border_)
        falls(Reject::border, settings_.border.weight(std::min(border_->at(root), unbounded)));
    return weight;
}

double RootFilter::weigh(const RootSample& root, double chance, Reject& reason) const
{
    if (!weighs_)
        return 1.0;
    const Site site = needsSite_ ? siteOf(root) : Site();
    double weight = weighEverybody(root, site, chance, reason);
    if (weight <= chance || !mix_.needsPlace())
        return weight;
    Reject own = Reject::mask;
    weight *= mix_.shares(mix_.habitatWeights(ground_, root, site, own)).total;
    if (weight <= chance)
        reason = own;
    return weight;
}

double RootFilter::paintedDensity(const RootSample& root, double chance, Reject& reason) const
{
    if (!painting_ || !painting_->mayChangeDensity(root.position))
        return weigh(root, chance, reason);
    Reject own = Reject::mask;
    const double weight = weigh(root, 0.0, own);
    // No paint fills the holes of a material.
    const double density = weight <= 0.0 && own == Reject::cutout
                               ? 0.0
                               : painting_->densityAt(root.position, root.normal, weight);
    if (density > chance)
        return density;
    reason = Reject::paint;
    if (weight <= chance)
        weigh(root, chance, reason);
    return density;
}

// Adds what strokes say. Where they raise the density, blades grow as if the ground said so.
void RootFilter::paintStand(const RootSample& root, Stand& stand) const
{
    if (stand.weight < 1.0 && painting_->mayChangeDensity(root.position)) {
        const double density = painting_->densityAt(root.position, root.normal, stand.weight);
        stand.raised = std::clamp((density - stand.weight) / (1.0 - stand.weight), 0.0, 1.0);
    }
    SpeciesShares& shares = stand.shares;
    if (shares.total <= 0.0)
        shares = mix_.evenShares();
    const PaintedSpecies species = painting_->speciesAt(root.position, root.normal);
    for (std::size_t slot = 0; slot < stand.vigour.size(); ++slot) {
        const double painted = species.share[slot];
        shares.share[slot] = species.kept * shares.share[slot] + shares.total * painted;
        double& vigour = stand.vigour[slot];
        vigour += std::max(stand.raised, painted) * (1.0 - vigour);
    }
}

Stand RootFilter::standAt(const RootSample& root, bool paints) const
{
    paints = paints && painting_;
    Stand stand;
    stand.shares = mix_.evenShares();
    stand.vigour.fill(1.0);
    if (!weighs_) {
        if (paints)
            paintStand(root, stand);
        return stand;
    }
    const Site site = needsSite_ ? siteOf(root) : Site();
    Reject ignored = Reject::mask;
    if (mix_.needsPlace()) {
        stand.vigour = mix_.habitatWeights(ground_, root, site, ignored);
        stand.shares = mix_.shares(stand.vigour);
    }
    stand.weight = weighEverybody(root, site, 0.0, ignored);
    for (double& vigour : stand.vigour)
        vigour *= stand.weight;
    if (mix_.needsPlace())
        stand.weight *= stand.shares.total;
    if (paints)
        paintStand(root, stand);
    return stand;
}

std::optional<Reject> RootFilter::obstacle(const RootSample& root) const
{
    if (!needsObstacles_)
        return std::nullopt;
    const glm::dvec3 place(root.position);
    const glm::dvec3 groundUp = groundUpAt(root);
    if (!excluded_.empty()) {
        const glm::dvec3 outward = ground_.origin + place - settings_.groundUp.centre;
        const double below = settings_.groundUp.radial ? std::sqrt(glm::dot(outward, outward))
                                                       : std::numeric_limits<double>::infinity();
        for (const Exclusion& area : excluded_)
            if (area.holds(place, groundUp, below))
                return Reject::excluded;
    }
    if (occluders_ && occluders_->buries(place, groundUp, scale_))
        return Reject::occluder;
    if (settings_.clearance > 0.0) {
        const glm::dvec3 up = upVector(glm::dvec3(root.normal), groundUp, settings_.align);
        if (!query_->isClear(place, up, settings_.clearance, root.triangle))
            return Reject::clearance;
    }
    if (sky_) {
        const double chance = uniform(settings_.seed, keyBits(keyOf(ground_, root)),
                                      static_cast<std::uint32_t>(Dimension::sky));
        if (settings_.sky.weight(sky_->at(root)) <= chance)
            return Reject::exposure;
    }
    return std::nullopt;
}

bool filterNeedsRays(const terrain::GroundMesh& ground, const BakeSettings& settings)
{
    return settings.clearance > 0.0 || needsSky(settings) || hasOccluders(ground);
}

terrain::FeatureChoice featuresFor(const BakeSettings& settings)
{
    const auto needsCurvature = [](const SpeciesTraits& one) {
        return one.habitat.needsCurvature();
    };
    return {.curvature = restricts(settings.curvature) ||
                         std::any_of(settings.meadow.species.begin(), settings.meadow.species.end(),
                                     needsCurvature),
            .islands = settings.minIsland > 0.0,
            .borders = restricts(settings.border)};
}

void checkGround(const terrain::GroundMesh& ground, const BakeSettings& settings)
{
    for (const ExcludedArea& area : settings.excluded)
        expect(area.mesh != nullptr || area.map != nullptr, "an excluded area has no mesh");
    readMaps(ground, settings);
    if (needsGreen(settings) && !hasOwnColors(ground, masksByVertexColor(settings)))
        fail(ErrorKind::usage,
             "--mask ground:green: the ground that bears grass has no colours: no image, no vertex "
             "colours, and no material with a colour of its own");
    checkMasks(settings.masks, ground);
    for (const SpeciesTraits& species : settings.meadow.species)
        checkMasks(species.habitat.masks, ground);
}

double reachOf(const terrain::GroundMesh& ground, const BakeSettings& settings, double scale,
               double clumpSpacing)
{
    double reach = settings.clearance;
    if (restricts(settings.border))
        reach = std::max(reach, settings.border.low);
    if (settings.exposureRays > 0)
        reach = std::max(reach, settings.rayLength * scale);
    if (hasOccluders(ground))
        reach = std::max(reach, OccluderTest::reach);
    const bool isWide = settings.meadow.wideVariation > 0.0;
    reach = std::max(reach, 1.5 * clumpSpacing + (isWide ? wideVariationReach * scale : 0.0));
    reach = std::max(reach, settings.meadow.edges.pathReach * scale);
    double painted = 1.0;
    for (const Stroke& stroke : settings.strokes.list)
        if (stroke.kind == StrokeKind::height)
            painted = std::max(painted, stroke.value);
    for (const SpeciesTraits& species : settings.meadow.species) {
        reach = std::max(reach, painted * species.height.y * scale *
                                    (1.0 + settings.meadow.heightWaves) *
                                    (isWide ? wideVariationHeight : 1.0) *
                                    std::max(1.0, settings.meadow.edges.occluderHeight));
        reach = std::max(reach, 3.0 * species.tuftSpacing * scale);
    }
    return reach;
}

} // namespace sward::bake
