#pragma once

#include "apps/common/picture/exr_file.h"
#include "apps/sward_view/picture/radiance.h"
#include "render/layers/frame_layers.h"

#include <filesystem>
#include <vector>

namespace sward::view {

/// Writes radiance and layers as parts of one OpenEXR file: "color" with R G B as halves, then a
/// part of each layer (docs/layers.md). Throws as apps::writeExr().
void writeLayersExr(const Radiance& picture, const render::FrameLayers& layers,
                    apps::ExrCompression compression, const std::filesystem::path& path,
                    bool overwrite);

/// Writes the same as arrays of an .npz archive. Throws as apps::writeNpz().
void writeLayersNpz(const Radiance& picture, const render::FrameLayers& layers,
                    const std::filesystem::path& path, bool overwrite);

/// The name of a layer's own picture: frame.png → frame.depth.png.
std::filesystem::path layerPath(const std::filesystem::path& path, render::Layer layer);

/// Writes each layer as a PNG of 16 bits beside the picture `path`, scaled as docs/layers.md says.
void writeLayerPngs(const render::FrameLayers& layers, const std::filesystem::path& path,
                    bool overwrite);

} // namespace sward::view
