#include "bake/poisson/poisson_parts.h"

#include "bake/poisson/disk_map.h"
#include "core/random.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace sward::bake {
namespace {

// Keys of the random numbers of darts and of part orders.
constexpr std::uint64_t dartSalt = 0x64617274ULL;
constexpr std::uint64_t orderSalt = 0x6f72646572ULL;

constexpr double sharesOfOne = 0x1.0p24;

double largestOf(const glm::dvec3& v)
{
    return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
}

// Visits 0 … count − 1 in strides of the golden ratio, an order independent of the mesh's order.
template <typename Visit>
void forEachInStrides(std::size_t count, Visit visit)
{
    if (count == 0)
        return;
    std::size_t stride =
        std::max<std::size_t>(1, static_cast<std::size_t>(0.6180339887498949 * double(count)));
    while (std::gcd(stride, count) != 1)
        ++stride;
    for (std::size_t i = 0, at = 0; i < count; ++i) {
        visit(at);
        at += stride;
        if (at >= count)
            at -= count;
    }
}

// TriangleSide::sheetNormal and sheetCosine. Normals of roots are between those of the corners, or
// the face's.
std::pair<glm::vec3, float> sheetOf(const terrain::GroundMesh& ground, const TriangleSide& side,
                                    double sheetCosine)
{
    constexpr float never = 2.0f;
    constexpr double slack = 1e-5;
    const glm::uvec3 t = ground.triangles[side.triangle];
    const std::array<glm::dvec3, 4> normals = {glm::dvec3(ground.normals[t.x]),
                                               glm::dvec3(ground.normals[t.y]),
                                               glm::dvec3(ground.normals[t.z]), side.face};
    const glm::dvec3 sum = normals[0] + normals[1] + normals[2] + normals[3];
    const double length = std::sqrt(glm::dot(sum, sum));
    if (!(length > slack))
        return {glm::vec3(side.face), never};
    const glm::dvec3 mean = sum / length;
    double cosine = 1.0; // of the widest angle to the mean
    for (const glm::dvec3& normal : normals)
        cosine = std::min(cosine, glm::dot(normal, mean));
    if (!(cosine > sheetCosine))
        return {glm::vec3(mean), never};
    // The cosine of the difference of both angles.
    const double both = sheetCosine * cosine +
                        std::sqrt((1.0 - sheetCosine * sheetCosine) * (1.0 - cosine * cosine));
    return {glm::vec3(side.back ? -mean : mean), static_cast<float>(both + slack)};
}

} // namespace

RegionParts::RegionParts(const terrain::GroundMesh& ground, std::uint64_t seed,
                         const RootFilter& filter, const PoissonLattice& lattice, double spacing,
                         const PoissonTuning& tuning, const TileRegion* counted)
    : ground_(ground)
    , seed_(seed)
    , filter_(filter)
    , lattice_(lattice)
    , spacing_(spacing)
    , tuning_(tuning)
    , counted_(counted)
{
}

void RegionParts::addSide(const RegionPiece& piece)
{
    const glm::uvec3 corners = ground_.triangles[piece.triangle];
    TriangleSide& side = sides_.emplace_back();
    side.corner = glm::dvec3(ground_.positions[corners.x]);
    side.first = glm::dvec3(ground_.positions[corners.y]) - side.corner;
    side.second = glm::dvec3(ground_.positions[corners.z]) - side.corner;
    side.face = ground_.faceNormal(piece.triangle);
    side.triangle = piece.triangle;
    side.source = ground_.source(piece.triangle);
    side.back = piece.back;
    const auto [sheetNormal, sheetCosine] = sheetOf(ground_, side, tuning_.sheetCosine);
    const WeightBound bound = boundOn({piece.triangle, piece.back});
    side.bound = std::nextafter(static_cast<float>(bound.weight), 2.0f * float(bound.weight));
    side.boundReason = bound.reason;
    side.sheetNormal = sheetNormal;
    side.sheetCosine = sheetCosine;
    side.level = fragmentLevel(ground_, piece.triangle, tuning_.fragmentEdge * spacing_);
    const double area = ground_.area(piece.triangle) / double(1ULL << (2 * side.level));
    const double tries = area / (tuning_.areaPerDart * spacing_ * spacing_);
    side.tries = static_cast<std::uint64_t>(tries * sharesOfOne);
    // Candidates are numbered pass by pass.
    std::uint64_t number = 0;
    for (int pass = 0; pass < PoissonTuning::passes; ++pass) {
        side.firstNumber[std::size_t(pass)] = static_cast<std::uint32_t>(number);
        if (tuning_.rounds[std::size_t(pass)] > 0)
            number += static_cast<std::uint64_t>(tuning_.rounds[std::size_t(pass)] * tries + 1.0)
                      << 2 * (side.level + pass);
    }
}

