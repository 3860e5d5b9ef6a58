#include "bake/seeds/seed_cells.h"

#include "bake/blades/clumps.h"
#include "bake/sample/triangle_points.h"
#include "bake/seeds/seed_pieces.h"
#include "core/error.h"
#include "core/random.h"
#include "shaders/shared/sow/sown_blade.h"

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace sward::bake {
namespace {

// Conditions that vary are sampled at least this densely [m].
constexpr double finestSample = 0.5;
constexpr std::uint32_t maxGridSteps = 64;

// Where nothing tells of change, parts of large triangles are sampled this densely first [m].
constexpr double coarsestSample = 2.0;

// Where the exposures of a triangle's corners differ by less, it varies linearly on the triangle: a
// share of the sky, or two of few rays, which differ by chance.
float evenExposure(const BakeSettings& settings)
{
    constexpr float evenShare = 0.15f;
    return std::max(evenShare, 2.5f / float(std::max(settings.exposureRays, 1)));
}

// Of a vertex that rays have not left yet, and of one that something is above or beside.
constexpr float unknownExposure = -2.0f;
constexpr float narrowPlace = -1.0f;
constexpr std::int32_t unknownMoisture = std::numeric_limits<std::int32_t>::min();

// Where their densities differ by less, in 65535ths, it does so, too.
constexpr std::uint32_t evenDensity = 1000;

std::string_view bytesOf(const shared::SeedConditions& conditions)
{
    return {reinterpret_cast<const char*>(&conditions), sizeof conditions};
}

bool areEqual(const std::vector<shared::SeedConditions>& list)
{
    return std::all_of(list.begin(), list.end(), [&](const shared::SeedConditions& one) {
        return bytesOf(one) == bytesOf(list.front());
    });
}

std::uint32_t densityOf(const shared::SeedConditions& conditions)
{
    return conditions.growth & 65535U;
}

// Whether conditions vary so little that they are linear between the corners: without ground that
// buries, bends or crushes blades.
bool areEven(const std::vector<shared::SeedConditions>& list, float evenExposure)
{
    constexpr std::uint32_t openRoom = 255;
    const auto evenBytes = static_cast<std::uint32_t>(std::min(evenExposure, 1.0f) * 255.0f);
    std::uint32_t sparsest = 65535;
    std::uint32_t densest = 0;
    std::uint32_t darkest = 255;
    std::uint32_t lightest = 0;
    const shared::SeedConditions& first = list.front();
    for (const shared::SeedConditions& one : list) {
        const std::uint32_t exposure = one.growth >> 16U & 255U;
        sparsest = std::min(sparsest, densityOf(one));
        densest = std::max(densest, densityOf(one));
        darkest = std::min(darkest, exposure);
        lightest = std::max(lightest, exposure);
        if (one.growth >> 24U != first.growth >> 24U || one.lean != first.lean ||
            one.look >> 24U != first.look >> 24U || (one.size & 65535U) != (first.size & 65535U) ||
            one.size >> 24U != openRoom)
            return false;
    }
    return densest - sparsest <= evenDensity && (sparsest > 0 || densest == 0) &&
           lightest - darkest <= evenBytes;
}

// What the corners of a whole triangle tell of it.
struct CornerSites {
    enum class Kind {
        unknown,  // nothing: all must be sampled
        evenRays, // what rays find varies linearly
        linear    // everything does
    };

    Kind kind = Kind::unknown;
    std::array<float, 3> exposure{1.0f, 1.0f, 1.0f};

    float at(glm::vec2 barycentric) const
    {
        return exposure[0] + barycentric.x * (exposure[1] - exposure[0]) +
               barycentric.y * (exposure[2] - exposure[0]);
    }
};

// Where strokes change how blades look, conditions are sampled as densely as a share of their
// radius, within these bounds [m].
constexpr double sampleOfRadius = 0.2;
constexpr double finestPainted = 0.0625;

// Doublings of the height of blades that SeedPiece::form holds.
std::uint32_t doublingsOf(double tallest)
{
    std::uint32_t doublings = 0;
    while (doublings < 3 && std::ldexp(1.0, int(doublings)) < tallest)
        ++doublings;
    return doublings;
}

// A grid of places of a part.
struct SampleGrid {
    std::uint32_t alongS = 1;
    std::uint32_t alongV = 1;
};

} // namespace

// Gathers one cell.
class SeedCells::Builder {
public:
    Builder(const SeedCells& of, const SeedCellNumber& cell, const Former* former)
        : of_(of)
        , former_(former)
        , clumpKey_(clumpKeyOf(of.settings_.seed))
    {
        result_.cell = cell;
    }

    // A part with what grows on it.
    struct Sampled {
        shared::SeedPiece piece = {};
        std::vector<shared::SeedConditions> conditions; // one, or its grid; none: nothing grows
        std::vector<std::uint32_t> bits;                // one a candidate, or none
        bool isFormer = false;                          // all this is to be taken as it was
    };

    // Thread-safe.
    Sampled sample(const SeedPart& part) const
    {
        Sampled sampled;
        sampled.piece = pieceOf(of_.ground_, of_.settings_.seed, of_.meadow_.density, part);
        const DAabb box = boxOfPart(of_.ground_, part);
        sampled.isFormer = former_ != nullptr && !former_->isTouched(box);
        if (!sampled.isFormer)
            setConditions(part, TrianglePoints(of_.ground_, part.triangle), box, sampled);
        return sampled;
    }

    void add(const SeedPart& part, Sampled&& sampled)
    {
        const TrianglePoints points(of_.ground_, part.triangle);
        shared::SeedPiece& piece = sampled.piece;
        const shared::SeedPiece* const before = nextFormer(piece);
        if (sampled.isFormer && before != nullptr)
            takeFormer(*before, sampled);
        if (sampled.conditions.empty())
            return;
        if (!sampled.bits.empty()) {
            piece.bits = static_cast<std::uint32_t>(result_.words.size());
            result_.words.insert(result_.words.end(), sampled.bits.begin(), sampled.bits.end());
        }
        piece.records = addConditions(sampled.conditions);
        setCreases(part, piece);
        setCorners(part, points, piece);
        pieceOf_.try_emplace(part.triangle, static_cast<std::uint32_t>(result_.pieces.size()));
        result_.pieces.push_back(piece);
    }

    void add(const SeedCentre& centre)
    {
        auto found = pieceOf_.find(centre.triangle);
        if (found == pieceOf_.end()) {
            // It lies on a triangle that grows nothing here.
            const TrianglePoints points(of_.ground_, centre.triangle);
            shared::SeedPiece piece = {};
            piece.source = of_.ground_.source(centre.triangle);
            piece.bits = shared::noSeedBits;
            piece.creases = shared::noSeedBits;
            setCorners({centre.triangle, 0, 0, 0, 0, 0}, points, piece);
            found =
                pieceOf_.emplace(centre.triangle, static_cast<std::uint32_t>(result_.pieces.size()))
                    .first;
            result_.pieces.push_back(piece);
        }
        const shared::SeedPiece& piece = result_.pieces[found->second];
        const glm::ivec3 place = shared::sowClumpPlace(
            result_.vertices[piece.corners[0]], result_.vertices[piece.corners[1]],
            result_.vertices[piece.corners[2]],
            shared::sowClumpKey(clumpKey_, piece.source, centre.number));
        const std::int32_t moisture = former_ != nullptr
                                          ? former_->cell.clumps[result_.clumps.size()].moisture
                                          : of_.moistureOf(centre, positionOf(place));
        result_.clumps.push_back({found->second, centre.number, moisture});
    }

    bool growsAnything() const
    {
        return std::any_of(result_.pieces.begin(), result_.pieces.end(),
                           [](const shared::SeedPiece& piece) { return piece.count > 0; });
    }

    field::SeedCell finish() { return std::move(result_); }

private:
    // The piece of the former cell that is this part; null if nothing grew on it. Parts come in the
    // order of its pieces.
    const shared::SeedPiece* nextFormer(const shared::SeedPiece& piece)
    {
        if (former_ == nullptr || nextFormer_ == former_->cell.pieces.size())
            return nullptr;
        constexpr std::uint32_t partBits = 1023U | 1U << 31U;
        const shared::SeedPiece& next = former_->cell.pieces[nextFormer_];
        if (next.count == 0 || next.source != piece.source ||
            ((next.form ^ piece.form) & partBits) != 0 || next.low != piece.low ||
            next.target != piece.target)
            return nullptr;
        ++nextFormer_;
        return &next;
    }

    // Takes number, bits and conditions of a part as they were.
    void takeFormer(const shared::SeedPiece& before, Sampled& sampled) const
    {
        const field::SeedCell& cell = former_->cell;
        shared::SeedPiece& piece = sampled.piece;
        piece.count = before.count;
        piece.form = before.form;
        piece.sStart = before.sStart;
        piece.sScale = before.sScale;
        if (before.bits != shared::noSeedBits) {
            const auto from = cell.words.begin() + std::ptrdiff_t(before.bits);
            sampled.bits.assign(from, from + std::ptrdiff_t((std::size_t(before.count) + 31) / 32));
        }
        const std::size_t points =
            std::size_t((before.form >> 10U & 255U) + 1) * ((before.form >> 18U & 255U) + 1);
        const auto from = cell.conditions.begin() + std::ptrdiff_t(before.records);
        sampled.conditions.assign(from, from + std::ptrdiff_t(points));
    }

    // First of these conditions in the cell; single ones are shared.
    std::uint32_t addConditions(std::span<const shared::SeedConditions> list)
    {
        const auto next = static_cast<std::uint32_t>(result_.conditions.size());
        if (list.size() == 1) {
            const auto [found, isNew] =
                conditionsOf_.try_emplace(std::string(bytesOf(list.front())), next);
            if (!isNew)
                return found->second;
        }
        result_.conditions.insert(result_.conditions.end(), list.begin(), list.end());
        return next;
    }

    // A position relative to the ground's origin [m].
    glm::dvec3 positionOf(const glm::ivec3& place) const
    {
        const SeedCellNumber& cell = result_.cell;
        return seedCellSide * glm::dvec3(double(cell[0]), double(cell[1]), double(cell[2])) +
               std::ldexp(1.0, -int(of_.units_.bits())) * glm::dvec3(place);
    }

    DAabb cellBox() const
    {
        DAabb box;
        box.add(positionOf(glm::ivec3(0)));
        box.add(positionOf(glm::ivec3(0)) + seedCellSide);
        return box;
    }

    // Lists the creases near a part.
    void setCreases(const SeedPart& part, shared::SeedPiece& piece)
    {
        const glm::uvec3 corners = of_.ground_.triangles[part.triangle];
        DAabb box;
        for (glm::length_t k = 0; k < 3; ++k)
            box.add(glm::dvec3(of_.ground_.positions[corners[k]]));
        const std::vector<terrain::ConvexCrease> creases = of_.sites_.creasesNear(box, cellBox());
        if (creases.empty())
            return;
        std::vector<std::uint32_t> list{static_cast<std::uint32_t>(creases.size())};
        for (const terrain::ConvexCrease& crease : creases)
            list.push_back(wordsOf(crease));
        piece.creases = static_cast<std::uint32_t>(result_.words.size());
        result_.words.insert(result_.words.end(), list.begin(), list.end());
    }

    // First word of a crease.
    std::uint32_t wordsOf(const terrain::ConvexCrease& crease)
    {
        const shared::SeedVertex from = of_.units_.in(result_.cell, crease.from);
        const shared::SeedVertex to = of_.units_.in(result_.cell, crease.to);
        const auto word = [](int x) { return static_cast<std::uint32_t>(x); };
        const std::array<std::uint32_t, shared::seedCreaseWords> words{
            word(from.x), word(from.y), word(from.z), word(to.x), word(to.y), word(to.z),
            SeedSites::pack(glm::dvec3(crease.normals[0])),
            SeedSites::pack(glm::dvec3(crease.normals[1]))};
        const auto [found, isNew] =
            creaseOf_.try_emplace(words, static_cast<std::uint32_t>(result_.words.size()));
        if (isNew)
            result_.words.insert(result_.words.end(), words.begin(), words.end());
        return found->second;
    }

    void setCorners(const SeedPart& part, const TrianglePoints& points, shared::SeedPiece& piece)
    {
        const glm::uvec3 corners = of_.ground_.triangles[part.triangle];
        for (glm::length_t k = 0; k < 3; ++k) {
            const RootSample root = rootAt(part, points, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0, 0);
            const std::uint32_t up = piece.creases == shared::noSeedBits
                                         ? of_.sites_.upAt(root)
                                         : SeedSites::pack(glm::dvec3(root.normal));
            const auto [found, isNew] =
                vertexOf_.try_emplace(std::uint64_t(corners[k]) << 32U | up,
                                      static_cast<std::uint32_t>(result_.vertices.size()));
            if (isNew) {
                shared::SeedVertex vertex =
                    of_.units_.in(result_.cell, of_.ground_.positions[corners[k]]);
                vertex.up = up;
                result_.vertices.push_back(vertex);
            }
            piece.corners[k] = found->second;
        }
    }

    // Samples the conditions of a part; leaves none if nothing grows there.
    void setConditions(const SeedPart& part, const TrianglePoints& points, const DAabb& box,
                       Sampled& sampled) const
    {
        shared::SeedPiece& piece = sampled.piece;
        const std::array<std::uint32_t, 2> s = rangeOfS(part);
        const PaintedPart painted = of_.sites_.paintedIn(box);
        if (piece.count == 0 && painted.highest <= 1.0)
            return;
        std::vector<shared::SeedConditions> list;
        SampleGrid grid;
        const bool varies = of_.sites_.varies(part.triangle, box);
        const CornerSites corners =
            varies ? CornerSites() : sampleCorners(part, points, painted, list);
        const bool isLinear = corners.kind == CornerSites::Kind::linear && !painted.look;
        if (!isLinear && (varies || painted.look || !isEvenPart(part, points, s, painted, list))) {
            grid = gridOf(part, s,
                          std::clamp(sampleOfRadius * painted.finest, finestPainted, finestSample));
            sampleGrid(part, points, s, grid, corners, painted, list);
        }
        const auto isZero = [](const auto& one) { return densityOf(one) == 0; };
        if (!painted.density && std::all_of(list.begin(), list.end(), isZero))
            return;
        const bool isSharp = painted.density || std::any_of(list.begin(), list.end(), isZero);
        if (isSharp && !setBits(part, points, painted.highest, sampled))
            return;
        piece.form |= doublingsOf(painted.tallest) << 26U;
        if (areEqual(list)) {
            sampled.conditions.assign(1, list.front());
            return;
        }
        sampled.conditions = std::move(list);
        piece.form |= grid.alongS << 10U | grid.alongV << 18U;
        piece.sStart = s[0];
        piece.sScale = static_cast<std::uint32_t>(
            std::min((std::uint64_t(grid.alongS) << 48U) / (s[1] - s[0]),
                     std::uint64_t(std::numeric_limits<std::uint32_t>::max())));
    }

    // Conditions at the corners of a whole triangle, and how they go on between them.
    CornerSites sampleCorners(const SeedPart& part, const TrianglePoints& points,
                              const PaintedPart& painted,
                              std::vector<shared::SeedConditions>& list) const
    {
        CornerSites found;
        if (part.p + part.q > 0)
            return found;
        const glm::uvec3 corners = of_.ground_.triangles[part.triangle];
        std::array<shared::SeedConditions, 3> at;
        float low = 1.0f;
        float high = 0.0f;
        std::uint32_t sparsest = 65535;
        std::uint32_t densest = 0;
        for (glm::length_t k = 0; k < 3; ++k) {
            const RootSample root = rootAt(part, points, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0,
                                           static_cast<std::uint32_t>(k));
            const float exposure = of_.exposureAtVertex(corners[k], part.back != 0);
            if (exposure < 0.0f)
                return found;
            SeedRays rays;
            rays.around.exposure = exposure;
            at[std::size_t(k)] = of_.sites_.at(root, rays, painted);
            low = std::min(low, exposure);
            high = std::max(high, exposure);
            sparsest = std::min(sparsest, densityOf(at[std::size_t(k)]));
            densest = std::max(densest, densityOf(at[std::size_t(k)]));
            found.exposure[std::size_t(k)] = exposure;
        }
        if (high - low > evenExposure(of_.settings_))
            return found;
        // (s, v): (0, 0), (1, 0), (0, 1), (1, 1)
        list = {at[0], at[1], at[0], at[2]};
        found.kind = densest - sparsest <= evenDensity && (sparsest > 0 || densest == 0)
                         ? CornerSites::Kind::linear
                         : CornerSites::Kind::evenRays;
        return found;
    }

    // Whether samples of a few metres tell that conditions vary hardly on a part of a large
    // triangle; then `list` has those of its corners.
    bool isEvenPart(const SeedPart& part, const TrianglePoints& points,
                    const std::array<std::uint32_t, 2>& s, const PaintedPart& painted,
                    std::vector<shared::SeedConditions>& list) const
    {
        if (part.p + part.q == 0)
            return false;
        const SampleGrid grid = gridOf(part, s, coarsestSample);
        sampleGrid(part, points, s, grid, CornerSites(), painted, list);
        if (!areEven(list, evenExposure(of_.settings_)))
            return false;
        const std::size_t lastRow = std::size_t(grid.alongV) * (grid.alongS + 1);
        list = {list[0], list[grid.alongS], list[lastRow], list[lastRow + grid.alongS]};
        return true;
    }

    // Steps of a grid whose samples are at most this far apart [m].
    SampleGrid gridOf(const SeedPart& part, const std::array<std::uint32_t, 2>& s,
                      double spacing) const
    {
        const glm::uvec3 corners = of_.ground_.triangles[part.triangle];
        const glm::dvec3 a(of_.ground_.positions[corners.x]);
        const glm::dvec3 b(of_.ground_.positions[corners.y]);
        const glm::dvec3 c(of_.ground_.positions[corners.z]);
        const double farther = std::max(glm::length(b - a), glm::length(c - a));
        const double along = farther * double(s[1] - s[0]) * 0x1p-32;
        const double across =
            glm::length(c - b) * double(s[1]) * 0x1p-32 * std::ldexp(1.0, -int(part.q));
        const auto steps = [&](double length) {
            return std::clamp(static_cast<std::uint32_t>(std::ceil(length / spacing)), 1U,
                              maxGridSteps);
        };
        // Steps along s are counted in 2⁻¹⁶ of them.
        return {std::clamp(steps(along), 1U, std::max((s[1] - s[0]) >> 16U, 1U)), steps(across)};
    }

    void sampleGrid(const SeedPart& part, const TrianglePoints& points,
                    const std::array<std::uint32_t, 2>& s, const SampleGrid& grid,
                    const CornerSites& corners, const PaintedPart& painted,
                    std::vector<shared::SeedConditions>& list) const
    {
        list.clear();
        std::uint32_t number = 0;
        for (std::uint32_t row = 0; row <= grid.alongV; ++row)
            for (std::uint32_t column = 0; column <= grid.alongS; ++column, ++number) {
                const RootSample root =
                    rootOn(part, points, s, double(column) / double(grid.alongS),
                           double(row) / double(grid.alongV), number);
                if (corners.kind != CornerSites::Kind::unknown) {
                    SeedRays rays;
                    rays.around.exposure = corners.at(root.barycentric);
                    list.push_back(of_.sites_.at(root, rays, painted));
                } else {
                    list.push_back(of_.sites_.at(root, of_.sites_.raysAt(root), painted));
                }
            }
    }

    // Asks for each candidate, of this density relative to the bake's; false if none grows.
    bool setBits(const SeedPart& part, const TrianglePoints& points, double highest,
                 Sampled& sampled) const
    {
        shared::SeedPiece& piece = sampled.piece;
        const TriangleSequence sequence(of_.settings_.seed, piece.source, part.back != 0);
        const std::uint32_t usual = piece.count;
        const std::uint32_t all = highest > 1.0
                                      ? entriesOf(of_.ground_, of_.settings_.seed,
                                                  highest * of_.meadow_.density, part, piece)
                                      : usual;
        const double rounding = roundingShare(of_.settings_.seed, piece.source, part.back != 0);
        const double perCandidate = 1.0 / (of_.meadow_.density * of_.ground_.area(part.triangle));
        std::vector<std::uint32_t> bits((std::size_t(all) + 31) / 32);
        std::uint32_t count = usual;
        bool growsAny = false;
        for (std::uint32_t j = 0; j < all; ++j) {
            const std::uint32_t candidate = shared::sowCandidate(piece, j);
            const glm::vec2 place = sequence.at(candidate);
            const RootSample root =
                points.at(place.x, place.y, candidate | (part.back != 0 ? backSide : 0U));
            if (j < usual ? !of_.sites_.grows(root)
                          : !of_.sites_.growsMore(root, (double(candidate) + 1.0 - rounding) *
                                                            perCandidate))
                continue;
            bits[j / 32] |= 1U << j % 32;
            count = std::max(count, j + 1);
            growsAny = true;
        }
        if (!growsAny)
            return false;
        piece.count = count;
        bits.resize((std::size_t(count) + 31) / 32);
        sampled.bits = std::move(bits);
        return true;
    }

    const SeedCells& of_;
    const Former* former_;
    std::size_t nextFormer_ = 0; ///< piece
    field::SeedCell result_;
    std::unordered_map<std::uint64_t, std::uint32_t> vertexOf_; ///< by ground vertex and up-vector
    std::unordered_map<std::uint32_t, std::uint32_t> pieceOf_;  ///< first one, by triangle
    std::unordered_map<std::string, std::uint32_t> conditionsOf_;
    std::map<std::array<std::uint32_t, shared::seedCreaseWords>, std::uint32_t> creaseOf_;
    std::uint64_t clumpKey_;
};

SeedCells::SeedCells(const terrain::GroundMesh& ground, const BakeSettings& settings,
                     const field::SeedMeadow& meadow, const SeedUnits& units,
                     const SeedSites& sites, std::size_t centreCount)
    : ground_(ground)
    , settings_(settings)
    , meadow_(meadow)
    , units_(units)
    , sites_(sites)
    , triangleOf_(ground.positions.size(), terrain::SurfaceQuery::none)
    , exposures_(2 * ground.positions.size())
    , moistures_(centreCount)
{
    for (std::size_t t = ground.triangles.size(); t-- > 0;)
        for (glm::length_t k = 0; ground.bears[t] != 0 && k < 3; ++k)
            triangleOf_[ground.triangles[t][k]] = static_cast<std::uint32_t>(t);
    for (std::atomic<float>& exposure : exposures_)
        exposure.store(unknownExposure, std::memory_order_relaxed);
    for (std::atomic<std::int32_t>& moisture : moistures_)
        moisture.store(unknownMoisture, std::memory_order_relaxed);
}

std::int32_t SeedCells::moistureOf(const SeedCentre& centre, glm::dvec3 place) const
{
    std::atomic<std::int32_t>& known = moistures_[centre.id];
    std::int32_t moisture = known.load(std::memory_order_relaxed);
    if (moisture == unknownMoisture) {
        moisture = sites_.moistureOf(centre.triangle, place);
        known.store(moisture, std::memory_order_relaxed);
    }
    return moisture;
}

// Threads that ask at the same time find the same.
float SeedCells::exposureAtVertex(std::uint32_t vertex, bool isBack) const
{
    std::atomic<float>& known = exposures_[2 * std::size_t(vertex) + (isBack ? 1 : 0)];
    if (const float exposure = known.load(std::memory_order_relaxed); exposure != unknownExposure)
        return exposure;
    const std::uint32_t triangle = triangleOf_[vertex];
    const glm::uvec3 corners = ground_.triangles[triangle];
    std::uint32_t k = 0;
    while (k < 2 && corners[glm::length_t(k)] != vertex)
        ++k;
    const SeedRays rays = sites_.raysAt(
        TrianglePoints(ground_, triangle)
            .at(k == 1 ? 1.0f : 0.0f, k == 2 ? 1.0f : 0.0f, k | (isBack ? backSide : 0U)));
    const bool isOpen = !rays.isBlocked && rays.room >= 1.0 && !(rays.around.foot > 0.0f);
    const float exposure = isOpen ? rays.around.exposure : narrowPlace;
    known.store(exposure, std::memory_order_relaxed);
    return exposure;
}

field::SeedCell SeedCells::make(std::span<const SeedPlaces::Part> parts,
                                std::span<const SeedPlaces::Centre> centres,
                                const Former* former) const
{
    Builder builder(*this, parts.front().cell, former);
    if (former == nullptr) {
        for (const SeedPlaces::Part& part : parts)
            builder.add(part.part, builder.sample(part.part));
    } else {
        // One cell is all that there is to do: its few touched parts are dealt to threads.
        std::vector<Builder::Sampled> sampled(parts.size());
        tbb::parallel_for(std::size_t(0), parts.size(),
                          [&](std::size_t i) { sampled[i] = builder.sample(parts[i].part); });
        for (std::size_t i = 0; i < parts.size(); ++i)
            builder.add(parts[i].part, std::move(sampled[i]));
    }
    if (builder.growsAnything())
        for (const SeedPlaces::Centre& centre : centres)
            builder.add(centre.centre);
    return builder.finish();
}

} // namespace sward::bake
