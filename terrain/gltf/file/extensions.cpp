#include "terrain/gltf/file/extensions.h"

#include "terrain/gltf/file/json.h"

#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace sward::terrain {
namespace {

// Applied in full.
constexpr std::array<std::string_view, 9> applied = {
    "KHR_node_visibility",     "MSFT_lod",
    "KHR_mesh_quantization",   "KHR_texture_transform",
    "EXT_mesh_gpu_instancing", "KHR_draco_mesh_compression",
    "EXT_meshopt_compression", "KHR_meshopt_compression",
    "MESHOPT_compression",
};

// Extensions without effect on static ground; KHR_materials_… have none either.
constexpr std::array<std::string_view, 4> harmless = {
    "KHR_lights_punctual",
    "KHR_animation_pointer",
    "KHR_xmp_json_ld",
    "EXT_lights_image_based",
};

// What adds nothing that grass could grow on: behaviour, physics, sound, annotation. A file that
// requires it may mean more by it.
constexpr std::array<std::string_view, 30> additions = {
    "KHR_xmp",
    "KHR_node_hoverability",
    "KHR_node_selectability",
    "KHR_interactivity",
    "KHR_physics_rigid_bodies",
    "KHR_implicit_shapes",
    "KHR_audio_emitter",
    "EXT_lights_ies",
    "EXT_mesh_features",
    "EXT_mesh_manifold",
    "EXT_mesh_primitive_edge_visibility",
    "EXT_instance_features",
    "EXT_structural_metadata",
    "EXT_feature_metadata",
    "CESIUM_primitive_outline",
    "FB_geometry_metadata",
    "AGI_stk_metadata",
    "AGI_articulations",
    "GODOT_single_root",
    "OMI_collider",
    "OMI_physics_body",
    "OMI_physics_joint",
    "OMI_physics_shape",
    "MSFT_packing_normalRoughnessMetallic",
    "MSFT_packing_occlusionRoughnessMetallic",
    "ADOBE_materials_clearcoat_specular",
    "ADOBE_materials_clearcoat_tint",
    "VRM",
    "VRMC_vrm",
    "VRMC_springBone",
};

// These change how indices make triangles: without them the triangles are others.
constexpr std::array<std::string_view, 3> remaking = {
    "KHR_mesh_primitive_restart", "EXT_mesh_primitive_restart", "EXT_primitive_voxels"};

// Textures in unsupported formats: keep the material without its image.
constexpr std::array<std::string_view, 4> imageFormats = {"EXT_texture_webp", "EXT_texture_avif",
                                                          "KHR_texture_basisu", "MSFT_texture_dds"};

template <typename List>
bool contains(const List& list, std::string_view name)
{
    return std::find(list.begin(), list.end(), name) != list.end();
}

bool isMaterialExtension(std::string_view name)
{
    return name.substr(0, 14) == "KHR_materials_";
}

bool isKnown(std::string_view name)
{
    return contains(applied, name) || contains(harmless, name) || contains(imageFormats, name) ||
           isMaterialExtension(name);
}

std::vector<std::string> namesUnder(const nlohmann::json& document, const char* key,
                                    const std::string& place)
{
    std::vector<std::string> names;
    const auto found = document.find(key);
    if (found == document.end())
        return names;
    if (!found->is_array())
        fail(ErrorKind::input, "{}: {} is not an array", place, key);
    for (const nlohmann::json& name : *found) {
        if (!name.is_string())
            fail(ErrorKind::input, "{}: {} holds something that is not a name", place, key);
        names.push_back(name.get<std::string>());
    }
    return names;
}

} // namespace

void checkGltfExtensions(const nlohmann::json& document, const std::string& place,
                         Diagnostics& diagnostics)
{
    for (const std::string& name : namesUnder(document, "extensionsRequired", place))
        if (!isKnown(name))
            fail(ErrorKind::unsupported,
                 "{}: requires the glTF extension {}, which is not supported; supported are {}",
                 place, name, fmt::join(applied, ", "));

    for (const std::string& name : namesUnder(document, "extensionsUsed", place)) {
        if (name == "KHR_materials_pbrSpecularGlossiness")
            diagnostics.warn("{}: the colours of {} are not read", place, name);
        else if (contains(remaking, name))
            fail(ErrorKind::unsupported,
                 "{}: uses the glTF extension {}, which makes other triangles of its indices and "
                 "is not supported",
                 place, name);
        else if (!isKnown(name) && !contains(additions, name))
            diagnostics.warn("{}: uses the glTF extension {}, which is not known: what it hides, "
                             "replaces or places is read as if it were not there",
                             place, name);
    }
}

std::string imageFormatOf(const GltfObject& texture)
{
    if (const nlohmann::json* const extensions = texture.object("extensions"))
        for (const std::string_view name : imageFormats)
            if (extensions->contains(name))
                return std::string(name);
    return {};
}

} // namespace sward::terrain
