#include "unit/terrain/gltf/compressed_glb.h"

#include "core/expect.h"

#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>
#include <glm/geometric.hpp>
#include <meshoptimizer.h>

#include <cmath>
#include <vector>

namespace sward::terrain {
namespace {

struct Grid {
    std::vector<float> positions, normals, uvs;
    std::vector<std::uint32_t> indices;

    std::size_t vertices() const { return positions.size() / 3; }
};

Grid makeGrid(unsigned cells)
{
    Grid grid;
    for (unsigned j = 0; j <= cells; ++j)
        for (unsigned i = 0; i <= cells; ++i) {
            const double x = 0.5 * i;
            const double z = 0.5 * j;
            const double dx = 0.3 * std::cos(x) * std::cos(0.7 * z);
            const double dz = -0.21 * std::sin(x) * std::sin(0.7 * z);
            const glm::dvec3 n = glm::normalize(glm::dvec3(-dx, 1.0, -dz));
            for (const double value : {x, 0.3 * std::sin(x) * std::cos(0.7 * z), z})
                grid.positions.push_back(static_cast<float>(value));
            for (const double value : {n.x, n.y, n.z})
                grid.normals.push_back(static_cast<float>(value));
            grid.uvs.push_back(static_cast<float>(i) / static_cast<float>(cells));
            grid.uvs.push_back(static_cast<float>(j) / static_cast<float>(cells));
        }
    for (unsigned j = 0; j < cells; ++j)
        for (unsigned i = 0; i < cells; ++i) {
            const unsigned a = j * (cells + 1) + i;
            const unsigned c = a + cells + 1;
            for (const unsigned corner : {a, c, a + 1, a + 1, c, c + 1})
                grid.indices.push_back(corner);
        }
    return grid;
}

nlohmann::json accessorOf(int componentType, const char* type, std::size_t count)
{
    return {{"componentType", componentType}, {"type", type}, {"count", count}};
}

nlohmann::json primitiveOf()
{
    return {{"attributes", {{"POSITION", 0}, {"NORMAL", 1}, {"TEXCOORD_0", 2}}}, {"indices", 3}};
}

// Compresses one view after the other.
class MeshoptWriter {
public:
    explicit MeshoptWriter(const MeshoptLook& look)
        : look_(look)
    {
    }

    void attributes(const void* elements, std::size_t count, std::size_t stride, const char* filter)
    {
        std::vector<unsigned char> stream(meshopt_encodeVertexBufferBound(count, stride));
        stream.resize(
            meshopt_encodeVertexBuffer(stream.data(), stream.size(), elements, count, stride));
        nlohmann::json extension = {{"mode", "ATTRIBUTES"}};
        if (filter != nullptr)
            extension["filter"] = filter;
        add(stream, count, stride, extension);
        builder.document["bufferViews"].back()["byteStride"] = stride;
    }

    void indices(const std::vector<std::uint32_t>& indices, std::size_t vertices)
    {
        meshopt_encodeIndexVersion(1);
        const bool isTriangles = look_.indexMode == "TRIANGLES";
        std::vector<unsigned char> stream(
            isTriangles ? meshopt_encodeIndexBufferBound(indices.size(), vertices)
                        : meshopt_encodeIndexSequenceBound(indices.size(), vertices));
        stream.resize(isTriangles ? meshopt_encodeIndexBuffer(stream.data(), stream.size(),
                                                              indices.data(), indices.size())
                                  : meshopt_encodeIndexSequence(stream.data(), stream.size(),
                                                                indices.data(), indices.size()));
        add(stream, indices.size(), look_.shortIndices ? 2 : 4, {{"mode", look_.indexMode}});
    }

    GlbBuilder take()
    {
        nlohmann::json placeholder = {{"byteLength", plain_}};
        placeholder["extensions"][look_.extension] = {{"fallback", true}};
        builder.document["buffers"] = {{{"byteLength", builder.binary().size()}}, placeholder};
        builder.document["extensionsUsed"] = {look_.extension};
        builder.document["extensionsRequired"] = {look_.extension};
        return std::move(builder);
    }

    GlbBuilder builder;

private:
    void add(const std::vector<unsigned char>& stream, std::size_t count, std::size_t stride,
             nlohmann::json extension)
    {
        expect(!stream.empty(), "an encoder that encodes");
        builder.view(stream.data(), stream.size());
        nlohmann::json& view = builder.document["bufferViews"].back();
        extension.update({{"buffer", 0},
                          {"byteOffset", view["byteOffset"]},
                          {"byteLength", stream.size()},
                          {"byteStride", stride},
                          {"count", count}});
        view = {{"buffer", 1}, {"byteOffset", plain_}, {"byteLength", count * stride}};
        view["extensions"][look_.extension] = extension;
        plain_ += (count * stride + 3) / 4 * 4;
    }

