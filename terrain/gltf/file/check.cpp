#include "terrain/gltf/file/check.h"

#include "terrain/gltf/file/extensions.h"
#include "terrain/gltf/file/json.h"
#include "terrain/gltf/file/layout.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <string_view>
#include <vector>

namespace sward::terrain {
namespace {

using nlohmann::json;

constexpr std::size_t depthLimit = 256; // nodes inside nodes

// Objects of one kind. A node takes some hundred bytes, of JSON and here, for the three that "{},"
// has.
constexpr std::size_t objectLimit = std::size_t(1) << 19;
constexpr std::size_t lookLimit = std::size_t(1) << 16; // materials, textures, images

// Most elements of an accessor without bytes, beside one for each byte of the buffers.
constexpr std::uint64_t freeZeros = std::uint64_t(1) << 16;

ImageWrap wrapOf(std::uint64_t mode)
{
    constexpr std::uint64_t clampToEdge = 33071;
    constexpr std::uint64_t mirroredRepeat = 33648;
    if (mode == clampToEdge)
        return ImageWrap::clamp;
    return mode == mirroredRepeat ? ImageWrap::mirror : ImageWrap::repeat;
}

class Checker {
public:
    Checker(const json& document, const GltfBuffers& buffers, const std::string& file,
            Diagnostics& diagnostics)
        : document_(document)
        , buffers_(buffers)
        , file_(file)
        , diagnostics_(diagnostics)
    {
        for (std::size_t i = 0; i < buffers.count(); ++i)
            bytes_ += buffers.bytes(i).size();
    }

    GltfStructure run()
    {
        checkAsset();
        each("bufferViews", "bufferView", kept_.views,
             [&](const GltfObject& o) { return bufferView(o); });
        each("accessors", "accessor", kept_.accessors, [&](const GltfObject& o) {
            return checkAccessor(o, kept_.views, freeZeros + bytes_);
        });
        each("images", "image", kept_.images, [&](const GltfObject& o) { return image(o); });
        each("samplers", "sampler", samplers_, [&](const GltfObject& o) { return sampler(o); });
        each("textures", "texture", kept_.textures,
             [&](const GltfObject& o) { return texture(o); });
        each("materials", "material", kept_.materials,
             [&](const GltfObject& o) { return checkMaterial(o, kept_.textures.size()); });
        each("meshes", "mesh", kept_.meshes, [&](const GltfObject& o) { return mesh(o); });
        each("skins", "skin", kept_.skins, [&](const GltfObject& o) { return skin(o); });
        each("nodes", "node", kept_.nodes, [&](const GltfObject& o) { return node(o); });
        each("scenes", "scene", kept_.scenes, [&](const GltfObject& o) { return scene(o); });
        checkHierarchy();
        kept_.scene =
            GltfObject{document_, file_}.reference("scene", kept_.scenes.size(), "scenes");
        return std::move(kept_);
    }

private:
    // Entries of an array that is not checked yet.
    std::size_t size(const char* key) const
    {
        const auto found = document_.find(key);
        return found == document_.end() ? 0 : found->size();
    }

    template <typename Entry, typename Check>
    void each(const char* key, const char* kind, std::vector<Entry>& entries, Check&& check)
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
        entries.reserve(found->size());
        for (std::size_t i = 0; i < found->size(); ++i) {
            if (!(*found)[i].is_object())
                fail(ErrorKind::input, "{}: {} {} is not an object", file_, kind, i);
            entries.push_back(check(GltfObject{(*found)[i], file_, kind, i}));
        }
    }

    void checkAsset()
    {
        const json* const found = GltfObject{document_, file_}.object("asset");
        if (found == nullptr)
            fail(ErrorKind::input, "{}: no \"asset\": not a glTF file", file_);
        const GltfObject asset{*found, file_, "asset"};
        const std::string version = asset.text("version");
        const std::string least = asset.text("minVersion");
        kept_.copyright = asset.text("copyright");
        if (version.empty())
            asset.failHere("its version is missing; a glTF file says \"version\": \"2.0\"");
        const bool isNewer = !least.empty() && least != "2.0";
        if (version.substr(0, 2) != "2." || isNewer)
            fail(ErrorKind::unsupported, "{}: glTF version \"{}\"; only 2.0 is read", file_,
                 isNewer ? least : version);
    }

