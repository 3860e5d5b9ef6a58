#include "bake/poisson/poisson_region.h"

#include "bake/poisson/disk_grid.h"
#include "bake/poisson/disk_map.h"
#include "bake/poisson/poisson_parts.h"
#include "bake/sample/triangle_points.h"
#include "core/random.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace sward::bake {
namespace {

constexpr std::uint64_t golden = 0x9e3779b97f4a7c15U;

// Darts whose places are computed before the first of them lands.
constexpr std::size_t dartsInFlight = 128;

// Width of the grid cells for a region's disks, in spacings.
constexpr double cellWidth = 2.0;

// A region is smooth if all its normals lie within 36° of their mean: then all of them are on one
// side.
constexpr double smoothCosine = 0.81;

// Relative rounding error of single-precision positions, with a margin.
constexpr double relativeSlack = 0x1.0p-21;

double largest(const glm::dvec3& v)
{
    return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
}

} // namespace

// State of a region during filling.
class RegionFiller::Sampler {
public:
    Sampler(const terrain::GroundMesh& ground, std::uint64_t seed, const RootFilter& filter,
            const PoissonLattice& lattice, double spacing, bool filtered,
            const PoissonTuning& tuning, const TileRegion* counted)
        : ground_(ground)
        , filter_(filter)
        , spacing_(spacing)
        , widest_(filtered ? tuning.widest * spacing : spacing)
        , tuning_(tuning)
        , counted_(counted)
        , parts_(ground, seed, filter, lattice, spacing, tuning, counted)
    {
    }

    RegionResult fill(std::span<const RegionPiece> pieces, const CubeIndex<Disk>& before)
    {
        result_ = {};
        parts_.gather(pieces);
        for (std::size_t i = 0; i < rejectCount; ++i) {
            result_.thrown += parts_.bareDarts()[i];
            result_.rejected[i] += parts_.bareDarts()[i];
        }
        if (!parts_.empty()) {
            gatherDisks(before);
            throwAll();
        }
        return std::move(result_);
    }

    const SearchLimit* limit = nullptr; // of time, if there is one

private:
    struct Dart {
        glm::vec3 local;     // place, in a smooth region
        std::uint32_t index; // among the darts of its part
        std::uint64_t bits;  // random
        const DartPart* part;
    };

    void gatherDisks(const CubeIndex<Disk>& before);
    void findMeanNormal();
    bool agrees(const glm::dvec3& normal) const { return glm::dot(normal, axis_) > smoothCosine; }
    void insertInGrid(const Disk& disk);
    void throwAll();
    void throwRound(int round);
    void land();
    void throwDart(const Dart& dart);
    glm::vec2 placeOf(const Dart& dart) const;
    bool countsOnBorder(const Dart& dart) const;
    bool counts(const Dart& dart) const
    {
        return dart.part->counts == DartPart::Counts::some
                   ? countsOnBorder(dart)
                   : dart.part->counts == DartPart::Counts::all;
    }
    bool isCovered(const DartPart& part, int level) const;
    bool covers(const Disk& disk, const TriangleSide& side, const Fragment& fragment) const;

    const terrain::GroundMesh& ground_;
    const RootFilter& filter_;
    double spacing_;
    double widest_;
    const PoissonTuning& tuning_;
    const TileRegion* counted_;

    RegionParts parts_;
    DAabb box_;            // of all disks that can block a dart
    glm::dvec3 axis_{0.0}; // mean normal
    bool smooth_ = false;  // all normals agree with it
    bool mapped_ = false;  // disks are in the map, else in the grid
    DiskMap map_;
    DiskGrid grid_;
    std::vector<Disk> earlier_;
    std::vector<Dart> flight_;
    std::vector<std::uint32_t> landing_;
    RegionResult result_;
};

