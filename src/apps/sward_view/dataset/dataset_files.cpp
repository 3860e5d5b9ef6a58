#include "apps/sward_view/dataset/dataset_files.h"

#include "apps/common/version.h"
#include "apps/sward_view/dataset/file_hash.h"
#include "apps/sward_view/picture/layer_files.h"
#include "core/error.h"
#include "core/files/atomic_file.h"
#include "core/files/mapped_file.h"
#include "core/json/json_text.h"
#include "core/json/settings_json.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>

namespace sward::view {
namespace {

namespace fs = std::filesystem;
using OrderedJson = nlohmann::ordered_json;

constexpr std::size_t largestDescription = std::size_t(1) << 30; ///< [bytes]

OrderedJson arrayOf(glm::dvec3 v)
{
    return OrderedJson::array({v.x, v.y, v.z});
}

/// Camera as places and as matrices: x to the right, y down, z along the view.
OrderedJson describe(const render::Camera& camera, glm::uvec2 size)
{
    const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(camera.up)));
    const glm::dvec3 down = glm::cross(forward, right);
    OrderedJson rows = OrderedJson::array();
    for (const glm::dvec3& axis : {right, down, forward})
        rows.push_back(OrderedJson::array({axis.x, axis.y, axis.z, -glm::dot(axis, camera.eye)}));
    rows.push_back(OrderedJson::array({0.0, 0.0, 0.0, 1.0}));
    const double focal = 0.5 * double(size.y) / std::tan(0.5 * glm::radians(double(camera.fovY)));
    OrderedJson json;
    json["eye"] = arrayOf(camera.eye);
    json["target"] = arrayOf(camera.target);
    json["up"] = arrayOf(glm::dvec3(camera.up));
    json["fov_y_deg"] = camera.fovY;
    json["world_to_camera"] = rows;
    json["intrinsics"] = OrderedJson::array({OrderedJson::array({focal, 0.0, 0.5 * double(size.x)}),
                                             OrderedJson::array({0.0, focal, 0.5 * double(size.y)}),
                                             OrderedJson::array({0.0, 0.0, 1.0})});
    return json;
}

/// Appends the object as JSON. A frame has thousands of objects with a hundred runs each: a tree of
/// values took most of the time of writing it.
void describe(const SeenObject& object, glm::uvec2 size, std::uint32_t category, std::string& text)
{
    const glm::uvec2 extent = object.high - object.low;
    const auto out = std::back_inserter(text);
    fmt::format_to(out, R"({{"category_id":{},)", category + 1);
    if (object.plant != 0) // a text: beyond what every program reads as a number
        fmt::format_to(out, R"("plant":"{}",)", object.plant);
    fmt::format_to(out, R"("bbox":[{},{},{},{}],"area":{},"iscrowd":{},)", object.low.x,
                   object.low.y, extent.x, extent.y, object.area, object.plant == 0 ? 1 : 0);
    fmt::format_to(out, R"("segmentation":{{"size":[{},{}],"counts":[{}]}}}})", size.y, size.x,
                   fmt::join(object.runs, ","));
}

std::string wholeText(const fs::path& path)
{
    const std::vector<std::byte> bytes = readFile(path, largestDescription);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

constexpr const char* manifestName = "manifest.json";

[[noreturn]] void failAsOther(const fs::path& manifest, const std::string& key)
{
    fail(ErrorKind::usage, "{}: is of another set: its \"{}\" differs; choose another folder",
         manifest.string(), key);
}

} // namespace

DatasetFiles::DatasetFiles(const DatasetScene& scene, std::span<const field::FieldView> fields,
                           std::span<const DrawnBake> bakes, fs::path folder)
    : scene_(scene)
    , bakes_(bakes)
    , folder_(std::move(folder))
{
    for (std::size_t i = 0; i < fields.size(); ++i) {
        std::vector<std::uint32_t>& slots = categoryOf_.emplace_back();
        for (const field::Species& species : fields[i].species) {
            const auto found = std::ranges::find(categories_, species.name, &Category::name);
            slots.push_back(static_cast<std::uint32_t>(found - categories_.begin()));
            if (found == categories_.end())
                categories_.push_back({species.name});
        }
        contents_.push_back(hashOfFile(scene.fields[i]));
    }
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error || !fs::is_directory(folder_))
        fail(ErrorKind::io, "{}: cannot make this folder", folder_.string());
}

fs::path DatasetFiles::nameOf(std::uint64_t frame, const char* extension) const
{
    return folder_ / fmt::format("frame_{:08}{}", frame, extension);
}

bool DatasetFiles::isFinished(std::uint64_t frame) const
{
    return fs::exists(nameOf(frame, ".json"));
}

bool DatasetFiles::isComplete() const
{
    for (std::uint64_t frame = 0; frame < scene_.frames; ++frame)
        if (!isFinished(frame))
            return false;
    return true;
}

void DatasetFiles::requireScene(const DatasetScene& scene, const fs::path& folder)
{
    const fs::path path = folder / manifestName;
    if (!fs::exists(path))
        return;
    const nlohmann::json there = parseJson(wholeText(path), path.string());
    if (!there.contains("scene") || there.at("scene") != nlohmann::json::parse(scene.text))
        failAsOther(path, "scene");
}