    GltfView bufferView(const GltfObject& o)
    {
        GltfView view;
        view.buffer =
            static_cast<std::uint64_t>(o.requiredReference("buffer", buffers_.count(), "buffers"));
        view.offset = o.count("byteOffset").value_or(0);
        view.length = o.requiredCount("byteLength");
        const std::uint64_t total = buffers_.bytes(view.buffer).size();
        // Only what uses it is wrong.
        view.isEmpty = total == 0;
        if (view.isEmpty)
            return view;
        if (view.length == 0)
            o.failHere("byteLength is 0: a view has one byte or more");
        if (view.offset > total || view.length > total - view.offset)
            o.failHere("{} bytes from byte {} on are not inside buffer {} of {} bytes", view.length,
                       view.offset, view.buffer, total);
        const auto stride = o.count("byteStride", 253);
        if (stride && (*stride < 4 || *stride % 4 != 0))
            o.failHere("byteStride is {}, not a multiple of 4 from 4 to 252", *stride);
        view.stride = stride.value_or(0);
        return view;
    }

    GltfImage image(const GltfObject& o)
    {
        GltfImage kept;
        kept.name = o.text("name");
        kept.uri = o.text("uri");
        o.text("mimeType");
        kept.view = o.reference("bufferView", kept_.views.size(), "bufferViews");
        if ((kept.view != noEntry) == (o.find("uri") != nullptr))
            o.failHere("it needs either a uri or a bufferView");
        return kept;
    }

    static GltfTexture sampler(const GltfObject& o)
    {
        GltfTexture kept;
        kept.wrapU = wrapOf(o.count("wrapS", 65536).value_or(0));
        kept.wrapV = wrapOf(o.count("wrapT", 65536).value_or(0));
        return kept;
    }

    GltfTexture texture(const GltfObject& o)
    {
        GltfTexture kept;
        if (const int index = o.reference("sampler", samplers_.size(), "samplers");
            index != noEntry)
            kept = samplers_[static_cast<std::size_t>(index)];
        kept.image = o.reference("source", kept_.images.size(), "images");
        if (kept.image == noEntry)
            if (const std::string format = imageFormatOf(o); !format.empty())
                diagnostics_.warn(
                    "{}: texture {}: {} is not read; its materials are drawn without an image",
                    file_, o.index, format);
        return kept;
    }

    GltfPrimitive primitive(const GltfObject& o)
    {
        const std::size_t accessors = kept_.accessors.size();
        GltfPrimitive kept;
        const json* const attributes = o.object("attributes");
        if (attributes == nullptr)
            o.failHere("it has no attributes");
        kept.attributes = checkAttributes(o, *attributes, accessors);
        kept.indices = o.reference("indices", accessors, "accessors");
        kept.material = o.reference("material", kept_.materials.size(), "materials");
        kept.mode = static_cast<int>(o.count("mode", 7).value_or(4));
        if (const json* const targets = o.find("targets")) {
            if (!targets->is_array())
                o.failHere("its targets are not an array");
            for (const json& target : *targets) {
                if (!target.is_object())
                    o.failHere("a morph target is not an object");
                kept.targets.push_back(checkAttributes(o, target, accessors));
            }
        }
        return kept;
    }

    GltfMesh mesh(const GltfObject& o)
    {
        GltfMesh kept;
        kept.name = o.text("name");
        const json* const primitives = o.find("primitives");
        if (primitives == nullptr || !primitives->is_array() || primitives->empty())
            o.failHere("it has no array of primitives");
        primitives_ += primitives->size();
        if (primitives_ > objectLimit)
            o.failHere("the meshes up to it have {} primitives, more than {}", primitives_,
                       objectLimit);
        kept.primitives.reserve(primitives->size());
        for (std::size_t i = 0; i < primitives->size(); ++i) {
            GltfObject p = o.part((*primitives)[i]);
            p.inner = fmt::format(", primitive {}", i);
            if (!p.value.is_object())
                p.failHere("it is not an object");
            kept.primitives.push_back(primitive(p));
            if (kept.primitives[i].targets.size() != kept.primitives[0].targets.size())
                diagnostics_.warn("{}: it has {} morph targets, and primitive 0 has {}", p.name(),
                                  kept.primitives[i].targets.size(),
                                  kept.primitives[0].targets.size());
        }
        kept.weights = o.numbers("weights", 0);
        requireWeights(o, kept.weights, kept);
        return kept;
    }

    static void requireWeights(const GltfObject& o, const std::vector<double>& weights,
                               const GltfMesh& mesh)
    {
        const std::size_t targets = mesh.primitives[0].targets.size();
        if (!weights.empty() && weights.size() != targets)
            o.failHere("{} weights for {} morph targets", weights.size(), targets);
    }

