#include "apps/sward/options/trace_options.h"

#include "apps/common/parse_text.h"
#include "core/error.h"
#include "core/files/mapped_file.h"
#include "core/json/settings_json.h"
#include "trace/camera_presets.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

namespace sward::apps {
namespace {

constexpr int maxTraceThreads = 1024;
constexpr std::uint32_t maxSide = 16384; // [pixels]
constexpr std::uint64_t maxPixels = std::uint64_t(1) << 26;
constexpr double maxPlace = 1e12;                    // [m]
constexpr double brightest = 1000.0;                 // radiance; that of the sky is about 1
constexpr std::size_t largestTraceCamera = 1u << 20; // [bytes]

// "x,y,z" with each number within ±largest.
glm::dvec3 parsePlace(const char* option, const std::string& text, double low, double high)
{
    const std::vector<std::string_view> parts = splitText(text, ',');
    if (parts.size() != 3)
        fail(ErrorKind::usage, "{}: '{}' is not three numbers; write them like 1,2.5,-3", option,
             text);
    glm::dvec3 place;
    for (glm::length_t i = 0; i < 3; ++i)
        place[i] = parseNumber(option, parts[static_cast<std::size_t>(i)], low, high);
    return place;
}

// A whole number of an option.
std::uint64_t parseWhole(const char* option, const std::string& text, std::uint64_t low,
                         std::uint64_t high)
{
    std::uint64_t number = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    if (error != std::errc() || stop != end || number < low || number > high)
        fail(ErrorKind::usage, "{}: '{}' is not a whole number from {} to {}", option, text, low,
             high);
    return number;
}

bool isLayer(std::string_view word)
{
    return std::find(std::begin(traceLayers), std::end(traceLayers), word) != std::end(traceLayers);
}

std::vector<std::string> parseLayers(const std::string& text)
{
    std::vector<std::string> layers;
    if (text == "all")
        return {std::begin(traceLayers), std::end(traceLayers)};
    for (const std::string_view word : splitText(text, ',')) {
        if (!isLayer(word)) {
            std::string known;
            for (const char* layer : traceLayers)
                known += std::string(known.empty() ? "" : ", ") + layer;
            fail(ErrorKind::usage, "--layers: '{}' is not all or one of {}", word, known);
        }
        if (std::find(layers.begin(), layers.end(), word) == layers.end())
            layers.emplace_back(word);
    }
    return layers;
}

glm::vec3 upOf(const field::FieldView& view)
{
    const glm::vec3 down = view.defaults->gravityDirection;
    return glm::length(down) > 0.0f ? -glm::normalize(down) : glm::vec3(0.0f, 1.0f, 0.0f);
}

// `v`, turned as +Y turns to unit `up` (Rodrigues).
glm::vec3 turnedToUp(glm::vec3 up, glm::vec3 v)
{
    const glm::vec3 y(0.0f, 1.0f, 0.0f);
    const glm::vec3 axis = glm::cross(y, up);
    const float cosine = glm::dot(y, up);
    if (cosine < -0.99999f)
        return {v.x, -v.y, -v.z};
    return v * cosine + glm::cross(axis, v) + axis * (glm::dot(axis, v) / (1.0f + cosine));
}

// A camera file of the viewer.
trace::Camera readTraceCamera(const std::string& path, glm::dvec3 up)
{
    const std::vector<std::byte> bytes = readFile(path, largestTraceCamera);
    const nlohmann::json json =
        parseJson({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path);
    SettingsReader reader(json, path);
    trace::Camera camera;
    camera.up = up;
    for (const char* key : {"eye", "target"})
        if (!reader.has(key))
            fail(ErrorKind::input, "{}: missing", reader.placeOf(key));
    reader.read("eye", camera.eye, -maxPlace, maxPlace);
    reader.read("target", camera.target, -maxPlace, maxPlace);
    reader.read("up", camera.up, -1e6, 1e6);
    reader.read("fov_y_deg", camera.fovY, 0.01, 170.0);
    reader.finish();
    return camera;
}

} // namespace

void TraceOptions::add(CLI::App& app)
{
    app.add_option("FIELD", field, "Field file")->type_name("")->required();
    app.add_option(
           "-o,--output", output,
           "Picture to write: .exr with linear radiance, or .png developed as by the viewer")
        ->type_name("OUT")
        ->required();
    addView(app);
    addLight(app);
    addRun(app);
}

void TraceOptions::addView(CLI::App& app)
{
    const auto parsed = [&app](const char* name, const char* type, const char* text, auto&& take) {
        return app.add_option_function<std::string>(name, take, text)
            ->type_name(type)
            ->group("View");
    };
    parsed("--size", "WxH",
           "Width and height of the picture in pixels, together at most 67 million",
           [this](const std::string& text) {
               settings_.size = parseSize("--size", text, maxSide);
               if (std::uint64_t(settings_.size.x) * settings_.size.y > maxPixels)
                   fail(ErrorKind::usage, "--size: {} has more than {} pixels", text, maxPixels);
           })
        ->default_str("1280x720");
    app.add_option("--camera", camera_,
                   "View: fit, eye or top, or a camera file {eye, target, up, fov_y_deg}")
        ->type_name("NAME|FILE")
        ->group("View")
        ->default_str("fit");
    parsed(
        "--eye", "X,Y,Z", "Place of the eye in metres, instead of --camera; with --target",
        [this](const std::string& text) { eye_ = parsePlace("--eye", text, -maxPlace, maxPlace); });
    parsed("--target", "X,Y,Z", "Place that the eye looks at", [this](const std::string& text) {
        target_ = parsePlace("--target", text, -maxPlace, maxPlace);
    });
    parsed("--up", "X,Y,Z", "Direction that is up in the picture", [this](const std::string& text) {
        up_ = parsePlace("--up", text, -1e6, 1e6);
    })->default_str("against gravity");
    parsed("--fov", "DEGREES", "Vertical field of view, 0.01 to 170",
           [this](const std::string& text) { fovY_ = parseNumber("--fov", text, 0.01, 170.0); })
        ->default_str("of the camera; 45 with --eye");
    app.add_option(
           "--blades", poses,
           "How the blades stand: a file of 'sward-view render --dump-blades' of this field")
        ->type_name("FILE.csv")
        ->group("View")
        ->default_str("at rest, without wind");
}

void TraceOptions::addLight(CLI::App& app)
{
    const auto parsed = [&app](const char* name, const char* type, const char* text, auto&& take) {
        return app.add_option_function<std::string>(name, take, text)
            ->type_name(type)
            ->group("Light and leaves");
    };
    const auto color = [&](const char* name, glm::vec3& value, const char* text) {
        parsed(name, "R,G,B", text, [name, &value](const std::string& word) {
            value = glm::vec3(parsePlace(name, word, 0.0, brightest));
        })->default_str(fmt::format("{:g},{:g},{:g}", value.x, value.y, value.z));
    };
    parsed("--sun", "X,Y,Z", "Direction towards the sun", [this](const std::string& text) {
        const glm::dvec3 towards = parsePlace("--sun", text, -1e6, 1e6);
        if (glm::length(towards) < 1e-6)
            fail(ErrorKind::usage, "--sun: {} has no direction", text);
        sun_ = glm::vec3(glm::normalize(towards));
    })->default_str("0.72,0.62,-0.42 above level ground");
    color("--sun-color", light.sunColor,
          "Radiance of a white surface that faces the sun, linear, 0 to 1000; 0,0,0: no sun");
    parsed("--sun-radius", "DEGREES", "Angular radius of the sun's disk, 0 to 25",
           [this](const std::string& text) {
               light.sunRadius =
                   static_cast<float>(glm::radians(parseNumber("--sun-radius", text, 0.0, 25.0)));
           })
        ->default_str("0.265");
    color(
        "--sky-color", light.skyColor,
        "Colour of the sky, linear, 0 to 1000; its radiance is 1.25 times this, as in the viewer");
    color("--ground-color", light.groundColor,
          "Radiance from below the horizon, linear, 0 to 1000");
    const auto factor = [&](const char* name, float& value, const char* text) {
        parsed(name, "F", text, [name, &value](const std::string& word) {
            value = static_cast<float>(parseNumber(name, word, 0.0, 1.0));
        })->default_str("1");
    };
    factor("--gloss", surfaces.gloss, "Factor of the species' gloss, 0 to 1; 0: dull leaves");
    factor("--translucency", surfaces.translucency,
           "Factor of the species' translucency, 0 to 1; 0: no light passes leaves");
    factor("--thatch", surfaces.thatch, "Share of the undergrowth that covers the ground, 0 to 1");
}

void TraceOptions::addRun(CLI::App& app)
{
    const auto parsed = [&app](const char* name, const char* type, const char* text, auto&& take) {
        return app.add_option_function<std::string>(name, take, text)
            ->type_name(type)
            ->group("Run");
    };
    parsed("--samples", "N", "Paths of each pixel, 1 to 1048576; the noise falls with its root",
           [this](const std::string& text) {
               samples = static_cast<std::uint32_t>(parseWhole("--samples", text, 1, 1u << 20));
           })
        ->default_str("64");
    parsed("--bounces", "N",
           "Times that light is scattered on before the surface that is seen, 0 to 1000; 0: only "
           "direct light",
           [this](const std::string& text) {
               settings_.bounces =
                   static_cast<std::uint32_t>(parseWhole("--bounces", text, 0, 1000));
           })
        ->default_str("8");
    parsed("--seed", "S", "Start of the random numbers, 0 to 18446744073709551615",
           [this](const std::string& text) {
               settings_.seed = parseWhole("--seed", text, 0, UINT64_MAX);
           })
        ->default_str("0");
    parsed("--layers", "LIST",
           "Layers of an .exr beside the light, with commas: all, albedo, normal, depth, blade, "
           "direct, indirect, visibility, sun, sky",
           [this](const std::string& text) { layers = parseLayers(text); });
    parsed(
        "--exposure", "F", "Factor of the light in a .png, 0.0001 to 10000",
        [this](const std::string& text) { exposure = parseNumber("--exposure", text, 1e-4, 1e4); })
        ->default_str("makes grass and ground 18 % grey");
    app.add_flag("--progressive", progressive,
                 "Write the picture also after 1, 4, 16 … samples, each over the last")
        ->group("Run");
    app.add_option("--threads", threads,
                   "Threads, 0 to 1024; 0: one for each CPU; the picture does not depend on it")
        ->type_name("N")
        ->check(CLI::Range(0, maxTraceThreads).description(""))
        ->group("Run")
        ->capture_default_str();
    app.add_flag("--force", overwrite, "Overwrite an existing file")->group("Run");
}

void TraceOptions::check() const
{
    if (eye_.has_value() != target_.has_value())
        fail(ErrorKind::usage, "--eye and --target need each other");
    if (eye_ && !camera_.empty())
        fail(ErrorKind::usage, "--eye and --camera exclude each other");
    const bool isExr = std::filesystem::path(output).extension() != ".png";
    if (!layers.empty() && !isExr)
        fail(ErrorKind::usage, "{}: --layers needs an .exr output", output);
    if (exposure && isExr)
        fail(ErrorKind::usage, "{}: --exposure needs a .png output; an .exr holds the light itself",
             output);
}

trace::Light TraceOptions::lightOver(const field::FieldView& view) const
{
    trace::Light over = light;
    over.up = upOf(view);
    over.sunDirection = sun_ ? *sun_ : turnedToUp(over.up, light.sunDirection);
    return over;
}

trace::Camera TraceOptions::cameraOf(const field::FieldView& view, const trace::RayScene& scene,
                                     const trace::Light& over) const
{
    using trace::CameraPreset;
    struct Named {
        const char* name;
        CameraPreset preset;
    };
    constexpr Named presets[] = {
        {"fit", CameraPreset::fit}, {"eye", CameraPreset::eye}, {"top", CameraPreset::top}};
    const std::string name = camera_.empty() ? "fit" : camera_;
    const Named* const found = std::find_if(std::begin(presets), std::end(presets),
                                            [&](const Named& one) { return name == one.name; });
    trace::Camera camera;
    if (eye_) {
        camera.eye = *eye_;
        camera.target = *target_;
        camera.up = glm::dvec3(over.up);
    } else if (found != std::end(presets)) {
        camera = trace::presetCamera(found->preset, view, scene, over.up, over.sunDirection,
                                     double(settings_.size.x) / double(settings_.size.y));
    } else {
        // A word that is neither a preset nor a file is probably a misspelt preset.
        if (!std::filesystem::exists(name) && name.find_first_of("./") == std::string::npos)
            fail(ErrorKind::usage, "--camera: '{}' is not fit, eye or top, and no such file", name);
        camera = readTraceCamera(name, glm::dvec3(over.up));
    }
    camera.up = up_.value_or(camera.up);
    camera.fovY = fovY_.value_or(camera.fovY);
    return camera;
}

} // namespace sward::apps
