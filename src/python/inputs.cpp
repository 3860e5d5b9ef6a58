#include "python/inputs.h"

#include "bake/settings/stroke_file.h"
#include "terrain/loading/arrays.h"

#include <cstddef>
#include <memory>
#include <utility>

namespace sward::python {
namespace {

namespace py = pybind11;

std::size_t rowsOf(const py::array& array)
{
    return static_cast<std::size_t>(array.shape(0));
}

// The values of an attribute; missing components are 1, as everywhere.
terrain::VertexAttribute attributeOf(const std::string& name, const Inputs::Floats& array)
{
    const auto values = array.unchecked<2>();
    terrain::VertexAttribute attribute{
        .name = name, .components = static_cast<std::uint32_t>(values.shape(1)), .values = {}};
    attribute.values.resize(rowsOf(array), glm::vec4(1.0f));
    for (py::ssize_t i = 0; i < values.shape(0); ++i)
        for (py::ssize_t c = 0; c < values.shape(1); ++c)
            attribute.values[static_cast<std::size_t>(i)][static_cast<glm::length_t>(c)] =
                values(i, c);
    return attribute;
}

} // namespace

void Inputs::setMesh(const std::string& name, const Doubles& vertices, const Indices& triangles,
                     const std::optional<Floats>& colors, const std::optional<Floats>& uvs,
                     const py::dict& attributes, bool isSingle)
{
    const auto mesh = std::make_shared<terrain::MeshArrays>();
    mesh->isSingle = isSingle;
    mesh->vertices.resize(rowsOf(vertices));
    const auto places = vertices.unchecked<2>();
    for (py::ssize_t i = 0; i < places.shape(0); ++i)
        mesh->vertices[static_cast<std::size_t>(i)] = {places(i, 0), places(i, 1), places(i, 2)};
    mesh->triangles.resize(rowsOf(triangles));
    const auto corners = triangles.unchecked<2>();
    for (py::ssize_t i = 0; i < corners.shape(0); ++i)
        mesh->triangles[static_cast<std::size_t>(i)] = {corners(i, 0), corners(i, 1),
                                                        corners(i, 2)};
    if (colors)
        mesh->colors = attributeOf("", *colors).values;
    if (uvs)
        for (const glm::vec4& uv : attributeOf("", *uvs).values)
            mesh->uvs.emplace_back(uv.x, uv.y);
    for (const auto& [key, value] : attributes)
        mesh->attributes.push_back(attributeOf(key.cast<std::string>(), value.cast<Floats>()));
    given_.groundName = name;
    given_.isHeightmap = false;
    given_.ground = [mesh, name](const terrain::ImportSettings& settings, Diagnostics& warnings) {
        return terrain::load(terrain::MeshArrays(*mesh), name, settings, warnings);
    };
}

void Inputs::setHeights(const std::string& name, const Floats& heights)
{
    const auto array = std::make_shared<terrain::HeightArray>();
    array->size = {static_cast<std::uint32_t>(heights.shape(1)),
                   static_cast<std::uint32_t>(heights.shape(0))};
    array->values.assign(heights.data(), heights.data() + heights.size());
    given_.groundName = name;
    given_.isHeightmap = true;
    given_.ground = [array, name](const terrain::ImportSettings& settings, Diagnostics& warnings) {
        return terrain::load(terrain::HeightArray(*array), name, settings, warnings);
    };
}

void Inputs::addMask(const std::string& name, const Words& values, bool invert)
{
    auto image = std::make_shared<terrain::ChannelImage>();
    image->height = static_cast<std::uint32_t>(values.shape(0));
    image->width = static_cast<std::uint32_t>(values.shape(1));
    image->values.assign(values.data(), values.data() + values.size());
    given_.masks.push_back({.source = bake::Mask::Source::texture,
                            .invert = invert,
                            .file = name,
                            .image = std::move(image)});
}

void Inputs::setStrokes(const std::string& json)
{
    given_.strokes = bake::parseStrokes(json, "strokes");
    given_.strokes->file = "strokes";
}

void Inputs::setMeadow(const std::string& json)
{
    given_.meadow = bake::parseMeadow(json, "meadow");
}

} // namespace sward::python
