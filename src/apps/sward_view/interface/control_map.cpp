#include "apps/sward_view/interface/control_map.h"

#include "core/json/json_text.h"

#include <nlohmann/json.hpp>

#include <fstream>

namespace sward::view {

void ControlMap::finishFrame()
{
    if (!path_.empty()) {
        nlohmann::json json = nlohmann::json::object();
        for (const auto& [name, place] : places_)
            json[name] = {{"x", place.x},           {"y", place.y},         {"width", place.width},
                          {"height", place.height}, {"shows", place.shows}, {"about", place.about},
                          {"kind", place.kind}};
        // Rename, so that a reader never sees a partial file; no sync to the disk.
        const std::filesystem::path part = path_.string() + ".part";
        std::ofstream(part) << jsonText(json, 1);
        std::error_code ignored;
        std::filesystem::rename(part, path_, ignored);
    }
    places_.clear();
}

} // namespace sward::view
