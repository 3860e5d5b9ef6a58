#include "terrain/gltf/codecs/draco.h"

#include "terrain/gltf/codecs/draco_geometry.h"
#include "terrain/gltf/file/json.h"
#include "terrain/gltf/file/layout.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstring>
#include <map>
#include <utility>

namespace sward::terrain {
namespace {

using nlohmann::json;

constexpr const char* extensionName = "KHR_draco_mesh_compression";

// Most triangles of all primitives of a file, and of one by its compressed bytes: Draco makes room
// for as many as a header claims. A level grid takes a tenth of a byte for each, others a byte or
// two.
constexpr std::uint64_t dracoTriangleLimit = 25'000'000;
constexpr std::uint64_t freeDracoTriangles = std::uint64_t(1) << 15;
constexpr std::uint64_t dracoTriangleGain = 32;

// Most decoded bytes of a file [bytes].
constexpr std::uint64_t byteLimit = std::uint64_t(2) << 30;

// Content of an accessor: a Draco attribute's id, or the indices.
constexpr std::uint64_t indicesSource = std::uint64_t(1) << 32;

class Decompressor {
public:
    Decompressor(json& document, GltfBuffers& buffers, const std::string& place)
        : document_(document)
        , buffers_(buffers)
        , place_(place)
    {
        const auto required = document.find("extensionsRequired");
        isRequired_ =
            required != document.end() && required->is_array() &&
            std::find(required->begin(), required->end(), extensionName) != required->end();
    }

    void run()
    {
        const auto meshes = document_.find("meshes");
        if (meshes == document_.end() || !meshes->is_array())
            return;
        for (const char* const key : {"accessors", "bufferViews"})
            if (document_.contains(key) && !document_[key].is_array())
                fail(ErrorKind::input, "{}: {} is not an array", place_, key);
        for (std::size_t i = 0; i < meshes->size(); ++i) {
            json& mesh = (*meshes)[i];
            if (!mesh.is_object() || !mesh.contains("primitives") || !mesh["primitives"].is_array())
                continue;
            for (json& primitive : mesh["primitives"])
                if (primitive.is_object() && primitive.contains("extensions"))
                    visit(primitive, i);
        }
    }

private:
    void visit(json& primitive, std::size_t mesh)
    {
        const GltfObject o{primitive, place_, "mesh", mesh};
        const json* const extension = o.part(*o.object("extensions")).object(extensionName);
        if (extension == nullptr || (!isRequired_ && isPlain(o)))
            return;
        decode(o, o.part(*extension));
        // Draco decodes strips to separate triangles, too.
        primitive["mode"] = 4U;
        primitive.erase("extensions");
    }

    json& accessor(const GltfObject& owner, const char* key)
    {
        const std::size_t count =
            document_.contains("accessors") ? document_["accessors"].size() : 0;
        const std::uint64_t index = owner.requiredCount(key, count);
        json& found = document_["accessors"][index];
        if (!found.is_object())
            owner.failHere("accessor {} is not an object", index);
        return found;
    }

    bool isPlain(const GltfObject& primitive)
    {
        const json* const attributes = primitive.object("attributes");
        return attributes != nullptr && attributes->contains("POSITION") &&
               accessor(primitive.part(*attributes), "POSITION").contains("bufferView");
    }