// The mean normal of all sides, and whether they agree with it.
void RegionFiller::Sampler::findMeanNormal()
{
    glm::dvec3 sum(0.0);
    for (const TriangleSide& side : parts_.sides())
        sum += side.back ? -side.face : side.face;
    const double length = std::sqrt(glm::dot(sum, sum));
    smooth_ = length > 0.0;
    axis_ = smooth_ ? sum / length : sum;
    for (const TriangleSide& side : parts_.sides()) {
        if (!smooth_)
            break;
        const double sign = side.back ? -1.0 : 1.0;
        const glm::uvec3 corners = ground_.triangles[side.triangle];
        smooth_ = agrees(sign * side.face) &&
                  agrees(sign * glm::dvec3(ground_.normals[corners.x])) &&
                  agrees(sign * glm::dvec3(ground_.normals[corners.y])) &&
                  agrees(sign * glm::dvec3(ground_.normals[corners.z]));
    }
}

void RegionFiller::Sampler::gatherDisks(const CubeIndex<Disk>& before)
{
    box_ = parts_.bounds();
    const DAabb inner = box_;
    const double margin =
        widest_ + largest(glm::max(glm::abs(box_.low), glm::abs(box_.high))) * 1e-6;
    box_.low -= margin;
    box_.high += margin;
    findMeanNormal();

    earlier_.clear();
    before.forEachIn(box_.low, box_.high, [&](const Disk& disk) {
        const glm::dvec3 place(disk.position);
        for (glm::length_t i = 0; i < 3; ++i)
            if (place[i] <= box_.low[i] || place[i] >= box_.high[i])
                return;
        smooth_ = smooth_ && agrees(glm::dvec3(disk.normal));
        earlier_.push_back(disk);
    });
    mapped_ = smooth_ && tuning_.maps;
    if (mapped_) {
        map_.clear(parts_.placeIn(axis_, inner, widest_));
    } else {
        grid_.clear(box_.low, box_.high, cellWidth * spacing_);
        parts_.place();
    }
    for (const Disk& disk : earlier_)
        if (!mapped_ || !map_.insert(disk))
            insertInGrid(disk);
}

void RegionFiller::Sampler::insertInGrid(const Disk& disk)
{
    if (mapped_) {
        // Sheets lie on each other: go on with the grid. It blocks the same darts.
        mapped_ = false;
        grid_.clear(box_.low, box_.high, cellWidth * spacing_);
        map_.forEach([&](const Disk& other) { grid_.insert(other); });
    }
    grid_.insert(disk);
}

void RegionFiller::Sampler::throwAll()
{
    for (int pass = 0; pass < PoissonTuning::passes; ++pass) {
        const int rounds = tuning_.rounds[std::size_t(pass)];
        if (rounds == 0)
            continue;
        if (pass > parts_.pass())
            parts_.quarter(pass - parts_.pass(),
                           [&](const DartPart& part, int level) { return isCovered(part, level); });
        for (int round = 0; round < rounds; ++round)
            throwRound(round);
    }
}

void RegionFiller::Sampler::throwRound(int round)
{
    flight_.clear();
    for (const DartPart& part : parts_.parts()) {
        // Number of darts proportional to the part's area, rounded by the part's random number.
        const auto rounds = static_cast<std::uint64_t>(round);
        const auto first = static_cast<std::uint32_t>((rounds * part.tries + part.share) >> 24);
        const auto end = static_cast<std::uint32_t>(((rounds + 1) * part.tries + part.share) >> 24);
        for (std::uint32_t i = first; i < end; ++i) {
            const std::uint64_t bits = mixBits(part.key + i * golden);
            flight_.push_back({part.local(DartShares(bits)), i, bits, &part});
        }
        if (flight_.size() >= dartsInFlight)
            land();
    }
    land();
}

