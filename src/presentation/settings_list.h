#pragma once

#include "core/json/settings_json.h"

#include <cstddef>
#include <vector>

namespace sward::presentation {

/// One reader per object of the array under `key`; none if the key is absent. Throws Error{input}
/// on another type, or on more than `most` entries.
std::vector<SettingsReader> readersOf(SettingsReader& reader, const char* key, std::size_t most);

/// Replaces `list` by read(SettingsReader&) of each entry of the array under `key`, if the key
/// exists. Throws as readersOf() does.
template <typename Entry, typename Read>
void readList(SettingsReader& reader, const char* key, std::size_t most, std::vector<Entry>& list,
              Read read)
{
    if (!reader.has(key))
        return;
    list.clear();
    for (SettingsReader& one : readersOf(reader, key, most))
        list.push_back(read(one));
}

} // namespace sward::presentation
