#pragma once

#include "field/field.h"
#include "render/camera.h"
#include "render/colliders.h"
#include "render/frame_stats.h"
#include "render/wind.h"
#include "shaders/shared/culling.h"
#include "shaders/shared/physics.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace sward::render {

/// `reason` draws every blade in the colour of its cull result; the renderer has been told to record
/// them.
enum class DebugMode : std::uint32_t { none = 0, lod = 1, patches = 2, wind = 3, reason = 4 };

/// Segments of blades up to a distance.
struct LevelStep {
    float distance = 0.0f; ///< [m]
    int segments = 1;      ///< 1 to 64
};

/// The paper's distance test (section 6.2): blades are dealt into so many buckets, of which those
/// left out grow with distance until none is drawn. What is left keeps its width.
struct Buckets {
    std::uint32_t count = 0; ///< 0: none is left out
    float distance = 0.0f;   ///< [m] where the last one ends
};

/// How far from the eye blades move how often; what is not given is chosen by their size.
struct UpdateRate {
    std::optional<float> everyFrame; ///< [m] up to here in every frame
    std::optional<float> everyThird; ///< [m] up to here in every third; beyond hardly ever
};

/// Everything of a frame that somebody may turn while it runs. Starts from a field's defaults.
struct FrameSettings {
    field::Defaults environment; ///< gravity, recovery, draw distance; its wind is not asked again
    float forward = shared::forwardShare; ///< [0, 1] share of gravity that leans a blade forward
    std::vector<WindSource> winds = sourcesOf(environment.wind); ///< at most shared::maxWindSources
    std::vector<Collider> colliders;                             ///< at most shared::maxColliders

    /// Tests that leave blades out: shared::cullPatch …
    std::uint32_t cullMask = shared::cullPatch | shared::cullOrientation | shared::cullFrustum |
                             shared::cullDistance | shared::cullOcclusion;
    /// Blades that are thinned out wherever in their patch they stand are neither moved nor
    /// cullView. One that is drawn again fades in as if it had stood in its wind all the time.
    bool leavesThinned = true;
    bool levelOfDetail = true; ///< leave out and widen blades narrower than lodThreshold
    float lodThreshold = 0.3f; ///< [pixels], (0, 100]
    float minPixels = 0.8f;    ///< [samples' distances] blades are drawn no narrower while
                               ///< levelOfDetail is on; 0: as narrow as they are
    /// [times a ray's cross section] So much leaf area is drawn in the way of a ray while
    /// levelOfDetail is on, of blades wider than a pixel as many times more as the fourth
    /// power of their pixels; what is behind is hidden. [0, 1e6]; 0: as much as there is.
    float maxLeafArea = 10.0f;
    /// Cosine beyond which blades are cut as edge-on, 1: never. Not given: never while they are
    /// drawn no narrower than minPixels, which leaves nothing to cut; else the paper's.
    std::optional<float> maxEdgeOn;
    int tessellationLevel =
        0; ///< segments along a blade, 1 to 64; 0: by size on the screen, at most 16
    std::vector<LevelStep> levelSteps; ///< at most 4, rising; empty: by size on the screen
    Buckets buckets;                   ///< the paper's thinning
    UpdateRate updateRate;             ///< how often blades move
    DebugMode debug = DebugMode::none; ///< colours

    /// What is left out is culled from here instead of from the picture's camera, and what the
    /// ground hides as it was when this camera still was the picture's.
    std::optional<Camera> cullingCamera;

    /// Towards the sun, world space; normalised by record(). It stands beside what the preset
    /// cameras look at, so that form shows and light comes through the blades.
    glm::vec3 sunDirection{0.72f, 0.62f, -0.42f};
    glm::vec3 sunColor{3.4f, 2.85f, 2.1f};      ///< linear radiance
    glm::vec3 skyColor{0.42f, 0.60f, 0.92f};    ///< linear radiance from above
    glm::vec3 groundColor{0.20f, 0.23f, 0.11f}; ///< linear radiance from below: grass in the sun
    float exposure = 1.0f;                      ///< of the film, linear
    float fogDensity = -1.0f;                   ///< [1/m]; below 0: chosen from the field's size
    float fogHeight = 0.0f; ///< [m] above the lowest ground where 1/e of it is left; 0: nowhere
    float clouds = 0.35f;   ///< [0, 1] share of the sky
    std::optional<glm::vec3> skyUp; ///< where the sky is; unset: where things do not fall to

    /// Settings that start from what is saved in the field.
    static FrameSettings of(const field::FieldView& field)
    {
        FrameSettings s;
        s.environment = *field.defaults;
        s.winds = sourcesOf(s.environment.wind);
        return s;
    }
};

} // namespace sward::render
