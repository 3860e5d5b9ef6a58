#include "terrain/gltf/materials.h"

#include "core/error.h"
#include "core/exact_math.h"
#include "core/mapped_file.h"
#include "terrain/gltf/uri.h"
#include "terrain/image/image_decode.h"

#include <algorithm>
#include <cstdint>
#include <map>

namespace sward::terrain {
namespace {

// The index converts to int and std::size_t (tinygltf versions differ) without a change of sign.
double numberOf(const tinygltf::Value& object, const char* key, std::uint8_t index,
                double otherwise)
{
    if (!object.Has(key))
        return otherwise;
    const tinygltf::Value& value = object.Get(key);
    if (value.IsNumber())
        return value.GetNumberAsDouble();
    return value.IsArray() && value.Get(index).IsNumber() ? value.Get(index).GetNumberAsDouble()
                                                          : otherwise;
}

// uv' = translation · rotation · scale · uv, as KHR_texture_transform has it.
GltfUvSource uvSourceOf(const tinygltf::TextureInfo& texture)
{
    GltfUvSource source;
    source.set = std::max(texture.texCoord, 0);
    const auto found = texture.extensions.find("KHR_texture_transform");
    if (found == texture.extensions.end())
        return source;
    const tinygltf::Value& move = found->second;
    source.set = static_cast<int>(numberOf(move, "texCoord", 0, source.set));
    const SinCos turn = exactSinCos(std::clamp(numberOf(move, "rotation", 0, 0.0), -1e6, 1e6));
    const double scaleU = numberOf(move, "scale", 0, 1.0);
    const double scaleV = numberOf(move, "scale", 1, 1.0);
    source.placing[0] = glm::vec2(glm::dvec2(turn.cos * scaleU, -turn.sin * scaleU));
    source.placing[1] = glm::vec2(glm::dvec2(turn.sin * scaleV, turn.cos * scaleV));
    source.placing[2] =
        glm::vec2(glm::dvec2(numberOf(move, "offset", 0, 0.0), numberOf(move, "offset", 1, 0.0)));
    return source;
}

// Decodes each image once, and only images of some material.
class Images {
public:
    Images(const GltfModel& model, std::uint32_t storedChannels, const std::string& place,
           Soup& soup, Diagnostics& diagnostics)
        : model_(model)
        , place_(place)
        , soup_(soup)
        , diagnostics_(diagnostics)
    {
        budget_.storedChannels = storedChannels;
    }

    std::uint32_t indexOf(int textureIndex)
    {
        if (textureIndex < 0)
            return GroundMaterial::noImage;
        const int source =
            model_.structure.textures.at(static_cast<std::size_t>(textureIndex)).source;
        // Without a source, the image is in an extension; checkGltf() has warned of it.
        if (source < 0)
            return GroundMaterial::noImage;
        // Images with the same name or view are decoded once.
        const GltfImage& image = model_.images.at(static_cast<std::size_t>(source));
        const std::string key = image.view             ? fmt::format("view {}", *image.view)
                                : isDataUri(image.uri) ? fmt::format("image {}", source)
                                                       : "uri " + image.uri;
        const auto [known, isNew] = indices_.try_emplace(key, GroundMaterial::noImage);
        if (isNew)
            known->second = decode(source);
        return known->second;
    }

private:
    std::uint32_t decode(int source)
    {
        const GltfImage& image = model_.images.at(static_cast<std::size_t>(source));
        std::string place = fmt::format("{}: image {}", place_, source);
        if (!image.name.empty())
            place += " \"" + image.name + "\"";
        GroundImage decoded = decode(image, place);
        if (decoded.width == 0)
            return GroundMaterial::noImage;
        decoded.name = image.name.empty() && !isDataUri(image.uri) ? image.uri : image.name;
        soup_.images.push_back(std::move(decoded));
        return static_cast<std::uint32_t>(soup_.images.size() - 1);
    }

    // Decodes from a URI, a file or a view.
    GroundImage decode(const GltfImage& image, const std::string& place)
    {
        if (image.view)
            return decodeImage(model_.view(*image.view), place, budget_, diagnostics_);
        if (isDataUri(image.uri)) {
            const auto bytes = decodeDataUri(image.uri);
            return decodeImage(bytes.value_or(std::vector<std::byte>()), place, budget_,
                               diagnostics_);
        }
        if (isOnNetwork(image.uri)) {
            diagnostics_.warn("{}: {} is on the network, and nothing is fetched; its material is "
                              "drawn without an image",
                              place, image.uri);
            return {};
        }
        try {
            const MappedFile file(fileBeside(model_.path, image.uri));
            return decodeImage(file.bytes(), place, budget_, diagnostics_);
        } catch (const Error&) {
            diagnostics_.warn("{}: {} cannot be read; its material is drawn without an image",
                              place, image.uri);
            return {};
        }
    }

    const GltfModel& model_;
    const std::string& place_;
    Soup& soup_;
    Diagnostics& diagnostics_;
    ImageBudget budget_;
    std::map<std::string, std::uint32_t> indices_;
};

float unitInterval(double value)
{
    return static_cast<float>(std::clamp(value, 0.0, 1.0));
}

} // namespace

std::vector<GltfUvSource> importGltfMaterials(const GltfModel& file, std::uint32_t storedChannels,
                                              const std::string& place, Soup& soup,
                                              Diagnostics& diagnostics)
{
    const tinygltf::Model& model = file.structure;
    std::vector<GltfUvSource> sources;
    Images images(file, storedChannels, place, soup, diagnostics);
    for (std::size_t i = 0; i < model.materials.size(); ++i) {
        const tinygltf::Material& material = model.materials[i];
        const tinygltf::PbrMetallicRoughness& surface = material.pbrMetallicRoughness;
        GroundMaterial ground;
        ground.name = material.name.empty() ? fmt::format("material {}", i) : material.name;
        ground.baseColor = glm::vec4(1.0f);
        for (std::size_t c = 0; c < std::min<std::size_t>(surface.baseColorFactor.size(), 4); ++c)
            ground.baseColor[int(c)] = unitInterval(surface.baseColorFactor[c]);
        ground.roughness = unitInterval(surface.roughnessFactor);
        ground.metallic = unitInterval(surface.metallicFactor);
        ground.doubleSided = material.doubleSided;
        if (material.alphaMode == "MASK")
            ground.alphaCutoff = static_cast<float>(std::clamp(material.alphaCutoff, 0.0, 1e6));
        ground.image = images.indexOf(surface.baseColorTexture.index);
        if (surface.baseColorTexture.index >= 0) {
            const auto texture = static_cast<std::size_t>(surface.baseColorTexture.index);
            ground.wrapU = file.wraps.at(texture).u;
            ground.wrapV = file.wraps.at(texture).v;
        }
        soup.materials.push_back(std::move(ground));
        sources.push_back(uvSourceOf(surface.baseColorTexture));
    }
    soup.materials.push_back({.name = "default", .baseColor = glm::vec4(1.0f)});
    sources.emplace_back();
    return sources;
}

} // namespace sward::terrain
