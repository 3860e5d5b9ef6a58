#include "terrain/gltf/codecs/draco_geometry.h"

#include "core/error.h"

#include <draco/compression/config/compression_shared.h>
#include <draco/compression/config/decoder_options.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/decoder_buffer.h>
#include <draco/core/varint_decoding.h>
#include <draco/mesh/mesh.h>

#include <cstring>
#include <memory>

namespace sward::terrain {
namespace {

// The version that KHR_draco_mesh_compression allows.
constexpr int bitStreamMajor = 2;
constexpr int bitStreamMinor = 2;

// Most attributes with separate seams; each costs as much as the mesh's connectivity.
constexpr std::uint64_t seamLimit = 8;

// All attributes of all points together, and those of one point [bytes]. glTF has at most 16 to an
// attribute.
constexpr std::uint64_t attributeLimit = std::uint64_t(1) << 30;
constexpr std::uint64_t pointLimit = 256;

// Draco trusts the counts in its headers. These two functions check them first.

class GuardedEdgebreaker final : public draco::MeshEdgebreakerDecoder {
public:
    explicit GuardedEdgebreaker(std::uint64_t triangles)
        : triangles_(triangles)
    {
    }

protected:
    bool DecodeConnectivity() override
    {
        // Draco's bit stream, "Decode Edgebreaker Connectivity Data".
        draco::DecoderBuffer ahead = *buffer();
        std::uint32_t vertices = 0;
        std::uint32_t faces = 0;
        std::uint8_t seams = 0;
        std::uint32_t symbols = 0;
        std::uint32_t splits = 0;
        return draco::DecodeVarint(&vertices, &ahead) && draco::DecodeVarint(&faces, &ahead) &&
               ahead.Decode(&seams) && draco::DecodeVarint(&symbols, &ahead) &&
               draco::DecodeVarint(&splits, &ahead) && faces == triangles_ &&
               vertices <= 3 * triangles_ && splits <= triangles_ && seams <= seamLimit &&
               draco::MeshEdgebreakerDecoder::DecodeConnectivity();
    }

    bool DecodeAllAttributes() override;

private:
    std::uint64_t triangles_;
};

class GuardedSequential final : public draco::MeshSequentialDecoder {
public:
    explicit GuardedSequential(std::uint64_t triangles)
        : triangles_(triangles)
    {
    }

protected:
    bool DecodeConnectivity() override
    {
        // Draco's bit stream, "Decode Sequential Connectivity Data".
        draco::DecoderBuffer ahead = *buffer();
        std::uint32_t faces = 0;
        std::uint32_t points = 0;
        return draco::DecodeVarint(&faces, &ahead) && draco::DecodeVarint(&points, &ahead) &&
               faces == triangles_ && points <= 3 * triangles_ &&
               draco::MeshSequentialDecoder::DecodeConnectivity();
    }

