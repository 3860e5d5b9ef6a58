#include "interchange/gltf.h"

#include "core/error.h"
#include "core/files/atomic_file.h"
#include "interchange/blade_groups.h"
#include "interchange/compact/compact_glb.h"
#include "interchange/engine/drawn_look.h"
#include "interchange/engine/engine_extras.h"
#include "interchange/gltf/glb_container.h"
#include "interchange/gltf/gltf_species.h"
#include "interchange/gltf/gltf_document.h"
#include "interchange/gltf/gltf_ground.h"
#include "interchange/instance_attributes.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <limits>
#include <optional>
#include <utility>

namespace sward::interchange {
namespace {

using nlohmann::ordered_json;

// The instances of a group, by species. `looks` are null unless they are for engines.
std::vector<std::vector<Instance>> bySpecies(const field::FieldView& field, const BladeGroup& group,
                                             const std::string& source, const DrawnLooks* looks)
{
    std::vector<Instance> instances = instancesOf(field, group, source);
    if (looks != nullptr) {
        orderByRank(instances);
        for (Instance& instance : instances)
            instance.look = looks->of(instance.blade);
    }
    std::vector<std::vector<Instance>> result(field.species.size());
    for (const Instance& instance : instances)
        result[instance.blade.species].push_back(instance);
    return result;
}

// Adds the node for one species in one group; reserves its bytes.
std::size_t addInstances(GltfDocument& document, const BladeGroup& group, const std::string& name,
                         std::uint32_t species, std::span<const Instance> instances,
                         bool forEngines)
{
    Aabb places;
    for (const Instance& instance : instances)
        places.add(instance.place);
    ordered_json attributes;
    for (const InstanceAttribute& attribute : instanceAttributes(forEngines)) {
        GltfAccessor accessor{.componentType = attribute.componentType,
                              .type = attribute.type,
                              .count = instances.size(),
                              .normalized = attribute.normalized};
        accessor.view = document.reserveView(instances.size() * attribute.bytes);
        if (attributes.empty())
            accessor.bounds = places;
        attributes[attribute.name] = document.addAccessor(accessor);
    }
    return document.add("nodes",
                        {{"name", name},
                         {"mesh", species},
                         {"translation", {group.place.x, group.place.y, group.place.z}},
                         {"extensions", {{instancingExtension, {{"attributes", attributes}}}}}});
}

// Builds the JSON in a first pass over the blades.
void describe(GltfDocument& document, const field::FieldView& field,
              const std::vector<BladeGroup>& groups, const ExportSettings& settings,
              const DrawnLooks* looks, Progress& progress)
{
    const std::vector<MeanBlade> means = meanBlades(field);
    addSpecies(document, field, means);
    ordered_json children = ordered_json::array();
    if (settings.withGround)
        if (const std::optional<std::size_t> ground = addGround(document, *field.ground, looks))
            children.push_back(*ground);

    if (!groups.empty())
        document.require(instancingExtension);
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const auto species = bySpecies(field, groups[g], settings.source, looks);
        for (std::uint32_t s = 0; s < species.size(); ++s)
            if (!species[s].empty())
                children.push_back(addInstances(
                    document, groups[g], fmt::format("group {} {}", g, field.species[s].name), s,
                    species[s], looks != nullptr));
        progress.advance(groups[g].bladeCount);
    }

    // Store the origin again in extras, in double precision.
    const ordered_json origin = {field.origin.x, field.origin.y, field.origin.z};
    ordered_json root = {{"name", "field"}, {"translation", origin}};
    if (!children.empty())
        root["children"] = std::move(children);
    root["extras"] = {{"origin_m", origin}, {"blades", field::rootedBlades(field)}};
    if (looks != nullptr)
        root["extras"]["sward"] = engineExtras(field, *looks, means);
    document.setScene(document.add("nodes", std::move(root)));
}

} // namespace

void refuseLargeGlb(const std::filesystem::path& path, std::uint64_t blades, std::uint64_t bytes,
                    std::uint64_t perBlade)
{
    // Lengths in the file have 32 bits.
    constexpr std::uint64_t largest = std::numeric_limits<std::uint32_t>::max();
    if (bytes > largest)
        fail(ErrorKind::unsupported,
             "{}: {} blades need {} bytes, a .glb holds at most {} (some {} million blades); .ply "
             "and .usda have no such limit",
             path.string(), blades, bytes, largest, largest / perBlade / 1'000'000);
}

void writeGlb(const field::FieldView& field, const std::filesystem::path& path,
              const ExportSettings& settings, Progress& progress)
{
    if (settings.compact) {
        writeCompactGlb(field, path, settings, progress);
        return;
    }
    // Check the size of the blades before any work.
    const std::uint64_t blades = field.blades.size();
    const std::uint64_t perBlade = settings.forEngines ? glbBytesPerEngineBlade : glbBytesPerBlade;
    refuseLargeGlb(path, blades, glbHeaderBytes + blades * perBlade, perBlade);

    progress.begin("export", 2 * blades);
    const std::vector<BladeGroup> groups = groupBlades(field);
    GltfDocument document(settings.generator, *field.copyright);
    const std::optional<DrawnLooks> looks =
        settings.forEngines ? std::optional<DrawnLooks>(field) : std::nullopt;
    const DrawnLooks* const drawn = looks ? &*looks : nullptr;
    describe(document, field, groups, settings, drawn, progress);
    const std::string text = document.text();
    const std::uint64_t bytes = glbHeaderBytes + text.size() + document.binaryBytes();
    refuseLargeGlb(path, blades, bytes, perBlade);

    AtomicFile file(path, settings.overwrite);
    writeGlbHeader(file, text, document.binaryBytes());
    file.write(document.fixedBytes());
    for (const BladeGroup& group : groups) {
        for (const std::vector<Instance>& instances :
             bySpecies(field, group, settings.source, drawn))
            file.write(attributeBytes(instances, settings.forEngines));
        progress.advance(group.bladeCount);
    }
    file.commit();
}

} // namespace sward::interchange
