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

constexpr std::size_t pathLimit = 4096;                  // [bytes]
constexpr std::size_t visitLimit = std::size_t(1) << 20; // nodes of a scene

// Memory of the placements of a scene, their paths included: at most so much [bytes], and so much
// for each byte of the file beside a little for all. An instance has 12 bytes or more.
constexpr std::uint64_t placementLimit = std::uint64_t(1) << 29;
constexpr std::uint64_t freePlacements = std::uint64_t(1) << 22;
constexpr std::uint64_t placementGain = 24;

// Nodes that are not shown, of which the first is named.
struct LeftOut {
    std::size_t count = 0;
    std::string first;

    void add(const std::string& path)
    {
        if (count++ == 0)
            first = path;
    }
};

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

// The transforms of EXT_mesh_gpu_instancing; none if the node does not use it.
std::vector<glm::dmat4> instancesOf(const GltfModel& model, const GltfNode& node,
                                    const std::string& place)
{
    if (node.instances.empty())
        return {};
    // Attributes of the application alone place every instance where the node is.
    const auto first = static_cast<std::size_t>(node.instances[0].second);
    const std::size_t count = model.structure.accessors.at(first).count;
    const auto numbersOf = [&](const char* key, std::size_t components) {
        const int accessor = accessorOf(node.instances, key);
        if (accessor == noEntry)
            return std::vector<float>();
        const GltfAccessor reader(model, accessor, place + ": " + key);
        reader.requireComponents(components, components);
        return reader.numbers();
    };
    const std::vector<float> t = numbersOf("TRANSLATION", 3);
    const std::vector<float> r = numbersOf("ROTATION", 4);
    const std::vector<float> s = numbersOf("SCALE", 3);

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

// The nodes that MSFT_lod shows in the place of others from afar.
std::vector<bool> coarserLevels(const GltfStructure& model)
{
    std::vector<bool> coarse(model.nodes.size(), false);
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        if (coarse[i])
            continue;
        for (const int node : model.nodes[i].coarser)
            if (node != static_cast<int>(i))
                coarse[static_cast<std::size_t>(node)] = true;
    }
    return coarse;
}

std::string nameOf(const GltfStructure& model, int node)
{
    const std::string& name = model.nodes.at(static_cast<std::size_t>(node)).name;
    return name.empty() ? fmt::format("node {}", node) : name;
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
        const GltfNode& node = model_.structure.nodes.at(static_cast<std::size_t>(index));
        const std::string path =
            (parentPath.empty() ? "" : parentPath + "/") + nameOf(model_.structure, index);
        if (path.size() > pathLimit)
            fail(ErrorKind::input, "{}: the path of node {} has more than {} bytes", place_, index,
                 pathLimit);
        if (++visits_ > visitLimit)
            fail(ErrorKind::input, "{}: its scene shows more than {} nodes", place_, visitLimit);
        const std::string place = fmt::format("{}: node \"{}\"", place_, path);
        if (node.isHidden) {
            hidden_.add(path);
            return;
        }
        if (coarse_[static_cast<std::size_t>(index)]) {
            coarser_.add(path);
            return;
        }
        const glm::dmat4 transform = parent * gltfTransform(node, place);

        if (node.mesh != noEntry)
            placeMesh(index, path, transform, place);
        for (const int child : node.children)
            visit(child, transform, path);
    }

    std::vector<GltfPlacement> take(Diagnostics& diagnostics)
    {
        const auto warn = [&](const LeftOut& nodes, const char* why) {
            if (nodes.count > 0)
                diagnostics.warn("{}: {} nodes are {}, and left out with what is below them: {}{}",
                                 place_, nodes.count, why, nodes.first,
                                 nodes.count > 1 ? ", …" : "");
        };
        if (skinned_.count > 0)
            diagnostics.warn("{}: {} nodes have a skin and EXT_mesh_gpu_instancing; their joints "
                             "place them once: {}{}",
                             place_, skinned_.count, skinned_.first,
                             skinned_.count > 1 ? ", …" : "");
        warn(hidden_, "hidden (KHR_node_visibility)");
        warn(coarser_, "coarser levels of detail (MSFT_lod)");
        if (placements_.empty() && hidden_.count + coarser_.count > 0)
            fail(ErrorKind::input,
                 "{}: its scene shows no mesh: {} nodes are hidden (KHR_node_visibility), {} are "
                 "coarser levels of detail (MSFT_lod)",
                 place_, hidden_.count, coarser_.count);
        return std::move(placements_);
    }

    // Visits a node that the scene names. What lies above it places it, too.
    void visitRoot(int index, Diagnostics& diagnostics)
    {
        const std::vector<GltfNode>& nodes = model_.structure.nodes;
        std::vector<int> above;
        for (int at = nodes[static_cast<std::size_t>(index)].parent; at != noEntry;
             at = nodes[static_cast<std::size_t>(at)].parent)
            above.push_back(at);
        glm::dmat4 transform(1.0);
        std::string path;
        bool isHidden = false;
        for (auto at = above.rbegin(); at != above.rend(); ++at) {
            const GltfNode& node = nodes[static_cast<std::size_t>(*at)];
            path += (path.empty() ? "" : "/") + nameOf(model_.structure, *at);
            transform = transform * gltfTransform(node, fmt::format("{}: node {}", place_, *at));
            isHidden = isHidden || node.isHidden;
        }
        if (!above.empty())
            diagnostics.warn("{}: its scene names node {}, and not node {}, whose child it is; it "
                             "is placed as that child",
                             place_, index, above[0]);
        if (isHidden)
            hidden_.add(path);
        else
            visit(index, transform, path);
    }

