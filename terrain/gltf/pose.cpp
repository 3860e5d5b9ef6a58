#include "terrain/gltf/pose.h"

#include "core/error.h"
#include "terrain/gltf/accessor.h"
#include "terrain/gltf/nodes.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace sward::terrain {
namespace {

// Joints and weights of a primitive: one array for each set of four.
struct Influences {
    std::vector<std::vector<float>> joints;
    std::vector<std::vector<float>> weights;
};

// Largest number of weights of a primitive: freeWeights, and weightGain for each byte of the file.
// Zeros of accessors without a bufferView count. Compression takes a fraction of a byte for one.
constexpr std::uint64_t freeWeights = std::uint64_t(1) << 22;
constexpr std::uint64_t weightGain = 24;

// Component types that may number joints (glTF 2.0, 3.7.3.3).
constexpr std::uint32_t unsignedByte = 5121;
constexpr std::uint32_t unsignedShort = 5123;

void requireJointType(const GltfModel& model, int accessor, const std::string& place)
{
    const GltfElements& own = model.structure.accessors.at(static_cast<std::size_t>(accessor));
    if (own.isNormalized || (own.type != unsignedByte && own.type != unsignedShort))
        fail(ErrorKind::input,
             "{}: accessor {} has component type {}{}, but joints are unsigned bytes or shorts "
             "(5121 or 5123), not normalized",
             place, accessor, own.type, own.isNormalized ? ", normalized" : "");
}

Influences influencesOf(const GltfModel& model, const GltfPrimitive& primitive,
                        std::size_t vertices, const std::string& place)
{
    Influences found;
    // A file may have thousands of sets: search them quickly.
    std::unordered_map<std::string_view, int> accessors;
    for (const auto& [name, accessor] : primitive.attributes)
        accessors.emplace(name, accessor);
    const auto accessorNamed = [&](const std::string& name) {
        const auto entry = accessors.find(name);
        return entry == accessors.end() ? noEntry : entry->second;
    };
    const std::uint64_t limit = freeWeights + weightGain * model.size;
    for (int set = 0;; ++set) {
        const std::string joints = fmt::format("JOINTS_{}", set);
        const std::string weights = fmt::format("WEIGHTS_{}", set);
        const int jointsAt = accessorNamed(joints);
        const int weightsAt = accessorNamed(weights);
        if (jointsAt == noEntry && weightsAt == noEntry)
            return found;
        if (jointsAt == noEntry || weightsAt == noEntry)
            fail(ErrorKind::input, "{}: it has {} and no {}", place,
                 jointsAt == noEntry ? weights : joints, jointsAt == noEntry ? joints : weights);
        if (const std::uint64_t count = (std::uint64_t(set) + 1) * 4 * vertices; count > limit)
            fail(ErrorKind::input,
                 "{}: JOINTS_0 to {} give {} weights to its {} vertices, more than {}, which a "
                 "file of {} bytes may have",
                 place, joints, count, vertices, limit, model.size);
        requireJointType(model, jointsAt, place + ": " + joints);
        const auto numbersOf = [&](int accessor, const std::string& name) {
            const GltfAccessor reader(model, accessor, place + ": " + name);
            reader.requireComponents(4, 4);
            if (reader.count() != vertices)
                fail(ErrorKind::input, "{}: {} has {} elements for {} vertices", place, name,
                     reader.count(), vertices);
            return reader.numbers();
        };
        found.joints.push_back(numbersOf(jointsAt, joints));
        found.weights.push_back(numbersOf(weightsAt, weights));
        for (std::size_t i = 0; i < found.weights.back().size(); ++i)
            if (const float weight = found.weights.back()[i];
                !(weight >= 0.0f) || !std::isfinite(weight))
                fail(ErrorKind::input, "{}: {} of vertex {} is {}, not a number from 0", place,
                     weights, i / 4, weight);
    }
}

// Blends the joints of vertices, and tells what is odd about their weights.
class Blender {
public:
    Blender(const Influences& influences, const GltfPose& pose, const std::string& place)
        : influences_(influences)
        , pose_(pose)
        , place_(place)
    {
    }

    glm::dmat4 matrixOf(std::size_t vertex)
    {
        glm::dmat4 matrix(0.0);
        double sum = 0.0;
        for (std::size_t set = 0; set < influences_.joints.size(); ++set)
            for (std::size_t i = 4 * vertex; i < 4 * vertex + 4; ++i) {
                const auto weight = static_cast<double>(influences_.weights[set][i]);
                if (weight > 0.0)
                    matrix += weight * joint(vertex, influences_.joints[set][i]);
                sum += weight;
            }
        if (sum == 0.0) {
            ++unweighted_;
            return joint(vertex, influences_.joints[0][4 * vertex]);
        }
        constexpr double tolerance = 0.01; // rounding of four bytes
        uneven_ += std::fabs(sum - 1.0) > tolerance ? 1U : 0U;
        return matrix * (1.0 / sum);
    }

    void warn(Diagnostics& diagnostics) const
    {
        if (uneven_ > 0)
            diagnostics.warn("{}: the weights of {} vertices do not add up to 1; they are divided "
                             "by their sum",
                             place_, uneven_);
        if (unweighted_ > 0)
            diagnostics.warn("{}: {} vertices have no weight at all; they follow their first joint",
                             place_, unweighted_);
    }

private:
    const glm::dmat4& joint(std::size_t vertex, float number) const
    {
        if (!(number >= 0.0f) || number >= static_cast<float>(pose_.joints.size()))
            fail(ErrorKind::input,
                 "{}: vertex {} follows joint {}, but its skin has {}, counted "
                 "from 0",
                 place_, vertex, number, pose_.joints.size());
        return pose_.joints[static_cast<std::size_t>(number)];
    }

