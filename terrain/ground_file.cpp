#include "terrain/ground_file.h"

#include "core/error.h"

#include <cstdint>

namespace sward::terrain {
namespace {

// The numbers of a material, as they lie in the file.
struct MaterialRecord {
    glm::vec4 baseColor;
    float roughness;
    float metallic;
    std::uint32_t image;
    std::uint32_t doubleSided;
};

struct ImageRecord {
    std::uint32_t width;
    std::uint32_t height;
};

} // namespace

void write(RecordWriter& writer, const GroundMesh& ground)
{
    writer.addOne(ground.origin);
    writer.add(ground.positions);
    writer.add(ground.normals);
    writer.add(ground.uvs);
    writer.add(ground.colors);
    writer.add(ground.triangles);
    writer.add(ground.materialOf);
    writer.add(ground.nodeOf);
    writer.add(ground.bears);
    writer.add(ground.sourceOf);
    writer.addOne(static_cast<std::uint64_t>(ground.materials.size()));
    for (const GroundMaterial& material : ground.materials) {
        writer.add(std::string_view(material.name));
        writer.addOne(MaterialRecord{material.baseColor, material.roughness, material.metallic,
                                     material.image, material.doubleSided ? 1U : 0U});
    }
    writer.addOne(static_cast<std::uint64_t>(ground.images.size()));
    for (const GroundImage& image : ground.images) {
        writer.add(std::string_view(image.name));
        writer.addOne(ImageRecord{image.width, image.height});
        writer.add(image.rgba);
    }
    writer.addOne(static_cast<std::uint64_t>(ground.nodes.size()));
    for (const std::string& node : ground.nodes)
        writer.add(std::string_view(node));
    writer.add(std::string_view(ground.copyright));
    writer.addOne(static_cast<std::uint32_t>(ground.hasColors ? 1 : 0));
    writer.addOne(static_cast<std::uint32_t>(ground.hasNormals ? 1 : 0));
}

GroundMesh readGround(RecordReader& reader, const std::string& place)
{
    GroundMesh ground;
    reader.readOne(ground.origin);
    reader.read(ground.positions);
    reader.read(ground.normals);
    reader.read(ground.uvs);
    reader.read(ground.colors);
    reader.read(ground.triangles);
    reader.read(ground.materialOf);
    reader.read(ground.nodeOf);
    reader.read(ground.bears);
    reader.read(ground.sourceOf);
    std::uint64_t count = 0;
    for (reader.readOne(count); count > 0; --count) {
        GroundMaterial& material = ground.materials.emplace_back();
        reader.read(material.name);
        MaterialRecord record = {};
        reader.readOne(record);
        material.baseColor = record.baseColor;
        material.roughness = record.roughness;
        material.metallic = record.metallic;
        material.image = record.image;
        material.doubleSided = record.doubleSided != 0;
    }
    for (reader.readOne(count); count > 0; --count) {
        GroundImage& image = ground.images.emplace_back();
        reader.read(image.name);
        ImageRecord record = {};
        reader.readOne(record);
        image.width = record.width;
        image.height = record.height;
        reader.read(image.rgba);
        if (image.rgba.size() != std::size_t(4) * image.width * image.height)
            fail(ErrorKind::input, "{}: an image of {} x {} has {} bytes", place, image.width,
                 image.height, image.rgba.size());
    }
    for (reader.readOne(count); count > 0; --count)
        reader.read(ground.nodes.emplace_back());
    reader.read(ground.copyright);
    std::uint32_t flag = 0;
    reader.readOne(flag);
    ground.hasColors = flag != 0;
    reader.readOne(flag);
    ground.hasNormals = flag != 0;
    if (!ground.triangles.empty())
        validate(ground, place);
    return ground;
}

} // namespace sward::terrain
