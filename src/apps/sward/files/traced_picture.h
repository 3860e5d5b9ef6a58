#pragma once

#include "trace/tracer.h"

#include <glm/vec2.hpp>

#include <optional>
#include <string>
#include <vector>

namespace sward::apps {

/// Writes linear radiance as R, G and B, and each of `layers` (traceLayers) under its name. Throws
/// as writeExr() does.
void writeTracedExr(const trace::Layers& picture, glm::uvec2 size,
                    const std::vector<std::string>& layers, const std::string& path,
                    bool overwrite);

/// Writes the light times `exposure`, developed by the film curve of the viewer. Throws as
/// writePng() does.
void writeTracedPng(const trace::Layers& picture, glm::uvec2 size, double exposure,
                    const std::string& path, bool overwrite);

/// The exposure that makes the mean of grass and ground 18 % grey; of the sky, if nothing else is
/// in the picture. In [1e-4, 1e4].
double exposureOf(const trace::Layers& picture);

} // namespace sward::apps
