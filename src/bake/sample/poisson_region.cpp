#include "bake/sample/poisson_region.h"

#include "bake/sample/disk_grid.h"
#include "bake/sample/triangle_points.h"
#include "core/random.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace sward::bake {
namespace {

// Keys of the random numbers of darts and of part orders.
constexpr std::uint64_t dartSalt = 0x64617274ULL;
constexpr std::uint64_t orderSalt = 0x6f72646572ULL;

constexpr std::uint64_t golden = 0x9e3779b97f4a7c15U;

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
        , seed_(seed)
        , filter_(filter)
        , lattice_(lattice)
        , spacing_(spacing)
        , widest_(filtered ? tuning.widest * spacing : spacing)
        , tuning_(tuning)
        , counted_(counted)
    {
    }

    RegionResult fill(std::span<const RegionPiece> pieces, const CubeIndex<Disk>& before)
    {
        RegionResult result;
        pass_ = 0;
        gatherParts(pieces);
        if (parts_.empty())
            return result;
        gatherDisks(before);
        for (pass_ = 0; pass_ < PoissonTuning::passes; ++pass_)
            if (const int rounds = tuning_.rounds[std::size_t(pass_)]; rounds > 0) {
                if (pass_ > 0)
                    quarter();
                for (int round = 0; round < rounds; ++round)
                    throwRound(round, result);
            }
        return result;
    }

    const SearchLimit* limit = nullptr; // of time, if there is one

private:
    // A triangle side with parts in the region.
    struct TriangleSide {
        glm::dvec3 corner, first, second;
        std::uint32_t triangle;
        std::uint32_t source;
        int level;
        bool back;
        std::uint64_t key;   // of random numbers
        std::uint64_t tries; // per part and round, times 2³²
        std::array<std::uint32_t, PoissonTuning::passes> firstNumber; // of candidates per pass
        double slack;                                                 // rounding of positions [m]
    };

    // One of the 4^(level + pass) parts of its triangle.
    struct Part {
        std::uint32_t side;
        std::uint16_t column;
        std::uint16_t row;
        bool turned;
        bool open;
    };

    void gatherParts(std::span<const RegionPiece> pieces);
    void gatherDisks(const CubeIndex<Disk>& before);
    void quarter();
    void throwRound(int round, RegionResult& result);
    void throwAt(Part& part, int round, RegionResult& result);
    void throwDart(Part& part, const Fragment& fragment, std::uint32_t candidate,
                   RegionResult& result);
    bool covers(const Disk& disk, const TriangleSide& side, const Fragment& fragment) const;
    Fragment fragmentOf(const Part& part) const
    {
        return fragmentAt(sides_[part.side].level + pass_, part.column, part.row, part.turned);
    }
    glm::dvec3 placeOf(const TriangleSide& side, double b, double c) const
    {
        return side.corner + b * side.first + c * side.second;
    }
    const terrain::GroundMesh& ground_;
    std::uint64_t seed_;
    const RootFilter& filter_;
    const PoissonLattice& lattice_;
    double spacing_;
    double widest_;
    const PoissonTuning& tuning_;
    const TileRegion* counted_;

    std::vector<TriangleSide> sides_;
    std::vector<Part> parts_;
    std::vector<Part> next_;
    DiskGrid grid_;
    bool smooth_ = false;
    int pass_ = 0;
};

void RegionFiller::Sampler::gatherParts(std::span<const RegionPiece> pieces)
{
    sides_.clear();
    parts_.clear();
    for (const RegionPiece& piece : pieces) {
        if (sides_.empty() || sides_.back().triangle != piece.triangle ||
            sides_.back().back != piece.back) {
            const glm::uvec3 corners = ground_.triangles[piece.triangle];
            TriangleSide side;
            side.corner = glm::dvec3(ground_.positions[corners.x]);
            side.first = glm::dvec3(ground_.positions[corners.y]) - side.corner;
            side.second = glm::dvec3(ground_.positions[corners.z]) - side.corner;
            side.triangle = piece.triangle;
            side.source = ground_.source(piece.triangle);
            side.back = piece.back;
            side.key = hashBits(seed_ ^ orderSalt,
                                std::uint64_t(side.source) << 1 | std::uint64_t(piece.back));
            side.level = fragmentLevel(ground_, piece.triangle, tuning_.fragmentEdge * spacing_);
            const double area = ground_.area(piece.triangle) / double(1ULL << (2 * side.level));
            const double tries = area / (tuning_.areaPerDart * spacing_ * spacing_);
            side.tries = static_cast<std::uint64_t>(tries * 0x1.0p32);
            // Candidates are numbered pass by pass.
            std::uint64_t number = 0;
            for (int pass = 0; pass < PoissonTuning::passes; ++pass) {
                side.firstNumber[std::size_t(pass)] = static_cast<std::uint32_t>(number);
                number +=
                    static_cast<std::uint64_t>(tuning_.rounds[std::size_t(pass)] * tries + 1.0)
                    << 2 * (side.level + pass);
            }
            side.slack =
                relativeSlack * (largest(side.corner) + largest(side.first) + largest(side.second));
            sides_.push_back(side);
        }
        const TriangleSide& side = sides_.back();
        const auto index = static_cast<std::uint32_t>(sides_.size() - 1);
        const auto place = [&](std::uint32_t column, std::uint32_t row, bool turned) {
            if (!piece.whole) {
                const Fragment fragment = fragmentAt(side.level, column, row, turned);
                const double third = double(fragment.size) / 3.0;
                const glm::dvec3 middle =
                    placeOf(side, double(fragment.b) + third, double(fragment.c) + third);
                if (lattice_.regionOf(middle) != piece.region)
                    return;
            }
            parts_.push_back({index, static_cast<std::uint16_t>(column),
                              static_cast<std::uint16_t>(row), turned, true});
        };
        forEachPart(piece, side.level, place);
    }
}