private:
    void placeMesh(int index, const std::string& path, const glm::dmat4& transform,
                   const std::string& place)
    {
        const GltfNode& node = model_.structure.nodes[static_cast<std::size_t>(index)];
        auto instances = instancesOf(model_, node, place);
        // Joints alone place a skinned mesh, so that all instances would lie at one place.
        if (node.skin != noEntry && !instances.empty()) {
            skinned_.add(path);
            instances.clear();
        }
        const std::size_t count = std::max<std::size_t>(instances.size(), 1);
        bytes_ += count * (sizeof(GltfPlacement) + path.size());
        const std::uint64_t limit =
            std::min(placementLimit, freePlacements + placementGain * model_.size);
        if (bytes_ > limit)
            fail(ErrorKind::input,
                 "{}: node \"{}\" is one of more instances than a file of {} bytes may show: their "
                 "list takes more than {} bytes",
                 place_, path.substr(0, 64), model_.size, limit);
        if (instances.empty())
            placements_.push_back({node.mesh, index, path, transform, false});
        for (std::size_t i = 0; i < instances.size(); ++i)
            placements_.push_back({node.mesh, index, path, transform * instances[i], i > 0});
    }

    const GltfModel& model_;
    const std::string& place_;
    std::vector<bool> coarse_; // per node
    LeftOut hidden_;
    LeftOut coarser_;
    LeftOut skinned_; // instances
    std::vector<GltfPlacement> placements_;
    std::size_t visits_ = 0;
    std::uint64_t bytes_ = 0; // of placements
};

std::vector<int> rootNodes(const GltfStructure& model)
{
    std::vector<int> roots;
    for (std::size_t i = 0; i < model.nodes.size(); ++i)
        if (model.nodes[i].parent == noEntry)
            roots.push_back(static_cast<int>(i));
    return roots;
}

// The meshes of the nodes below these, by name alone.
std::size_t meshesBelow(const GltfStructure& model, std::vector<int> nodes)
{
    std::size_t meshes = 0;
    while (!nodes.empty()) {
        const GltfNode& node = model.nodes[static_cast<std::size_t>(nodes.back())];
        nodes.pop_back();
        meshes += node.mesh != noEntry ? 1U : 0U;
        nodes.insert(nodes.end(), node.children.begin(), node.children.end());
    }
    return meshes;
}

// Throws if the chosen scene shows no mesh. Names one that does.
void requireMeshes(const GltfStructure& model, std::size_t chosen, const std::string& place)
{
    if (meshesBelow(model, model.scenes[chosen]) > 0)
        return;
    for (std::size_t i = 0; i < model.scenes.size(); ++i)
        if (const std::size_t meshes = meshesBelow(model, model.scenes[i]); meshes > 0)
            fail(ErrorKind::input,
                 "{}: no triangles: scene {} shows no mesh, but scene {} shows {}: try --scene {}",
                 place, chosen, i, meshes, i);
    fail(ErrorKind::input, "{}: no triangles: none of its {} scenes shows a mesh", place,
         model.scenes.size());
}

// The roots that do not lie below another one: what is named twice is shown once.
std::vector<int> withoutChildren(const GltfStructure& model, const std::vector<int>& roots,
                                 const std::string& place, Diagnostics& diagnostics)
{
    const auto parentOf = [&](int node) {
        return model.nodes[static_cast<std::size_t>(node)].parent;
    };
    std::vector<bool> isRoot(model.nodes.size(), false);
    for (const int root : roots)
        isRoot[static_cast<std::size_t>(root)] = true;
    std::vector<int> kept;
    for (const int root : roots) {
        int above = parentOf(root);
        while (above >= 0 && !isRoot[static_cast<std::size_t>(above)])
            above = parentOf(above);
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
    const GltfStructure& model = file.structure;
    const auto scenes = static_cast<int>(model.scenes.size());
    if (scene && (*scene < 0 || *scene >= scenes))
        fail(ErrorKind::usage, "{}: scene {} does not exist; the file has {}", place, *scene,
             scenes);
    const auto chosen =
        static_cast<std::size_t>(scene.value_or(model.scene == noEntry ? 0 : model.scene));
    if (scenes > 0)
        requireMeshes(model, chosen, place);

    Walker walker(file, place);
    const std::vector<int> roots = scenes == 0 ? rootNodes(model) : model.scenes[chosen];
    for (const int root : withoutChildren(model, roots, place, diagnostics))
        walker.visitRoot(root, diagnostics);
    return walker.take(diagnostics);
}

glm::dmat4 gltfTransform(const GltfNode& node, const std::string& place)
{
    const std::vector<double>& n = node.placing;
    if (n.empty())
        return glm::dmat4(1.0);
    if (n.size() == 10)
        return compose({n[0], n[1], n[2]}, {n[3], n[4], n[5], n[6]}, {n[7], n[8], n[9]}, place);
    constexpr double lastRow[] = {0.0, 0.0, 0.0, 1.0};
    constexpr double tolerance = 1e-6; // rounding of exporters
    for (std::size_t column = 0; column < 4; ++column)
        if (std::fabs(n[4 * column + 3] - lastRow[column]) > tolerance)
            fail(ErrorKind::input,
                 "{}: element {} of its matrix is {}, but the last row must be 0 0 0 1: a "
                 "projection does not place ground",
                 place, 4 * column + 3, n[4 * column + 3]);
    glm::dmat4 matrix(1.0);
    for (glm::length_t column = 0; column < 4; ++column)
        for (glm::length_t row = 0; row < 3; ++row)
            matrix[column][row] = n[std::size_t(4 * column + row)];
    return matrix;
}

} // namespace sward::terrain
