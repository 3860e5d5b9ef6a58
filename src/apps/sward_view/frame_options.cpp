#include "apps/sward_view/frame_options.h"

#include "apps/common/parse_text.h"
#include "apps/sward_view/collider_text.h"
#include "apps/sward_view/cull_list.h"
#include "core/error.h"
#include "render/settings_file.h"
#include "shaders/shared/distance_band.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <string_view>

namespace sward::view {
namespace {

// What --gpu-memory takes [bytes].
constexpr std::uint64_t leastMemory = std::uint64_t(1) << 20;
constexpr std::uint64_t mostMemory = std::uint64_t(1) << 44;

render::Geometry parseGeometry(const std::string& word)
{
    using render::Geometry;
    for (const Geometry geometry : {Geometry::automatic, Geometry::tessellation, Geometry::raster})
        if (word == render::nameOf(geometry))
            return geometry;
    fail(ErrorKind::usage, "--geometry: '{}' is not one of auto, tessellation, raster", word);
}

/// Of an option that says no, yes, or leaves it to what suits best.
std::optional<bool> parseChoice(const char* option, const std::string& word, const char* no,
                                const char* yes)
{
    if (word == "auto")
        return std::nullopt;
    if (word != no && word != yes)
        fail(ErrorKind::usage, "{}: '{}' is not one of auto, {}, {}", option, word, no, yes);
    return word == yes;
}

render::DebugMode parseDebug(const std::string& word)
{
    if (word == "none")
        return render::DebugMode::none;
    if (word == "lod")
        return render::DebugMode::lod;
    if (word == "patches")
        return render::DebugMode::patches;
    if (word == "wind")
        return render::DebugMode::wind;
    if (word == "reason")
        return render::DebugMode::reason;
    // Three modes of the shaders' own, which no window shows: bands of distance.
    constexpr std::array<std::string_view, 3> bands{"near", "middle", "far"};
    const auto* const found = std::find(bands.begin(), bands.end(), word);
    if (found != bands.end())
        return static_cast<render::DebugMode>(shared::debugNear + (found - bands.begin()));
    fail(ErrorKind::usage,
         "--debug: '{}' is not one of none, wind, lod, patches, reason, near, middle, far", word);
}

} // namespace

void FrameOptions::addShared(CLI::App& app)
{
    const auto option = [&app](const char* name, auto read, const char* type, const char* about) {
        return app.add_option_function<std::string>(name, read, about)->type_name(type);
    };
    option(
        "--size",
        [this](const std::string& text) { size = apps::parseSize("--size", text, largestSize); },
        "WxH", "Size of the picture in pixels [1280x720]");
    app.add_option("--camera", camera,
                   "fit, eye, top, edge, or a file with a camera or a path [fit]")
        ->type_name("NAME|FILE");
    option(
        "--samples",
        [this](const std::string& text) {
            if (text != "1" && text != "4")
                fail(ErrorKind::usage, "--samples: '{}' is not 1 or 4", text);
            samples = text == "1" ? 1u : 4u;
        },
        "1|4", "Samples per pixel [4; in a window on a CPU device 1]");
    option(
        "--draw-distance",
        [this](const std::string& text) {
            drawDistance =
                static_cast<float>(apps::parseNumber("--draw-distance", text, 1e-3, 1e9));
        },
        "M", "Blades farther away are not drawn [the field's]");
    option(
        "--wind-strength",
        [this](const std::string& text) {
            windStrength = static_cast<float>(apps::parseNumber("--wind-strength", text, 0, 1000));
        },
        "X", "Blade heights per second, of all winds together; 0 is calm [the field's]");
    app.add_option("--settings", settingsFile, "Wind, gravity, colliders: docs/settings.md")
        ->type_name("JSON");
    app.add_option_function<std::vector<std::string>>(
           "--collider",
           [this](const std::vector<std::string>& texts) {
               for (const std::string& text : texts)
                   colliders.push_back(parseCollider(text));
           },
           "sphere:x,y,z,r or capsule:x,y,z,x,y,z,r that presses blades down; may be repeated")
        ->type_name("TEXT");
    app.add_option("--device", device, "Vulkan device, see 'sward-view devices' [best]")
        ->type_name("N|NAME")
        ->envname("SWARD_DEVICE");
    option(
        "--gpu-memory",
        [this](const std::string& text) {
            gpuMemory = apps::parseBytes("--gpu-memory", text, leastMemory, mostMemory);
        },
        "SIZE",
        "Device memory that may be taken, as 512M or 2G; a field that needs more is streamed "
        "[all]");
    app.add_flag("--validation", validation,
                 "Run under the validation layer; any message is a failure");
    log.add(app);
}

void FrameOptions::addMeasured(CLI::App& app)
{
    const auto option = [&app](const char* name, auto read, const char* type, const char* about) {
        return app.add_option_function<std::string>(name, read, about)
            ->type_name(type)
            ->group("Drawing");
    };
    option(
        "--fixed-dt",
        [this](const std::string& text) {
            fixedStep = apps::parseNumber("--fixed-dt", text, 0, 1e6);
        },
        "S", "Seconds from frame to frame, a fraction if you like [1/60]");
    option(
        "--geometry", [this](const std::string& text) { geometry = parseGeometry(text); }, "WORD",
        "auto, tessellation, raster [auto]");
    option(
        "--raster-for",
        [this](const std::string& text) {
            rastersForCpu = parseChoice("--raster-for", text, "gpu", "cpu");
        },
        "WORD", "How the rasteriser goes about it: auto, as the device is; gpu, cpu [auto]");
    app.add_option("--tess-level", tessellationLevel,
                   "Segments along every blade, 1 to 64; 0: by size on the screen [0]")
        ->type_name("N")
        ->check(CLI::Range(0, 64))
        ->group("Drawing");
    option(
        "--cull", [this](const std::string& text) { cullMask = parseCullList(text); }, "LIST",
        "all, none, or some of patch,orientation,frustum,distance,occlusion [all]");
    option(
        "--lod",
        [this](const std::string& text) {
            if (text != "on" && text != "off")
                fail(ErrorKind::usage, "--lod: '{}' is not on or off", text);
            levelOfDetail = text == "on";
        },
        "on|off", "Leave out and widen blades too thin for a pixel [on]");
    option(
        "--debug", [this](const std::string& text) { debug = parseDebug(text); }, "WORD",
        "Colour by none, wind, lod, patches, reason; near, middle, far: what grass covers [none]");
}

render::FrameSettings FrameOptions::settingsFor(const field::FieldView& view) const
{
    render::FrameSettings settings = render::FrameSettings::of(view);
    if (sceneSettings)
        render::readSettings(sceneSettings->text, sceneSettings->place, settings);
    if (!settingsFile.empty())
        render::readSettings(settingsFile, settings);
    settings.colliders.insert(settings.colliders.end(), colliders.begin(), colliders.end());
    if (settings.colliders.size() > shared::maxColliders)
        fail(ErrorKind::usage, "--collider: {} colliders, more than {}", settings.colliders.size(),
             shared::maxColliders);
    settings.cullMask = cullMask.value_or(settings.cullMask);
    settings.levelOfDetail = levelOfDetail.value_or(settings.levelOfDetail);
    if (tessellationLevel) {
        settings.tessellationLevel = *tessellationLevel;
        settings.levelSteps.clear();
    }
    settings.debug = debug;
    if (drawDistance)
        settings.nature.drawDistance = *drawDistance;
    if (windStrength)
        render::scaleWind(settings.winds, *windStrength);
    return settings;
}

} // namespace sward::view
