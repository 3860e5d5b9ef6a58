#include "apps/sward_view/dataset/dataset_files.h"

#include "apps/common/version.h"
#include "apps/sward_view/picture/layer_files.h"
#include "core/error.h"
#include "core/files/atomic_file.h"
#include "core/files/file_hash.h"
#include "core/files/foreign_bytes.h"
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
#include <optional>
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

/// Appends run lengths as COCO's compressed text: each less the one two before, in digits of five
/// bits, the lowest first, of which the sixth bit says that more follow.
void describeRuns(std::span<const std::uint64_t> runs, std::string& text)
{
    for (std::size_t i = 0; i < runs.size(); ++i) {
        auto left = static_cast<std::int64_t>(runs[i]);
        if (i > 2)
            left -= static_cast<std::int64_t>(runs[i - 2]);
        for (bool goesOn = true; goesOn;) {
            auto digit = static_cast<unsigned>(left & 0x1f);
            left >>= 5;
            goesOn = left != ((digit & 0x10u) != 0 ? -1 : 0);
            digit += (goesOn ? 0x20u : 0u) + '0';
            if (digit == '\\')
                text += '\\';
            text += static_cast<char>(digit);
        }
    }
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
    fmt::format_to(out, R"("segmentation":{{"size":[{},{}],"counts":")", size.y, size.x);
    describeRuns(object.runs, text);
    text += "\"}}";
}

std::string wholeText(const fs::path& path)
{
    const std::vector<std::byte> bytes = readFile(path, largestDescription);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

constexpr const char* manifestName = "manifest.json";
constexpr const char* objectsName = "coco.json";

/// A .json of a frame begins with its set and a hash of all after these two, and has a line for
/// each object.
constexpr std::string_view setKey = "{\"set\":\"", contentKey = "\",\"content\":\"",
                           headEnd = "\",", objectsBegin = "\"objects\":[", objectsEnd = "\n]}\n";
constexpr std::size_t hashDigits = 16;
constexpr std::size_t headSize =
    setKey.size() + contentKey.size() + headEnd.size() + 2 * hashDigits;

/// What a .json of a frame says of itself.
struct FrameHead {
    std::string_view set, content;
};

std::optional<FrameHead> headOf(std::string_view text)
{
    const std::size_t content = setKey.size() + hashDigits + contentKey.size();
    if (text.size() < headSize || !text.starts_with(setKey) ||
        text.substr(setKey.size() + hashDigits, contentKey.size()) != contentKey ||
        text.substr(content + hashDigits, headEnd.size()) != headEnd)
        return std::nullopt;
    return FrameHead{text.substr(setKey.size(), hashDigits), text.substr(content, hashDigits)};
}

std::string_view textOf(const MappedFile& file)
{
    return {reinterpret_cast<const char*>(file.bytes().data()), file.bytes().size()};
}

/// A manifest without what may change while its frames stay.
nlohmann::json lastingPart(nlohmann::json manifest)
{
    manifest.erase("set");
    if (const auto scene = manifest.find("scene"); scene != manifest.end() && scene->is_object()) {
        scene->erase("frames");
        scene->erase("about");
    }
    return manifest;
}

/// A value in a message: its beginning if it is long.
std::string shownValue(const nlohmann::json* value)
{
    constexpr std::size_t most = 60;
    if (value == nullptr)
        return "not stated";
    const std::string text = jsonText(*value);
    return text.size() <= most ? text : toUtf8(text.substr(0, most)) + "…";
}

/// "KEY" is VALUE there and VALUE here: the first difference of two values that differ.
std::string differenceOf(const nlohmann::json* there, const nlohmann::json* here,
                         const std::string& key)
{
    if (there == nullptr || here == nullptr || !there->is_object() || !here->is_object())
        return fmt::format("its \"{}\" is {}, here it is {}", key, shownValue(there),
                           shownValue(here));
    const auto childOf = [](const nlohmann::json& object, const std::string& name) {
        const auto found = object.find(name);
        return found == object.end() ? nullptr : &*found;
    };
    nlohmann::json names = *here;
    names.update(*there);
    for (const auto& [name, unused] : names.items()) {
        const nlohmann::json* const a = childOf(*there, name);
        const nlohmann::json* const b = childOf(*here, name);
        if (a == nullptr || b == nullptr || *a != *b)
            return differenceOf(a, b, key.empty() ? name : key + "." + name);
    }
    return {};
}

/// Throws unless two manifests are of one set, as far as `here` states it.
void requireSameSet(const nlohmann::json& there, const nlohmann::json& here, const fs::path& path)
{
    const nlohmann::json a = lastingPart(there), b = lastingPart(here);
    if (a != b)
        fail(ErrorKind::usage, "{}: is of another set: {}; choose another folder", path.string(),
             differenceOf(&a, &b, ""));
}

std::uint64_t framesOf(const nlohmann::json& manifest)
{
    const nlohmann::json& scene = manifest.at("scene");
    const auto found = scene.find("frames");
    return found != scene.end() && found->is_number() ? found->get<std::uint64_t>() : 1;
}

/// The set of a manifest, as its frames name it.
std::string setOf(const nlohmann::json& manifest)
{
    if (const auto set = manifest.find("set"); set != manifest.end() && set->is_string())
        return set->get<std::string>();
    return hashOfText(jsonText(lastingPart(manifest)));
}

} // namespace

