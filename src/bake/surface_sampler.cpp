#include "bake/surface_sampler.h"

#include "core/error.h"
#include "core/exact_math.h"
#include "core/random.h"

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sward::bake {
namespace {

constexpr double degreesPerRadian = 57.29577951308232;

// Candidates are tried in blocks of so many, each by one thread. The result does not depend on it.
constexpr std::uint64_t candidatesPerBlock = 16384;

// Bins of priority in which rejections are counted.
constexpr std::size_t priorityBins = 512;

// Candidates that are tried to learn which share is kept, and at most for a count. Ground that
// keeps fewer than one in a million of its candidates is not worth more.
constexpr double fewTrials = 1e5;
constexpr double manyTrials = 4e6;
constexpr double mostTrials = 1e8;

// A candidate's number has 31 bits on each side.
constexpr double mostCandidates = 2147483647.0;

double random(std::uint64_t seed, field::BladeKey key, Dimension dimension)
{
    return uniform(seed, keyBits(key), static_cast<std::uint32_t>(dimension));
}

glm::dvec3 corner(const terrain::GroundMesh& ground, std::size_t triangle, std::size_t i)
{
    return glm::dvec3(ground.positions[ground.triangles[triangle][i]]);
}

} // namespace

double priorityOf(std::uint64_t seed, field::BladeKey key)
{
    return random(seed, key, Dimension::priority);
}

glm::dvec3 surfaceNormal(const terrain::GroundMesh& ground, std::size_t triangle, double b,
                         double c)
{
    const glm::dvec3 face = ground.faceNormal(triangle);
    const glm::uvec3 corners = ground.triangles[triangle];
    const glm::dvec3 sum = (1.0 - b - c) * glm::dvec3(ground.normals[corners.x]) +
                           b * glm::dvec3(ground.normals[corners.y]) +
                           c * glm::dvec3(ground.normals[corners.z]);
    const double squared = glm::dot(sum, sum);
    if (squared < 1e-12 || glm::dot(sum, face) <= 0.0)
        return face;
    return sum / std::sqrt(squared);
}

// What one block of triangles yields.
struct SurfaceSampler::Block {
    std::vector<RootSample> roots;
    std::uint64_t proposed = 0;
    std::array<std::uint64_t, rejectCount> rejected{};
    // For a count: rejections by reason and bin of priority.
    std::vector<std::array<std::uint32_t, rejectCount>> rejectedByPriority;

    void reject(Reject reason, double priority)
    {
        ++rejected[static_cast<std::size_t>(reason)];
        if (!rejectedByPriority.empty())
            ++rejectedByPriority[static_cast<std::size_t>(priority * double(priorityBins))]
                                [static_cast<std::size_t>(reason)];
    }
};

SurfaceSampler::SurfaceSampler(const terrain::GroundMesh& ground, const BakeSettings& settings,
                               const terrain::SurfaceQuery* query)
    : ground_(ground)
    , settings_(settings)
    , query_(query)
{
    for (std::size_t t = 0; t < ground.triangles.size(); ++t)
        if (ground.bears[t] != 0)
            area_ += ground.area(t);
    if (settings.sides == Sides::both)
        area_ *= 2.0;
}

std::uint32_t SurfaceSampler::candidates(std::size_t triangle, double density, bool back) const
{
    // One random number per triangle and side rounds its share.
    const field::BladeKey key{static_cast<std::uint32_t>(triangle), back ? backSide : 0U};
    const double share = density * ground_.area(triangle);
    const double count = std::floor(share + random(settings_.seed, key, Dimension::count));
    if (count > mostCandidates)
        fail(ErrorKind::input, "triangle {} of {} m² would bear {} blades, more than {}", triangle,
             ground_.area(triangle), count, mostCandidates);
    return static_cast<std::uint32_t>(count);
}

void SurfaceSampler::propose(std::size_t triangle, std::uint32_t candidate, Block& block) const
{
    RootSample root;
    root.key = {static_cast<std::uint32_t>(triangle), candidate};

    // Uniform on a triangle: Osada et al., "Shape Distributions", 2002.
    const double s = std::sqrt(random(settings_.seed, root.key, Dimension::u));
    const double v = random(settings_.seed, root.key, Dimension::v);
    const double b = s * (1.0 - v);
    const double c = s * v;
    const glm::dvec3 p0 = corner(ground_, triangle, 0);
    const glm::dvec3 position =
        p0 + b * (corner(ground_, triangle, 1) - p0) + c * (corner(ground_, triangle, 2) - p0);
    const glm::dvec3 normal = surfaceNormal(ground_, triangle, b, c);

    root.barycentric = glm::vec2(static_cast<float>(b), static_cast<float>(c));
    root.position = glm::vec3(position);
    root.normal = glm::vec3((candidate & backSide) != 0 ? -normal : normal);
    ++block.proposed;
    if (passes(root, block))
        block.roots.push_back(root);
}

bool SurfaceSampler::passes(const RootSample& root, Block& block) const
{
    const std::uint64_t seed = settings_.seed;
    const double priority = priorityOf(seed, root.key);
    const auto reject = [&](Reject reason) {
        block.reject(reason, priority);
        return false;
    };

    // Masks multiply; the candidate survives with the product as its probability.
    if (!settings_.masks.empty()) {
        const glm::uvec3 corners = ground_.triangles[root.key.triangle];
        const float b = root.barycentric.x;
        const float c = root.barycentric.y;
        const glm::vec4 color = (1.0f - b - c) * ground_.colors[corners.x] +
                                b * ground_.colors[corners.y] + c * ground_.colors[corners.z];
        double weight = 1.0;
        for (const VertexColorMask& mask : settings_.masks) {
            const double value = double(color[static_cast<std::size_t>(mask.channel)]);
            weight *= mask.invert ? 1.0 - value : value;
        }
        if (random(seed, root.key, Dimension::mask) >= weight)
            return reject(Reject::mask);
    }

    const glm::dvec3 place = ground_.origin + glm::dvec3(root.position);
    const glm::dvec3 groundUp = settings_.groundUp.at(place);
    const double slope = exactAcos(glm::dot(glm::dvec3(root.normal), groundUp)) * degreesPerRadian;
    if (random(seed, root.key, Dimension::slope) >= settings_.slope.weight(slope))
        return reject(Reject::slope);

    const double altitude = settings_.groundUp.radial
                                ? std::sqrt(glm::dot(place - settings_.groundUp.centre,
                                                     place - settings_.groundUp.centre))
                                : glm::dot(place, groundUp);
    if (random(seed, root.key, Dimension::altitude) >= settings_.altitude.weight(altitude))
        return reject(Reject::altitude);

    if (settings_.clearance > 0.0) {
        const double clear = query_->clearance(glm::dvec3(root.position), glm::dvec3(root.normal),
                                               settings_.clearance, root.key.triangle);
        if (clear < settings_.clearance)
            return reject(Reject::clearance);
    }
    return true;
}

std::vector<std::uint64_t> SurfaceSampler::firstCandidates(double density) const
{
    // One entry per triangle and side that bears, then the total.
    const std::size_t triangles = ground_.triangles.size();
    const bool front = settings_.sides != Sides::back;
    const bool back = settings_.sides != Sides::front;
    std::vector<std::uint64_t> first(triangles * (front && back ? 2 : 1) + 1);
    tbb::parallel_for(std::size_t(0), triangles, [&](std::size_t t) {
        if (ground_.bears[t] == 0)
            return;
        if (front)
            first[t + 1] = candidates(t, density, false);
        if (back)
            first[(front ? triangles : 0) + t + 1] = candidates(t, density, true);
    });
    std::partial_sum(first.begin(), first.end(), first.begin());
    return first;
}

std::vector<SurfaceSampler::Block> SurfaceSampler::run(double density, Progress& progress) const
{
    const std::vector<std::uint64_t> first = firstCandidates(density);
    const std::uint64_t total = first.back();
    const std::size_t triangles = ground_.triangles.size();
    const bool backOnly = settings_.sides == Sides::back;

    std::vector<Block> blocks((total + candidatesPerBlock - 1) / candidatesPerBlock);
    progress.begin("sample", total);
    tbb::parallel_for(std::size_t(0), blocks.size(), [&](std::size_t index) {
        Block& block = blocks[index];
        if (settings_.count)
            block.rejectedByPriority.resize(priorityBins);
        const std::uint64_t begin = index * candidatesPerBlock;
        const std::uint64_t end = std::min(begin + candidatesPerBlock, total);
        // The triangle (and side) that the block's first candidate belongs to.
        auto slot = static_cast<std::size_t>(std::upper_bound(first.begin(), first.end(), begin) -
                                             first.begin() - 1);
        for (std::uint64_t i = begin; i < end; ++i) {
            while (first[slot + 1] <= i)
                ++slot;
            const bool back = backOnly || slot >= triangles;
            propose(slot % triangles,
                    static_cast<std::uint32_t>(i - first[slot]) | (back ? backSide : 0U), block);
        }
        progress.advance(end - begin);
    });
    return blocks;
}

Sampling SurfaceSampler::sample(double density, Progress& progress) const
{
    const std::vector<Block> blocks = run(density, progress);
    Sampling result;
    std::size_t total = 0;
    for (const Block& block : blocks)
        total += block.roots.size();
    result.roots.reserve(total);
    for (const Block& block : blocks) {
        result.roots.insert(result.roots.end(), block.roots.begin(), block.roots.end());
        result.proposed += block.proposed;
        for (std::size_t i = 0; i < rejectCount; ++i)
            result.rejected[i] += block.rejected[i];
    }
    return result;
}

Sampling SurfaceSampler::sampleCount(std::uint64_t count, Progress& progress) const
{
    Sampling result;
    if (count == 0 || area_ <= 0.0)
        return result;

    // Learn from a small sample which share of candidates is kept; from a larger one if it is
    // small.
    Sampling probe = sample(fewTrials / area_, progress);
    if (probe.roots.empty())
        probe = sample(manyTrials / area_, progress);
    if (probe.roots.empty())
        return probe;
    const double share = double(probe.roots.size()) / double(probe.proposed);

    // Ask for a little more than needed, and for more again should chance be against it.
    double density =
        (double(count) * 1.02 + 6.0 * std::sqrt(double(count)) + 16.0) / (area_ * share);
    const double densityLimit = std::max(mostTrials, 4.0 * double(count)) / area_;
    std::vector<Block> blocks = run(std::min(density, densityLimit), progress);
    const auto kept = [&] {
        std::size_t sum = 0;
        for (const Block& block : blocks)
            sum += block.roots.size();
        return sum;
    };
    while (kept() < count && density < densityLimit) {
        density *= 1.5;
        blocks = run(std::min(density, densityLimit), progress);
    }

    // The priority of the last root that is taken; ties are decided by the key.
    std::vector<std::pair<double, std::uint64_t>> order;
    order.reserve(kept());
    for (const Block& block : blocks)
        for (const RootSample& root : block.roots)
            order.emplace_back(priorityOf(settings_.seed, root.key), keyBits(root.key));
    std::pair<double, std::uint64_t> last{1.0, 0};
    if (order.size() > count) {
        const auto nth = order.begin() + static_cast<std::ptrdiff_t>(count) - 1;
        std::nth_element(order.begin(), nth, order.end());
        last = *nth;
    }
    const auto lastBin = static_cast<std::size_t>(std::min(last.first, 1.0) * double(priorityBins));
    for (const Block& block : blocks) {
        for (const RootSample& root : block.roots)
            if (std::pair(priorityOf(settings_.seed, root.key), keyBits(root.key)) <= last)
                result.roots.push_back(root);
        for (std::size_t bin = 0; bin < lastBin; ++bin)
            for (std::size_t i = 0; i < rejectCount; ++i)
                result.rejected[i] += block.rejectedByPriority[bin][i];
    }
    result.proposed = result.roots.size();
    for (const std::uint64_t rejected : result.rejected)
        result.proposed += rejected;
    return result;
}

} // namespace sward::bake
