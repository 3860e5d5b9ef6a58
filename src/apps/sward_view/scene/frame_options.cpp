#include "apps/sward_view/scene/frame_options.h"

#include "apps/common/parse_text.h"
#include "apps/sward_view/scene/collider_text.h"
#include "apps/sward_view/scene/cull_list.h"
#include "core/error.h"
#include "core/log.h"
#include "presentation/settings_file.h"
#include "shaders/shared/distance_band.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <string_view>

namespace sward::view {
namespace {

// Range of --gpu-memory [bytes].
constexpr std::uint64_t minMemory = std::uint64_t(1) << 20;
constexpr std::uint64_t maxMemory = std::uint64_t(1) << 44;

// Range of --sown-memory [bytes], besides 0. Below, a few units would come and go; above, blades
// could not be numbered.
constexpr std::uint64_t minSown = std::uint64_t(16) << 20;
constexpr std::uint64_t maxSown = std::uint64_t(64) << 30;

std::uint64_t parseSown(const std::string& text)
{
    return text == "0" ? 0 : apps::parseBytes("--sown-memory", text, minSown, maxSown);
}

render::Geometry parseGeometry(const std::string& word)
{
    using render::Geometry;
    for (const Geometry geometry : {Geometry::automatic, Geometry::tessellation, Geometry::raster})
        if (word == render::nameOf(geometry))
            return geometry;
    fail(ErrorKind::usage, "--geometry: '{}' is not one of auto, tessellation, raster", word);
}

/// Parses an option with the values no, yes and automatic (none).
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
    // Three shader modes that the window does not offer: bands of distance.
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
    const char* group = "Picture";
    const auto option = [&app, &group](const char* name, auto read, const char* type,
                                       const char* about) {
        return app.add_option_function<std::string>(name, read, about)
            ->type_name(type)
            ->group(group);
    };
    option(
        "--size",
        [this](const std::string& text) { size = apps::parseSize("--size", text, largestSize); },
        "WxH", "Width and height in pixels, 1x1 to 16384x16384")
        ->default_str("1280x720");
    app.add_option("--camera", camera,
                   "Camera: fit, eye, top, edge, or a JSON file with a camera or a path")
        ->type_name("NAME|FILE")
        ->group(group)
        ->capture_default_str();
    option(
        "--samples",
        [this](const std::string& text) {
            if (text != "1" && text != "4")
                fail(ErrorKind::usage, "--samples: '{}' is not 1 or 4", text);
            samples = text == "1" ? 1u : 4u;
        },
        "1|4", "Samples per pixel")
        ->default_str("4, but 1 in a window on a CPU device");
    option(
        "--draw-distance",
        [this](const std::string& text) {
            drawDistance =
                static_cast<float>(apps::parseNumber("--draw-distance", text, 1e-3, 1e9));
        },
        "M", "Distance in metres beyond which no blade is drawn, 0.001 to 1 billion")
        ->default_str("the field's");
    option(
        "--thatch",
        [this](const std::string& text) {
            thatch = static_cast<float>(apps::parseNumber("--thatch", text, 0, 1));
        },
        "SHARE", "Undergrowth that is drawn on the ground between blades, 0 to 1")
        ->default_str("1, or the settings file's");
    group = "Environment";
    option(
        "--wind-strength",
        [this](const std::string& text) {
            windStrength = static_cast<float>(apps::parseNumber("--wind-strength", text, 0, 1000));
        },
        "X", "Total strength of all winds in blade heights per second, 0 to 1000; 0: calm")
        ->default_str("the field's");
    app.add_option("--settings", settingsFile,
                   "Settings file: wind, gravity, colliders and more (keys: docs/settings.md)")
        ->type_name("FILE.json")
        ->group(group);
    app.add_option_function<std::vector<std::string>>(
           "--collider",
           [this](const std::vector<std::string>& texts) {
               for (const std::string& text : texts)
                   colliders.push_back(parseCollider(text));
           },
           "Shapes in metres that press blades down, 256 at most: sphere:x,y,z,r or "
           "capsule:x,y,z,x,y,z,r")
        ->type_name("SHAPE")
        ->group(group);
    group = "Device";
    app.add_option("--device", device,
                   "Vulkan device, by the number or a part of the name that 'sward-view devices' "
                   "lists")
        ->type_name("N|NAME")
        ->group(group)
        ->default_str("the best")
        ->envname("SWARD_DEVICE");
    option(
        "--gpu-memory",
        [this](const std::string& text) {
            gpuMemory = apps::parseBytes("--gpu-memory", text, minMemory, maxMemory);
        },
        "SIZE",
        "Limit of device memory, 1M to 16T, such as 512M or 2G; a field that needs more is "
        "streamed")
        ->default_str("all");
    option(
        "--sown-memory", [this](const std::string& text) { sownMemory = parseSown(text); }, "SIZE",
        "Device memory for the blades that a field with seeds sows near the eye, 16M to 64G, but "
        "at most half of --gpu-memory or of the device's; 0: stored blades alone")
        ->default_str("512M");
    app.add_flag("--validation", validation,
                 "Run under the Vulkan validation layer; any message is a failure")
        ->group(group);
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
        "S",
        "Time between frames in seconds, 0 to 1 million; fractions are allowed. No frame is later "
        "than 8589934592 s (272 years)")
        ->default_str("1/60");
    option(
        "--geometry", [this](const std::string& text) { geometry = parseGeometry(text); },
        "auto|tessellation|raster",
        "How blades are drawn: by the tessellator or by the compute rasteriser; auto: by the "
        "rasteriser where the device can")
        ->default_str("auto");
    option(
        "--raster-for",
        [this](const std::string& text) {
            rastersForCpu = parseChoice("--raster-for", text, "gpu", "cpu");
        },
        "auto|gpu|cpu", "Variant of the compute rasteriser; auto: that of the device")
        ->default_str("auto");
    app.add_option("--tess-level", tessellationLevel,
                   "Segments along every blade, 0 to 64; 0: by its size on the screen")
        ->type_name("N")
        ->check(CLI::Range(0, 64).description(""))
        ->default_str("0")
        ->group("Drawing");
    option(
        "--cull", [this](const std::string& text) { cullMask = parseCullList(text); }, "LIST",
        "Culling tests: all, none, or a list of patch,orientation,frustum,distance,occlusion")
        ->default_str("all");
    option(
        "--lod",
        [this](const std::string& text) {
            if (text != "on" && text != "off")
                fail(ErrorKind::usage, "--lod: '{}' is not on or off", text);
            levelOfDetail = text == "on";
        },
        "on|off", "Level of detail: of blades thinner than a pixel fewer are drawn, each wider")
        ->default_str("on");
    option(
        "--debug", [this](const std::string& text) { debug = parseDebug(text); }, "WORD",
        "Colour blades by wind, lod, patches or reason (of culling); near, middle, far: by bands "
        "of "
        "distance")
        ->default_str("none");
}

