#include "apps/sward_view/dataset/dataset_scene.h"

#include "apps/common/parse_text.h"
#include "apps/sward_view/picture/layer_list.h"
#include "apps/sward_view/scene/frame_options.h"
#include "core/error.h"
#include "core/files/mapped_file.h"
#include "core/json/settings_json.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <string_view>

namespace sward::view {
namespace {

constexpr std::size_t largestFile = 1u << 22; ///< [bytes]
constexpr int maxDatasetFrames = 10'000'000;
constexpr double farthestPlace = 1e9; ///< [m]

std::string besideScene(const DatasetScene& scene, const std::string& name)
{
    return (scene.file.parent_path() / name).lexically_normal().string();
}

void readFields(SettingsReader& reader, DatasetScene& scene)
{
    const bool hasBakes = reader.has("bakes");
    if (!reader.has("fields") && !hasBakes)
        fail(ErrorKind::input, "{}: missing, and so is \"bakes\"", reader.placeOf("fields"));
    if (hasBakes)
        scene.bakes = readBakeRanges(reader.child("bakes"), reader.placeOf("bakes"),
                                     render::LayerId::maxFields);
    if (!reader.has("fields"))
        return;
    const nlohmann::json& names = reader.child("fields");
    if (!names.is_array() || names.empty() || names.size() > render::LayerId::maxFields)
        fail(ErrorKind::input, "{}: expected an array of 1 to {} names of fields",
             reader.placeOf("fields"), render::LayerId::maxFields);
    for (const nlohmann::json& name : names) {
        if (!name.is_string())
            fail(ErrorKind::input, "{}: expected names of fields, found {}",
                 reader.placeOf("fields"), name.type_name());
        if (name.get_ref<const std::string&>().empty())
            fail(ErrorKind::input, "{}: expected names of fields, found \"\"",
                 reader.placeOf("fields"));
        scene.fields.push_back(besideScene(scene, name.get<std::string>()));
    }
}

/// Reads the name of a file in the scene's folder; empty if the key is absent.
void readFileName(SettingsReader& reader, const char* key, const DatasetScene& scene,
                  std::string& name)
{
    reader.read(key, name);
    if (!reader.has(key))
        return;
    if (name.empty())
        fail(ErrorKind::input, "{}: expected the name of a file, found \"\"", reader.placeOf(key));
    name = besideScene(scene, name);
}

/// Refuses a key that another one makes meaningless.
void refuseBeside(SettingsReader& reader, const char* key, std::string_view why)
{
    if (reader.has(key))
        fail(ErrorKind::input, "{}: means nothing {}", reader.placeOf(key), why);
}

void readOptional(SettingsReader& reader, const char* key, std::optional<glm::dvec2>& range,
                  double low, double high)
{
    if (!reader.has(key))
        return;
    glm::dvec2 read(0.0);
    reader.readRange(key, read, low, high);
    range = read;
}

void readCameras(SettingsReader& outer, DatasetScene& scene)
{
    if (!outer.has("cameras"))
        return;
    SettingsReader reader(outer.child("cameras"), outer.placeOf("cameras"));
    if (outer.has("path"))
        for (const char* key : {"height_m", "pitch_deg", "heading_deg", "roll_deg", "fov_y_deg",
                                "speed_m_s", "turn_deg_s", "x_m", "z_m"})
            refuseBeside(reader, key, "beside \"path\", which gives the cameras");
    DatasetScene::Cameras& cameras = scene.cameras;
    reader.readRange("height_m", cameras.height, 0.0, 1e5);
    reader.readRange("pitch_deg", cameras.pitch, -89.0, 89.0);
    reader.readRange("heading_deg", cameras.heading, -360.0, 360.0);
    reader.readRange("roll_deg", cameras.roll, -180.0, 180.0);
    reader.readRange("fov_y_deg", cameras.fovY, 1.0, 170.0);
    reader.readRange("speed_m_s", cameras.speed, -1e3, 1e3);
    reader.readRange("turn_deg_s", cameras.turn, -1e4, 1e4);
    readOptional(reader, "x_m", cameras.x, -farthestPlace, farthestPlace);
    readOptional(reader, "z_m", cameras.z, -farthestPlace, farthestPlace);
    reader.finish();
}

void readSky(SettingsReader& outer, DatasetScene& scene)
{
    if (!outer.has("sun"))
        return;
    SettingsReader reader(outer.child("sun"), outer.placeOf("sun"));
    readOptional(reader, "height_deg", scene.sunHeight, -5.0, 90.0);
    readOptional(reader, "heading_deg", scene.sunHeading, -360.0, 360.0);
    reader.finish();
}

void readObjects(SettingsReader& outer, DatasetScene& scene)
{
    if (!outer.has("objects"))
        return;
    SettingsReader reader(outer.child("objects"), outer.placeOf("objects"));
    reader.read("min_area_pixels", scene.minArea, 1.0, 1e9);
    reader.read("plants", scene.listsPlants);
    reader.read("species", scene.listsSpecies);
    reader.finish();
}

void readPictures(SettingsReader& reader, DatasetScene& scene)
{
    std::string size = "640x360";
    reader.read("size", size);
    scene.size = apps::parseSize(reader.placeOf("size"), size, largestSize);
    int samples = 1;
    reader.read("samples", samples, 1, 4);
    if (samples != 1 && samples != 4)
        fail(ErrorKind::input, "{}: {} is not 1 or 4", reader.placeOf("samples"), samples);
    scene.samples = static_cast<std::uint32_t>(samples);
    std::string layers = "depth,normal,id,class";
    reader.read("layers", layers);
    if (layers != "none")
        scene.layers = parseLayers(reader.placeOf("layers"), layers);
    constexpr std::array<std::string_view, 3> formats{"exr", "npz", "png"};
    scene.format = static_cast<DatasetFormat>(reader.readWord("format", formats, 0));
    reader.read("compressed", scene.isCompressed);
    // False is what the other formats are.
    if (scene.isCompressed && scene.format != DatasetFormat::exr)
        refuseBeside(reader, "compressed", "beside a \"format\" other than \"exr\"");
}

} // namespace

DatasetScene readDatasetScene(const std::filesystem::path& file)
{
    const std::vector<std::byte> bytes = readFile(file, largestFile);
    DatasetScene scene;
    scene.file = file;
    scene.text.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const nlohmann::json json = parseJson(scene.text, file.string());
    SettingsReader reader(json, file.string());
    std::string about;
    reader.read("about", about);
    readFields(reader, scene);
    try {
        readPictures(reader, scene);
    } catch (const Error& error) {
        // Lists and sizes are read as on the command line, but it is the file that is wrong.
        fail(ErrorKind::input, "{}", error.what());
    }
    int count = 1;
    reader.read("frames", count, 1, maxDatasetFrames);
    scene.frames = static_cast<std::uint64_t>(count);
    int seed = 1;
    reader.read("seed", seed, 0, 2'000'000'000);
    scene.seed = static_cast<std::uint64_t>(seed);
    readCameras(reader, scene);
    readFileName(reader, "path", scene, scene.path);
    if (scene.path.empty())
        for (const char* key : {"path_step_s", "jitter_deg"})
            refuseBeside(reader, key, "without \"path\"");
    reader.read("path_step_s", scene.pathStep, 0.0, 1e6);
    reader.read("jitter_m", scene.jitter, 0.0, 1e3);
    reader.read("jitter_deg", scene.jitterAngle, 0.0, 45.0);
    readSky(reader, scene);
    readOptional(reader, "wind_strength", scene.windStrength, 0.0, 1000.0);
    reader.readRange("time_s", scene.time, 0.0, 1e6);
    reader.read("step_s", scene.step, 1e-4, 10.0);
    int settling = 4;
    reader.read("settling_frames", settling, 1, 1000);
    scene.settling = static_cast<std::uint32_t>(settling);
    readObjects(reader, scene);
    readFileName(reader, "settings", scene, scene.settings);
    reader.finish();
    return scene;
}

} // namespace sward::view
