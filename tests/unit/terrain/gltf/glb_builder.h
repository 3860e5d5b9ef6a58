#pragma once

#include "terrain/ground_mesh.h"
#include "terrain/load.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

namespace sward::terrain {

/// Writes glTF byte by byte, so that a test states exactly what the file holds, right or wrong.
class GlbBuilder {
public:
    GlbBuilder();

    /// Each appends an accessor on a buffer view of its own and returns its index.
    int floats(const std::vector<float>& values, const char* type);
    int bytes(const std::vector<std::uint8_t>& values, const char* type, bool normalized = false);
    int shorts(const std::vector<std::uint16_t>& values, const char* type, bool normalized = false);
    int words(const std::vector<std::uint32_t>& values, const char* type);

    /// Raw bytes as a buffer view; returns its index.
    int view(const void* bytes, std::size_t size);

    /// Appends a mesh of one primitive, or another primitive to the last mesh.
    int mesh(nlohmann::json primitive);
    void primitive(nlohmann::json primitive)
    {
        document["meshes"].back()["primitives"].push_back(primitive);
    }

    /// Appends a node; one that is not named as a child later belongs to the scene.
    int node(nlohmann::json node);

    /// The file: its JSON, and its bytes as the BIN chunk.
    std::string glb() const;

    /// The same as .gltf with the bytes in a data URI.
    std::string gltf() const;

    const std::string& binary() const { return binary_; }

    nlohmann::json document;

private:
    int accessor(int view, int componentType, const char* type, std::size_t count, bool normalized);
    nlohmann::json finished() const;

    std::string binary_;
};

/// Bytes in base64.
std::string base64(const std::string& bytes);

/// A folder that is gone afterwards.
class ScratchFolder {
public:
    ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    ~ScratchFolder();

    /// Writes a file and returns its path.
    std::string write(const std::string& name, const std::string& content) const;
    std::filesystem::path path(const std::string& name) const { return folder_ / name; }

private:
    std::filesystem::path folder_;
};

/// Loads `content` as a file of that name.
GroundMesh loadContent(const std::string& name, const std::string& content,
                       const ImportSettings& settings = {}, Diagnostics* diagnostics = nullptr);

/// Message of the Error{input} with which loadContent() refuses a file. "it was read" without
/// one, "another kind of error" for others.
std::string inputErrorOf(const std::string& name, const std::string& content);

/// World position of a vertex.
glm::dvec3 worldPosition(const GroundMesh& mesh, std::size_t vertex);

/// A GLB of one triangle (0,0,0) (1,0,0) (0,0,-1), facing up, with indices and normals.
GlbBuilder triangleGlb();

} // namespace sward::terrain