DatasetFiles::DatasetFiles(const DatasetScene& scene, std::span<const field::FieldView> fields,
                           std::span<const DrawnBake> bakes, fs::path folder)
    : scene_(scene)
    , bakes_(bakes)
    , folder_(std::move(folder))
    , finished_(scene.frames, 0)
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

fs::path DatasetFiles::pictureOf(std::uint64_t frame) const
{
    constexpr const char* extensions[] = {".exr", ".npz", ".png"};
    return nameOf(frame, extensions[static_cast<std::size_t>(scene_.format)]);
}

/// The set of the folder's manifest; `file`: of a frame, found before.
const std::string& DatasetFiles::knownSet(const fs::path& file)
{
    if (!set_.empty())
        return set_;
    const fs::path path = folder_ / manifestName;
    if (!fs::exists(path))
        fail(ErrorKind::usage,
             "{}: is here without a {} that says of which set it is; choose another folder",
             file.string(), manifestName);
    return set_ = setOf(parseJson(wholeText(path), path.string()));
}

/// Whether the files of a frame are whole.
bool DatasetFiles::isWhole(std::uint64_t frame)
{
    const fs::path path = nameOf(frame, ".json");
    if (!fs::exists(path)) {
        if (const fs::path picture = pictureOf(frame); fs::exists(picture))
            static_cast<void>(knownSet(picture));
        return false;
    }
    const std::string& set = knownSet(path);
    const MappedFile file(path);
    const std::string_view text = textOf(file);
    const std::optional<FrameHead> head = headOf(text);
    if (!head)
        return false;
    if (head->set != set)
        fail(ErrorKind::usage,
             "{}: is a frame of the set {}, and {} is of {}; choose another folder", path.string(),
             head->set, manifestName, set);
    const std::string_view rest = text.substr(headSize);
    if (head->content != hashOfText(rest))
        return false;
    const auto described = nlohmann::json::parse(
        "{" + std::string(rest.substr(0, rest.find('}') + 1)) + "}", nullptr, false);
    if (!described.is_object() || !described.contains("files"))
        return false;
    for (const auto& [name, size] : described.at("files").items()) {
        std::error_code error;
        if (!size.is_number_unsigned() ||
            fs::file_size(folder_ / name, error) != size.get<std::uint64_t>() || error)
            return false;
    }
    return true;
}

bool DatasetFiles::isFinished(std::uint64_t frame)
{
    if (finished_[frame] == 0 && isWhole(frame))
        finished_[frame] = 1;
    return finished_[frame] != 0;
}

bool DatasetFiles::isComplete()
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
    if (!there.is_object() || !there.contains("scene") || !there.at("scene").is_object())
        fail(ErrorKind::usage, "{}: is no manifest of a set; choose another folder", path.string());
    requireSameSet(nlohmann::json::object({{"scene", there.at("scene")}}),
                   nlohmann::json::object({{"scene", parseJson(scene.text, scene.file.string())}}),
                   path);
    if (framesOf(there) > scene.frames)
        fail(ErrorKind::usage, "{}: its \"scene.frames\" is {}, here it is {}; a set can only grow",
             path.string(), framesOf(there), scene.frames);
}

void DatasetFiles::writeManifest(const std::string& device)
{
    OrderedJson json;
    json["program"] = apps::versionText("sward-view");
    json["device"] = device;
    json["scene"] = OrderedJson::parse(withoutMark(scene_.text));
    for (const DrawnBake& bake : bakes_)
        json["bakes"].push_back(bake.shown);
    for (const std::string& content : contents_)
        json["fields"].push_back(content);
    for (const std::string* file : {&scene_.settings, &scene_.path})
        if (!file->empty())
            json["files"].push_back(hashOfFile(*file));
    for (const Category& category : categories_)
        json["categories"].push_back(category.name);
    const fs::path path = folder_ / manifestName;
    const bool isThere = fs::exists(path);
    const std::string former = isThere ? wholeText(path) : std::string();
    set_ = setOf(nlohmann::json(json));
    if (isThere) {
        const nlohmann::json there = parseJson(former, path.string());
        requireSameSet(there, nlohmann::json(json), path);
        set_ = setOf(there);
        // It says nothing of the new frames.
        if (framesOf(there) < scene_.frames)
            fs::remove(folder_ / objectsName);
    }
    json["set"] = set_;
    const std::string text = jsonText(json, 2) + "\n";
    if (former != text)
        writeTextFile(path, text, true);
}

