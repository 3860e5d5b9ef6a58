#include "terrain/gltf/export.h"

#include "core/error.h"
#include "core/files/atomic_file.h"
#include "core/json/json_text.h"
#include "terrain/gltf/file/container.h"

#include <nlohmann/json.hpp>
#include <stb/stb_image_write.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <span>
#include <sstream>
#include <utility>

namespace sward::terrain {
namespace {

// The triangles of one node in one material, with the vertices they use.
struct Part {
    std::vector<std::uint32_t> vertices; // indices into the mesh
    std::vector<std::uint32_t> indices;  // into `vertices`
};

class Exporter {
public:
    explicit Exporter(const GroundMesh& mesh)
        : mesh_(mesh)
    {
    }

    tinygltf::Model run()
    {
        model_.asset.version = "2.0";
        model_.asset.generator = "Sward";
        model_.asset.copyright = toUtf8(mesh_.copyright);
        model_.buffers.emplace_back();
        addMaterials();
        hasUvs_ = std::any_of(mesh_.uvs.begin(), mesh_.uvs.end(),
                              [](const glm::vec2& uv) { return uv != glm::vec2(0.0f); });

        // Sort the triangles by node, then by material, in their old order.
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::size_t>> groups;
        for (std::size_t i = 0; i < mesh_.triangles.size(); ++i)
            groups[{mesh_.nodeOf[i], mesh_.materialOf[i]}].push_back(i);

        tinygltf::Scene scene;
        for (auto group = groups.begin(); group != groups.end();) {
            const std::uint32_t node = group->first.first;
            tinygltf::Mesh mesh;
            mesh.name = toUtf8(mesh_.nodes[node]);
            for (; group != groups.end() && group->first.first == node; ++group)
                mesh.primitives.push_back(primitiveOf(group->second, group->first.second));
            scene.nodes.push_back(addNode(std::move(mesh)));
        }
        model_.scenes.push_back(std::move(scene));
        model_.defaultScene = 0;
        return std::move(model_);
    }

private:
    int addView(const void* bytes, std::size_t size, int target)
    {
        std::vector<unsigned char>& buffer = model_.buffers[0].data;
        buffer.resize((buffer.size() + 3) / 4 * 4, 0);
        tinygltf::BufferView view;
        view.buffer = 0;
        view.byteOffset = buffer.size();
        view.byteLength = size;
        view.target = target;
        const auto* const first = static_cast<const unsigned char*>(bytes);
        buffer.insert(buffer.end(), first, first + size);
        model_.bufferViews.push_back(view);
        return static_cast<int>(model_.bufferViews.size() - 1);
    }

    template <typename Value>
    int addAccessor(const std::vector<Value>& values, int componentType, int type, int target)
    {
        tinygltf::Accessor accessor;
        accessor.bufferView = addView(values.data(), values.size() * sizeof(Value), target);
        accessor.componentType = componentType;
        accessor.type = type;
        accessor.count = values.size();
        model_.accessors.push_back(std::move(accessor));
        return static_cast<int>(model_.accessors.size() - 1);
    }

    // The entries of `values` for the vertices of `part`.
    template <typename Value>
    int addAttribute(const std::vector<Value>& values, const Part& part, int type)
    {
        std::vector<Value> chosen;
        chosen.reserve(part.vertices.size());
        for (const std::uint32_t vertex : part.vertices)
            chosen.push_back(values[vertex]);
        return addAccessor(chosen, TINYGLTF_COMPONENT_TYPE_FLOAT, type,
                           TINYGLTF_TARGET_ARRAY_BUFFER);
    }

    Part partOf(const std::vector<std::size_t>& triangles)
    {
        Part part;
        for (const std::size_t i : triangles)
            for (glm::length_t corner = 0; corner < 3; ++corner)
                part.vertices.push_back(mesh_.triangles[i][corner]);
        part.indices = part.vertices;

        // Keep the vertices in their order, each once.
        std::sort(part.vertices.begin(), part.vertices.end());
        part.vertices.erase(std::unique(part.vertices.begin(), part.vertices.end()),
                            part.vertices.end());
        for (std::uint32_t& index : part.indices)
            index = static_cast<std::uint32_t>(
                std::lower_bound(part.vertices.begin(), part.vertices.end(), index) -
                part.vertices.begin());
        return part;
    }

