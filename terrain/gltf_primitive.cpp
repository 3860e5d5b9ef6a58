#include "terrain/gltf_primitive.h"

#include "core/error.h"
#include "terrain/gltf_accessor.h"

#include <cmath>
#include <numeric>
#include <optional>

namespace sward::terrain {
namespace {

std::optional<int> attribute(const tinygltf::Primitive& primitive, const std::string& name)
{
    const auto found = primitive.attributes.find(name);
    return found == primitive.attributes.end() ? std::nullopt : std::optional(found->second);
}

// Points and lines are not.
bool isGround(const tinygltf::Primitive& primitive)
{
    return primitive.mode < 0 || primitive.mode >= TINYGLTF_MODE_TRIANGLES;
}

// Appends the triangles of a list, strip or fan; `first` is the soup's number of vertex 0.
void appendTriangles(const std::vector<std::uint32_t>& indices, int mode, std::uint32_t first,
                     std::vector<glm::uvec3>& triangles)
{
    const std::size_t begin = triangles.size();
    const std::size_t n = indices.size();
    switch (mode) {
    case TINYGLTF_MODE_TRIANGLE_STRIP:
        // Every other triangle of a strip is turned round.
        for (std::size_t i = 0; i + 2 < n; ++i)
            triangles.emplace_back(indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]);
        break;
    case TINYGLTF_MODE_TRIANGLE_FAN:
        for (std::size_t i = 0; i + 2 < n; ++i)
            triangles.emplace_back(indices[i + 1], indices[i + 2], indices[0]);
        break;
    default:
        for (std::size_t i = 0; i + 2 < n; i += 3)
            triangles.emplace_back(indices[i], indices[i + 1], indices[i + 2]);
        break;
    }
    for (std::size_t i = begin; i < triangles.size(); ++i)
        triangles[i] += first;
}

// One primitive on its way into the soup of its mesh.
class PrimitiveReader {
public:
    PrimitiveReader(const GltfModel& model, const tinygltf::Primitive& primitive, std::string place,
                    Soup& soup)
        : model_(model)
        , primitive_(primitive)
        , place_(std::move(place))
        , soup_(soup)
        , first_(soup.positions.size())
    {
    }

    void read(const std::vector<GltfUvSource>& uvs, Diagnostics& diagnostics)
    {
        readPositions();
        readNormals();
        const std::size_t material = primitive_.material >= 0
                                         ? static_cast<std::size_t>(primitive_.material)
                                         : uvs.size() - 1;
        readUvs(uvs.at(material), diagnostics);
        readColors();
        readTriangles(static_cast<std::uint32_t>(material), diagnostics);
    }

private:
    // The numbers of an attribute, one element per vertex.
    std::vector<float> numbersOf(int accessor, const std::string& name, std::size_t low,
                                 std::size_t high)
    {
        const GltfAccessor reader(model_, accessor, place_ + ": " + name);
        reader.requireComponents(low, high);
        components_ = reader.components();
        if (name != "POSITION" && reader.count() != vertices_)
            fail(ErrorKind::input, "{}: {} has {} elements for {} vertices", place_, name,
                 reader.count(), vertices_);
        vertices_ = reader.count();
        std::vector<float> numbers = reader.numbers();
        for (std::size_t i = 0; i < numbers.size(); ++i)
            if (!std::isfinite(numbers[i]))
                fail(ErrorKind::input, "{}: {} of vertex {} is not a finite number", place_, name,
                     i / components_);
        return numbers;
    }

    void readPositions()
    {
        const auto accessor = attribute(primitive_, "POSITION");
        if (!accessor)
            fail(ErrorKind::input, "{}: no POSITION", place_);
        const std::vector<float> p = numbersOf(*accessor, "POSITION", 3, 3);
        for (std::size_t i = 0; i < vertices_; ++i)
            soup_.positions.emplace_back(p[3 * i], p[3 * i + 1], p[3 * i + 2]);
        soup_.normals.resize(first_ + vertices_, glm::vec3(0.0f));
        soup_.uvs.resize(first_ + vertices_, glm::vec2(0.0f));
        soup_.colors.resize(first_ + vertices_, glm::vec4(1.0f));
    }

    void readNormals()
    {
        const auto accessor = attribute(primitive_, "NORMAL");
        if (!accessor)
            return;
        const std::vector<float> n = numbersOf(*accessor, "NORMAL", 3, 3);
        for (std::size_t i = 0; i < vertices_; ++i)
            soup_.normals[first_ + i] = {n[3 * i], n[3 * i + 1], n[3 * i + 2]};
    }