    void decode(const GltfObject& primitive, const GltfObject& extension)
    {
        const auto mode = primitive.count("mode", 7);
        if (mode && *mode != 4 && *mode != 5)
            primitive.failHere("{}: mode {} has no triangles", extensionName, *mode);
        const json* const attributes = primitive.object("attributes");
        const json* const ids = extension.object("attributes");
        if (attributes == nullptr || ids == nullptr)
            primitive.failHere("{}: no attributes", extensionName);
        const std::uint64_t view = extension.requiredCount("bufferView");

        // Decode what the accessors declare.
        json& indices = accessor(primitive, "indices");
        std::vector<std::pair<json*, std::uint64_t>> targets = {{&indices, indicesSource}};
        std::vector<DracoAttribute> wanted;
        const GltfObject owner = primitive.part(*attributes);
        for (const auto& [name, id] : ids->items()) {
            if (!attributes->contains(name))
                continue;
            json& target = accessor(owner, name.c_str());
            wanted.push_back(attributeOf(
                primitive.part(target), name,
                extension.part(*ids).requiredCount(name.c_str(), std::uint64_t(1) << 32)));
            targets.emplace_back(&target, wanted.back().id);
        }
        if (wanted.empty())
            primitive.failHere("{}: none of its attributes is the primitive's", extensionName);
        if (isDone(targets, view))
            return;

        const std::uint64_t corners = primitive.part(indices).requiredCount("count");
        if (corners == 0 || corners % 3 != 0 || corners / 3 > dracoTriangleLimit - decoded_)
            primitive.failHere("{}: {} indices, which are no triangles or more than {} in all",
                               extensionName, corners, dracoTriangleLimit);
        decoded_ += corners / 3;
        const auto bytes = bytesOf(primitive, view);
        if (corners / 3 > freeDracoTriangles + dracoTriangleGain * bytes.size())
            primitive.failHere("{}: {} bytes cannot hold {} triangles", extensionName, bytes.size(),
                               corners / 3);
        const DracoGeometry geometry = decodeDraco(
            bytes, corners / 3, wanted, fmt::format("{}: mesh {}", place_, primitive.index));

        indices["componentType"] = 5125U;
        indices["type"] = "SCALAR";
        place(indices, geometry.indices.data(), geometry.indices.size() * sizeof(std::uint32_t));
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            json& target = *targets[i + 1].first;
            const std::uint64_t count = primitive.part(target).requiredCount("count");
            if (count != geometry.points)
                primitive.failHere("{}: {} points for the {} elements of {}", extensionName,
                                   geometry.points, count, wanted[i].name);
            place(target, geometry.attributes[i].data(), geometry.attributes[i].size());
        }
        for (const auto& [target, source] : targets)
            done_[target] = {view, source};
    }

    // Whether another primitive has already filled all of them from the same source.
    bool isDone(const std::vector<std::pair<json*, std::uint64_t>>& targets,
                std::uint64_t view) const
    {
        for (const auto& [target, source] : targets) {
            const auto found = done_.find(target);
            if (found == done_.end() || found->second != std::pair(view, source))
                return false;
        }
        return true;
    }

    static DracoAttribute attributeOf(const GltfObject& accessor, const std::string& name,
                                      std::uint64_t id)
    {
        const std::uint64_t type = accessor.requiredCount("componentType", 65536);
        accessor.text("type");
        const std::uint64_t components =
            gltfComponentCount(accessor.value.value("type", std::string()));
        if (gltfComponentSize(type) == 0 || components == 0 || components > 4)
            accessor.failHere("{}: the accessor of {} has no type that Draco knows", extensionName,
                              name);
        return {.name = name,
                .id = static_cast<std::uint32_t>(id),
                .componentType = static_cast<int>(type),
                .components = components};
    }

    std::span<const std::byte> bytesOf(const GltfObject& primitive, std::uint64_t view) const
    {
        const auto views = document_.find("bufferViews");
        if (views == document_.end() || view >= views->size() || !(*views)[view].is_object())
            primitive.failHere("{}: there is no bufferView {}", extensionName, view);
        const GltfObject o{(*views)[view], place_, "bufferView", view};
        const auto bytes = buffers_.bytes(o.requiredCount("buffer", buffers_.count()));
        const std::uint64_t offset = o.count("byteOffset").value_or(0);
        const std::uint64_t length = o.requiredCount("byteLength");
        if (length == 0)
            o.failHere("byteLength is 0: a view has one byte or more");
        if (offset > bytes.size() || length > bytes.size() - offset)
            o.failHere("{} bytes from byte {} on are not inside its buffer of {} bytes", length,
                       offset, bytes.size());
        return bytes.subspan(offset, length);
    }

    // Gives an accessor a buffer of its own.
    void place(json& accessor, const void* bytes, std::size_t size)
    {
        bytes_ += size;
        if (bytes_ > byteLimit)
            fail(ErrorKind::input, "{}: {}: more than {} bytes", place_, extensionName, byteLimit);
        std::vector<std::byte> own(size);
        std::memcpy(own.data(), bytes, size);
        const std::size_t buffer = buffers_.add(std::move(own));
        json& views = document_["bufferViews"];
        views.push_back({{"buffer", buffer}, {"byteLength", size}});
        accessor["bufferView"] = views.size() - 1;
        accessor.erase("byteOffset");
        accessor.erase("sparse");
    }

    json& document_;
    GltfBuffers& buffers_;
    const std::string& place_;
    bool isRequired_ = false;
    std::uint64_t decoded_ = 0;                                           // triangles
    std::uint64_t bytes_ = 0;                                             // decoded
    std::map<const json*, std::pair<std::uint64_t, std::uint64_t>> done_; // accessor → view, source
};

} // namespace

void decompressDraco(json& document, GltfBuffers& buffers, const std::string& place)
{
    Decompressor(document, buffers, place).run();
}

} // namespace sward::terrain
