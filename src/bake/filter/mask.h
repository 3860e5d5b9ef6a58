#pragma once

#include "bake/root_sample.h"
#include "terrain/ground_mesh.h"
#include "terrain/image/channel_image.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sward::bake {

/// A factor in [0, 1] at every position of the ground; it multiplies the density. Values are used
/// as stored, regardless of the colour space of image or colours.
struct Mask {
    enum class Source {
        vertexColor,     ///< COLOR_0 of the ground
        texture,         ///< a separate image at the ground's texture coordinates
        materialTexture, ///< the base colour image of the ground's own material
        groundGreen      ///< greenWeight() of the ground's own colour
    };

    Source source = Source::vertexColor;
    int channel = 0; ///< 0 red, 1 green, 2 blue, 3 alpha
    bool invert = false;
    std::string file = {}; ///< of a texture
    std::shared_ptr<const terrain::ChannelImage> image = {};

    /// Value at a root. `green`: GroundGreen::at() there. Thread-safe.
    double at(const terrain::GroundMesh& ground, const RootSample& root, double green = 1.0) const;
};

/// Parses "vertex-color:C", "material-texture:C", "texture:FILE[:C]" or "ground:green", optionally
/// with ":invert". C is R, G, B or A; R for a texture without it. Returns none for any other text.
std::optional<Mask> readMask(const std::string& text);

/// As readMask(), for an option. Throws Error{usage}.
Mask parseMask(const std::string& text);

/// The text that readMask() reads back.
std::string textOf(const Mask& mask);

/// Reads the images of texture masks, each once. Throws Error{io, input}.
void loadImages(std::vector<Mask>& masks);

/// Throws Error{input} if bearing ground lacks what a mask needs: vertex colours, or a material's
/// texture coordinates or image. The error names the material.
void checkMasks(const std::vector<Mask>& masks, const terrain::GroundMesh& ground);

} // namespace sward::bake
