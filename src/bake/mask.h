#pragma once

#include "bake/root_sample.h"
#include "terrain/channel_image.h"
#include "terrain/ground_mesh.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sward::bake {

/// A number in [0, 1] at every place of the ground, by which density is multiplied. Numbers are
/// taken as stored, whatever colour space the image or the colours are said to be in.
struct Mask {
    enum class Source {
        vertexColor,    ///< COLOR_0 of the ground
        texture,        ///< an image of its own at the ground's texture coordinates
        materialTexture ///< the base colour image of the ground's own material
    };

    Source source = Source::vertexColor;
    int channel = 0; ///< 0 red, 1 green, 2 blue, 3 alpha
    bool invert = false;
    std::string file = {}; ///< of a texture
    std::shared_ptr<const terrain::ChannelImage> image = {};

    /// Value at a root. Thread-safe.
    double at(const terrain::GroundMesh& ground, const RootSample& root) const;
};

/// "vertex-color:C", "material-texture:C" or "texture:FILE[:C]", then perhaps ":invert". C is R, G,
/// B or A; of a texture R if left out. None if the text is something else.
std::optional<Mask> readMask(const std::string& text);

/// The same of an option. Throws Error{usage}.
Mask parseMask(const std::string& text);

/// The text that readMask() reads back.
std::string textOf(const Mask& mask);

/// Reads the images of textures, each once. Throws Error{io, input}.
void loadImages(std::vector<Mask>& masks);

/// Throws Error{input} if the ground lacks what a mask needs where it bears grass: vertex colours,
/// or a material's texture coordinates or image, which is named.
void checkMasks(const std::vector<Mask>& masks, const terrain::GroundMesh& ground);

} // namespace sward::bake