// Lets the darts in flight hit the ground, in their order. First a look at the map rejects most of
// them, without a branch: a dart that is blocked now is blocked later.
void RegionFiller::Sampler::land()
{
    if (limit != nullptr)
        limit->require();
    std::uint64_t thrown = 0;
    std::uint64_t blocked = 0;
    std::size_t left = 0;
    landing_.resize(flight_.size());
    const DiskMap::Look look(map_);
    std::uint32_t* const landing = landing_.data();
    for (std::size_t i = 0; i < flight_.size(); ++i) {
        const Dart& dart = flight_[i];
        const auto isCounted = std::uint64_t(counts(dart));
        const auto isBlocked = mapped_ ? std::uint64_t(look.surelyBlocks(dart.local)) : 0;
        thrown += isCounted;
        blocked += isCounted & isBlocked;
        landing[left] = static_cast<std::uint32_t>(i);
        left += 1 - isBlocked;
    }
    constexpr std::size_t ahead = 8;
    for (std::size_t i = 0; i < left; ++i) {
        // What a dart reads of its side lies anywhere.
        const DartPart& next = *flight_[landing[std::min(i + ahead, left - 1)]].part;
        const auto* const side = reinterpret_cast<const char*>(&parts_.sideOf(next));
        __builtin_prefetch(side);
        __builtin_prefetch(side + 64);
        throwDart(flight_[landing[i]]);
    }
    result_.thrown += thrown;
    result_.rejected[static_cast<std::size_t>(Reject::spacing)] += blocked;
    flight_.clear();
}

// Barycentrics of a dart.
glm::vec2 RegionFiller::Sampler::placeOf(const Dart& dart) const
{
    const Fragment fragment = parts_.fragmentOf(*dart.part);
    const DartShares shares(dart.bits);
    const double unit = double(fragment.size) * 0x1.0p-24;
    return {static_cast<float>(double(fragment.b) + unit * double(shares.u)),
            static_cast<float>(double(fragment.c) + unit * double(shares.v))};
}

bool RegionFiller::Sampler::countsOnBorder(const Dart& dart) const
{
    const glm::vec2 place = placeOf(dart);
    return counted_->holds(
        glm::vec3(parts_.sideOf(*dart.part).placeOf(double(place.x), double(place.y))));
}

void RegionFiller::Sampler::throwDart(const Dart& dart)
{
    const DartPart& part = *dart.part;
    const bool isCounted = counts(dart);
    const auto reject = [&](Reject reason) {
        result_.rejected[static_cast<std::size_t>(reason)] += std::uint64_t(isCounted);
    };
    if (mapped_ && DiskMap::Look(map_).surelyBlocks(dart.local)) {
        reject(Reject::spacing);
        return;
    }
    const TriangleSide& side = parts_.sideOf(part);
    // A share of the darts is thrown where less grows.
    const double least = 1.0 / (tuning_.widest * tuning_.widest);
    const std::uint64_t more = mixBits(dart.bits ^ golden);
    const double draw = double(more >> 32) * 0x1.0p-32;
    const double chance = draw < least ? 0.0 : draw;
    if (double(side.bound) <= chance) {
        reject(side.boundReason);
        return;
    }
    const glm::vec2 place = placeOf(dart);
    const float b = place.x;
    const float c = place.y;
    const glm::vec3 position(side.placeOf(double(b), double(c)));
    // No disk is smaller than the spacing: most darts need no root to be rejected.
    if (!mapped_ &&
        grid_.blocksNearby(position, static_cast<float>(spacing_),
                           smooth_ ? nullptr : &side.sheetNormal, double(side.sheetCosine))) {
        reject(Reject::spacing);
        return;
    }
    const auto rootHere = [&] {
        return TrianglePoints(ground_, side.triangle, side.face)
            .at(b, c, parts_.candidate(part, dart.index));
    };

    // Lower density: widen the disks in proportion to the darts that are left out.
    RootSample root;
    float radius = static_cast<float>(spacing_);
    bool bears = true;
    Reject whyThinned = Reject::mask;
    const bool needsAnything = filter_.needsAnything();
    const bool needsRoot = needsAnything || !smooth_;
    if (needsRoot)
        root = rootHere();
    if (needsAnything) {
        Reject reason = Reject::mask;
        const double weight = filter_.weigh(root, chance, reason);
        if (weight <= chance) {
            reject(reason);
            return;
        }
        const double wanted = std::max(weight, least);
        const double thinning = double(more & 0xffffffffU) * 0x1.0p-32 * wanted;
        bears = thinning < weight;
        if (!bears)
            filter_.weigh(root, thinning, whyThinned);
        radius = static_cast<float>(spacing_ / std::sqrt(wanted));
    }

    const bool blocked = mapped_ ? map_.blocks(position, dart.local, radius)
                                 : grid_.blocker(position, radius, smooth_ ? nullptr : &root.normal,
                                                 tuning_.sheetCosine) != nullptr;
    if (blocked) {
        reject(Reject::spacing);
        return;
    }
    if (needsAnything) {
        if (const std::optional<Reject> obstacle = filter_.obstacle(root)) {
            reject(*obstacle);
            return;
        }
    }
    if (!needsRoot)
        root = rootHere();
    const Disk disk{position, radius, root.normal};
    if (!mapped_ || !map_.insert(disk, dart.local))
        insertInGrid(disk);
    if (!bears)
        reject(whyThinned);
    result_.roots.push_back(root);
    result_.radii.push_back(radius);
    result_.bears.push_back(bears ? 1 : 0);
}

