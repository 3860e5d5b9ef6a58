#include "apps/sward/options/effective_settings.h"

#include "core/json/json_text.h"

#include <nlohmann/json.hpp>

namespace sward::apps {

std::string effectiveSettings(const BakeRequest& request)
{
    const terrain::ImportSettings& import = request.import;
    nlohmann::ordered_json ground;
    ground["input"] = request.inputs;
    ground["occluder"] = request.occluders;
    ground["up_axis"] = import.upAxis;
    ground["units"] = import.units;
    ground["scale"] = import.scale;
    ground["scene"] = import.scene ? nlohmann::ordered_json(*import.scene) : nullptr;
    ground["node"] = import.bearingNodes;
    ground["material"] = import.bearingMaterials;
    ground["bare_names"] = import.bareNames ? "known" : "none";
    ground["occlude_node"] = import.occluderNodes;
    const terrain::HeightmapSettings& map = import.heightmap;
    const auto pair = [](const auto& value) {
        return value ? nlohmann::ordered_json{value->x, value->y} : nlohmann::ordered_json();
    };
    ground["size"] = pair(map.size);
    ground["extent"] = pair(map.extent);
    ground["height"] = pair(map.height);
    ground["hole_mask"] = map.holeMask;
    ground["endian"] = map.endian.empty() ? "little" : map.endian;
    ground["encoding"] = map.encoding.empty() ? "none" : map.encoding;
    ground["flip_rows"] = map.flipRows;
    ground["no_data"] = map.noData ? nlohmann::ordered_json(*map.noData) : nullptr;

    nlohmann::ordered_json all;
    all["ground"] = std::move(ground);
    all["bake"] = nlohmann::ordered_json::parse(bake::toJson(request.settings));
    all["budget"] = request.settings.budget;
    all["max_blades"] = request.settings.maxBlades;
    all["threads"] = request.threads;
    return jsonText(all, 2);
}

} // namespace sward::apps
