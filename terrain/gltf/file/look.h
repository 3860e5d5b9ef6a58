#pragma once

#include "terrain/ground_mesh.h"

#include <glm/mat3x2.hpp>

#include <string>

namespace sward::terrain {

/// Stands for a reference of a glTF that is not there.
inline constexpr int noEntry = -1;

/// Source of texture coordinates of a material's image.
struct GltfUvSource {
    int set = 0;                                             ///< TEXCOORD_n
    glm::mat3x2 placing{1.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f}; ///< KHR_texture_transform
};

struct GltfMaterial {
    std::string name;
    glm::vec4 color{1.0f};
    float roughness = 1.0f;
    float metallic = 1.0f;
    float alphaCutoff = -1.0f; ///< as GroundMaterial::alphaCutoff
    bool doubleSided = false;
    int texture = noEntry;
    GltfUvSource uvs;
};

struct GltfTexture {
    int image = noEntry; ///< noEntry: in a format that is not read
    ImageWrap wrapU = ImageWrap::repeat;
    ImageWrap wrapV = ImageWrap::repeat;
};

/// An image, still encoded.
struct GltfImage {
    std::string name;
    std::string uri;    ///< a data URI or the name of a file; empty: see `view`
    int view = noEntry; ///< buffer view
};

} // namespace sward::terrain