    bool DecodeAllAttributes() override;

private:
    std::uint64_t triangles_;
};

// Called when the attributes are known and their values are not yet decoded.
bool fit(const draco::PointCloud& cloud)
{
    std::uint64_t bytes = 0;
    for (int i = 0; i < cloud.num_attributes(); ++i) {
        const draco::PointAttribute& attribute = *cloud.attribute(i);
        bytes += std::uint64_t(attribute.num_components()) *
                 static_cast<std::uint64_t>(draco::DataTypeLength(attribute.data_type()));
    }
    return bytes <= pointLimit && bytes * cloud.num_points() <= attributeLimit;
}

bool GuardedEdgebreaker::DecodeAllAttributes()
{
    return fit(*point_cloud()) && draco::MeshEdgebreakerDecoder::DecodeAllAttributes();
}

bool GuardedSequential::DecodeAllAttributes()
{
    return fit(*point_cloud()) && draco::MeshSequentialDecoder::DecodeAllAttributes();
}

void decodeInto(draco::Mesh& mesh, std::span<const std::byte> bytes, std::uint64_t triangles,
                const std::string& place)
{
    const auto buffer = [&] {
        draco::DecoderBuffer start;
        start.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        return start;
    };
    draco::DecoderBuffer ahead = buffer();
    draco::DracoHeader header = {};
    if (!draco::PointCloudDecoder::DecodeHeader(&ahead, &header).ok() ||
        header.encoder_type != draco::TRIANGULAR_MESH)
        fail(ErrorKind::input, "{}: not a Draco mesh", place);
    if (header.version_major != bitStreamMajor || header.version_minor != bitStreamMinor)
        fail(ErrorKind::unsupported, "{}: Draco bit stream {}.{}; only {}.{} is read", place,
             header.version_major, header.version_minor, bitStreamMajor, bitStreamMinor);

    const draco::DecoderOptions options;
    draco::DecoderBuffer whole = buffer();
    draco::Status status;
    if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING)
        status = GuardedEdgebreaker(triangles).Decode(options, &whole, &mesh);
    else
        status = GuardedSequential(triangles).Decode(options, &whole, &mesh);
    if (!status.ok())
        fail(ErrorKind::input, "{}: a damaged Draco mesh, or not one of {} triangles", place,
             triangles);
}

template <typename Value>
std::vector<std::byte> valuesOf(const draco::PointAttribute& attribute, std::size_t points,
                                const DracoAttribute& wanted, const std::string& place)
{
    const std::size_t size = wanted.components * sizeof(Value);
    std::vector<std::byte> values(points * size);
    std::vector<Value> element(wanted.components);
    for (std::size_t i = 0; i < points; ++i) {
        const auto index = attribute.mapped_index(draco::PointIndex(static_cast<unsigned>(i)));
        if (index.value() >= attribute.size() ||
            !attribute.ConvertValue<Value>(index, static_cast<std::int8_t>(wanted.components),
                                           element.data()))
            fail(ErrorKind::input, "{}: {} of point {} does not fit its accessor", place,
                 wanted.name, i);
        std::memcpy(values.data() + i * size, element.data(), size);
    }
    return values;
}

std::vector<std::byte> valuesOf(const draco::Mesh& mesh, const DracoAttribute& wanted,
                                const std::string& place)
{
    const draco::PointAttribute* const attribute = mesh.GetAttributeByUniqueId(wanted.id);
    if (attribute == nullptr)
        fail(ErrorKind::input, "{}: {} is attribute {} of the Draco mesh, which has none of it",
             place, wanted.name, wanted.id);
    const std::size_t points = mesh.num_points();
    switch (wanted.componentType) {
    case 5120:
        return valuesOf<std::int8_t>(*attribute, points, wanted, place);
    case 5121:
        return valuesOf<std::uint8_t>(*attribute, points, wanted, place);
    case 5122:
        return valuesOf<std::int16_t>(*attribute, points, wanted, place);
    case 5123:
        return valuesOf<std::uint16_t>(*attribute, points, wanted, place);
    case 5125:
        return valuesOf<std::uint32_t>(*attribute, points, wanted, place);
    default:
        return valuesOf<float>(*attribute, points, wanted, place);
    }
}

} // namespace

DracoGeometry decodeDraco(std::span<const std::byte> bytes, std::uint64_t triangles,
                          const std::vector<DracoAttribute>& wanted, const std::string& place)
{
    draco::Mesh mesh;
    decodeInto(mesh, bytes, triangles, place);
    DracoGeometry geometry;
    geometry.points = mesh.num_points();
    for (draco::FaceIndex i(0); i < mesh.num_faces(); ++i)
        for (const draco::PointIndex& corner : mesh.face(i)) {
            if (corner.value() >= geometry.points)
                fail(ErrorKind::input, "{}: triangle {} names point {}, but there are {}", place,
                     i.value(), corner.value(), geometry.points);
            geometry.indices.push_back(corner.value());
        }
    for (const DracoAttribute& attribute : wanted)
        geometry.attributes.push_back(valuesOf(mesh, attribute, place));
    return geometry;
}

} // namespace sward::terrain