void RegionParts::gather(std::span<const RegionPiece> pieces)
{
    sides_.clear();
    places_.clear();
    bareDarts_ = {};
    pass_ = 0;
    region_ = pieces.front().region;
    const RegionPiece* last = nullptr; // of the current side
    bool sideBears = false;            // some part of it is left
    for (const RegionPiece& piece : pieces) {
        if (last == nullptr || last->triangle != piece.triangle || last->back != piece.back) {
            if (last != nullptr && !sideBears)
                sides_.pop_back();
            addSide(piece);
            last = &piece;
            sideBears = false;
        }
        const TriangleSide& side = sides_.back();
        const auto index = static_cast<std::uint32_t>(sides_.size() - 1);
        const auto place = [&](std::uint32_t column, std::uint32_t row, bool turned) {
            const Fragment fragment = fragmentAt(side.level, column, row, turned);
            if (!piece.whole) {
                const double third = double(fragment.size) / 3.0;
                const glm::dvec3 middle =
                    side.placeOf(double(fragment.b) + third, double(fragment.c) + third);
                if (lattice_.regionOf(middle) != piece.region)
                    return;
            }
            DartPlace& added =
                places_.emplace_back(DartPlace{index, static_cast<std::uint16_t>(column),
                                               static_cast<std::uint16_t>(row), turned});
            WeightBound bound{double(side.bound), side.boundReason};
            if (!bound.isBare() && side.level > 0)
                bound = boundOn({side.triangle, side.back, double(fragment.b), double(fragment.c),
                                 double(fragment.size)});
            if (bound.isBare()) {
                bareDarts_[static_cast<std::size_t>(bound.reason)] += dartsAt(side, added);
                added.side = DartPlace::bare;
            }
            sideBears = sideBears || !bound.isBare();
        };
        forEachPart(piece, side.level, place);
    }
    if (!sideBears)
        sides_.pop_back();
}

WeightBound RegionParts::boundOn(const GroundPart& part) const
{
    return tuning_.bounds ? filter_.bounds().on(part) : WeightBound();
}

// Number of darts of the first pass at a part, if a tile counts it. Its middle decides, so that
// tiles add up to the whole.
std::uint64_t RegionParts::dartsAt(const TriangleSide& side, const DartPlace& place) const
{
    const Fragment fragment = fragmentAt(side.level, place.column, place.row, place.turned);
    const double third = double(fragment.size) / 3.0;
    if (counted_ != nullptr && !counted_->holds(glm::vec3(side.placeOf(
                                   double(fragment.b) + third, double(fragment.c) + third))))
        return 0;
    return (std::uint64_t(tuning_.rounds[0]) * static_cast<std::uint32_t>(side.tries) +
            shareOf(keyOf(side, place))) >>
           24;
}

// Key of the random numbers of a part of the current pass.
std::uint64_t RegionParts::keyOf(const TriangleSide& side, const DartPlace& place) const
{
    const std::uint64_t number =
        std::uint64_t(side.firstNumber[std::size_t(pass_)]) +
        partNumber(side.level + pass_, place.column, place.row, place.turned);
    const std::uint64_t index =
        std::uint64_t(side.source) << 32 | std::uint64_t(side.back) << 31 | (number & 0x7fffffffU);
    return hashBits(seed_ ^ dartSalt, index);
}

std::uint32_t RegionParts::shareOf(std::uint64_t key) const
{
    return static_cast<std::uint32_t>(mixBits(key ^ seed_ ^ orderSalt) >> 40);
}

DAabb RegionParts::bounds() const
{
    DAabb box;
    for (const TriangleSide& side : sides_) {
        box.add(side.corner);
        box.add(side.corner + side.first);
        box.add(side.corner + side.second);
    }
    // A part's centroid lies in the region.
    const double beyond = fromCentroid * tuning_.fragmentEdge * spacing_ * 1.0001;
    const DAabb region = lattice_.boxOf(region_);
    box.low = glm::max(box.low, region.low - beyond);
    box.high = glm::min(box.high, region.high + beyond);
    return box;
}

void RegionParts::place()
{
    makeParts();
}

