#include "trace/tracer.h"

#include "core/expect.h"
#include "core/random.h"
#include "shaders/shared/octahedral.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>

namespace sward::trace {
namespace {

// Surfaces after which Russian roulette begins.
constexpr std::uint32_t surestSurfaces = 3;

// Orthonormal axes with a surface's normal as the third.
struct Frame {
    glm::vec3 x;
    glm::vec3 y;
    glm::vec3 z;

    explicit Frame(glm::vec3 normal)
        : x(shared::tangentOf(normal))
        , y(glm::cross(normal, x))
        , z(normal)
    {
    }

    glm::vec3 into(glm::vec3 v) const { return {glm::dot(v, x), glm::dot(v, y), glm::dot(v, z)}; }
    glm::vec3 outOf(glm::vec3 v) const { return v.x * x + v.y * y + v.z * z; }
};

} // namespace

// One sample of one pixel.
struct Tracer::Path {
    std::uint64_t key; // of its random numbers
    std::uint32_t dimension = 0;
    glm::vec3 from;
    glm::vec3 direction;

    float next()
    {
        // The same as uniform(), in single precision: below 1.
        return static_cast<float>(hashBits(key, dimension++) >> 40) * 0x1.0p-24f;
    }
    glm::vec2 place()
    {
        const float x = next();
        return {x, next()};
    }
};

Tracer::Tracer(const RayScene& scene, const Camera& camera, glm::dvec3 origin, const Light& light,
               const TraceSettings& settings)
    : scene_(scene)
    , lens_(camera, origin, settings.size)
    , sky_(light)
    , settings_(settings)
    , sums_(std::size_t(settings.size.x) * settings.size.y)
{
    lookAtMiddles();
}

void Tracer::lookAtMiddles()
{
    depth_.resize(sums_.size());
    surface_.resize(sums_.size());
    const std::size_t width = settings_.size.x;
    tbb::parallel_for(std::size_t(0), std::size_t(settings_.size.y), [&](std::size_t y) {
        for (std::size_t x = 0; x < width; ++x) {
            const glm::vec3 direction = lens_.direction({float(x) + 0.5f, float(y) + 0.5f});
            RayHit hit;
            const bool isHit = scene_.meets(lens_.eye(), direction, hit);
            depth_[y * width + x] = isHit ? lens_.depthOf(direction, hit.distance)
                                          : std::numeric_limits<float>::infinity();
            surface_[y * width + x] = !isHit ? noSurface
                                      : hit.part == Part::ground
                                          ? groundSurface
                                          : firstBlade + scene_.surfaces().strips[hit.strip].blade;
        }
    });
}

Leaf Tracer::leafOf(const RayHit& hit) const
{
    const Surfaces& surfaces = scene_.surfaces();
    if (hit.part == Part::blades)
        return leafAt(surfaces.strips[hit.strip], {hit.across, hit.along});
    return trace::leafOf(groundAlbedo(surfaces, hit.primitive, hit.shares), glm::vec3(0.0f), 0.0f);
}

std::uint64_t Tracer::trace(Path& path, Sums& sums) const
{
    std::uint64_t rays = 0;
    glm::vec3 weight(1.0f);
    for (std::uint32_t surface = 0;; ++surface) {
        RayHit hit;
        ++rays;
        if (!scene_.meets(path.from, path.direction, hit)) {
            // The sun has been added by rays of its own, but for an eye that looks into it.
            const glm::vec3 sky = sky_.radiance(path.direction);
            sums.sky += weight * sky;
            if (surface == 0 && settings_.sunDisk)
                sums.sun += sky_.radianceWithSun(path.direction) - sky;
            if (surface == 0 && settings_.sunDisk)
                sums.direct += sky_.radianceWithSun(path.direction);
            else if (surface <= 1)
                sums.direct += weight * sky;
            return rays;
        }
        const Frame frame(hit.normal);
        const Leaf leaf = leafOf(hit);
        const glm::vec3 out = frame.into(-path.direction);

        // The sun.
        const glm::vec3 towards = sky_.towardsSun(path.place());
        const glm::vec3 in = frame.into(towards);
        const glm::vec3 lit =
            weight * model_.value(leaf, out, in) * (std::abs(in.z) * sky_.sunIrradiance());
        const bool isLit = lit.x > 0.0f || lit.y > 0.0f || lit.z > 0.0f;
        if (isLit || surface == 0) {
            ++rays;
            const bool isSeen = !scene_.isHidden(RayScene::leaving(hit, towards), towards);
            if (isSeen) {
                sums.sun += lit;
                if (surface == 0)
                    sums.direct += lit;
            }
            if (surface == 0)
                sums.sunSeen += isSeen ? 1.0f : 0.0f;
        }
        if (surface == 0) {
            sums.albedo += leaf.reflection;
            sums.normal += hit.normal;
            sums.hits += 1.0f;
        }

        // The next direction. What it meets after the last bounce counts only if it is the sky.
        const float choice = path.next();
        const Scattered scattered = model_.sample(leaf, out, choice, path.place());
        weight *= scattered.weight;
        const float strongest = std::max({weight.x, weight.y, weight.z});
        if (!(strongest > 0.0f))
            return rays;
        path.direction = glm::normalize(frame.outOf(scattered.direction));
        path.from = RayScene::leaving(hit, path.direction);
        if (surface + 1 > settings_.bounces) {
            ++rays;
            if (!scene_.isHidden(path.from, path.direction)) {
                const glm::vec3 sky = weight * sky_.radiance(path.direction);
                sums.sky += sky;
                if (surface == 0)
                    sums.direct += sky;
            }
            return rays;
        }
        if (surface + 1 >= surestSurfaces && strongest < 1.0f) {
            if (path.next() >= strongest)
                return rays;
            weight /= strongest;
        }
    }
}

void Tracer::add(std::uint32_t samples, Progress& progress)
{
    const std::size_t width = settings_.size.x;
    std::atomic<std::uint64_t> rays = 0;
    tbb::parallel_for(std::size_t(0), std::size_t(settings_.size.y), [&](std::size_t y) {
        std::uint64_t own = 0;
        for (std::size_t x = 0; x < width; ++x) {
            const std::size_t pixel = y * width + x;
            const std::uint64_t key = hashBits(settings_.seed, pixel);
            for (std::uint32_t i = 0; i < samples; ++i) {
                Path path{.key = hashBits(key, samples_ + i), .from = lens_.eye(), .direction = {}};
                path.direction = lens_.direction(glm::vec2(float(x), float(y)) + path.place());
                own += trace(path, sums_[pixel]);
            }
        }
        rays += own;
        progress.advance(samples);
    });
    samples_ += samples;
    counts_.paths += std::uint64_t(samples) * sums_.size();
    counts_.rays += rays;
}

Layers Tracer::layers() const
{
    expect(samples_ > 0, "a picture has samples");
    const float share = 1.0f / static_cast<float>(samples_);
    Layers layers;
    for (const Sums& sums : sums_) {
        const glm::vec3 color = share * (sums.sun + sums.sky);
        layers.color.push_back(color);
        layers.sun.push_back(share * sums.sun);
        layers.sky.push_back(share * sums.sky);
        layers.direct.push_back(share * sums.direct);
        layers.indirect.push_back(glm::max(color - share * sums.direct, glm::vec3(0.0f)));
        layers.albedo.push_back(share * sums.albedo);
        layers.normal.push_back(share * sums.normal);
        layers.sunVisibility.push_back(sums.hits > 0.0f ? sums.sunSeen / sums.hits : 0.0f);
    }
    layers.depth = depth_;
    layers.surface = surface_;
    return layers;
}

} // namespace sward::trace