render::FrameSettings usualSettings(const field::FieldView& view)
{
    render::FrameSettings settings = render::FrameSettings::of(view);
    settings.bladeShadows = true;
    return settings;
}

render::FrameSettings FrameOptions::settingsFor(const field::FieldView& view) const
{
    Diagnostics diagnostics;
    const render::FrameSettings settings = settingsFor(view, diagnostics);
    for (const std::string& warning : diagnostics.warnings())
        log::warn("{}", warning);
    return settings;
}

render::FrameSettings FrameOptions::settingsFor(const field::FieldView& view,
                                                Diagnostics& diagnostics) const
{
    render::FrameSettings settings = usualSettings(view);
    const auto warn = [&](const std::vector<std::string>& warnings) {
        for (const std::string& warning : warnings)
            diagnostics.warn("{}", warning);
    };
    if (sceneSettings)
        warn(presentation::readSettings(sceneSettings->text, sceneSettings->place, settings));
    if (!settingsFile.empty())
        warn(presentation::readSettings(settingsFile, settings));
    settings.colliders.insert(settings.colliders.end(), colliders.begin(), colliders.end());
    if (settings.colliders.size() > render::maxColliders)
        fail(ErrorKind::usage, "--collider: {} colliders, more than {}", settings.colliders.size(),
             render::maxColliders);
    settings.cullMask = cullMask.value_or(settings.cullMask);
    settings.levelOfDetail = levelOfDetail.value_or(settings.levelOfDetail);
    if (tessellationLevel) {
        settings.tessellationLevel = *tessellationLevel;
        settings.levelSteps.clear();
    }
    settings.debug = debug;
    if (drawDistance)
        settings.environment.drawDistance = *drawDistance;
    settings.thatch = thatch.value_or(settings.thatch);
    if (windStrength)
        render::scaleWind(settings.winds, *windStrength);
    return settings;
}

} // namespace sward::view
