#pragma once

#include "field/defaults.h"
#include "render/frame/camera.h"
#include "render/frame/colliders.h"
#include "render/frame/wind.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace sward::field {
struct FieldView;
} // namespace sward::field

namespace sward::render {

/// Tests that drop blades: bits of FrameSettings::cullMask.
enum CullingTest : std::uint32_t {
    cullPatch = 1,       ///< whole patches
    cullOrientation = 2, ///< blades seen from their edge
    cullFrustum = 4,     ///< beside the picture
    cullDistance = 8,    ///< beyond the draw distance
    cullOcclusion = 16,  ///< behind depth
    cullByAll = 31       ///< all of them
};

/// `reason` draws every blade in the colour of its cull result; the renderer must record cull
/// results.
enum class DebugMode : std::uint32_t { none = 0, lod = 1, patches = 2, wind = 3, reason = 4 };

/// Segments per blade up to a distance.
struct LevelStep {
    float distance = 0.0f; ///< [m]
    int segments = 1;      ///< 1 to 64
};

/// The paper's distance test (section 6.2). Blades are assigned to `count` buckets; the number of
/// dropped buckets grows with distance, up to all. The other blades keep their width.
struct Buckets {
    std::uint32_t count = 0; ///< 0: none is dropped
    float distance = 0.0f;   ///< [m] at which all buckets are dropped
};

/// Update rate of blades by distance from the eye; unset values are chosen from their size.
struct UpdateRate {
    std::optional<float> everyFrame; ///< [m] moved every frame up to here
    std::optional<float> everyThird; ///< [m] every third frame up to here; beyond, rarely
};

/// All settings that may change from frame to frame. Starts from a field's defaults.
struct FrameSettings {
    field::Defaults environment; ///< gravity, recovery, draw distance; its wind is ignored
    float forward = 0.25f;       ///< [0, 1] share of gravity that bends a blade forward
    WindFrame windFrame; ///< of the field: the world itself, unless a host places it elsewhere
    std::vector<WindSource> winds = sourcesOf(environment.wind); ///< at most maxWindSources
    std::vector<Collider> colliders;                             ///< at most maxColliders

    std::uint32_t cullMask = cullByAll; ///< enabled tests: cullPatch …
    /// Thinned-out blades are neither moved nor culled, wherever in their patch they stand. One
    /// that is drawn again fades in, settled in its wind.
    bool leavesThinned = true;
    bool levelOfDetail = true; ///< drop, and widen, blades narrower than lodThreshold
    float lodThreshold = 0.3f; ///< [pixels], (0, 100]
    float minPixels = 0.8f;    ///< [sample distances] minimum drawn width while
                               ///< levelOfDetail is on; 0: no minimum
    /// Leaf-area limit [times a ray's cross-section] of blades drawn along a ray while
    /// levelOfDetail is on. For blades wider than a pixel it is multiplied by the fourth power of
    /// their width in pixels. Blades behind the limit are hidden. [0, 1e6]; 0: no limit.
    float maxLeafArea = 10.0f;
    /// Cosine above which blades are culled as edge-on; 1: never. Unset: never if minPixels limits
    /// their width, since then no blade is too thin; else the paper's.
    std::optional<float> maxEdgeOn;
    int tessellationLevel = 0; ///< segments per blade, 1 to 64; 0: by screen size, at most 16
    std::vector<LevelStep> levelSteps; ///< at most 4, ascending; empty: by screen size
    Buckets buckets;                   ///< the paper's thinning
    UpdateRate updateRate;             ///< how often blades move
    DebugMode debug = DebugMode::none; ///< colours

    /// Culling uses this camera instead of the picture's. Occlusion by the ground stays as of the
    /// last frame in which both cameras were the same.
    std::optional<Camera> cullingCamera;

    /// Towards the sun, world space; record() normalises it. By default 37° high. The preset
    /// `fit` looks from its side.
    glm::vec3 sunDirection{0.72f, 0.62f, -0.42f};
    glm::vec3 sunColor{3.4f, 2.85f, 2.1f};      ///< linear radiance
    glm::vec3 skyColor{0.42f, 0.60f, 0.92f};    ///< linear radiance from above
    glm::vec3 groundColor{0.20f, 0.23f, 0.11f}; ///< linear radiance from below: grass in the sun
    /// Of the film, linear. Unset: the renderer of a field chooses it by the field's colours
    /// (exposure.h); 1 in a host's view.
    std::optional<float> exposure;
    float adaptation = 1.0f;  ///< above 0: factor of an exposure that is not set
    float fogDensity = -1.0f; ///< [1/m]; below 0: chosen from the field's size
    float fogHeight = 0.0f;   ///< [m] above the lowest ground where 1/e of it is left; 0: nowhere
    float clouds = 0.35f;     ///< [0, 1] cover of the sky
    float thatch = 1.0f; ///< [0, 1] share of the undergrowth that covers the ground between blades
    /// Up to `bladeShadowDistance` [m] from the eye, (0, 1000], blades cast shadows of their own
    /// shape on blades, and on the ground of a FieldRenderer that compute shaders draw. Beyond it,
    /// and everywhere if this is false, they dim the sunlight by a formula. sward-view sets it. The
    /// device needs 64-bit atomics on buffers.
    bool bladeShadows = false;
    float bladeShadowDistance = 8.0f; ///< [m]
    std::optional<glm::vec3> skyUp; ///< up direction of the sky; unset: against gravity

    /// Settings initialised from the defaults saved in the field.
    /// The sun stands as high above the field's ground as above a level one.
    static FrameSettings of(const field::FieldView& field);
};

} // namespace sward::render
