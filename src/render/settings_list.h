#pragma once

#include "core/error.h"
#include "core/settings_json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <vector>

namespace sward::render {

/// Replaces `list` by what read(SettingsReader&) makes of each entry of the array under `key`, if
/// there is one. Throws Error{input} on another type, or on more than `most` entries.
template <typename Entry, typename Read>
void readList(SettingsReader& reader, const char* key, std::size_t most, std::vector<Entry>& list,
              Read read)
{
    if (!reader.has(key))
        return;
    const nlohmann::json& array = reader.child(key);
    if (!array.is_array())
        fail(ErrorKind::input, "{}: expected an array", reader.placeOf(key));
    if (array.size() > most)
        fail(ErrorKind::input, "{}: {} entries, more than {}", reader.placeOf(key), array.size(),
             most);
    list.clear();
    for (const nlohmann::json& entry : array) {
        SettingsReader one(entry, fmt::format("{}[{}]", reader.placeOf(key), list.size()));
        list.push_back(read(one));
    }
}

} // namespace sward::render
