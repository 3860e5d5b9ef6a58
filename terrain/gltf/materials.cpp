#include "terrain/gltf/materials.h"

#include "core/error.h"
#include "core/files/mapped_file.h"
#include "terrain/gltf/file/uri.h"
#include "terrain/image/image_decode.h"

#include <algorithm>
#include <cstdint>
#include <map>

namespace sward::terrain {
namespace {

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
        if (textureIndex == noEntry)
            return GroundMaterial::noImage;
        const int source =
            model_.structure.textures.at(static_cast<std::size_t>(textureIndex)).image;
        // Without a source, the image is in an extension; checkGltf() has warned of it.
        if (source == noEntry)
            return GroundMaterial::noImage;
        // Images with the same name or view are decoded once.
        const GltfImage& image = model_.structure.images.at(static_cast<std::size_t>(source));
        const std::string key = image.view != noEntry  ? fmt::format("view {}", image.view)
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
        const GltfImage& image = model_.structure.images.at(static_cast<std::size_t>(source));
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
        if (image.view != noEntry)
            return decodeImage(model_.view(static_cast<std::size_t>(image.view)), place, budget_,
                               diagnostics_);
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
            const MappedFile file(fileBeside(model_.path, image.uri, place, diagnostics_));
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

} // namespace

std::vector<GltfUvSource> importGltfMaterials(const GltfModel& file, std::uint32_t storedChannels,
                                              const std::string& place, Soup& soup,
                                              Diagnostics& diagnostics)
{
    const GltfStructure& model = file.structure;
    std::vector<GltfUvSource> sources;
    Images images(file, storedChannels, place, soup, diagnostics);
    for (std::size_t i = 0; i < model.materials.size(); ++i) {
        const GltfMaterial& material = model.materials[i];
        GroundMaterial ground;
        ground.name = material.name.empty() ? fmt::format("material {}", i) : material.name;
        ground.baseColor = material.color;
        ground.roughness = material.roughness;
        ground.metallic = material.metallic;
        ground.doubleSided = material.doubleSided;
        ground.alphaCutoff = material.alphaCutoff;
        ground.image = images.indexOf(material.texture);
        if (material.texture != noEntry) {
            const GltfTexture& texture =
                model.textures.at(static_cast<std::size_t>(material.texture));
            ground.wrapU = texture.wrapU;
            ground.wrapV = texture.wrapV;
        }
        soup.materials.push_back(std::move(ground));
        sources.push_back(material.uvs);
    }
    soup.materials.push_back({.name = "default", .baseColor = glm::vec4(1.0f)});
    sources.emplace_back();
    return sources;
}

} // namespace sward::terrain
