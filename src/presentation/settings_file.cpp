#include "presentation/settings_file.h"

#include "core/files/mapped_file.h"
#include "core/json/settings_json.h"
#include "presentation/detail_settings.h"
#include "presentation/environment_settings.h"
#include "presentation/look_settings.h"

#include <nlohmann/json.hpp>

#include <string_view>
#include <vector>

namespace sward::presentation {

using render::FrameSettings;

namespace {

constexpr std::size_t largestFile = 1u << 22; ///< [bytes] 256 colliders with long paths take less

} // namespace

std::vector<std::string> readSettings(const std::filesystem::path& path, FrameSettings& settings)
{
    const std::vector<std::byte> bytes = readFile(path, largestFile);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return readSettings(text, path.string(), settings);
}

std::vector<std::string> readSettings(std::string_view text, const std::string& place,
                                      FrameSettings& settings)
{
    const nlohmann::json json = parseJson(text, place);
    SettingsReader reader(json, place);
    std::string about; // a comment in the file
    reader.read("about", about);
    readEnvironment(reader, settings);
    std::vector<std::string> warnings = readDetail(reader, settings);
    readLook(reader, settings);
    reader.finish();
    return warnings;
}

} // namespace sward::presentation