// Whether one disk covers the whole part, so that no root can stand on it. May miss some.
bool RegionFiller::Sampler::isCovered(const DartPart& part, int level) const
{
    if (mapped_)
        return map_.surelyCovers(part.corner, part.corner + part.first, part.corner + part.second);
    const TriangleSide& side = parts_.sideOf(part);
    const Fragment fragment = fragmentAt(level, part.column, part.row, part.turned);
    const double third = double(fragment.size) / 3.0;
    const glm::vec3 middle(side.placeOf(double(fragment.b) + third, double(fragment.c) + third));
    const glm::vec3 normal(side.back ? -side.face : side.face);
    const Disk* disk = grid_.blocker(middle, static_cast<float>(spacing_),
                                     smooth_ ? nullptr : &normal, tuning_.sheetCosine);
    return disk != nullptr && covers(*disk, side, fragment);
}

bool RegionFiller::Sampler::covers(const Disk& disk, const TriangleSide& side,
                                   const Fragment& fragment) const
{
    const double slack = relativeSlack * (largest(side.corner) + largest(side.first) +
                                          largest(side.second)); // rounding of positions
    const double reach = spacing_ - slack;                       // no disk is smaller
    if (reach <= 0.0)
        return false;
    const auto b = double(fragment.b);
    const auto c = double(fragment.c);
    const auto size = double(fragment.size);
    const glm::dvec3 middle(disk.position);
    const auto near = [&](const glm::dvec3& corner) {
        const glm::dvec3 offset = corner - middle;
        return glm::dot(offset, offset) <= reach * reach;
    };
    if (!near(side.placeOf(b, c)) || !near(side.placeOf(b + size, c)) ||
        !near(side.placeOf(b, c + size)))
        return false;
    if (smooth_)
        return true;
    // A disk covers nothing on another side.
    const double sign = side.back ? -1.0 : 1.0;
    const glm::uvec3 corners = ground_.triangles[side.triangle];
    const glm::dvec3 normal = sign * glm::dvec3(disk.normal);
    const double least = tuning_.sheetCosine + 1e-6;
    return glm::dot(side.face, normal) > least &&
           glm::dot(glm::dvec3(ground_.normals[corners.x]), normal) > least &&
           glm::dot(glm::dvec3(ground_.normals[corners.y]), normal) > least &&
           glm::dot(glm::dvec3(ground_.normals[corners.z]), normal) > least;
}

PoissonTuning tuningOf(const BakeSettings& settings)
{
    return settings.spread == Spread::poissonDense ? PoissonTuning::dense() : PoissonTuning::fast();
}

RegionFiller::RegionFiller(const terrain::GroundMesh& ground, std::uint64_t seed,
                           const RootFilter& filter, const PoissonLattice& lattice, double spacing,
                           bool filtered, const PoissonTuning& tuning, const TileRegion* counted)
    : sampler_(std::make_unique<Sampler>(ground, seed, filter, lattice, spacing, filtered, tuning,
                                         counted))
{
}

RegionFiller::~RegionFiller() = default;

void RegionFiller::bound(const SearchLimit& limit)
{
    sampler_->limit = &limit;
}

RegionResult RegionFiller::fill(std::span<const RegionPiece> pieces, const CubeIndex<Disk>& before)
{
    return sampler_->fill(pieces, before);
}

} // namespace sward::bake
