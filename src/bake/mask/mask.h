#pragma once

#include "bake/ground/root_sample.h"
#include "terrain/ground_mesh.h"
#include "terrain/image/channel_image.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sward::bake {

class MapMask;

/// A factor in [0, 1] at every position of the ground; it multiplies the density. Values are used
/// as stored, regardless of the colour space of image or colours.
struct Mask {
    enum class Source {
        vertexColor,     ///< a vertex attribute of the ground
        texture,         ///< a separate image at texture coordinates of the ground
        materialTexture, ///< the base colour image of the ground's own material
        groundGreen,     ///< greenWeight() of the ground's own colour
        raster           ///< a band of a map, where the ground lies on it
    };

    Source source = Source::vertexColor;
    int channel = 0; ///< 0 red, 1 green, 2 blue, 3 alpha
    bool invert = false;
    std::string file = {}; ///< of a texture, or a map
    std::shared_ptr<const terrain::ChannelImage> image = {};
    bool orWhite = false;       ///< vertex colours: parts of a file that have none count as white
    std::string attribute = {}; ///< that is read, by its glTF name; empty: the usual one

    int band = 1;                   ///< of a map, from 1
    std::vector<double> classes{};  ///< of a map: values that are 1, all others 0; empty: as stored
    double low = 0.0;               ///< of a map without classes: the value that is 0 …
    double high = 1.0;              ///< … and the one that is 1
    std::shared_ptr<MapMask> map{}; ///< made by loadImages()

    /// The vertex attribute that is read: COLOR_0 of vertex colours, TEXCOORD_0 as stored of a
    /// texture, or `attribute`. terrain::materialCoordinates of the material's own image. Empty for
    /// the ground's green.
    std::string attributeName() const;

    /// Value at a root. `green`: GroundGreen::at() there. Thread-safe.
    double at(const terrain::GroundMesh& ground, const RootSample& root, double green = 1.0) const;
};

/// Parses "vertex-color:C", "vertex-colorN:C" (COLOR_N), "vertex-color:_NAME[:C]" (a custom
/// attribute), "material-texture:C", "texture:FILE[:C]" with ":uvN" (TEXCOORD_N) or ":transform"
/// (as the material places its own image), or "ground:green", optionally with ":invert", vertex
/// colours before it with ":or-white". C is R, G, B or A; R where it may be left out. N is 0 to 15.
/// "raster:FILE[:bN][:V,V,…]" is where band N of a GeoTIFF has one of these values,
/// "raster:FILE[:bN][:A..B]" the band itself, which is 0 at A and 1 at B. Returns
/// none for any other text.
std::optional<Mask> readMask(const std::string& text);

/// As readMask(), for an option. Throws Error{usage}.
Mask parseMask(const std::string& text);

/// The text that readMask() reads back.
std::string textOf(const Mask& mask);

/// Reads the images of texture masks, each once. Throws Error{io, input}.
void loadImages(std::vector<Mask>& masks);

/// What importers have to keep for these masks.
terrain::MaskInputs inputsOf(const std::vector<Mask>& masks);

/// Reads the maps of masks where the ground lies. Throws Error{input} if bearing ground lacks what
/// a mask needs: a vertex attribute, a channel of it, a material's image, or a place on a map. The
/// error names the part of the file and its material.
void checkMasks(const std::vector<Mask>& masks, const terrain::GroundMesh& ground);

} // namespace sward::bake