    tinygltf::Primitive primitiveOf(const std::vector<std::size_t>& triangles,
                                    std::uint32_t material)
    {
        const Part part = partOf(triangles);
        tinygltf::Primitive primitive;
        primitive.mode = TINYGLTF_MODE_TRIANGLES;
        primitive.material = static_cast<int>(material);
        const int positions = addAttribute(mesh_.positions, part, TINYGLTF_TYPE_VEC3);
        addBounds(part, model_.accessors[static_cast<std::size_t>(positions)]);
        primitive.attributes["POSITION"] = positions;
        primitive.attributes["NORMAL"] = addAttribute(mesh_.normals, part, TINYGLTF_TYPE_VEC3);
        if (hasUvs_)
            primitive.attributes["TEXCOORD_0"] = addAttribute(mesh_.uvs, part, TINYGLTF_TYPE_VEC2);
        if (mesh_.hasColors)
            primitive.attributes["COLOR_0"] =
                addAttribute(mesh_.materials[material].srgbColors ? linearColors() : mesh_.colors,
                             part, TINYGLTF_TYPE_VEC4);
        primitive.indices = addAccessor(part.indices, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                        TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
        return primitive;
    }

    // Colours as COLOR_0 has them: a bake takes sRGB for a square, and reads the same again.
    std::vector<glm::vec4> linearColors() const
    {
        std::vector<glm::vec4> colors = mesh_.colors;
        for (glm::vec4& color : colors)
            color = {color.x * color.x, color.y * color.y, color.z * color.z, color.w};
        return colors;
    }

    void addBounds(const Part& part, tinygltf::Accessor& accessor)
    {
        Aabb box;
        for (const std::uint32_t vertex : part.vertices)
            box.add(mesh_.positions[vertex]);
        for (glm::length_t axis = 0; axis < 3; ++axis) {
            accessor.minValues.push_back(static_cast<double>(box.low[axis]));
            accessor.maxValues.push_back(static_cast<double>(box.high[axis]));
        }
    }

    int addNode(tinygltf::Mesh mesh)
    {
        tinygltf::Node node;
        node.name = mesh.name;
        node.mesh = static_cast<int>(model_.meshes.size());
        if (mesh_.origin != glm::dvec3(0.0))
            node.translation = {mesh_.origin.x, mesh_.origin.y, mesh_.origin.z};
        model_.meshes.push_back(std::move(mesh));
        model_.nodes.push_back(std::move(node));
        return static_cast<int>(model_.nodes.size() - 1);
    }

    void addMaterials()
    {
        for (const GroundImage& image : mesh_.images)
            addImage(image);
        for (const GroundMaterial& ground : mesh_.materials) {
            tinygltf::Material material;
            material.name = toUtf8(ground.name);
            material.doubleSided = ground.doubleSided;
            if (ground.alphaCutoff > 0.0f) {
                material.alphaMode = "MASK";
                material.alphaCutoff = static_cast<double>(ground.alphaCutoff);
            }
            auto& surface = material.pbrMetallicRoughness;
            const glm::dvec4 color(ground.baseColor);
            surface.baseColorFactor = {color.x, color.y, color.z, color.w};
            surface.roughnessFactor = static_cast<double>(ground.roughness);
            surface.metallicFactor = static_cast<double>(ground.metallic);
            if (ground.image != GroundMaterial::noImage)
                surface.baseColorTexture.index = static_cast<int>(ground.image);
            model_.materials.push_back(std::move(material));
        }
    }

    // A texture and its image share their index.
    void addImage(const GroundImage& ground)
    {
        std::vector<unsigned char> png;
        const auto append = [](void* to, void* bytes, int size) {
            const auto* const first = static_cast<const unsigned char*>(bytes);
            static_cast<std::vector<unsigned char>*>(to)->insert(
                static_cast<std::vector<unsigned char>*>(to)->end(), first, first + size);
        };
        if (stbi_write_png_to_func(append, &png, static_cast<int>(ground.width),
                                   static_cast<int>(ground.height), 4, ground.rgba.data(),
                                   static_cast<int>(4 * ground.width)) == 0)
            fail(ErrorKind::runtime, "image \"{}\" cannot be encoded as PNG", ground.name);
        tinygltf::Image image;
        image.name = toUtf8(ground.name);
        image.mimeType = "image/png";
        image.bufferView = addView(png.data(), png.size(), 0);
        tinygltf::Texture texture;
        texture.source = static_cast<int>(model_.images.size());
        model_.images.push_back(std::move(image));
        model_.textures.push_back(std::move(texture));
    }

    const GroundMesh& mesh_;
    tinygltf::Model model_;
    bool hasUvs_ = false;
};

// Gives a texture with a sampler to every material whose image does not repeat. tinygltf cannot:
// Debian's tinygltf.so and its header disagree on a sampler's size.
std::string withWraps(std::string file, const GroundMesh& mesh)
{
    const auto repeats = [](const GroundMaterial& material) {
        return material.image == GroundMaterial::noImage ||
               (material.wrapU == ImageWrap::repeat && material.wrapV == ImageWrap::repeat);
    };
    if (std::all_of(mesh.materials.begin(), mesh.materials.end(), repeats))
        return file;
    const auto mode = [](ImageWrap wrap) {
        return wrap == ImageWrap::clamp    ? TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE
               : wrap == ImageWrap::mirror ? TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT
                                           : TINYGLTF_TEXTURE_WRAP_REPEAT;
    };
    const GltfParts parts = splitGltf(std::as_bytes(std::span(file)), "export");
    nlohmann::json document = nlohmann::json::parse(parts.json);
    for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
        const GroundMaterial& material = mesh.materials[i];
        if (repeats(material))
            continue;
        document["textures"].push_back(
            {{"source", material.image}, {"sampler", document["samplers"].size()}});
        document["samplers"].push_back(
            {{"wrapS", mode(material.wrapU)}, {"wrapT", mode(material.wrapV)}});
        document["materials"][i]["pbrMetallicRoughness"]["baseColorTexture"]["index"] =
            document["textures"].size() - 1;
    }
    const std::vector<unsigned char> joined = joinGlb(jsonText(document), parts.binary);
    return {joined.begin(), joined.end()};
}

} // namespace

void exportGltf(const GroundMesh& mesh, const std::filesystem::path& path, bool overwrite)
{
    // Check before the work, then write a temporary file and rename it.
    refuseOverwrite(path, overwrite);
    const tinygltf::Model model = Exporter(mesh).run();
    std::ostringstream stream;
    tinygltf::TinyGLTF writer;
    if (!writer.WriteGltfSceneToStream(&model, stream, false, true))
        fail(ErrorKind::runtime, "{}: glTF cannot be written", path.string());
    AtomicFile file(path, overwrite);
    file.write(std::string_view(withWraps(stream.str(), mesh)));
    file.commit();
}

} // namespace sward::terrain