RegionFrame RegionParts::placeIn(const glm::dvec3& normal, const DAabb& box, double widest)
{
    // The first axis follows the box's longest edge, so that narrow regions have narrow maps.
    glm::dvec3 along(0.0);
    double longest = 0.0;
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        glm::dvec3 edge(0.0);
        edge[axis] = box.high[axis] - box.low[axis];
        edge -= glm::dot(edge, normal) * normal;
        const double squared = glm::dot(edge, edge);
        if (squared > longest) {
            longest = squared;
            along = edge;
        }
    }
    along /= std::sqrt(std::max(longest, std::numeric_limits<double>::min()));
    RegionFrame frame;
    frame.spacing = spacing_;
    frame.rounding =
        largestOf(glm::max(glm::abs(box.low), glm::abs(box.high)) + widest) * 0x1.0p-22;
    const double perMetre = DiskMap::cellsPerSpacing / spacing_;
    frame.axes = glm::transpose(
        glm::dmat3(along * perMetre, glm::cross(normal, along) * perMetre, normal * perMetre));
    frame.origin = box.low;
    for (TriangleSide& side : sides_) {
        side.localCorner = frame.place(side.corner);
        side.localFirst = frame.vector(side.first);
        side.localSecond = frame.vector(side.second);
    }
    makeParts();

    // Move the origin so that the map begins at (0, 0).
    Aabb local;
    for (const DartPart& part : parts_) {
        local.add(part.corner);
        local.add(part.corner + part.first);
        local.add(part.corner + part.second);
    }
    const double margin = std::ceil(DiskMap::margin + 1.0 + (widest + frame.rounding) * perMetre);
    const glm::dvec3 low(std::floor(double(local.low.x)) - margin,
                         std::floor(double(local.low.y)) - margin, 0.0);
    frame.origin += glm::transpose(frame.axes) * low / (perMetre * perMetre);
    for (DartPart& part : parts_)
        part.corner -= glm::vec3(low);
    for (TriangleSide& side : sides_)
        side.localCorner -= low;
    const glm::dvec3 size = glm::dvec3(local.high) + margin - low;
    frame.cells = glm::ivec2(static_cast<int>(size.x) + 2, static_cast<int>(size.y) + 2);
    return frame;
}

void RegionParts::makeParts()
{
    parts_.clear();
    parts_.reserve(places_.size());
    forEachInStrides(places_.size(), [&](std::size_t at) {
        if (places_[at].side != DartPlace::bare)
            addPart(places_[at]);
    });
}

void RegionParts::placeTurns()
{
    parts_.clear();
    for (std::vector<DartPlace>& turn : turns_) {
        for (const DartPlace& place : turn)
            addPart(place);
        turn.clear();
    }
}

void RegionParts::addPart(const DartPlace& place)
{
    const TriangleSide& side = sides_[place.side];
    const int level = side.level + pass_;
    const Fragment fragment = fragmentAt(level, place.column, place.row, place.turned);
    const auto b = double(fragment.b);
    const auto c = double(fragment.c);
    const auto size = double(fragment.size);
    DartPart& part = parts_.emplace_back();
    part.corner = glm::vec3(side.localCorner + b * side.localFirst + c * side.localSecond);
    part.first = glm::vec3(size * side.localFirst);
    part.second = glm::vec3(size * side.localSecond);
    part.side = place.side;
    part.column = place.column;
    part.row = place.row;
    part.turned = place.turned;
    part.key = keyOf(side, place);
    part.tries = static_cast<std::uint32_t>(side.tries);
    part.share = shareOf(part.key);
    part.counts = countsOf(side, fragment);
}

std::array<DartPart, 4> RegionParts::quartersOf(const DartPart& part)
{
    std::array<DartPart, 4> quarters;
    const glm::vec3 first = 0.5f * part.first;
    const glm::vec3 second = 0.5f * part.second;
    // The inner one is an upright one seen from the opposite corner.
    quarters[0].corner = part.corner;
    quarters[1].corner = part.corner + first;
    quarters[2].corner = part.corner + second;
    quarters[3].corner = part.corner + first + second;
    const std::uint32_t far = part.turned ? 1 : 0;
    for (std::size_t i = 0; i < 4; ++i) {
        DartPart& quarter = quarters[i];
        const bool inner = i == 3;
        quarter.first = inner ? -first : first;
        quarter.second = inner ? -second : second;
        quarter.side = part.side;
        quarter.turned = part.turned != inner;
        quarter.column = static_cast<std::uint16_t>(2U * part.column + (i == 1 ? 1 - far : far));
        quarter.row = static_cast<std::uint16_t>(2U * part.row + (i == 2 ? 1 - far : far));
    }
    return quarters;
}

DartPart::Counts RegionParts::countsOf(const TriangleSide& side, const Fragment& fragment) const
{
    if (counted_ == nullptr)
        return DartPart::Counts::all;
    const auto b = double(fragment.b);
    const auto c = double(fragment.c);
    const auto size = double(fragment.size);
    DAabb box;
    box.add(side.placeOf(b, c));
    box.add(side.placeOf(b + size, c));
    box.add(side.placeOf(b, c + size));
    // Wider than any rounding of a dart's place.
    const double slack =
        1e-6 * (spacing_ + largestOf(glm::max(glm::abs(box.low), glm::abs(box.high))));
    const CellNumber low = cellOf(ground_.origin, glm::vec3(box.low - slack));
    const CellNumber high = cellOf(ground_.origin, glm::vec3(box.high + slack));
    if (low != high)
        return DartPart::Counts::some;
    return counted_->holds(low) ? DartPart::Counts::all : DartPart::Counts::none;
}

std::uint32_t RegionParts::candidate(const DartPart& part, std::uint32_t index) const
{
    const TriangleSide& side = sideOf(part);
    const int level = side.level + pass_;
    const std::uint32_t number = side.firstNumber[std::size_t(pass_)] + (index << 2 * level) +
                                 partNumber(level, part.column, part.row, part.turned);
    return side.back ? number | backSide : number;
}

} // namespace sward::bake