    MeshoptLook look_;
    std::size_t plain_ = 0; // bytes of the views when they are decoded
};

} // namespace

GlbBuilder plainGrid(unsigned cells)
{
    const Grid grid = makeGrid(cells);
    GlbBuilder builder;
    builder.floats(grid.positions, "VEC3");
    builder.floats(grid.normals, "VEC3");
    builder.floats(grid.uvs, "VEC2");
    builder.words(grid.indices, "SCALAR");
    builder.mesh(primitiveOf());
    builder.node({{"mesh", 0}, {"name", "grid"}});
    return builder;
}

GlbBuilder meshoptGrid(unsigned cells, const MeshoptLook& look)
{
    const Grid grid = makeGrid(cells);
    const std::size_t count = grid.vertices();
    MeshoptWriter writer(look);
    auto& accessors = writer.builder.document["accessors"];
    if (look.filters) {
        std::vector<float> exponential(grid.positions.size());
#if MESHOPTIMIZER_VERSION >= 190
        meshopt_encodeFilterExp(exponential.data(), count, 12, 20, grid.positions.data(),
                                meshopt_EncodeExpSharedVector);
#else // shared by the vector, without a choice
        meshopt_encodeFilterExp(exponential.data(), count, 12, 20, grid.positions.data());
#endif
        writer.attributes(exponential.data(), count, 12, "EXPONENTIAL");
        std::vector<float> four;
        for (std::size_t i = 0; i < count; ++i) {
            four.insert(four.end(), grid.normals.begin() + static_cast<std::ptrdiff_t>(3 * i),
                        grid.normals.begin() + static_cast<std::ptrdiff_t>(3 * i + 3));
            four.push_back(0.0f);
        }
        std::vector<std::int8_t> octahedral(4 * count);
        meshopt_encodeFilterOct(octahedral.data(), count, 4, 8, four.data());
        writer.attributes(octahedral.data(), count, 4, "OCTAHEDRAL");
    } else {
        writer.attributes(grid.positions.data(), count, 12, nullptr);
        writer.attributes(grid.normals.data(), count, 12, nullptr);
    }
    writer.attributes(grid.uvs.data(), count, 8, nullptr);
    writer.indices(grid.indices, count);

    accessors.push_back(accessorOf(5126, "VEC3", count));
    accessors.push_back(accessorOf(look.filters ? 5120 : 5126, "VEC3", count));
    accessors.push_back(accessorOf(5126, "VEC2", count));
    accessors.push_back(accessorOf(look.shortIndices ? 5123 : 5125, "SCALAR", grid.indices.size()));
    for (std::size_t i = 0; i < accessors.size(); ++i)
        accessors[i]["bufferView"] = i;
    if (look.filters)
        accessors[1]["normalized"] = true;
    writer.builder.mesh(primitiveOf());
    writer.builder.node({{"mesh", 0}, {"name", "grid"}});
    return writer.take();
}

GlbBuilder dracoGrid(unsigned cells, const DracoLook& look)
{
    const Grid grid = makeGrid(cells);
    const auto count = static_cast<unsigned>(grid.vertices());
    draco::Mesh mesh;
    mesh.set_num_points(count);
    nlohmann::json ids;
    const auto add = [&](const char* name, draco::GeometryAttribute::Type type,
                         const std::vector<float>& values, int components) {
        draco::GeometryAttribute attribute;
        attribute.Init(type, nullptr, static_cast<std::uint8_t>(components), draco::DT_FLOAT32,
                       false, 4 * components, 0);
        const int id = mesh.AddAttribute(attribute, true, count);
        for (unsigned i = 0; i < count; ++i)
            mesh.attribute(id)->SetAttributeValue(
                draco::AttributeValueIndex(i),
                values.data() + std::size_t(i) * static_cast<std::size_t>(components));
        ids[name] = mesh.attribute(id)->unique_id();
    };
    add("POSITION", draco::GeometryAttribute::POSITION, grid.positions, 3);
    add("NORMAL", draco::GeometryAttribute::NORMAL, grid.normals, 3);
    add("TEXCOORD_0", draco::GeometryAttribute::TEX_COORD, grid.uvs, 2);
    for (std::size_t i = 0; i < grid.indices.size(); i += 3)
        mesh.AddFace({draco::PointIndex(grid.indices[i]), draco::PointIndex(grid.indices[i + 1]),
                      draco::PointIndex(grid.indices[i + 2])});

    draco::Encoder encoder;
    encoder.SetEncodingMethod(look.edgebreaker ? draco::MESH_EDGEBREAKER_ENCODING
                                               : draco::MESH_SEQUENTIAL_ENCODING);
    if (look.bits > 0) {
        encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, look.bits);
        encoder.SetAttributeQuantization(draco::GeometryAttribute::NORMAL, look.bits);
    }
    draco::EncoderBuffer stream;
    expect(encoder.EncodeMeshToBuffer(mesh, &stream).ok(), "an encoder that encodes");

    GlbBuilder builder;
    const int view = builder.view(stream.data(), stream.size());
    auto& accessors = builder.document["accessors"];
    accessors.push_back(accessorOf(5126, "VEC3", count));
    accessors.push_back(accessorOf(5126, "VEC3", count));
    accessors.push_back(accessorOf(5126, "VEC2", count));
    accessors.push_back(accessorOf(5125, "SCALAR", grid.indices.size()));
    nlohmann::json primitive = primitiveOf();
    primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", view},
                                                             {"attributes", ids}};
    builder.mesh(primitive);
    builder.node({{"mesh", 0}, {"name", "grid"}});
    builder.document["extensionsUsed"] = {"KHR_draco_mesh_compression"};
    builder.document["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    return builder;
}

} // namespace sward::terrain