void RegionFiller::Sampler::gatherDisks(const CubeIndex<Disk>& before)
{
    // Bounding box of all positions that darts can hit.
    glm::dvec3 low(std::numeric_limits<double>::max());
    glm::dvec3 high(std::numeric_limits<double>::lowest());
    for (const Part& part : parts_) {
        const TriangleSide& side = sides_[part.side];
        const Fragment fragment = fragmentOf(part);
        const auto b = double(fragment.b);
        const auto c = double(fragment.c);
        const auto size = double(fragment.size);
        for (const glm::dvec3& corner :
             {placeOf(side, b, c), placeOf(side, b + size, c), placeOf(side, b, c + size)}) {
            low = glm::min(low, corner);
            high = glm::max(high, corner);
        }
    }
    // Extend the grid around it by the widest disk.
    const double margin = widest_ + largest(glm::max(glm::abs(low), glm::abs(high))) * 1e-6;
    low -= margin;
    high += margin;
    grid_.clear(low, high, cellWidth * spacing_);

    // Test whether the region is smooth.
    glm::dvec3 sum(0.0);
    for (const TriangleSide& side : sides_) {
        const glm::dvec3 face = ground_.faceNormal(side.triangle);
        sum += side.back ? -face : face;
    }
    const double length = std::sqrt(glm::dot(sum, sum));
    smooth_ = length > 0.0;
    const glm::dvec3 axis = smooth_ ? sum / length : sum;
    const auto agrees = [&](const glm::dvec3& normal) {
        return glm::dot(normal, axis) > smoothCosine;
    };
    for (std::size_t i = 0; i < sides_.size() && smooth_; ++i) {
        const TriangleSide& side = sides_[i];
        const double sign = side.back ? -1.0 : 1.0;
        const glm::uvec3 corners = ground_.triangles[side.triangle];
        smooth_ = agrees(sign * ground_.faceNormal(side.triangle)) &&
                  agrees(sign * glm::dvec3(ground_.normals[corners.x])) &&
                  agrees(sign * glm::dvec3(ground_.normals[corners.y])) &&
                  agrees(sign * glm::dvec3(ground_.normals[corners.z]));
    }

    before.forEachIn(low, high, [&](const Disk& disk) {
        const glm::dvec3 place(disk.position);
        for (glm::length_t i = 0; i < 3; ++i)
            if (place[i] <= low[i] || place[i] >= high[i])
                return;
        smooth_ = smooth_ && agrees(glm::dvec3(disk.normal));
        grid_.insert(disk);
    });
}

// Replaces open parts by their quarters; `pass_` is the pass of the quarters.
void RegionFiller::Sampler::quarter()
{
    next_.clear();
    for (const Part& part : parts_) {
        if (!part.open)
            continue;
        const std::uint32_t column = 2U * part.column;
        const std::uint32_t row = 2U * part.row;
        const auto add = [&](std::uint32_t i, std::uint32_t j, bool turned) {
            next_.push_back({part.side, static_cast<std::uint16_t>(column + i),
                             static_cast<std::uint16_t>(row + j), turned, true});
        };
        const std::uint32_t far = part.turned ? 1 : 0;
        add(far, far, part.turned);
        add(far, far, !part.turned);
        add(1 - far, far, part.turned);
        add(far, 1 - far, part.turned);
    }
    parts_.swap(next_);
}

