#include "terrain/gltf/primitive.h"

#include "core/error.h"
#include "terrain/gltf/accessor.h"
#include "terrain/unit_colors.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>

namespace sward::terrain {
namespace {

constexpr std::size_t noVertex = ~std::size_t(0);

// Modes of a primitive.
constexpr int triangleList = 4;
constexpr int triangleStrip = 5;
constexpr int triangleFan = 6;

std::optional<int> attribute(const GltfAttributes& attributes, const std::string& name)
{
    const int accessor = accessorOf(attributes, name);
    return accessor == noEntry ? std::nullopt : std::optional(accessor);
}

std::optional<int> attribute(const GltfPrimitive& primitive, const std::string& name)
{
    return attribute(primitive.attributes, name);
}

// Excludes points and lines.
bool isGround(const GltfPrimitive& primitive)
{
    return primitive.mode >= triangleList;
}

// Appends the triangles of a list, strip or fan; `first` is the soup's number of vertex 0.
void appendTriangles(const std::vector<std::uint32_t>& indices, int mode, std::uint32_t first,
                     std::vector<glm::uvec3>& triangles)
{
    const std::size_t begin = triangles.size();
    const std::size_t n = indices.size();
    switch (mode) {
    case triangleStrip:
        // Flip every other triangle of a strip.
        for (std::size_t i = 0; i + 2 < n; ++i)
            triangles.emplace_back(indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]);
        break;
    case triangleFan:
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

// Reads one primitive into the soup of its mesh.
class PrimitiveReader {
public:
    PrimitiveReader(const GltfModel& model, const GltfPrimitive& primitive, const GltfPose& pose,
                    std::string place, Soup& soup)
        : model_(model)
        , primitive_(primitive)
        , pose_(pose)
        , place_(std::move(place))
        , soup_(soup)
        , first_(soup.positions.size())
    {
    }

    void read(const std::vector<GltfUvSource>& uvs, const MaskInputs& wanted,
              Diagnostics& diagnostics)
    {
        readPositions();
        readNormals();
        const std::size_t material = primitive_.material != noEntry
                                         ? static_cast<std::size_t>(primitive_.material)
                                         : uvs.size() - 1;
        readUvs(uvs.at(material), diagnostics);
        readColors(diagnostics);
        const std::size_t firstTriangle = soup_.triangles.size();
        readTriangles(static_cast<std::uint32_t>(material), diagnostics);
        for (const std::string& name : wanted.attributes)
            readForMasks(name, uvs.at(material), firstTriangle, diagnostics);
        if (pose_.isSkinned())
            applySkin(model_, primitive_, pose_, place_, first_, firstTriangle, soup_, diagnostics);
    }

private:
    // Passes an attribute's elements to `put(vertex, numbers)`, one per vertex.
    template <typename Put>
    void readAttribute(int accessor, const std::string& name, std::size_t low, std::size_t high,
                       const Put& put)
    {
        const GltfAccessor reader(model_, accessor, place_ + ": " + name);
        if (reader.isWord())
            fail(ErrorKind::input,
                 "{}: {}: accessor {} has component type 5125 (unsigned int), which this attribute "
                 "cannot have",
                 place_, name, accessor);
        reader.requireComponents(low, high);
        if (reader.count() != vertices_)
            fail(ErrorKind::input, "{}: {} has {} elements for {} vertices", place_, name,
                 reader.count(), vertices_);
        const std::size_t components = reader.components();
        std::atomic<std::size_t> wrong = noVertex;
        reader.eachNumbers([&](std::size_t first, std::size_t count, const float* numbers) {
            for (std::size_t i = 0; i < count; ++i) {
                const float* const own = numbers + i * components;
                for (std::size_t c = 0; c < components; ++c)
                    if (!std::isfinite(own[c]))
                        wrong = first + i;
                put(first_ + first + i, own, components);
            }
        });
        // Several threads may have found an error: name the first.
        if (wrong != noVertex) {
            const std::vector<float> numbers = reader.numbers();
            for (std::size_t i = 0; i < numbers.size(); ++i)
                if (!std::isfinite(numbers[i]))
                    fail(ErrorKind::input, "{}: {} of vertex {} is not a finite number", place_,
                         name, i / components);
        }
    }

    // Passes the differences of the morph targets that count to `add(vertex, weight, numbers)`.
    template <typename Add>
    void addTargets(const std::string& name, std::size_t low, std::size_t high, const Add& add)
    {
        const std::size_t targets = std::min(pose_.weights.size(), primitive_.targets.size());
        for (std::size_t t = 0; t < targets; ++t) {
            const double weight = pose_.weights[t];
            const auto accessor = attribute(primitive_.targets[t], name);
            if (!accessor || weight == 0.0)
                continue;
            const std::string what = fmt::format("{} of morph target {}", name, t);
            const GltfAccessor reader(model_, *accessor, place_ + ": " + what);
            reader.requireComponents(low, high);
            if (reader.isWord() || reader.count() != vertices_)
                fail(ErrorKind::input, "{}: {}: accessor {} has {} elements for {} vertices{}",
                     place_, what, *accessor, reader.count(), vertices_,
                     reader.isWord() ? ", and of unsigned integers, which it cannot have" : "");
            const std::vector<float> numbers = reader.numbers();
            for (std::size_t i = 0; i < numbers.size(); ++i)
                if (!std::isfinite(numbers[i]))
                    fail(ErrorKind::input, "{}: {} of vertex {} is not a finite number", place_,
                         what, i / reader.components());
            for (std::size_t v = 0; v < vertices_; ++v)
                add(first_ + v, weight, numbers.data() + v * reader.components(),
                    reader.components());
        }
    }

    void readPositions()
    {
        const auto accessor = attribute(primitive_, "POSITION");
        if (!accessor)
            fail(ErrorKind::input, "{}: no POSITION", place_);
        const GltfElements& elements =
            model_.structure.accessors.at(static_cast<std::size_t>(*accessor));
        if (elements.view == noEntry && !elements.sparse)
            fail(ErrorKind::input,
                 "{}: POSITION: accessor {} has no bufferView, so that all of its {} vertices lie "
                 "at 0",
                 place_, *accessor, elements.count);
        vertices_ = elements.count;
        soup_.positions.resize(first_ + vertices_);
        readAttribute(*accessor, "POSITION", 3, 3,
                      [&](std::size_t vertex, const float* p, std::size_t) {
                          soup_.positions[vertex] = glm::dvec3(p[0], p[1], p[2]);
                      });
        notePrecision(*accessor);
        addTargets("POSITION", 3, 3,
                   [&](std::size_t vertex, double weight, const float* d, std::size_t) {
                       soup_.positions[vertex] += weight * glm::dvec3(d[0], d[1], d[2]);
                   });
    }

    // The step of quantised positions, or that of single precision.
    void notePrecision(int accessor)
    {
        const GltfAccessor reader(model_, accessor, place_);
        double step = reader.step();
        for (std::size_t v = first_; reader.isFloat() && v < soup_.positions.size(); ++v) {
            const glm::dvec3 size = glm::abs(soup_.positions[v]);
            step = std::max(step, 0x1p-23 * std::max({size.x, size.y, size.z}));
        }
        soup_.precision = std::max(soup_.precision, step);
    }

    void readNormals()
    {
        const auto accessor = attribute(primitive_, "NORMAL");
        if (!accessor)
            return;
        soup_.normals.resize(first_ + vertices_, glm::vec3(0.0f));
        readAttribute(*accessor, "NORMAL", 3, 3,
                      [&](std::size_t vertex, const float* n, std::size_t) {
                          soup_.normals[vertex] = glm::vec3(n[0], n[1], n[2]);
                      });
        addTargets(
            "NORMAL", 3, 3, [&](std::size_t vertex, double weight, const float* d, std::size_t) {
                soup_.normals[vertex] += static_cast<float>(weight) * glm::vec3(d[0], d[1], d[2]);
            });
    }

    void readUvs(const GltfUvSource& source, Diagnostics& diagnostics)
    {
        const std::string name = fmt::format("TEXCOORD_{}", source.set);
        const auto accessor = attribute(primitive_, name);
        if (!accessor) {
            if (source.set != 0)
                diagnostics.warn("{}: its material needs {}, which it does not have", place_, name);
            return;
        }
        soup_.uvs.resize(first_ + vertices_, glm::vec2(0.0f));
        readAttribute(*accessor, name, 2, 2, [&](std::size_t vertex, const float* uv, std::size_t) {
            soup_.uvs[vertex] = source.placing * glm::vec3(uv[0], uv[1], 1.0f);
        });
        addTargets(name, 2, 2, [&](std::size_t vertex, double weight, const float* d, std::size_t) {
            soup_.uvs[vertex] +=
                static_cast<float>(weight) * (source.placing * glm::vec3(d[0], d[1], 0.0f));
        });
    }

    void readColors(Diagnostics& diagnostics)
    {
        const auto accessor = attribute(primitive_, "COLOR_0");
        if (!accessor)
            return;
        soup_.colors.resize(first_ + vertices_, glm::vec4(1.0f));
        readAttribute(*accessor, "COLOR_0", 3, 4,
                      [&](std::size_t vertex, const float* c, std::size_t components) {
                          soup_.colors[vertex] = {c[0], c[1], c[2], components == 4 ? c[3] : 1.0f};
                      });
        // Differences have the unit of the colours, whatever the sum reaches.
        const std::span<glm::vec4> own = std::span(soup_.colors).subspan(first_);
        const glm::vec4 unit = scaleToUnit(own, place_, "COLOR_0", diagnostics);
        addTargets("COLOR_0", 3, 4,
                   [&](std::size_t vertex, double weight, const float* d, std::size_t components) {
                       for (std::size_t c = 0; c < components; ++c)
                           soup_.colors[vertex][int(c)] +=
                               static_cast<float>(weight) * d[c] / unit[int(c)];
                   });
        cutToUnit(own, place_, "COLOR_0", diagnostics);
        soup_.hasColors = true;
    }

    // Reads an attribute of a mask, or notes that it is missing.
    void readForMasks(const std::string& name, const GltfUvSource& shown, std::size_t firstTriangle,
                      Diagnostics& diagnostics)
    {
        const std::string given =
            name == materialCoordinates ? fmt::format("TEXCOORD_{}", shown.set) : name;
        const auto accessor = attribute(primitive_, given);
        if (!accessor)
            soup_.attributes.addGap(name, firstTriangle, soup_.triangles.size(), place_);
        if (!accessor || name == materialCoordinates || name == "COLOR_0")
            return;
        const bool isUv = name.starts_with("TEXCOORD_");
        const bool isColor = name.starts_with("COLOR_");
        VertexAttribute& kept = soup_.attributes.entry(name);
        const GltfAccessor shape(model_, *accessor, place_);
        if (!isColor)
            kept.components =
                std::min(kept.components, static_cast<std::uint32_t>(shape.components()));
        kept.values.resize(first_ + vertices_, glm::vec4(1.0f));
        const std::size_t low = isUv ? 2 : isColor ? 3 : 1;
        readAttribute(*accessor, name, low, isUv ? 2 : 4,
                      [&](std::size_t vertex, const float* numbers, std::size_t components) {
                          glm::vec4 value(0.0f, 0.0f, 0.0f, isColor ? 1.0f : 0.0f);
                          for (std::size_t c = 0; c < components; ++c)
                              value[int(c)] = numbers[c];
                          kept.values[vertex] = value;
                      });
        const std::span<glm::vec4> own = std::span(kept.values).subspan(first_);
        const glm::vec4 unit = isUv ? glm::vec4(1.0f) : scaleToUnit(own, place_, name, diagnostics);
        addTargets(name, low, isUv ? 2 : 4,
                   [&](std::size_t vertex, double weight, const float* d, std::size_t components) {
                       for (std::size_t c = 0; c < components; ++c)
                           kept.values[vertex][int(c)] +=
                               static_cast<float>(weight) * d[c] / unit[int(c)];
                   });
        // Packers store coordinates as integers, and their scale in the material.
        if (isUv && !shape.isFloat() && shown.placing != GltfUvSource{}.placing)
            diagnostics.warn("{}: {} is stored in integers, and its material has a "
                             "KHR_texture_transform that may hold their scale: a mask with "
                             ":transform follows it",
                             place_, name);
        if (!isUv)
            cutToUnit(own, place_, name, diagnostics);
    }

    void readTriangles(std::uint32_t material, Diagnostics& diagnostics)
    {
        if (primitive_.mode == triangleList && primitive_.indices != noEntry)
            readTriangleList(diagnostics);
        else
            readOtherTriangles(diagnostics);
        soup_.materialOf.resize(soup_.triangles.size(), material);
    }

    void warnOfRest(std::size_t indices, Diagnostics& diagnostics)
    {
        if (indices % 3 != 0)
            diagnostics.warn("{}: {} indices are not a multiple of 3; the last ones are left out",
                             place_, indices);
    }

    // Throws, or warns of an index that graphics APIs take for the start of another strip.
    void judgeIndices(const std::vector<std::uint32_t>& indices, std::uint32_t restart,
                      Diagnostics& diagnostics) const
    {
        std::size_t restarts = 0;
        std::size_t first = 0;
        for (std::size_t i = 0; i < indices.size(); ++i) {
            if (indices[i] >= vertices_)
                fail(ErrorKind::input, "{}: index {} names vertex {}, but there are {}{}", place_,
                     i, indices[i], vertices_,
                     indices[i] == restart ? "; it is the restart value, which glTF does not allow"
                                           : "");
            if (indices[i] == restart && restarts++ == 0)
                first = i;
        }
        if (restarts > 0)
            diagnostics.warn("{}: {} of its indices are {}, the restart value of their type, which "
                             "glTF does not allow, index {} first; vertex {} is taken",
                             place_, restarts, restart, first, restart);
    }

    // Reads indexed triangle lists block by block.
    void readTriangleList(Diagnostics& diagnostics)
    {
        const GltfAccessor reader(model_, primitive_.indices, place_ + ": indices");
        warnOfRest(reader.count(), diagnostics);
        const std::size_t begin = soup_.triangles.size();
        const std::size_t corners = reader.count() / 3 * 3;
        soup_.triangles.resize(begin + corners / 3);
        std::atomic<bool> isSound = true;
        const std::uint32_t restart = reader.restartIndex();
        reader.eachIndices([&](std::size_t first, std::size_t count, const std::uint32_t* indices) {
            for (std::size_t i = 0; i < count && first + i < corners; ++i) {
                if (indices[i] >= vertices_ || indices[i] == restart)
                    isSound = false;
                const std::size_t corner = first + i;
                soup_.triangles[begin + corner / 3][int(corner % 3)] =
                    indices[i] + static_cast<std::uint32_t>(first_);
            }
        });
        if (!isSound)
            judgeIndices(reader.indices(), restart, diagnostics);
    }

    // Reads strips, fans and unindexed lists.
    void readOtherTriangles(Diagnostics& diagnostics)
    {
        std::vector<std::uint32_t> indices;
        if (primitive_.indices != noEntry) {
            const GltfAccessor reader(model_, primitive_.indices, place_ + ": indices");
            indices = reader.indices();
            judgeIndices(indices, reader.restartIndex(), diagnostics);
        } else {
            indices.resize(vertices_);
            std::iota(indices.begin(), indices.end(), 0U);
        }
        if (primitive_.mode == triangleList)
            warnOfRest(indices.size(), diagnostics);
        appendTriangles(indices, primitive_.mode, static_cast<std::uint32_t>(first_),
                        soup_.triangles);
    }

    const GltfModel& model_;
    const GltfPrimitive& primitive_;
    const GltfPose& pose_;
    std::string place_;
    Soup& soup_;
    std::size_t first_;
    std::size_t vertices_ = 0;
};

} // namespace

GltfMeshSize sizeOfGltfMesh(const GltfModel& model, std::size_t mesh)
{
    const auto countOf = [&](int accessor) {
        return std::uint64_t(
            model.structure.accessors.at(static_cast<std::size_t>(accessor)).count);
    };
    GltfMeshSize size;
    for (const GltfPrimitive& primitive : model.structure.meshes.at(mesh).primitives) {
        const auto positions = attribute(primitive, "POSITION");
        if (!isGround(primitive) || !positions)
            continue;
        const std::uint64_t vertices = countOf(*positions);
        const std::uint64_t corners =
            primitive.indices != noEntry ? countOf(primitive.indices) : vertices;
        size.vertices += vertices;
        size.triangles += primitive.mode == triangleList ? corners / 3 : corners;
    }
    return size;
}

void readGltfMesh(const GltfModel& model, std::size_t mesh, const GltfPose& pose,
                  const std::vector<GltfUvSource>& uvs, const MaskInputs& read,
                  const std::string& place, Soup& soup, Diagnostics& diagnostics)
{
    const GltfMesh& source = model.structure.meshes.at(mesh);
    for (std::size_t i = 0; i < source.primitives.size(); ++i) {
        const GltfPrimitive& primitive = source.primitives[i];
        std::string where = fmt::format("{}: mesh {}", place, mesh);
        if (!source.name.empty())
            where += fmt::format(" \"{}\"", source.name);
        where += fmt::format(", primitive {}", i);
        if (!isGround(primitive)) {
            diagnostics.warn("{}: points and lines are not ground and are left out", where);
            continue;
        }
        if (!attribute(primitive, "POSITION")) {
            diagnostics.warn("{}: it has no POSITION and is left out", where);
            continue;
        }
        PrimitiveReader(model, primitive, pose, std::move(where), soup)
            .read(uvs, read, diagnostics);
    }
}

} // namespace sward::terrain