    GltfSkin skin(const GltfObject& o)
    {
        GltfSkin kept;
        if (o.find("joints") == nullptr)
            o.failHere("joints are missing");
        kept.joints = o.references("joints", size("nodes"), "nodes");
        if (kept.joints.empty())
            o.failHere("it has no joints");
        kept.inverseBind = o.reference("inverseBindMatrices", kept_.accessors.size(), "accessors");
        if (kept.inverseBind == noEntry)
            return kept;
        const GltfElements& matrices = kept_.accessors[static_cast<std::size_t>(kept.inverseBind)];
        constexpr std::uint32_t floats = 5126;
        if (matrices.type != floats || matrices.components != 16)
            o.failHere("its inverseBindMatrices, accessor {}, are no matrices of floats",
                       kept.inverseBind);
        if (matrices.count < kept.joints.size())
            o.failHere("{} inverseBindMatrices for {} joints", matrices.count, kept.joints.size());
        return kept;
    }

    GltfNode node(const GltfObject& o)
    {
        GltfNode kept;
        kept.name = o.text("name");
        kept.mesh = o.reference("mesh", kept_.meshes.size(), "meshes");
        kept.skin = o.reference("skin", kept_.skins.size(), "skins");
        kept.children = o.references("children", size("nodes"), "nodes");
        kept.placing = checkPlacing(o, diagnostics_);
        kept.instances = checkInstancing(o, kept_.accessors);
        if (kept.mesh != noEntry) {
            kept.weights = o.numbers("weights", 0);
            requireWeights(o, kept.weights, kept_.meshes[static_cast<std::size_t>(kept.mesh)]);
        }
        if (const json* const extensions = o.object("extensions")) {
            const GltfObject e = o.part(*extensions);
            if (const json* const shown = e.object("KHR_node_visibility"))
                kept.isHidden = !o.part(*shown).truth("visible").value_or(true);
            if (const json* const levels = e.object("MSFT_lod"))
                kept.coarser = o.part(*levels).references("ids", size("nodes"), "nodes");
        }
        return kept;
    }

    std::vector<int> scene(const GltfObject& o)
    {
        o.text("name");
        std::vector<int> roots = o.references("nodes", kept_.nodes.size(), "nodes");
        std::vector<int> sorted = roots;
        std::sort(sorted.begin(), sorted.end());
        if (const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
            twice != sorted.end())
            o.failHere("it names node {} twice", *twice);
        return roots;
    }

    // Checks that every node has at most one parent and is not its own ancestor.
    void checkHierarchy()
    {
        std::vector<GltfNode>& nodes = kept_.nodes;
        for (std::size_t i = 0; i < nodes.size(); ++i)
            for (const int child : nodes[i].children) {
                int& parent = nodes[static_cast<std::size_t>(child)].parent;
                if (parent != noEntry)
                    fail(ErrorKind::input, "{}: node {} is the child of more than one node", file_,
                         child);
                parent = static_cast<int>(i);
            }

        // Visit the nodes from the roots, level by level. Unreached nodes form a cycle.
        std::vector<int> level;
        for (std::size_t i = 0; i < nodes.size(); ++i)
            if (nodes[i].parent == noEntry)
                level.push_back(static_cast<int>(i));
        std::size_t reached = 0;
        for (std::size_t depth = 0; !level.empty(); ++depth) {
            if (depth == depthLimit)
                fail(ErrorKind::input, "{}: node {} lies deeper than {} nodes inside nodes", file_,
                     level.front(), depthLimit);
            reached += level.size();
            std::vector<int> next;
            for (const int i : level)
                for (const int child : nodes[static_cast<std::size_t>(i)].children)
                    next.push_back(child);
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
    GltfStructure kept_;
    std::vector<GltfTexture> samplers_; // without images
    std::size_t primitives_ = 0;        // of all meshes so far
    std::uint64_t bytes_ = 0;           // of all buffers
};

} // namespace

int accessorOf(const GltfAttributes& attributes, std::string_view name)
{
    for (const auto& [known, accessor] : attributes)
        if (known == name)
            return accessor;
    return noEntry;
}

GltfStructure checkGltf(const json& document, const GltfBuffers& buffers, const std::string& place,
                        Diagnostics& diagnostics)
{
    return Checker(document, buffers, place, diagnostics).run();
}

} // namespace sward::terrain
