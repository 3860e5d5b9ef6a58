#include "interchange/compact/compact_glb.h"

#include "core/error.h"
#include "core/files/piece_file.h"
#include "interchange/blade_groups.h"
#include "interchange/compact/morton_order.h"
#include "interchange/gltf/glb_container.h"
#include "interchange/gltf/gltf_ground.h"
#include "interchange/gltf/gltf_species.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace sward::interchange {
namespace {

using nlohmann::ordered_json;

// Streams are copied from the temporary file in pieces of this size.
constexpr std::size_t copiedBytes = std::size_t(1) << 20;

// A box rounded outwards to millimetres, which have few digits.
ordered_json boxJson(const Aabb& box)
{
    ordered_json low = ordered_json::array();
    ordered_json high = ordered_json::array();
    for (int axis = 0; axis < 3; ++axis) {
        low.push_back(std::floor(1000.0 * double(box.low[axis])) / 1000.0);
        high.push_back(std::ceil(1000.0 * double(box.high[axis])) / 1000.0);
    }
    return ordered_json::array({low, high});
}

void copyStreams(const ScratchFile& streams, AtomicFile& file)
{
    std::vector<std::byte> piece;
    for (std::uint64_t at = 0; at < streams.size(); at += piece.size()) {
        piece.resize(std::min<std::uint64_t>(copiedBytes, streams.size() - at));
        streams.read(at, piece);
        file.write(piece);
    }
}

Aabb relativeTo(const glm::dvec3& place, const Aabb& box)
{
    Aabb result;
    result.low = glm::vec3(glm::dvec3(box.low) - place);
    result.high = glm::vec3(glm::dvec3(box.high) - place);
    return result;
}

} // namespace

std::vector<std::size_t> addCompactNodes(GltfDocument& document, const field::FieldView& field,
                                         const CompactInstances& instances,
                                         const CompactPlace& place, const ExportSettings& settings)
{
    const auto attributes = compactAttributes(settings.withIds);
    std::vector<std::size_t> views;
    for (std::size_t a = 0; a < attributes.size(); ++a)
        views.push_back(document.reserveCompressedView({.stored = instances.streams[a].size(),
                                                        .count = instances.count,
                                                        .stride = attributes[a].stride,
                                                        .filter = attributes[a].filter},
                                                       settings.meshoptExtension));

    std::vector<std::size_t> nodes;
    for (const SpeciesRange& range : instances.ranges) {
        ordered_json accessors;
        for (std::size_t a = 0; a < attributes.size(); ++a) {
            GltfAccessor accessor{.view = views[a],
                                  .offset = range.first * attributes[a].stride,
                                  .componentType = attributes[a].componentType,
                                  .type = attributes[a].type,
                                  .count = range.count,
                                  .normalized = attributes[a].normalized};
            if (a == 0)
                accessor.bounds = range.places;
            accessors[attributes[a].name] = document.addAccessor(accessor);
        }
        nodes.push_back(document.add(
            "nodes",
            {{"name", fmt::format("{} {}", place.name, field.species[range.species].name)},
             {"mesh", place.firstMesh + range.species},
             {"translation", {place.place.x, place.place.y, place.place.z}},
             {"extensions", {{instancingExtension, {{"attributes", std::move(accessors)}}}}},
             {"extras", {{"bounds_m", boxJson(place.bounds)}}}}));
    }
    return nodes;
}

std::vector<std::byte> streamBytes(const CompactInstances& instances)
{
    std::vector<std::byte> bytes;
    for (const std::vector<std::byte>& stream : instances.streams) {
        bytes.insert(bytes.end(), stream.begin(), stream.end());
        bytes.resize((bytes.size() + 3) / 4 * 4);
    }
    return bytes;
}

void writeCompactGlb(const field::FieldView& field, const std::filesystem::path& path,
                     const ExportSettings& settings, Progress& progress)
{
    AtomicFile file(path, settings.overwrite);
    progress.begin("export", field.blades.size());
    GltfDocument document(settings.generator, *field.copyright);
    addSpecies(document, field, meanBlades(field, settings.rest), SpeciesLevels::both);
    ordered_json children = ordered_json::array();
    if (settings.withGround)
        if (const std::optional<std::size_t> ground = addGround(document, *field.ground))
            children.push_back(*ground);

    // Sizes of streams, which the JSON in front of them names, are known once they are compressed.
    ScratchFile streams(path);
    const std::vector<BladeGroup> groups = groupBlades(field, largestCompactGroup);
    if (!groups.empty()) {
        document.require(instancingExtension);
        document.require(settings.meshoptExtension);
    }
    BladeCounter counter(settings.rest);
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const BladeGroup& group = groups[g];
        std::vector<Instance> instances = instancesOf(field, group, settings.source);
        if (instances.empty())
            continue;
        sortForCompression(instances, std::ldexp(1.0f, compactPlaceExponent));
        const CompactInstances compact = compressInstances(instances, settings.withIds);
        for (const std::size_t node :
             addCompactNodes(document, field, compact,
                             {.name = fmt::format("group {}", g),
                              .place = group.place,
                              .bounds = relativeTo(group.place, group.bounds),
                              .firstMesh = 0},
                             settings))
            children.push_back(node);
        streams.append(streamBytes(compact));
        progress.advance(group.bladeCount);
        counter.add(group.bladeCount);
    }

    const ordered_json origin = {field.origin.x, field.origin.y, field.origin.z};
    ordered_json root = {{"name", "field"}, {"translation", origin}};
    if (!children.empty())
        root["children"] = std::move(children);
    root["extras"] = {{"origin_m", origin}, {"blades", field::rootedBlades(field)}};
    document.setScene(document.add("nodes", std::move(root)));

    const std::string text = document.text();
    const std::uint64_t bytes = glbHeaderBytes + text.size() + document.binaryBytes();
    if (bytes > largestGlb)
        fail(ErrorKind::unsupported, "{}: {} blades need {} bytes, a .glb holds at most {}",
             path.string(), field::rootedBlades(field), bytes, largestGlb);
    writeGlbHeader(file, text, document.binaryBytes());
    file.write(document.fixedBytes());
    copyStreams(streams, file);
    file.commit();
}

} // namespace sward::interchange
