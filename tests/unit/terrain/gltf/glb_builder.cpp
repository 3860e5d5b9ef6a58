#include "unit/terrain/gltf/glb_builder.h"

#include "core/error.h"

#include <unistd.h>

#include <atomic>
#include <fstream>

namespace sward::terrain {
namespace {

void appendWord(std::string& file, std::size_t word)
{
    for (unsigned shift = 0; shift < 32; shift += 8)
        file.push_back(static_cast<char>((word >> shift) & 0xffU));
}

} // namespace

std::string base64(const std::string& bytes)
{
    constexpr const char* digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t j = 0; j < 3; ++j)
            group = (group << 8) |
                    (i + j < bytes.size() ? static_cast<std::uint8_t>(bytes[i + j]) : 0U);
        for (std::size_t j = 0; j < 4; ++j)
            text.push_back(i + j <= bytes.size() ? digits[(group >> (18 - 6 * j)) & 63U] : '=');
    }
    return text;
}

GlbBuilder::GlbBuilder()
{
    document["asset"]["version"] = "2.0";
}

int GlbBuilder::view(const void* bytes, std::size_t size)
{
    binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
    document["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", size}});
    binary_.append(static_cast<const char*>(bytes), size);
    return static_cast<int>(document["bufferViews"].size() - 1);
}

int GlbBuilder::accessor(int view, int componentType, const char* type, std::size_t count,
                         bool normalized)
{
    const std::string shape = type;
    const std::size_t size = shape == "SCALAR" ? 1 : static_cast<std::size_t>(shape[3] - '0');
    const std::size_t components = shape.starts_with("MAT") ? size * size : size;
    nlohmann::json entry = {{"bufferView", view},
                            {"componentType", componentType},
                            {"type", type},
                            {"count", count / components}};
    if (normalized)
        entry["normalized"] = true;
    document["accessors"].push_back(entry);
    return static_cast<int>(document["accessors"].size() - 1);
}

int GlbBuilder::floats(const std::vector<float>& values, const char* type)
{
    return accessor(view(values.data(), 4 * values.size()), 5126, type, values.size(), false);
}

int GlbBuilder::bytes(const std::vector<std::uint8_t>& values, const char* type, bool normalized)
{
    return accessor(view(values.data(), values.size()), 5121, type, values.size(), normalized);
}

int GlbBuilder::shorts(const std::vector<std::uint16_t>& values, const char* type, bool normalized)
{
    return accessor(view(values.data(), 2 * values.size()), 5123, type, values.size(), normalized);
}

int GlbBuilder::words(const std::vector<std::uint32_t>& values, const char* type)
{
    return accessor(view(values.data(), 4 * values.size()), 5125, type, values.size(), false);
}

int GlbBuilder::mesh(nlohmann::json primitive)
{
    document["meshes"].push_back({{"primitives", nlohmann::json::array({std::move(primitive)})}});
    return static_cast<int>(document["meshes"].size() - 1);
}

int GlbBuilder::node(nlohmann::json node)
{
    document["nodes"].push_back(std::move(node));
    return static_cast<int>(document["nodes"].size() - 1);
}

nlohmann::json GlbBuilder::finished() const
{
    nlohmann::json result = document;
    if (!result.contains("buffers") && !binary_.empty())
        result["buffers"] = {{{"byteLength", binary_.size()}}};
    if (!result.contains("scenes") && result.contains("nodes")) {
        std::vector<bool> isChild(result["nodes"].size(), false);
        for (const auto& node : result["nodes"])
            if (node.contains("children"))
                for (const auto& child : node["children"])
                    isChild.at(child.get<std::size_t>()) = true;
        nlohmann::json roots = nlohmann::json::array();
        for (std::size_t i = 0; i < isChild.size(); ++i)
            if (!isChild[i])
                roots.push_back(i);
        result["scenes"] = {{{"nodes", roots}}};
        result["scene"] = 0;
    }
    return result;
}

std::string GlbBuilder::glb() const
{
    std::string json = finished().dump();
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string chunk = binary_;
    chunk.resize((chunk.size() + 3) / 4 * 4, '\0');

    std::string file = "glTF";
    appendWord(file, 2);
    appendWord(file, 12 + 8 + json.size() + (chunk.empty() ? 0 : 8 + chunk.size()));
    appendWord(file, json.size());
    file += "JSON" + json;
    if (!chunk.empty()) {
        appendWord(file, chunk.size());
        file += std::string("BIN\0", 4) + chunk;
    }
    return file;
}

std::string GlbBuilder::gltf() const
{
    nlohmann::json result = finished();
    result["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(binary_);
    return result.dump(1);
}

ScratchFolder::ScratchFolder()
{
    static std::atomic<int> next = 0;
    // In memory where that is possible: sweeps write thousands of files.
    std::error_code ignored;
    const std::filesystem::path memory = "/dev/shm";
    const bool usable =
        std::filesystem::is_directory(memory, ignored) && ::access("/dev/shm", W_OK) == 0;
    folder_ = (usable ? memory : std::filesystem::temp_directory_path()) /
              ("sward_terrain_test_" + std::to_string(::getpid()) + "_" + std::to_string(next++));
    std::filesystem::create_directories(folder_);
}

ScratchFolder::~ScratchFolder()
{
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
}

std::string ScratchFolder::write(const std::string& name, const std::string& content) const
{
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return (folder_ / name).string();
}

GroundMesh loadContent(const std::string& name, const std::string& content,
                       const ImportSettings& settings, Diagnostics* diagnostics)
{
    // One folder for all: sweeps load thousands of files.
    static const ScratchFolder folder;
    Diagnostics own;
    return load(folder.write(name, content), settings, diagnostics == nullptr ? own : *diagnostics);
}

std::string inputErrorOf(const std::string& name, const std::string& content)
{
    try {
        loadContent(name, content);
    } catch (const Error& error) {
        return error.kind() == ErrorKind::input ? error.what() : "another kind of error";
    }
    return "it was read";
}

glm::dvec3 worldPosition(const GroundMesh& mesh, std::size_t vertex)
{
    return mesh.origin + glm::dvec3(mesh.positions.at(vertex));
}

GlbBuilder triangleGlb()
{
    GlbBuilder builder;
    const int positions = builder.floats({0, 0, 0, 1, 0, 0, 0, 0, -1}, "VEC3");
    const int normals = builder.floats({0, 1, 0, 0, 1, 0, 0, 1, 0}, "VEC3");
    const int indices = builder.shorts({0, 1, 2}, "SCALAR");
    builder.mesh(
        {{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}, {"indices", indices}});
    builder.node({{"mesh", 0}, {"name", "patch"}});
    return builder;
}

} // namespace sward::terrain
