#include "terrain/files/ground_file.h"

#include "core/error.h"
#include "terrain/image/channel_image.h"

#include <cstdint>

namespace sward::terrain {
namespace {

// A material's numbers in file layout.
struct MaterialRecord {
    glm::vec4 baseColor;
    float roughness;
    float metallic;
    std::uint32_t image;
    std::uint32_t wrapU;
    std::uint32_t wrapV;
    std::uint32_t doubleSided;
    std::uint32_t srgbColors;
    float alphaCutoff;
};

struct ImageRecord {
    std::uint32_t width;
    std::uint32_t height;
};

ImageWrap wrapOf(std::uint32_t number, const std::string& place)
{
    if (number > static_cast<std::uint32_t>(ImageWrap::mirror))
        fail(ErrorKind::input, "{}: {} is not a wrap mode of an image", place, number);
    return static_cast<ImageWrap>(number);
}

} // namespace

void write(RecordWriter& writer, const GroundMesh& ground)
{
    writer.addOne(ground.origin);
    writer.add(ground.positions);
    writer.add(ground.normals);
    writer.add(ground.uvs);
    writer.add(ground.colors);
    writer.addOne(static_cast<std::uint64_t>(ground.attributes.list.size()));
    for (const VertexAttribute& one : ground.attributes.list) {
        writer.add(std::string_view(one.name));
        writer.add(one.values);
    }
    writer.add(ground.triangles);
    writer.add(ground.materialOf);
    writer.add(ground.nodeOf);
    writer.add(ground.bears);
    writer.add(ground.sourceOf);
    writer.addOne(static_cast<std::uint64_t>(ground.materials.size()));
    for (const GroundMaterial& material : ground.materials) {
        writer.add(std::string_view(material.name));
        writer.addOne(MaterialRecord{
            material.baseColor, material.roughness, material.metallic, material.image,
            static_cast<std::uint32_t>(material.wrapU), static_cast<std::uint32_t>(material.wrapV),
            material.doubleSided ? 1U : 0U, material.srgbColors ? 1U : 0U, material.alphaCutoff});
    }
    writer.addOne(static_cast<std::uint64_t>(ground.images.size()));
    for (const GroundImage& image : ground.images) {
        writer.add(std::string_view(image.name));
        writer.addOne(ImageRecord{image.width, image.height});
    }
    writer.addOne(static_cast<std::uint64_t>(ground.nodes.size()));
    for (const std::string& node : ground.nodes)
        writer.add(std::string_view(node));
    writer.add(std::string_view(ground.copyright));
    writer.add(std::string_view(ground.mapSystem));
    writer.addOne(static_cast<std::uint32_t>(ground.hasColors ? 1 : 0));
    writer.addOne(static_cast<std::uint32_t>(ground.hasNormals ? 1 : 0));
    const HeightCells none;
    const HeightCells& cells = ground.heightCells ? *ground.heightCells : none;
    writer.addOne(cells.first);
    writer.addOne(cells.step);
    writer.addOne(cells.count);
    writer.add(cells.triangles);
}

GroundMesh readGround(RecordReader& reader, const std::string& place)
{
    GroundMesh ground;
    reader.readOne(ground.origin);
    reader.read(ground.positions);
    reader.read(ground.normals);
    reader.read(ground.uvs);
    reader.read(ground.colors);
    std::uint64_t count = 0;
    for (reader.readOne(count); count > 0; --count) {
        VertexAttribute& one = ground.attributes.list.emplace_back();
        reader.read(one.name);
        reader.read(one.values);
    }
    reader.read(ground.triangles);
    reader.read(ground.materialOf);
    reader.read(ground.nodeOf);
    reader.read(ground.bears);
    reader.read(ground.sourceOf);
    for (reader.readOne(count); count > 0; --count) {
        GroundMaterial& material = ground.materials.emplace_back();
        reader.read(material.name);
        MaterialRecord record = {};
        reader.readOne(record);
        material.baseColor = record.baseColor;
        material.roughness = record.roughness;
        material.metallic = record.metallic;
        material.image = record.image;
        material.wrapU = wrapOf(record.wrapU, place);
        material.wrapV = wrapOf(record.wrapV, place);
        material.doubleSided = record.doubleSided != 0;
        material.srgbColors = record.srgbColors != 0;
        material.alphaCutoff = record.alphaCutoff;
    }
    for (reader.readOne(count); count > 0; --count) {
        GroundImage& image = ground.images.emplace_back();
        reader.read(image.name);
        ImageRecord record = {};
        reader.readOne(record);
        image.width = record.width;
        image.height = record.height;
    }
    for (const GroundMaterial& material : ground.materials)
        if (material.image != GroundMaterial::noImage && material.image >= ground.images.size())
            fail(ErrorKind::input, "{}: material \"{}\" names image {}, but there are {}", place,
                 material.name, material.image, ground.images.size());
    for (reader.readOne(count); count > 0; --count)
        reader.read(ground.nodes.emplace_back());
    reader.read(ground.copyright);
    reader.read(ground.mapSystem);
    std::uint32_t flag = 0;
    reader.readOne(flag);
    ground.hasColors = flag != 0;
    reader.readOne(flag);
    ground.hasNormals = flag != 0;
    HeightCells cells;
    reader.readOne(cells.first);
    reader.readOne(cells.step);
    reader.readOne(cells.count);
    reader.read(cells.triangles);
    if (!cells.triangles.empty())
        ground.heightCells = std::make_shared<const HeightCells>(std::move(cells));
    if (!ground.triangles.empty())
        validate(ground, place);
    return ground;
}

void writePixels(RecordWriter& writer, const GroundImage& image)
{
    writer.addOne(ImageRecord{image.width, image.height});
    writer.add(image.rgba);
    for (const auto& channel : image.stored) {
        const ChannelImage none;
        const ChannelImage& own = channel != nullptr ? *channel : none;
        writer.addOne(ImageRecord{own.width, own.height});
        writer.add(own.values);
    }
}

void readPixels(RecordReader& reader, GroundImage& image, const std::string& place)
{
    ImageRecord record = {};
    reader.readOne(record);
    reader.read(image.rgba);
    if (record.width != image.width || record.height != image.height ||
        image.rgba.size() != std::size_t(4) * image.width * image.height)
        fail(ErrorKind::input, "{}: {} bytes of {} x {} pixels, where the ground has {} x {}",
             place, image.rgba.size(), record.width, record.height, image.width, image.height);
    for (auto& channel : image.stored) {
        ChannelImage own;
        reader.readOne(record);
        reader.read(own.values);
        own.width = record.width;
        own.height = record.height;
        if (own.values.size() != std::size_t(own.width) * own.height)
            fail(ErrorKind::input, "{}: {} values of {} x {} pixels", place, own.values.size(),
                 own.width, own.height);
        if (!own.values.empty())
            channel = std::make_shared<const ChannelImage>(std::move(own));
    }
}

} // namespace sward::terrain