void DatasetFiles::writeManifest(const std::string& device) const
{
    OrderedJson json;
    json["program"] = apps::versionText("sward-view");
    json["device"] = device;
    json["scene"] = OrderedJson::parse(scene_.text);
    for (const DrawnBake& bake : bakes_)
        json["bakes"].push_back(bake.shown);
    for (const std::string& content : contents_)
        json["fields"].push_back(content);
    for (const std::string* file : {&scene_.settings, &scene_.path})
        if (!file->empty())
            json["files"].push_back(hashOfFile(*file));
    for (const Category& category : categories_)
        json["categories"].push_back(category.name);
    const std::string text = jsonText(json, 2) + "\n";
    const fs::path path = folder_ / manifestName;
    if (!fs::exists(path)) {
        AtomicFile file(path, true);
        file.write(text);
        file.commit();
        return;
    }
    const std::string former = wholeText(path);
    if (former == text)
        return;
    const nlohmann::json there = parseJson(former, path.string());
    for (const auto& [key, value] : json.items())
        if (!there.contains(key) || there.at(key) != nlohmann::json(value))
            failAsOther(path, key);
    fail(ErrorKind::usage, "{}: is of another set; choose another folder", path.string());
}

std::string DatasetFiles::descriptionOf(std::uint64_t frame, const DrawnFrame& what,
                                        std::span<const SeenObject> objects) const
{
    const std::size_t field = fieldOfFrame(scene_, frame);
    OrderedJson json;
    json["frame"] = frame;
    json["field"] = fs::path(scene_.fields[field]).filename().string();
    json["width"] = scene_.size.x;
    json["height"] = scene_.size.y;
    json["camera"] = describe(what.camera, scene_.size);
    json["camera_before"] = describe(what.before, scene_.size);
    json["camera_after"] = describe(what.next, scene_.size);
    json["sun_direction"] = arrayOf(glm::normalize(glm::dvec3(what.settings.sunDirection)));
    json["wind_strength"] = what.windStrength;
    json["time_s"] = what.time;
    json["objects"] = OrderedJson::array();
    std::string text = jsonText(json);
    text.resize(text.size() - std::string_view("]}").size());
    for (const SeenObject& object : objects) {
        if (text.back() != '[')
            text += ',';
        describe(object, scene_.size, categoryOf_[field][object.species], text);
    }
    return text + "]}\n";
}

std::uint64_t DatasetFiles::write(std::uint64_t frame, const DrawnFrame& what,
                                  LayeredFrame drawn) const
{
    const std::vector<SeenObject> objects = seenObjects(scene_, drawn.layers);
    // Layers that only objects need are not written.
    for (std::uint32_t i = 0; i < render::layerCount; ++i)
        if ((scene_.layers & (render::LayerMask(1) << i)) == 0)
            drawn.layers.arrays[i].clear();
    fs::path path;
    std::vector<fs::path> paths;
    switch (scene_.format) {
    case DatasetFormat::exr:
        path = nameOf(frame, ".exr");
        writeLayersExr(drawn.radiance, drawn.layers,
                       scene_.isCompressed ? apps::ExrCompression::zip : apps::ExrCompression::none,
                       path, true);
        break;
    case DatasetFormat::npz:
        path = nameOf(frame, ".npz");
        writeLayersNpz(drawn.radiance, drawn.layers, path, true);
        break;
    case DatasetFormat::png:
        path = nameOf(frame, ".png");
        writePng(drawn.picture, path, true);
        writeLayerPngs(drawn.layers, path, true);
        for (std::uint32_t i = 0; i < render::layerCount; ++i)
            if (const auto layer = static_cast<render::Layer>(i); drawn.layers.has(layer))
                paths.push_back(layerPath(path, layer));
        break;
    }
    paths.push_back(path);
    paths.push_back(nameOf(frame, ".json"));
    AtomicFile file(paths.back(), true);
    file.write(descriptionOf(frame, what, objects));
    file.commit();
    std::uint64_t bytes = 0;
    for (const fs::path& written : paths)
        bytes += fs::file_size(written);
    return bytes;
}

/// Holds one frame's objects at a time: those of a large set take more memory than there is.
void DatasetFiles::writeObjects() const
{
    constexpr const char* extensions[] = {".exr", ".npz", ".png"};
    const char* const extension = extensions[static_cast<std::size_t>(scene_.format)];
    OrderedJson info;
    info["description"] = scene_.file.filename().string();
    OrderedJson images = OrderedJson::array();
    for (std::uint64_t frame = 0; frame < scene_.frames; ++frame)
        images.push_back({{"id", frame},
                          {"file_name", nameOf(frame, extension).filename().string()},
                          {"width", scene_.size.x},
                          {"height", scene_.size.y}});
    OrderedJson categories = OrderedJson::array();
    for (std::size_t i = 0; i < categories_.size(); ++i)
        categories.push_back(
            {{"id", i + 1}, {"name", categories_[i].name}, {"supercategory", "plant"}});

    AtomicFile file(folder_ / "coco.json", true);
    file.write(fmt::format(R"({{"info":{},"images":{},"annotations":[)", jsonText(info),
                           jsonText(images)));
    std::uint64_t id = 0;
    std::string text;
    for (std::uint64_t frame = 0; frame < scene_.frames; ++frame) {
        const fs::path path = nameOf(frame, ".json");
        const OrderedJson described = OrderedJson::parse(wholeText(path), nullptr, false);
        const auto objects = described.is_object() ? described.find("objects") : described.end();
        if (objects == described.end() || !objects->is_array())
            fail(ErrorKind::input, "{}: no objects of a frame; remove it to draw the frame again",
                 path.string());
        text.clear();
        for (const OrderedJson& object : *objects) {
            OrderedJson annotation{{"id", ++id}, {"image_id", frame}};
            if (object.is_object())
                annotation.update(object);
            text += (id == 1 ? "" : ",") + jsonText(annotation);
        }
        file.write(text);
    }
    file.write(fmt::format(R"(],"categories":{}}}
)",
                           jsonText(categories)));
    file.commit();
}

} // namespace sward::view
