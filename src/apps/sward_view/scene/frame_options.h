#pragma once

#include "apps/common/terminal/log_switches.h"
#include "apps/sward_view/scene/scene.h"
#include "core/diagnostics.h"
#include "render/frame/frame_settings.h"
#include "render/viewer/field_renderer.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace sward::view {

/// Settings of the field, with shadows of blades.
render::FrameSettings usualSettings(const field::FieldView& field);

/// Common command-line options of render, bench and the window: fields, device, camera and drawing.
/// Must not move while a CLI::App refers to it.
struct FrameOptions {
    std::vector<std::string> fields;       ///< files, drawn together
    glm::uvec2 size{1280, 720};            ///< [pixels]
    std::string camera = "fit";            ///< a preset's name or a file
    std::optional<std::uint32_t> samples;  ///< 1 or 4; unset: the command decides
    std::optional<std::uint32_t> cullMask; ///< unset: the settings'
    std::optional<bool> levelOfDetail;     ///< unset: the settings'
    std::optional<int> tessellationLevel;  ///< unset: the settings'; 0: by size on the screen
    render::Geometry geometry = render::Geometry::automatic;
    std::optional<bool> rastersForCpu; ///< unset: chosen by the device
    render::DebugMode debug = render::DebugMode::none;
    std::optional<float> drawDistance;       ///< [m]; unset: the field's
    std::optional<float> thatch;             ///< [0, 1]; unset: the settings'
    std::optional<float> windStrength;       ///< [1/s]; unset: the field's or the settings'
    std::string settingsFile;                ///< empty: none
    std::optional<SceneText> sceneCamera;    ///< a camera or a path, instead of `camera`
    std::optional<SceneText> sceneSettings;  ///< overridden by the settings file
    bool watch = false;                      ///< reload the settings file when it changes
    std::vector<render::Collider> colliders; ///< beside those of the settings
    double fixedStep = 1.0 / 60.0;           ///< [s] between frames
    std::uint64_t gpuMemory = 0;             ///< [bytes] of device memory; 0: unlimited
    /// [bytes] of device memory for the blades that a field with seeds sows; 0: none are sown
    std::uint64_t sownMemory = render::FieldRendererSettings{}.sownBytes;
    std::string device; ///< index or part of the name; empty: the best
    bool validation = false;
    apps::LogSwitches log;

    /// Adds the options of every command: size, camera, device, wind, distances, log.
    void addShared(CLI::App& app);

    /// Adds the options of render and bench only: geometry, culling, fixed step, debug.
    void addMeasured(CLI::App& app);

    /// The resulting frame settings: those saved in the field, overridden by the settings file and
    /// the options. Throws as readSettings() does, and Error{usage} for too many colliders.
    /// Warnings go to `diagnostics`, or to the log.
    render::FrameSettings settingsFor(const field::FieldView& view, Diagnostics& diagnostics) const;
    render::FrameSettings settingsFor(const field::FieldView& view) const;
};

/// Largest width and height of a picture [pixels].
constexpr std::uint32_t largestSize = 16384;

} // namespace sward::view
