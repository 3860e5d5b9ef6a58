#include "terrain/gltf/check.h"

#include "terrain/gltf/extensions.h"
#include "terrain/gltf/json.h"
#include "terrain/gltf/layout.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <string_view>
#include <vector>

namespace sward::terrain {
namespace {

using nlohmann::json;

constexpr std::size_t depthLimit = 256; // nodes inside nodes

// Objects of one kind: tinygltf needs some hundred bytes for each, and two thousand for a material.
constexpr std::size_t objectLimit = std::size_t(1) << 19;
constexpr std::size_t lookLimit = std::size_t(1) << 16; // materials, textures, images

class Checker {
public:
    Checker(const json& document, const GltfBuffers& buffers, const std::string& file,
            Diagnostics& diagnostics)
        : document_(document)
        , buffers_(buffers)
        , file_(file)
        , diagnostics_(diagnostics)
    {
    }

    json run()
    {
        checkAsset();
        // GltfBuffers has checked each buffer, and decoders have added some.
        if (buffers_.count() > 0)
            kept_["buffers"] = json(buffers_.count(), json::object());
        each("bufferViews", "bufferView", [&](const GltfObject& o) { return bufferView(o); });
        each("accessors", "accessor", [&](const GltfObject& o) { return accessor(o); });
        each("images", "image", [&](const GltfObject& o) { return image(o); });
        each("samplers", "sampler", [&](const GltfObject& o) { return sampler(o); });
        each("textures", "texture", [&](const GltfObject& o) { return texture(o); });
        each("materials", "material", [&](const GltfObject& o) { return material(o); });
        each("meshes", "mesh", [&](const GltfObject& o) { return mesh(o); });
        each("nodes", "node", [&](const GltfObject& o) { return node(o); });
        each("scenes", "scene", [&](const GltfObject& o) { return scene(o); });
        checkHierarchy();

        const GltfObject root{document_, file_, "document", 0};
        if (const auto chosen = root.count("scene", size("scenes")))
            kept_["scene"] = *chosen;
        return std::move(kept_);
    }

private:
    std::size_t size(const char* key) const
    {
        const auto found = document_.find(key);
        return found == document_.end() ? 0 : found->size();
    }

    template <typename Check>
    void each(const char* key, const char* kind, Check&& check)
    {
        const auto found = document_.find(key);
        if (found == document_.end())
            return;
        if (!found->is_array())
            fail(ErrorKind::input, "{}: {} is not an array", file_, key);
        const std::string_view name = key;
        const std::size_t limit =
            name == "materials" || name == "textures" || name == "images" ? lookLimit : objectLimit;
        if (found->size() > limit)
            fail(ErrorKind::input, "{}: {} {}, more than {}", file_, found->size(), key, limit);
        json entries = json::array();
        for (std::size_t i = 0; i < found->size(); ++i) {
            if (!(*found)[i].is_object())
                fail(ErrorKind::input, "{}: {} {} is not an object", file_, kind, i);
            entries.push_back(check(GltfObject{(*found)[i], file_, kind, i}));
        }
        // tinygltf rejects an empty array.
        if (!entries.empty())
            kept_[key] = std::move(entries);
    }

    void checkAsset()
    {
        const GltfObject root{document_, file_, "document", 0};
        const json* const found = root.object("asset");
        if (found == nullptr)
            fail(ErrorKind::input, "{}: no \"asset\": not a glTF file", file_);
        const GltfObject asset{*found, file_, "asset", 0};
        asset.text("version");
        asset.text("minVersion");
        asset.text("copyright");
        const auto version = found->value("version", std::string());
        const auto least = found->value("minVersion", std::string("2.0"));
        if (version.substr(0, 2) != "2." || least != "2.0")
            fail(ErrorKind::unsupported, "{}: glTF version \"{}\"; only 2.0 is read", file_,
                 least != "2.0" ? least : version);
        kept_["asset"] = asset.keep({"version", "copyright"});
    }

    json bufferView(const GltfObject& o)
    {
        const std::uint64_t buffer = o.requiredCount("buffer", buffers_.count());
        const std::uint64_t offset = o.count("byteOffset").value_or(0);
        const std::uint64_t length = o.requiredCount("byteLength");
        const std::uint64_t total = buffers_.bytes(buffer).size();
        if (total == 0) {
            // Only what uses it is wrong.
            views_.push_back({0, 0, buffer});
            return o.keep({"buffer", "byteOffset", "byteLength"});
        }
        if (length == 0 || offset > total || length > total - offset)
            o.failHere("bytes {} to {} are not inside buffer {} of {} bytes", offset,
                       offset + length, buffer, total);
        const auto stride = o.count("byteStride", 253);
        if (stride && (*stride < 4 || *stride % 4 != 0))
            o.failHere("byteStride is {}, not a multiple of 4 from 4 to 252", *stride);
        views_.push_back({length, stride.value_or(0)});
        return o.keep({"buffer", "byteOffset", "byteLength", "byteStride"});
    }

    json accessor(const GltfObject& o)
    {
        json kept = checkAccessor(o, views_);
        accessorCounts_.push_back(o.requiredCount("count"));
        return kept;
    }

