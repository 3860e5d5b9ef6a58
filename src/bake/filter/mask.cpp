#include "bake/filter/mask.h"

#include "core/error.h"
#include "core/expect.h"
#include "terrain/image/image_sampling.h"

#include <glm/common.hpp>

namespace sward::bake {
namespace {

constexpr const char* channelNames = "RGBA";
constexpr const char* groundGreenText = "ground:green";
constexpr const char* invertWord = ":invert";

glm::dvec2 uvAt(const terrain::GroundMesh& ground, const RootSample& root)
{
    const glm::uvec3 corners = ground.triangles[root.triangle];
    const auto b = static_cast<double>(root.barycentric.x);
    const auto c = static_cast<double>(root.barycentric.y);
    return (1.0 - b - c) * glm::dvec2(ground.uvs[corners.x]) +
           b * glm::dvec2(ground.uvs[corners.y]) + c * glm::dvec2(ground.uvs[corners.z]);
}

double colorAt(const terrain::GroundMesh& ground, const RootSample& root, glm::length_t channel)
{
    const glm::uvec3 corners = ground.triangles[root.triangle];
    const float b = root.barycentric.x;
    const float c = root.barycentric.y;
    return double((1.0f - b - c) * ground.colors[corners.x][channel] +
                  b * ground.colors[corners.y][channel] + c * ground.colors[corners.z][channel]);
}

// Removes `end` from the end of the text, if present.
bool takeEnd(std::string& text, const std::string& end)
{
    if (!text.ends_with(end))
        return false;
    text.resize(text.size() - end.size());
    return true;
}

// Removes ":C" from the end of the text.
std::optional<int> takeChannel(std::string& text)
{
    for (int channel = 0; channel < 4; ++channel)
        if (takeEnd(text, std::string(":") + channelNames[channel]))
            return channel;
    return std::nullopt;
}

} // namespace

double Mask::at(const terrain::GroundMesh& ground, const RootSample& root, double green) const
{
    double value = 0.0;
    if (source == Source::groundGreen) {
        value = green;
    } else if (source == Source::vertexColor) {
        value = colorAt(ground, root, channel);
    } else if (source == Source::texture) {
        value = terrain::valueAt(*image, uvAt(ground, root));
    } else if (const terrain::GroundMaterial& own =
                   ground.materials[ground.materialOf[root.triangle]];
               own.image != terrain::GroundMaterial::noImage) {
        value = terrain::valueAt(ground.images[own.image], channel, {own.wrapU, own.wrapV},
                                 uvAt(ground, root));
    }
    return glm::clamp(invert ? 1.0 - value : value, 0.0, 1.0);
}

std::optional<Mask> readMask(const std::string& text)
{
    Mask mask;
    std::string rest = text;
    mask.invert = takeEnd(rest, invertWord);
    if (rest == groundGreenText) {
        mask.source = Mask::Source::groundGreen;
        return mask;
    }
    const std::optional<int> channel = takeChannel(rest);
    mask.channel = channel.value_or(0);
    const std::string texture = "texture:";
    if (rest == "material-texture" && channel) {
        mask.source = Mask::Source::materialTexture;
    } else if (rest.starts_with(texture) && rest.size() > texture.size()) {
        mask.source = Mask::Source::texture;
        mask.file = rest.substr(texture.size());
    } else if (rest != "vertex-color" || !channel) {
        return std::nullopt;
    }
    return mask;
}

Mask parseMask(const std::string& text)
{
    const std::optional<Mask> mask = readMask(text);
    if (!mask)
        fail(ErrorKind::usage,
             "--mask is \"{}\"; expected ground:green, or vertex-color:C, material-texture:C or "
             "texture:FILE:C with C one of R G B A, and perhaps :invert",
             text);
    return *mask;
}

std::string textOf(const Mask& mask)
{
    if (mask.source == Mask::Source::groundGreen)
        return fmt::format("{}{}", groundGreenText, mask.invert ? invertWord : "");
    const std::string source = mask.source == Mask::Source::vertexColor ? "vertex-color"
                               : mask.source == Mask::Source::texture   ? "texture:" + mask.file
                                                                        : "material-texture";
    return fmt::format("{}:{}{}", source, channelNames[mask.channel],
                       mask.invert ? invertWord : "");
}

void loadImages(std::vector<Mask>& masks)
{
    for (Mask& mask : masks) {
        if (mask.source != Mask::Source::texture || mask.image != nullptr)
            continue;
        for (const Mask& other : masks)
            if (other.file == mask.file && other.channel == mask.channel && other.image != nullptr)
                mask.image = other.image;
        if (mask.image == nullptr)
            mask.image = std::make_shared<const terrain::ChannelImage>(
                terrain::readChannel(mask.file, mask.channel));
    }
}

void checkMasks(const std::vector<Mask>& masks, const terrain::GroundMesh& ground)
{
    // Find materials that bear grass, and those with nonzero texture coordinates.
    std::vector<bool> bears(ground.materials.size(), false);
    std::vector<bool> isMapped(ground.materials.size(), false);
    for (std::size_t t = 0; !masks.empty() && t < ground.triangles.size(); ++t) {
        const std::uint32_t material = ground.materialOf[t];
        if (ground.bears[t] == 0 || isMapped[material])
            continue;
        bears[material] = true;
        for (glm::length_t corner = 0; corner < 3; ++corner)
            if (ground.uvs[ground.triangles[t][corner]] != glm::vec2(0.0f))
                isMapped[material] = true;
    }

    for (const Mask& mask : masks) {
        expect(mask.source != Mask::Source::texture || mask.image != nullptr,
               "loadImages() was not called");
        if (mask.source == Mask::Source::vertexColor && !ground.hasColors)
            fail(ErrorKind::input, "--mask {}: the ground has no vertex colours (glTF COLOR_0)",
                 textOf(mask));
        const bool isMappedMask =
            mask.source == Mask::Source::texture || mask.source == Mask::Source::materialTexture;
        for (std::size_t m = 0; isMappedMask && m < bears.size(); ++m) {
            const terrain::GroundMaterial& material = ground.materials[m];
            if (!bears[m])
                continue;
            if (mask.source == Mask::Source::materialTexture &&
                material.image == terrain::GroundMaterial::noImage)
                fail(ErrorKind::input,
                     "--mask {}: material \"{}\" has no base colour image; --material chooses "
                     "which materials bear grass",
                     textOf(mask), material.name);
            if (!isMapped[m])
                fail(ErrorKind::input,
                     "--mask {}: material \"{}\" has no texture coordinates; --material chooses "
                     "which materials bear grass",
                     textOf(mask), material.name);
        }
    }
}

} // namespace sward::bake