    const Influences& influences_;
    const GltfPose& pose_;
    const std::string& place_;
    std::size_t uneven_ = 0;
    std::size_t unweighted_ = 0;
};

} // namespace

double GltfPose::scale() const
{
    double largest = 0.0;
    const auto add = [&](const glm::dmat4& matrix) {
        for (glm::length_t axis = 0; axis < 3; ++axis)
            largest = std::max(largest, glm::length(glm::dvec3(matrix[axis])));
    };
    if (joints.empty())
        add(placing);
    for (const glm::dmat4& joint : joints)
        add(joint);
    return largest;
}

glm::dmat4 GltfPoser::worldOf(int node)
{
    if (const auto known = worlds_.find(node); known != worlds_.end())
        return known->second;
    const GltfNode& own = model_.structure.nodes.at(static_cast<std::size_t>(node));
    const glm::dmat4 local = gltfTransform(own, fmt::format("{}: node {}", place_, node));
    const glm::dmat4 world = own.parent == noEntry ? local : worldOf(own.parent) * local;
    worlds_.emplace(node, world);
    return world;
}

std::vector<glm::dmat4> GltfPoser::jointsOf(int index)
{
    constexpr double tolerance = 1e-4; // rounding of inverses in single precision
    const GltfSkin& skin = model_.structure.skins.at(static_cast<std::size_t>(index));
    std::vector<float> binds;
    if (skin.inverseBind != noEntry)
        binds = GltfAccessor(model_, skin.inverseBind,
                             fmt::format("{}: skin {}: inverseBindMatrices", place_, index))
                    .numbers();
    std::vector<glm::dmat4> joints;
    for (std::size_t i = 0; i < skin.joints.size(); ++i) {
        glm::dmat4 bind(1.0);
        for (std::size_t n = 0; n < 16 && !binds.empty(); ++n) {
            const double number = static_cast<double>(binds[16 * i + n]);
            if (!std::isfinite(number))
                fail(ErrorKind::input,
                     "{}: skin {}: element {} of the inverse bind matrix of joint {} is not a "
                     "finite number",
                     place_, index, n, i);
            double& element =
                bind[static_cast<glm::length_t>(n / 4)][static_cast<glm::length_t>(n % 4)];
            if (n % 4 < 3)
                element = number;
            else if (std::fabs(number - element) > tolerance)
                fail(
                    ErrorKind::input,
                    "{}: skin {}: element {} of the inverse bind matrix of joint {} is {:.6g}, but "
                    "the last row must be 0 0 0 1: a projection does not place ground",
                    place_, index, n, i, number);
        }
        joints.push_back(worldOf(skin.joints[i]) * bind);
    }
    return joints;
}

GltfPose GltfPoser::poseOf(int node, const glm::dmat4& placing)
{
    const GltfNode& own = model_.structure.nodes.at(static_cast<std::size_t>(node));
    GltfPose pose;
    pose.placing = placing;
    pose.weights = own.weights.empty()
                       ? model_.structure.meshes.at(static_cast<std::size_t>(own.mesh)).weights
                       : own.weights;
    if (own.skin == noEntry)
        return pose;
    auto known = skins_.find(own.skin);
    if (known == skins_.end())
        known = skins_.emplace(own.skin, jointsOf(own.skin)).first;
    pose.joints = known->second;
    return pose;
}

void applySkin(const GltfModel& model, const GltfPrimitive& primitive, const GltfPose& pose,
               const std::string& place, std::size_t firstVertex, std::size_t firstTriangle,
               Soup& soup, Diagnostics& diagnostics)
{
    const std::size_t vertices = soup.positions.size() - firstVertex;
    const Influences influences = influencesOf(model, primitive, vertices, place);
    if (influences.joints.empty()) {
        diagnostics.warn(
            "{}: its node has a skin, and it has no JOINTS_0; it is placed as its node "
            "is",
            place);
        transform(soup, pose.placing, firstVertex, firstTriangle);
        return;
    }
    Blender blender(influences, pose, place);
    std::vector<bool> isMirrored(vertices, false);
    for (std::size_t v = 0; v < vertices; ++v) {
        const glm::dmat4 matrix = blender.matrixOf(v);
        const glm::dmat3 linear(matrix);
        glm::dvec3& position = soup.positions[firstVertex + v];
        position = linear * position + glm::dvec3(matrix[3]);
        isMirrored[v] = glm::determinant(linear) < 0.0;
        if (firstVertex + v >= soup.normals.size())
            continue;
        const double sign = isMirrored[v] ? -1.0 : 1.0;
        const glm::dvec3 given(soup.normals[firstVertex + v]);
        const glm::dvec3 turned = sign * (given.x * glm::cross(linear[1], linear[2]) +
                                          given.y * glm::cross(linear[2], linear[0]) +
                                          given.z * glm::cross(linear[0], linear[1]));
        // Of any length, which single precision must hold.
        const double length = glm::length(turned);
        soup.normals[firstVertex + v] =
            length > 0.0 && std::isfinite(length) ? glm::vec3(turned / length) : glm::vec3(0.0f);
    }
    blender.warn(diagnostics);
    for (std::size_t t = firstTriangle; t < soup.triangles.size(); ++t) {
        glm::uvec3& triangle = soup.triangles[t];
        int mirrored = 0;
        for (glm::length_t corner = 0; corner < 3; ++corner)
            mirrored += isMirrored[triangle[corner] - firstVertex] ? 1 : 0;
        if (mirrored >= 2)
            std::swap(triangle.y, triangle.z);
    }
}

} // namespace sward::terrain
