#include "bake/mask/mask.h"

#include "bake/mask/map_mask.h"
#include "bake/mask/mask_words.h"
#include "core/error.h"
#include "core/expect.h"
#include "terrain/image/image_sampling.h"

#include <glm/common.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <string_view>

namespace sward::bake {
namespace {

constexpr const char* channelNames = "RGBA";
constexpr const char* groundGreenText = "ground:green";
constexpr const char* rasterText = "raster:";
constexpr const char* invertWord = ":invert";
constexpr const char* transformWord = ":transform";
constexpr const char* whiteWord = ":or-white";
constexpr int setLimit = 16; // of colours or texture coordinates

// The number of a set of colours or texture coordinates, without leading zeros.
std::optional<int> setNumber(std::string_view text)
{
    int number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || number < 0 ||
        number >= setLimit || (text.size() > 1 && text[0] == '0'))
        return std::nullopt;
    return number;
}

template <typename Value>
glm::dvec2 uvAt(const terrain::GroundMesh& ground, const std::vector<Value>& uvs,
                const RootSample& root)
{
    const glm::uvec3 corners = ground.triangles[root.triangle];
    const auto b = static_cast<double>(root.barycentric.x);
    const auto c = static_cast<double>(root.barycentric.y);
    return (1.0 - b - c) * glm::dvec2(uvs[corners.x]) + b * glm::dvec2(uvs[corners.y]) +
           c * glm::dvec2(uvs[corners.z]);
}

// In the world, by triangle and barycentrics alone.
glm::dvec3 placeOf(const terrain::GroundMesh& ground, const RootSample& root)
{
    const glm::uvec3 corners = ground.triangles[root.triangle];
    const auto b = static_cast<double>(root.barycentric.x);
    const auto c = static_cast<double>(root.barycentric.y);
    return ground.origin + (1.0 - b - c) * glm::dvec3(ground.positions[corners.x]) +
           b * glm::dvec3(ground.positions[corners.y]) +
           c * glm::dvec3(ground.positions[corners.z]);
}

double colorAt(const terrain::GroundMesh& ground, const std::vector<glm::vec4>& colors,
               const RootSample& root, glm::length_t channel)
{
    const glm::uvec3 corners = ground.triangles[root.triangle];
    const float b = root.barycentric.x;
    const float c = root.barycentric.y;
    return double((1.0f - b - c) * colors[corners.x][channel] + b * colors[corners.y][channel] +
                  c * colors[corners.z][channel]);
}

// Value of the material's own image, as the file stores it.
double ownImageAt(const terrain::GroundMesh& ground, const terrain::GroundMaterial& material,
                  const RootSample& root, int channel)
{
    const terrain::GroundImage& image = ground.images[material.image];
    const terrain::ImageWraps wraps{material.wrapU, material.wrapV};
    const glm::dvec2 uv = uvAt(ground, ground.uvs, root);
    const auto& stored = image.stored[static_cast<std::size_t>(channel)];
    return stored != nullptr ? terrain::valueAt(*stored, wraps, uv)
                             : terrain::valueAt(image, channel, wraps, uv);
}

// Removes ":uvN" or ":transform" from the end of the text; the attribute that it names.
std::string takeCoordinates(std::string& text)
{
    constexpr std::size_t digits = 2;
    if (text.ends_with(transformWord)) {
        text.resize(text.size() - std::string_view(transformWord).size());
        return terrain::materialCoordinates;
    }
    const std::size_t colon = text.rfind(":uv");
    if (colon == std::string::npos)
        return {};
    const std::optional<int> set = setNumber(std::string_view(text).substr(colon + 3));
    if (!set || text.size() - colon - 3 > digits)
        return {};
    text.resize(colon);
    return fmt::format("TEXCOORD_{}", *set);
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

// "A..B"; false, and nothing taken, for any other text.
bool takeRange(Mask& mask, std::string_view word)
{
    const std::optional<glm::dvec2> range = rangeOf(word);
    if (!range)
        return false;
    mask.low = range->x;
    mask.high = range->y;
    return true;
}

// "FILE[:bN][:V,V,…]" or "FILE[:bN][:A..B]"
std::optional<Mask> readRasterMask(Mask mask, std::string text)
{
    mask.source = Mask::Source::raster;
    if (const std::size_t colon = text.rfind(':'); colon != std::string::npos) {
        const std::string_view word = std::string_view(text).substr(colon + 1);
        mask.classes = classesOf(word);
        if (!mask.classes.empty() || takeRange(mask, word))
            text.resize(colon);
    }
    if (const std::size_t colon = text.rfind(":b"); colon != std::string::npos) {
        const std::string_view number = std::string_view(text).substr(colon + 2);
        const auto [stop, error] =
            std::from_chars(number.data(), number.data() + number.size(), mask.band);
        if (error == std::errc() && stop == number.data() + number.size() && mask.band >= 1)
            text.resize(colon);
        else
            mask.band = 1;
    }
    if (text.empty())
        return std::nullopt;
    mask.file = std::move(text);
    return mask;
}

// What an attribute is, in an error.
std::string describe(const std::string& attribute)
{
    if (attribute == terrain::materialCoordinates)
        return "no texture coordinates for its material's image";
    if (attribute.starts_with("TEXCOORD_"))
        return fmt::format("no texture coordinates {}; :uv1 or :transform choose others, if it has "
                           "some",
                           attribute);
    if (attribute.starts_with("COLOR_"))
        return fmt::format("no vertex colours (glTF {}), and :or-white takes it for white",
                           attribute);
    return fmt::format("no vertex attribute {}, and :or-white takes it for white", attribute);
}

// Throws if a part of the file that bears grass lacks what the mask reads of its vertices.
void checkParts(const Mask& mask, const terrain::GroundMesh& ground)
{
    const std::string name = mask.attributeName();
    const terrain::AttributeGap* first = nullptr;
    std::uint32_t material = 0;
    std::size_t more = 0;
    for (const terrain::AttributeGap& gap : ground.attributes.gaps) {
        if (gap.attribute != name || mask.orWhite)
            continue;
        const auto begin = ground.bears.begin() + gap.first;
        const auto end = ground.bears.begin() + gap.end;
        const auto bearing = std::find(begin, end, std::uint8_t(1));
        if (bearing == end)
            continue;
        if (first == nullptr)
            material = ground.materialOf[std::size_t(bearing - ground.bears.begin())];
        more += first == nullptr ? 0 : 1;
        first = first == nullptr ? &gap : first;
    }
    if (first != nullptr)
        fail(ErrorKind::input,
             "--mask {}: {}: material \"{}\" has {}{}; --material and --node choose what bears "
             "grass",
             textOf(mask), ground.attributes.parts[first->part], ground.materials[material].name,
             describe(name), more == 0 ? "" : fmt::format(", nor have {} other parts", more));
    const terrain::VertexAttribute* const own = ground.attributes.find(name);
    if (own == nullptr && mask.orWhite && name != "COLOR_0")
        fail(ErrorKind::input, "--mask {}: no part of the ground has {}", textOf(mask), name);
    if (own != nullptr && mask.source == Mask::Source::vertexColor &&
        own->components <= static_cast<std::uint32_t>(mask.channel))
        fail(ErrorKind::input, "--mask {}: {} has {} components, and {} would be number {}",
             textOf(mask), name, own->components, channelNames[mask.channel], mask.channel + 1);
}

} // namespace

std::string Mask::attributeName() const
{
    if (!attribute.empty())
        return attribute;
    switch (source) {
    case Source::vertexColor:
        return "COLOR_0";
    case Source::texture:
        return "TEXCOORD_0";
    case Source::materialTexture:
        return terrain::materialCoordinates;
    case Source::groundGreen:
    case Source::raster:
        break;
    }
    return {};
}

double Mask::at(const terrain::GroundMesh& ground, const RootSample& root, double green) const
{
    // What is no attribute of its own is in the ground's colours or texture coordinates.
    const terrain::VertexAttribute* const own =
        ground.attributes.list.empty() ? nullptr : ground.attributes.find(attributeName());
    double value = 0.0;
    if (source == Source::groundGreen) {
        value = green;
    } else if (source == Source::raster) {
        value = map->at(placeOf(ground, root));
        value = classes.empty() ? (value - low) / (high - low) : value;
        // Without data there is no grass, inverted or not.
        if (std::isnan(value))
            return 0.0;
    } else if (source == Source::vertexColor) {
        value = colorAt(ground, own != nullptr ? own->values : ground.colors, root, channel);
    } else if (source == Source::texture) {
        value = terrain::valueAt(*image, own != nullptr ? uvAt(ground, own->values, root)
                                                        : uvAt(ground, ground.uvs, root));
    } else if (const terrain::GroundMaterial& material =
                   ground.materials[ground.materialOf[root.triangle]];
               material.image != terrain::GroundMaterial::noImage) {
        value = ownImageAt(ground, material, root, channel);
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
    if (rest.starts_with(rasterText) && rest.size() > std::string_view(rasterText).size())
        return readRasterMask(std::move(mask), rest.substr(std::string_view(rasterText).size()));
    const std::string texture = "texture:";
    const std::string color = "vertex-color";
    mask.orWhite = rest.starts_with(color) && takeEnd(rest, whiteWord);
    if (rest.starts_with(texture))
        mask.attribute = takeCoordinates(rest);
    const std::optional<int> channel = takeChannel(rest);
    mask.channel = channel.value_or(0);
    if (rest == "material-texture" && channel) {
        mask.source = Mask::Source::materialTexture;
    } else if (rest.starts_with(texture) && rest.size() > texture.size()) {
        mask.source = Mask::Source::texture;
        mask.file = rest.substr(texture.size());
    } else if (rest.starts_with(color + ":_")) {
        mask.attribute = rest.substr(color.size() + 1);
    } else if (rest.starts_with(color) && channel) {
        const std::string number = rest.substr(color.size());
        const std::optional<int> set = number.empty() ? 0 : setNumber(number);
        if (!set)
            return std::nullopt;
        mask.attribute = number.empty() ? "" : fmt::format("COLOR_{}", *set);
    } else {
        return std::nullopt;
    }
    return mask;
}

Mask parseMask(const std::string& text)
{
    const std::optional<Mask> mask = readMask(text);
    if (!mask) {
        const std::string trouble = maskTrouble(text);
        fail(ErrorKind::usage,
             "--mask is \"{}\"{}{}; expected ground:green, or vertex-color:C, vertex-color1:C, "
             "vertex-color:_NAME, material-texture:C or texture:FILE:C with C one of R G B A, "
             "after a texture perhaps :uv1 or :transform, or raster:FILE:V,V with values of a "
             "GeoTIFF, and perhaps :invert",
             text, trouble.empty() ? "" : ": ", trouble);
    }
    return *mask;
}

std::string textOf(const Mask& mask)
{
    if (mask.source == Mask::Source::groundGreen)
        return fmt::format("{}{}", groundGreenText, mask.invert ? invertWord : "");
    const char* const invert = mask.invert ? invertWord : "";
    if (mask.source == Mask::Source::raster) {
        std::string text = fmt::format("{}{}:b{}", rasterText, mask.file, mask.band);
        for (std::size_t i = 0; i < mask.classes.size(); ++i)
            text += fmt::format("{}{}", i == 0 ? ':' : ',', mask.classes[i]);
        if (mask.classes.empty())
            text += fmt::format(":{}..{}", mask.low, mask.high);
        return text + invert;
    }
    const char* const white = mask.orWhite ? whiteWord : "";
    const char channel = channelNames[mask.channel];
    const std::size_t prefix = mask.attribute.rfind('_') + 1;
    if (mask.source == Mask::Source::materialTexture)
        return fmt::format("material-texture:{}{}", channel, invert);
    if (mask.source == Mask::Source::vertexColor) {
        if (mask.attribute.starts_with("_"))
            return fmt::format("vertex-color:{}:{}{}{}", mask.attribute, channel, white, invert);
        return fmt::format("vertex-color{}:{}{}{}", mask.attribute.substr(prefix), channel, white,
                           invert);
    }
    if (mask.attribute == terrain::materialCoordinates)
        return fmt::format("texture:{}:{}{}{}", mask.file, channel, transformWord, invert);
    const std::string set = mask.attribute.empty() ? "" : ":uv" + mask.attribute.substr(prefix);
    return fmt::format("texture:{}:{}{}{}", mask.file, channel, set, invert);
}

void loadImages(std::vector<Mask>& masks)
{
    for (Mask& mask : masks) {
        if (mask.source == Mask::Source::raster && mask.map == nullptr) {
            std::error_code ignored;
            if (const std::string trouble = rasterTrouble(mask.file);
                !trouble.empty() && !std::filesystem::exists(mask.file, ignored))
                fail(ErrorKind::usage, "mask \"{}{}\": {}", rasterText, mask.file, trouble);
            mask.map = std::make_shared<MapMask>(mask.file, mask.band, mask.classes, textOf(mask));
        }
        if (mask.source != Mask::Source::texture || mask.image != nullptr)
            continue;
        for (const Mask& other : masks)
            if (other.file == mask.file && other.channel == mask.channel && other.image != nullptr)
                mask.image = other.image;
        if (mask.image == nullptr) {
            // Words that are not known count as part of the file's name.
            std::error_code ignored;
            const std::string text = textOf(mask);
            if (const std::string trouble = maskTrouble(text);
                !trouble.empty() && !std::filesystem::exists(mask.file, ignored))
                fail(ErrorKind::usage, "mask \"{}\": {}", text, trouble);
            mask.image = std::make_shared<const terrain::ChannelImage>(
                terrain::readChannel(mask.file, mask.channel));
        }
    }
}

terrain::MaskInputs inputsOf(const std::vector<Mask>& masks)
{
    terrain::MaskInputs inputs;
    for (const Mask& mask : masks) {
        const std::string name = mask.attributeName();
        if (!name.empty() && std::find(inputs.attributes.begin(), inputs.attributes.end(), name) ==
                                 inputs.attributes.end())
            inputs.attributes.push_back(name);
        if (mask.source == Mask::Source::materialTexture)
            inputs.imageChannels |= 1U << mask.channel;
    }
    return inputs;
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
        if (mask.source == Mask::Source::raster) {
            expect(mask.map != nullptr, "loadImages() was not called");
            mask.map->read(ground);
            continue;
        }
        expect(mask.source != Mask::Source::texture || mask.image != nullptr,
               "loadImages() was not called");
        checkParts(mask, ground);
        if (mask.attributeName() == "COLOR_0" && !ground.hasColors)
            fail(ErrorKind::input, "--mask {}: the ground has no vertex colours (glTF COLOR_0)",
                 textOf(mask));
        const bool isMappedMask =
            mask.source == Mask::Source::texture || mask.source == Mask::Source::materialTexture;
        const bool hasOwn = ground.attributes.find(mask.attributeName()) != nullptr;
        for (std::size_t m = 0; isMappedMask && !hasOwn && m < bears.size(); ++m) {
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