// Visits the parts in strides of the golden ratio, an order independent of the mesh's order.
void RegionFiller::Sampler::throwRound(int round, RegionResult& result)
{
    const std::size_t count = parts_.size();
    if (count == 0)
        return;
    std::size_t stride =
        std::max<std::size_t>(1, static_cast<std::size_t>(0.6180339887498949 * double(count)));
    while (std::gcd(stride, count) != 1)
        ++stride;
    for (std::size_t i = 0, at = 0; i < count; ++i) {
        if (limit != nullptr && i % 1024 == 0)
            limit->require();
        if (parts_[at].open)
            throwAt(parts_[at], round, result);
        at += stride;
        if (at >= count)
            at -= count;
    }
}

void RegionFiller::Sampler::throwAt(Part& part, int round, RegionResult& result)
{
    const TriangleSide& side = sides_[part.side];
    // Number of tries proportional to the part's area, rounded by the part's random number.
    const std::uint32_t number = partNumber(side.level + pass_, part.column, part.row, part.turned);
    const std::uint64_t share = mixBits(side.key + number * golden +
                                        (pass_ == 0   ? 0U
                                         : pass_ == 1 ? 1U
                                                      : 2U)) >>
                                32;
    const auto rounds = static_cast<std::uint64_t>(round);
    const auto first = static_cast<std::uint32_t>((rounds * side.tries + share) >> 32);
    const auto last = static_cast<std::uint32_t>(((rounds + 1) * side.tries + share) >> 32);
    for (std::uint32_t i = first; i < last && part.open; ++i)
        throwDart(part, fragmentOf(part),
                  side.firstNumber[std::size_t(pass_)] + (i << 2 * (side.level + pass_)) + number,
                  result);
}

void RegionFiller::Sampler::throwDart(Part& part, const Fragment& fragment, std::uint32_t candidate,
                                      RegionResult& result)
{
    const TriangleSide& side = sides_[part.side];
    if (side.back)
        candidate |= backSide;
    const std::uint64_t bits =
        hashBits(seed_ ^ dartSalt, std::uint64_t(side.source) << 32 | candidate);
    double u = double(bits >> 32) * 0x1.0p-32;
    double v = double(bits & 0xffffffffU) * 0x1.0p-32;
    if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
    }
    const auto size = double(fragment.size);
    const auto b = static_cast<float>(double(fragment.b) + size * u);
    const auto c = static_cast<float>(double(fragment.c) + size * v);

    const glm::vec3 position(placeOf(side, double(b), double(c)));
    const auto counts = std::uint64_t(counted_ == nullptr || counted_->holds(position));
    result.thrown += counts;
    const auto reject = [&](Reject reason) {
        result.rejected[static_cast<std::size_t>(reason)] += counts;
    };

    // Lower density: throw fewer darts and widen the disks in proportion.
    RootSample root;
    float radius = static_cast<float>(spacing_);
    bool bears = true;
    Reject whyThinned = Reject::mask;
    const bool needsAnything = filter_.needsAnything();
    if (needsAnything || !smooth_)
        root = TrianglePoints(ground_, side.triangle).at(b, c, candidate);
    if (needsAnything) {
        const double least = 1.0 / (tuning_.widest * tuning_.widest);
        const std::uint64_t more = mixBits(bits ^ golden);
        const double draw = double(more >> 32) * 0x1.0p-32;
        const double chance = draw < least ? 0.0 : draw;
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

    if (const Disk* disk = grid_.blocker(position, radius, smooth_ ? nullptr : &root.normal,
                                         tuning_.sheetCosine)) {
        reject(Reject::spacing);
        if (covers(*disk, side, fragment))
            part.open = false;
        return;
    }
    if (needsAnything) {
        if (const std::optional<Reject> obstacle = filter_.obstacle(root)) {
            reject(*obstacle);
            return;
        }
    } else if (smooth_) {
        root = TrianglePoints(ground_, side.triangle).at(b, c, candidate);
    }
    grid_.insert({position, radius, root.normal});
    if (!bears)
        reject(whyThinned);
    result.roots.push_back(root);
    result.radii.push_back(radius);
    result.bears.push_back(bears ? 1 : 0);
    if (covers(grid_.last(), side, fragment))
        part.open = false;
}

// Whether this one disk covers the whole part, so that no root can stand on it.
bool RegionFiller::Sampler::covers(const Disk& disk, const TriangleSide& side,
                                   const Fragment& fragment) const
{
    const double reach = spacing_ - side.slack; // no disk is smaller
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
    if (!near(placeOf(side, b, c)) || !near(placeOf(side, b + size, c)) ||
        !near(placeOf(side, b, c + size)))
        return false;
    if (smooth_)
        return true;
    // A disk covers nothing on another side.
    const double sign = side.back ? -1.0 : 1.0;
    const glm::uvec3 corners = ground_.triangles[side.triangle];
    const glm::dvec3 normal = sign * glm::dvec3(disk.normal);
    const double least = tuning_.sheetCosine + 1e-6;
    return glm::dot(ground_.faceNormal(side.triangle), normal) > least &&
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
