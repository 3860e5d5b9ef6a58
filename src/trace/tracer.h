#pragma once

#include "core/progress.h"
#include "trace/camera.h"
#include "trace/light.h"
#include "trace/ray_scene.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace sward::trace {

/// What a picture is traced with.
struct TraceSettings {
    glm::uvec2 size{1280, 720}; ///< [pixels]
    std::uint32_t bounces = 8;  ///< times that light is scattered on before the last surface; 0:
                                ///< direct light only
    std::uint64_t seed = 0;     ///< of all random numbers
    bool sunDisk = true;        ///< the camera sees the sun itself
};

/// A picture's layers, row after row from the top. All light is linear radiance.
struct Layers {
    std::vector<glm::vec3> color;     ///< all light
    std::vector<glm::vec3> sun;       ///< the part that comes from the sun …
    std::vector<glm::vec3> sky;       ///< … and from the sky; both together are `color`
    std::vector<glm::vec3> direct;    ///< the part that one surface has scattered, and the sky
    std::vector<glm::vec3> indirect;  ///< the part that several have: color − direct
    std::vector<glm::vec3> albedo;    ///< diffuse reflection of what is seen; 0 of the sky
    std::vector<glm::vec3> normal;    ///< mean of unit normals towards the eye; 0 of the sky
    std::vector<float> sunVisibility; ///< [0, 1] share of the sun's disk that what is seen sees
    std::vector<float> depth;         ///< [m] along the view, in the middle of the pixel; infinite
    std::vector<std::uint32_t> surface; ///< what is there: noSurface …, firstBlade + index
};

/// Traces paths from a camera through the blades: at each surface it adds the sun by a ray to a
/// random place of its disk, and follows one random direction of the BSDF, until that meets the
/// sky or light has been scattered `bounces` times on. After three surfaces a path goes on with the
/// probability of its weight (Russian roulette). The estimate has no bias but for the limit on
/// bounces.
///
/// Random numbers are functions of seed, pixel, sample and dimension: the result is the same, to
/// the bit, for any number of threads and however the samples are divided among calls of add().
class Tracer {
public:
    /// `scene` must outlive this. Rays start relative to `origin`, the field's. Throws Error{usage}
    /// as Lens does.
    Tracer(const RayScene& scene, const Camera& camera, glm::dvec3 origin, const Light& light,
           const TraceSettings& settings);

    /// Adds `samples` to each pixel. Advances `progress`, whose stage the caller has begun, by a
    /// step for each sample of a row. Throws Error{interrupted} if it is cancelled; then the
    /// picture is of no use.
    void add(std::uint32_t samples, Progress& progress);

    /// Samples of each pixel so far.
    std::uint32_t samples() const { return samples_; }

    /// Surfaces that paths have met so far, and rays cast.
    struct Counts {
        std::uint64_t paths = 0; ///< from the camera
        std::uint64_t rays = 0;  ///< all, those to the sun too
    };
    Counts counts() const { return counts_; } ///< so far

    /// The mean of the samples. At least one must have been added.
    Layers layers() const;

private:
    struct Path;
    struct Sums {
        glm::vec3 sun{0.0f};
        glm::vec3 sky{0.0f};
        glm::vec3 direct{0.0f};
        glm::vec3 albedo{0.0f};
        glm::vec3 normal{0.0f};
        float sunSeen = 0.0f;
        float hits = 0.0f;
    };

    std::uint64_t trace(Path& path, Sums& sums) const;
    Leaf leafOf(const RayHit& hit) const;
    void lookAtMiddles();

    const RayScene& scene_;
    Lens lens_;
    Sky sky_;
    TraceSettings settings_;
    LeafModel model_;
    std::vector<Sums> sums_;
    std::vector<float> depth_;
    std::vector<std::uint32_t> surface_;
    std::uint32_t samples_ = 0;
    Counts counts_;
};

} // namespace sward::trace
