#include "terrain/gltf/nodes.h"

#include "core/error.h"
#include "terrain/gltf/accessor.h"

#include <fmt/core.h>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace sward::terrain {
namespace {

constexpr std::size_t pathLimit = 4096;                      // [bytes]
constexpr std::size_t visitLimit = std::size_t(1) << 20;     // nodes of a scene
constexpr std::size_t placementLimit = std::size_t(1) << 29; // of its meshes [bytes]

// translation · rotation · scale; the quaternion (x, y, z, w) need not be of unit length.
glm::dmat4 compose(const glm::dvec3& translation, const std::array<double, 4>& q,
                   const glm::dvec3& scale, const std::string& place)
{
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(length > 0.0) || !std::isfinite(length))
        fail(ErrorKind::input, "{}: its rotation has length {}", place, length);
    const glm::dquat unit(q[3] / length, q[0] / length, q[1] / length, q[2] / length);
    glm::dmat3 linear = glm::mat3_cast(unit);
    linear[0] *= scale.x;
    linear[1] *= scale.y;
    linear[2] *= scale.z;
    glm::dmat4 matrix(linear);
    matrix[3] = glm::dvec4(translation, 1.0);
    return matrix;
}

glm::dmat4 localTransform(const tinygltf::Node& node, const std::string& place)
{
    if (node.matrix.size() == 16) {
        constexpr double lastRow[] = {0.0, 0.0, 0.0, 1.0};
        constexpr double tolerance = 1e-6; // rounding of exporters
        for (std::size_t column = 0; column < 4; ++column)
            if (std::fabs(node.matrix[4 * column + 3] - lastRow[column]) > tolerance)
                fail(ErrorKind::input,
                     "{}: element {} of its matrix is {}, but the last row must be 0 0 0 1: a "
                     "projection does not place ground",
                     place, 4 * column + 3, node.matrix[4 * column + 3]);
        glm::dmat4 matrix(1.0);
        for (glm::length_t column = 0; column < 4; ++column)
            for (glm::length_t row = 0; row < 3; ++row)
                matrix[column][row] = node.matrix[std::size_t(4 * column + row)];
        return matrix;
    }
    glm::dvec3 translation(0.0);
    std::array<double, 4> rotation = {0.0, 0.0, 0.0, 1.0};
    glm::dvec3 scale(1.0);
    if (node.translation.size() == 3)
        translation = {node.translation[0], node.translation[1], node.translation[2]};
    if (node.rotation.size() == 4)
        rotation = {node.rotation[0], node.rotation[1], node.rotation[2], node.rotation[3]};
    if (node.scale.size() == 3)
        scale = {node.scale[0], node.scale[1], node.scale[2]};
    return compose(translation, rotation, scale, place);
}

// The transforms of EXT_mesh_gpu_instancing; none if the node does not use it.
std::vector<glm::dmat4> instancesOf(const GltfModel& model, const tinygltf::Node& node,
                                    const std::string& place)
{
    const auto found = node.extensions.find("EXT_mesh_gpu_instancing");
    if (found == node.extensions.end())
        return {};
    const tinygltf::Value& attributes = found->second.Get("attributes");
    std::size_t count = 0;
    const auto numbersOf = [&](const char* key, std::size_t components) {
        std::vector<float> numbers;
        if (attributes.Has(key)) {
            const GltfAccessor reader(model, attributes.Get(key).GetNumberAsInt(),
                                      place + ": " + key);
            reader.requireComponents(components, components);
            count = reader.count();
            numbers = reader.numbers();
        }
        return numbers;
    };
    const std::vector<float> t = numbersOf("TRANSLATION", 3);
    const std::vector<float> r = numbersOf("ROTATION", 4);
    const std::vector<float> s = numbersOf("SCALE", 3);

    // Attributes of the application alone place every instance where the node is.
    if (count == 0)
        for (const std::string& key : attributes.Keys())
            count = model.structure.accessors
                        .at(static_cast<std::size_t>(attributes.Get(key).GetNumberAsInt()))
                        .count;

    std::vector<glm::dmat4> instances;
    for (std::size_t i = 0; i < count; ++i) {
        const auto vector = [i](const std::vector<float>& v, double otherwise) {
            return v.empty() ? glm::dvec3(otherwise)
                             : glm::dvec3(v[3 * i], v[3 * i + 1], v[3 * i + 2]);
        };
        const std::array<double, 4> turn =
            r.empty() ? std::array<double, 4>{0.0, 0.0, 0.0, 1.0}
                      : std::array<double, 4>{r[4 * i], r[4 * i + 1], r[4 * i + 2], r[4 * i + 3]};
        instances.push_back(compose(vector(t, 0.0), turn, vector(s, 1.0),
                                    fmt::format("{}: instance {}", place, i)));
    }
    return instances;
}

// Whether KHR_node_visibility hides a node and what is below it.
bool isHidden(const tinygltf::Node& node)
{
    const auto found = node.extensions.find("KHR_node_visibility");
    if (found == node.extensions.end() || !found->second.Has("visible"))
        return false;
    const tinygltf::Value& visible = found->second.Get("visible");
    return visible.IsBool() && !visible.Get<bool>();
}

// The nodes that MSFT_lod shows in the place of others from afar.
std::vector<bool> coarserLevels(const tinygltf::Model& model)
{
    std::vector<bool> coarse(model.nodes.size(), false);
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        const auto found = model.nodes[i].extensions.find("MSFT_lod");
        if (found == model.nodes[i].extensions.end() || coarse[i])
            continue;
        const tinygltf::Value& levels = found->second.Get("ids");
        for (int level = 0; level < static_cast<int>(levels.ArrayLen()); ++level) {
            const int node = levels.Get(level).GetNumberAsInt();
            if (node != static_cast<int>(i))
                coarse[static_cast<std::size_t>(node)] = true;
        }
    }
    return coarse;
}