std::string DatasetFiles::descriptionOf(std::uint64_t frame, const DrawnFrame& what,
                                        std::span<const SeenObject> objects,
                                        std::span<const fs::path> files) const
{
    const std::size_t field = fieldOfFrame(scene_, frame);
    OrderedJson json;
    for (const fs::path& file : files)
        json["files"][file.filename().string()] = fs::file_size(file);
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
    std::string text = jsonText(json).substr(1);
    text.resize(text.size() - std::string_view("]}").size());
    for (const SeenObject& object : objects) {
        text += text.back() == '[' ? "\n" : ",\n";
        describe(object, scene_.size, categoryOf_[field][object.species], text);
    }
    text += objectsEnd;
    return fmt::format("{}{}{}{}{}{}", setKey, set_, contentKey, hashOfText(text), headEnd, text);
}

std::uint64_t DatasetFiles::write(std::uint64_t frame, const DrawnFrame& what, LayeredFrame drawn)
{
    const std::vector<SeenObject> objects = seenObjects(scene_, drawn.layers);
    // Layers that only objects need are not written.
    for (std::uint32_t i = 0; i < render::layerCount; ++i)
        if ((scene_.layers & (render::LayerMask(1) << i)) == 0)
            drawn.layers.arrays[i].clear();
    const fs::path path = pictureOf(frame);
    std::vector<fs::path> paths{path};
    switch (scene_.format) {
    case DatasetFormat::exr:
        writeLayersExr(drawn.radiance, drawn.layers,
                       scene_.isCompressed ? apps::ExrCompression::zip : apps::ExrCompression::none,
                       path, true);
        break;
    case DatasetFormat::npz:
        writeLayersNpz(drawn.radiance, drawn.layers, path, true);
        break;
    case DatasetFormat::png:
        writePng(drawn.picture, path, true);
        writeLayerPngs(drawn.layers, path, true);
        for (std::uint32_t i = 0; i < render::layerCount; ++i)
            if (const auto layer = static_cast<render::Layer>(i); drawn.layers.has(layer))
                paths.push_back(layerPath(path, layer));
        break;
    }
    const std::string description = descriptionOf(frame, what, objects, paths);
    writeTextFile(nameOf(frame, ".json"), description, true);
    finished_[frame] = 1;
    std::uint64_t bytes = description.size();
    for (const fs::path& written : paths)
        bytes += fs::file_size(written);
    return bytes;
}

/// Holds one frame's objects at a time: those of a large set take more memory than there is.
void DatasetFiles::writeObjects() const
{
    OrderedJson info;
    info["description"] = scene_.file.filename().string();
    OrderedJson images = OrderedJson::array();
    for (std::uint64_t frame = 0; frame < scene_.frames; ++frame)
        images.push_back({{"id", frame},
                          {"file_name", pictureOf(frame).filename().string()},
                          {"width", scene_.size.x},
                          {"height", scene_.size.y}});
    OrderedJson categories = OrderedJson::array();
    for (std::size_t i = 0; i < categories_.size(); ++i)
        categories.push_back(
            {{"id", i + 1}, {"name", categories_[i].name}, {"supercategory", "plant"}});

    AtomicFile file(folder_ / objectsName, true);
    file.write(fmt::format(R"({{"info":{},"images":{},"annotations":[)", jsonText(info),
                           jsonText(images)));
    std::uint64_t id = 0;
    std::string text;
    for (std::uint64_t frame = 0; frame < scene_.frames; ++frame) {
        const fs::path path = nameOf(frame, ".json");
        const MappedFile mapped(path);
        std::string_view rest = textOf(mapped);
        const std::size_t begin = rest.find(objectsBegin);
        if (begin == std::string_view::npos || !rest.ends_with(objectsEnd))
            fail(ErrorKind::io, "{}: has changed while the set was completed", path.string());
        rest = rest.substr(begin + objectsBegin.size());
        rest.remove_suffix(objectsEnd.size());
        text.clear();
        // An object is a line: "\n{…}", and a comma if another one follows.
        while (!rest.empty()) {
            std::string_view line = rest.substr(0, rest.find('\n', 1));
            rest.remove_prefix(line.size());
            if (line.ends_with(','))
                line.remove_suffix(1);
            fmt::format_to(std::back_inserter(text), "{}\n{{\"id\":{},\"image_id\":{},",
                           id > 0 ? "," : "", id + 1, frame);
            text += line.substr(std::string_view("\n{").size());
            ++id;
        }
        file.write(text);
    }
    file.write(fmt::format(R"(],"categories":{}}}
)",
                           jsonText(categories)));
    file.commit();
}

} // namespace sward::view