    json image(const GltfObject& o)
    {
        o.text("name");
        o.text("uri");
        o.text("mimeType");
        const bool inView = o.count("bufferView", views_.size()).has_value();
        if (inView == (o.find("uri") != nullptr))
            o.failHere("it needs either a uri or a bufferView");
        return o.keep({"name", "uri", "mimeType", "bufferView"});
    }

    json sampler(const GltfObject& o)
    {
        o.count("wrapS", 65536);
        o.count("wrapT", 65536);
        return o.keep({"wrapS", "wrapT"});
    }

    json texture(const GltfObject& o)
    {
        if (!o.count("source", size("images")))
            if (const std::string format = imageFormatOf(o); !format.empty())
                diagnostics_.warn(
                    "{}: texture {}: {} is not read; its materials are drawn without an image",
                    file_, o.index, format);
        o.count("sampler", size("samplers"));
        return o.keep({"source", "sampler"});
    }

    json material(const GltfObject& o) { return checkMaterial(o, size("textures")); }

    json mesh(const GltfObject& o)
    {
        o.text("name");
        json kept = o.keep({"name"});
        const json* const primitives = o.find("primitives");
        if (primitives == nullptr || !primitives->is_array() || primitives->empty())
            o.failHere("it has no array of primitives");
        primitives_ += primitives->size();
        if (primitives_ > objectLimit)
            o.failHere("the meshes up to it have {} primitives, more than {}", primitives_,
                       objectLimit);
        for (const json& primitive : *primitives) {
            if (!primitive.is_object())
                o.failHere("a primitive is not an object");
            const GltfObject p = o.part(primitive);
            const json* const attributes = p.object("attributes");
            if (attributes == nullptr)
                o.failHere("a primitive has no attributes");
            for (const auto& [name, index] : attributes->items())
                o.part(*attributes).requiredCount(name.c_str(), accessorCounts_.size());
            p.count("indices", accessorCounts_.size());
            p.count("material", size("materials"));
            p.count("mode", 7);
            if (p.find("targets") != nullptr)
                diagnostics_.warn("{}: mesh {} has morph targets; its rest pose is used", file_,
                                  o.index);
            kept["primitives"].push_back(p.keep({"attributes", "indices", "material", "mode"}));
        }
        return kept;
    }

    json node(const GltfObject& o)
    {
        o.text("name");
        o.count("mesh", size("meshes"));
        o.indices("children", size("nodes"));
        o.numbers("matrix", 16);
        o.numbers("translation", 3);
        o.numbers("rotation", 4);
        o.numbers("scale", 3);
        if (o.find("skin") != nullptr)
            diagnostics_.warn("{}: node {} has a skin; its rest pose is used", file_, o.index);
        json kept =
            o.keep({"name", "mesh", "children", "matrix", "translation", "rotation", "scale"});
        if (kept.contains("children") && kept["children"].empty())
            kept.erase("children");
        keepVisibility(o, size("nodes"), kept);
        keepInstancing(o, accessorCounts_, kept);
        return kept;
    }

    json scene(const GltfObject& o)
    {
        o.text("name");
        o.indices("nodes", size("nodes"));
        std::vector<bool> isShown(size("nodes"), false);
        for (const json& node : o.value.value("nodes", json::array())) {
            const auto index = node.get<std::size_t>();
            if (isShown[index])
                o.failHere("it names node {} twice", index);
            isShown[index] = true;
        }
        return o.keep({"name", "nodes"});
    }

    // Checks that every node has at most one parent and is not its own ancestor.
    void checkHierarchy() const
    {
        if (!kept_.contains("nodes"))
            return;
        const json& nodes = kept_["nodes"];
        std::vector<bool> hasParent(nodes.size(), false);
        for (std::size_t i = 0; i < nodes.size(); ++i)
            for (const json& child : nodes[i].value("children", json::array())) {
                const auto index = child.get<std::size_t>();
                if (hasParent[index])
                    fail(ErrorKind::input, "{}: node {} is the child of more than one node", file_,
                         index);
                hasParent[index] = true;
            }

        // Visit the nodes from the roots, level by level. Unreached nodes form a cycle.
        std::vector<std::size_t> level;
        for (std::size_t i = 0; i < nodes.size(); ++i)
            if (!hasParent[i])
                level.push_back(i);
        std::size_t reached = 0;
        for (std::size_t depth = 0; !level.empty(); ++depth) {
            if (depth == depthLimit)
                fail(ErrorKind::input, "{}: node {} lies deeper than {} nodes inside nodes", file_,
                     level.front(), depthLimit);
            reached += level.size();
            std::vector<std::size_t> next;
            for (const std::size_t i : level)
                for (const json& child : nodes[i].value("children", json::array()))
                    next.push_back(child.get<std::size_t>());
            level = std::move(next);
        }
        if (reached != nodes.size())
            fail(ErrorKind::input, "{}: {} nodes form a ring of children", file_,
                 nodes.size() - reached);
    }

    const json& document_;
    const GltfBuffers& buffers_;
    const std::string& file_;
    Diagnostics& diagnostics_;
    json kept_ = json::object();
    std::size_t primitives_ = 0; // of all meshes so far
    std::vector<GltfView> views_;
    std::vector<std::uint64_t> accessorCounts_;
};

} // namespace

json checkGltf(const json& document, const GltfBuffers& buffers, const std::string& place,
               Diagnostics& diagnostics)
{
    return Checker(document, buffers, place, diagnostics).run();
}

} // namespace sward::terrain