class Walker {
public:
    Walker(const GltfModel& model, const std::string& place)
        : model_(model)
        , place_(place)
        , coarse_(coarserLevels(model.structure))
    {
    }

    void visit(int index, const glm::dmat4& parent, const std::string& parentPath)
    {
        const tinygltf::Node& node = model_.structure.nodes.at(static_cast<std::size_t>(index));
        std::string path = parentPath.empty() ? "" : parentPath + "/";
        path += node.name.empty() ? fmt::format("node {}", index) : node.name;
        if (path.size() > pathLimit)
            fail(ErrorKind::input, "{}: the path of node {} has more than {} bytes", place_, index,
                 pathLimit);
        if (++visits_ > visitLimit)
            fail(ErrorKind::input, "{}: its scene shows more than {} nodes", place_, visitLimit);
        const std::string place = fmt::format("{}: node \"{}\"", place_, path);
        if (isHidden(node)) {
            hidden_.push_back(path);
            return;
        }
        if (coarse_[static_cast<std::size_t>(index)]) {
            coarser_.push_back(path);
            return;
        }
        const glm::dmat4 transform = parent * localTransform(node, place);

        if (node.mesh >= 0) {
            const auto instances = instancesOf(model_, node, place);
            const std::size_t count = std::max<std::size_t>(instances.size(), 1);
            bytes_ += count * (sizeof(GltfPlacement) + path.size());
            if (bytes_ > placementLimit)
                fail(ErrorKind::input, "{}: its scene shows more meshes than {} bytes can list",
                     place_, placementLimit);
            if (instances.empty())
                placements_.push_back({node.mesh, path, transform, false});
            for (std::size_t i = 0; i < instances.size(); ++i)
                placements_.push_back({node.mesh, path, transform * instances[i], i > 0});
        }
        for (const int child : node.children)
            visit(child, transform, path);
    }

    std::vector<GltfPlacement> take(Diagnostics& diagnostics)
    {
        const auto warn = [&](const std::vector<std::string>& paths, const char* why) {
            if (!paths.empty())
                diagnostics.warn("{}: {} nodes are {}, and left out with what is below them: {}{}",
                                 place_, paths.size(), why, paths[0],
                                 paths.size() > 1 ? ", …" : "");
        };
        warn(hidden_, "hidden (KHR_node_visibility)");
        warn(coarser_, "coarser levels of detail (MSFT_lod)");
        if (placements_.empty() && !(hidden_.empty() && coarser_.empty()))
            fail(ErrorKind::input,
                 "{}: its scene shows no mesh: {} nodes are hidden (KHR_node_visibility), {} are "
                 "coarser levels of detail (MSFT_lod)",
                 place_, hidden_.size(), coarser_.size());
        return std::move(placements_);
    }

private:
    const GltfModel& model_;
    const std::string& place_;
    std::vector<bool> coarse_;         // per node
    std::vector<std::string> hidden_;  // paths
    std::vector<std::string> coarser_; // paths
    std::vector<GltfPlacement> placements_;
    std::size_t visits_ = 0;
    std::size_t bytes_ = 0; // of placements
};

std::vector<int> rootNodes(const tinygltf::Model& model)
{
    std::vector<bool> isChild(model.nodes.size(), false);
    for (const tinygltf::Node& node : model.nodes)
        for (const int child : node.children)
            isChild.at(static_cast<std::size_t>(child)) = true;
    std::vector<int> roots;
    for (std::size_t i = 0; i < model.nodes.size(); ++i)
        if (!isChild[i])
            roots.push_back(static_cast<int>(i));
    return roots;
}

// The roots that do not lie below another one: what is named twice is shown once.
std::vector<int> withoutChildren(const tinygltf::Model& model, const std::vector<int>& roots,
                                 const std::string& place, Diagnostics& diagnostics)
{
    std::vector<int> parent(model.nodes.size(), -1);
    for (std::size_t i = 0; i < model.nodes.size(); ++i)
        for (const int child : model.nodes[i].children)
            parent[static_cast<std::size_t>(child)] = static_cast<int>(i);
    std::vector<bool> isRoot(model.nodes.size(), false);
    for (const int root : roots)
        isRoot[static_cast<std::size_t>(root)] = true;
    std::vector<int> kept;
    for (const int root : roots) {
        int above = parent[static_cast<std::size_t>(root)];
        while (above >= 0 && !isRoot[static_cast<std::size_t>(above)])
            above = parent[static_cast<std::size_t>(above)];
        if (above < 0)
            kept.push_back(root);
        else
            diagnostics.warn("{}: its scene names node {} and node {}, below which it is; it is "
                             "placed once, there",
                             place, root, above);
    }
    return kept;
}

} // namespace

std::vector<GltfPlacement> placeGltfMeshes(const GltfModel& file, std::optional<int> scene,
                                           const std::string& place, Diagnostics& diagnostics)
{
    const tinygltf::Model& model = file.structure;
    const auto scenes = static_cast<int>(model.scenes.size());
    if (scene && (*scene < 0 || *scene >= scenes))
        fail(ErrorKind::usage, "{}: scene {} does not exist; the file has {}", place, *scene,
             scenes);
    const int chosen = scene.value_or(model.defaultScene >= 0 ? model.defaultScene : 0);

    Walker walker(file, place);
    const std::vector<int> roots =
        scenes == 0 ? rootNodes(model) : model.scenes[static_cast<std::size_t>(chosen)].nodes;
    for (const int root : withoutChildren(model, roots, place, diagnostics))
        walker.visit(root, glm::dmat4(1.0), "");
    return walker.take(diagnostics);
}

} // namespace sward::terrain