    void readUvs(const GltfUvSource& source, Diagnostics& diagnostics)
    {
        const std::string name = fmt::format("TEXCOORD_{}", source.set);
        const auto accessor = attribute(primitive_, name);
        if (!accessor) {
            if (source.set != 0)
                diagnostics.warn("{}: its material asks for {}, which it does not have", place_,
                                 name);
            return;
        }
        const std::vector<float> uv = numbersOf(*accessor, name, 2, 2);
        for (std::size_t i = 0; i < vertices_; ++i)
            soup_.uvs[first_ + i] = source.placing * glm::vec3(uv[2 * i], uv[2 * i + 1], 1.0f);
    }

    void readColors()
    {
        const auto accessor = attribute(primitive_, "COLOR_0");
        if (!accessor)
            return;
        const std::vector<float> c = numbersOf(*accessor, "COLOR_0", 3, 4);
        const auto channel = [](float value) { return std::fmin(std::fmax(value, 0.0f), 1.0f); };
        for (std::size_t i = 0; i < vertices_; ++i) {
            const float* const own = c.data() + components_ * i;
            soup_.colors[first_ + i] = {channel(own[0]), channel(own[1]), channel(own[2]),
                                        components_ == 4 ? channel(own[3]) : 1.0f};
        }
        soup_.hasColors = true;
    }

    void readTriangles(std::uint32_t material, Diagnostics& diagnostics)
    {
        // Without indices the vertices are taken in their order.
        std::vector<std::uint32_t> indices(primitive_.indices >= 0 ? 0 : vertices_);
        if (primitive_.indices >= 0)
            indices = GltfAccessor(model_, primitive_.indices, place_ + ": indices").indices();
        else
            std::iota(indices.begin(), indices.end(), 0U);
        for (std::size_t i = 0; i < indices.size(); ++i)
            if (indices[i] >= vertices_)
                fail(ErrorKind::input, "{}: index {} names vertex {}, but there are {}", place_, i,
                     indices[i], vertices_);

        const int mode = primitive_.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive_.mode;
        if (mode == TINYGLTF_MODE_TRIANGLES && indices.size() % 3 != 0)
            diagnostics.warn("{}: {} indices are not a multiple of 3; the last ones are left out",
                             place_, indices.size());
        appendTriangles(indices, mode, static_cast<std::uint32_t>(first_), soup_.triangles);
        soup_.materialOf.resize(soup_.triangles.size(), material);
    }

    const GltfModel& model_;
    const tinygltf::Primitive& primitive_;
    std::string place_;
    Soup& soup_;
    std::size_t first_;
    std::size_t vertices_ = 0;
    std::size_t components_ = 0;
};

} // namespace

GltfMeshSize sizeOfGltfMesh(const GltfModel& model, std::size_t mesh)
{
    const auto countOf = [&](int accessor) {
        return std::uint64_t(
            model.structure.accessors.at(static_cast<std::size_t>(accessor)).count);
    };
    GltfMeshSize size;
    for (const tinygltf::Primitive& primitive : model.structure.meshes.at(mesh).primitives) {
        const auto positions = attribute(primitive, "POSITION");
        if (!isGround(primitive) || !positions)
            continue;
        const std::uint64_t vertices = countOf(*positions);
        const std::uint64_t corners =
            primitive.indices >= 0 ? countOf(primitive.indices) : vertices;
        size.vertices += vertices;
        const bool isList = primitive.mode < 0 || primitive.mode == TINYGLTF_MODE_TRIANGLES;
        size.triangles += isList ? corners / 3 : corners;
    }
    return size;
}

Soup readGltfMesh(const GltfModel& model, std::size_t mesh, const std::vector<GltfUvSource>& uvs,
                  const std::string& place, Diagnostics& diagnostics)
{
    Soup soup;
    const tinygltf::Mesh& source = model.structure.meshes.at(mesh);
    for (std::size_t i = 0; i < source.primitives.size(); ++i) {
        const tinygltf::Primitive& primitive = source.primitives[i];
        std::string where = fmt::format("{}: mesh {}", place, mesh);
        if (!source.name.empty())
            where += fmt::format(" \"{}\"", source.name);
        where += fmt::format(", primitive {}", i);
        if (!isGround(primitive)) {
            diagnostics.warn("{}: points and lines are not ground and are left out", where);
            continue;
        }
        PrimitiveReader(model, primitive, std::move(where), soup).read(uvs, diagnostics);
    }
    return soup;
}

} // namespace sward::terrain
