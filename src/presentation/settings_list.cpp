#include "presentation/settings_list.h"

#include "core/error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace sward::presentation {

std::vector<SettingsReader> readersOf(SettingsReader& reader, const char* key, std::size_t most)
{
    const nlohmann::json& array = reader.child(key);
    if (!array.is_array())
        fail(ErrorKind::input, "{}: expected an array", reader.placeOf(key));
    if (array.size() > most)
        fail(ErrorKind::input, "{}: {} entries, more than {}", reader.placeOf(key), array.size(),
             most);
    std::vector<SettingsReader> readers;
    for (const nlohmann::json& entry : array)
        readers.emplace_back(entry, fmt::format("{}[{}]", reader.placeOf(key), readers.size()));
    return readers;
}

} // namespace sward::presentation
