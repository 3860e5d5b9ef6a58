#include "terrain/gltf/file/json.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace sward::terrain {
namespace {

// Excerpt of JSON for a message.
std::string excerpt(const nlohmann::json& value)
{
    if (value.is_structured())
        return value.type_name();
    const std::string text = value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
    return text.size() <= 40 ? text : text.substr(0, 40) + "…";
}

bool isFiniteNumber(const nlohmann::json& value)
{
    return value.is_number() && std::isfinite(value.get<double>());
}

} // namespace

std::string GltfObject::name() const
{
    std::string text = file;
    if (*kind != '\0')
        text += fmt::format(": {}", kind);
    if (index != onlyOne)
        text += fmt::format(" {}", index);
    return text + inner;
}

const nlohmann::json* GltfObject::find(const char* key) const
{
    const auto found = value.find(key);
    return found == value.end() ? nullptr : &*found;
}

std::optional<std::uint64_t> GltfObject::count(const char* key, std::uint64_t limit) const
{
    const nlohmann::json* const found = find(key);
    if (found == nullptr)
        return std::nullopt;
    if (!found->is_number_unsigned())
        failHere("{} is {}, not a whole number from 0", key, excerpt(*found));
    const auto number = found->get<std::uint64_t>();
    if (number >= limit)
        failHere("{} is {}, but must be below {}", key, number, limit);
    return number;
}

std::uint64_t GltfObject::requiredCount(const char* key, std::uint64_t limit) const
{
    const auto number = count(key, limit);
    if (!number)
        failHere("{} is missing", key);
    return *number;
}

int GltfObject::reference(const char* key, std::size_t entries, const char* what) const
{
    const auto number = count(key);
    if (!number)
        return -1;
    if (entries == 0)
        failHere("{} is {}, but the file has no {}", key, *number, what);
    if (*number >= entries)
        failHere("{} is {}, but the file's {} end at {}", key, *number, what, entries - 1);
    return static_cast<int>(*number);
}

int GltfObject::requiredReference(const char* key, std::size_t entries, const char* what) const
{
    if (find(key) == nullptr)
        failHere("{} is missing", key);
    return reference(key, entries, what);
}

std::vector<int> GltfObject::references(const char* key, std::size_t entries,
                                        const char* what) const
{
    std::vector<int> list;
    const nlohmann::json* const found = find(key);
    if (found == nullptr)
        return list;
    if (!found->is_array())
        failHere("{} is {}, not an array", key, excerpt(*found));
    for (const nlohmann::json& entry : *found) {
        if (!entry.is_number_unsigned())
            failHere("{} holds {}, not an index", key, excerpt(entry));
        if (entries == 0)
            failHere("{} names {}, but the file has no {}", key, entry.get<std::uint64_t>(), what);
        if (entry.get<std::uint64_t>() >= entries)
            failHere("{} names {}, but the file's {} end at {}", key, entry.get<std::uint64_t>(),
                     what, entries - 1);
        list.push_back(entry.get<int>());
    }
    return list;
}

std::vector<double> GltfObject::numbers(const char* key, std::size_t length) const
{
    std::vector<double> list;
    const nlohmann::json* const found = find(key);
    if (found == nullptr)
        return list;
    if (!found->is_array() || (length > 0 && found->size() != length))
        failHere("{} is not an array of {} numbers", key,
                 length > 0 ? std::to_string(length) : std::string("finite"));
    for (const nlohmann::json& entry : *found) {
        if (!isFiniteNumber(entry))
            failHere("{} holds {}, not a finite number", key, excerpt(entry));
        list.push_back(entry.get<double>());
    }
    return list;
}

std::optional<double> GltfObject::number(const char* key) const
{
    const nlohmann::json* const found = find(key);
    if (found == nullptr)
        return std::nullopt;
    if (!isFiniteNumber(*found))
        failHere("{} is {}, not a finite number", key, excerpt(*found));
    return found->get<double>();
}

std::string GltfObject::text(const char* key) const
{
    const nlohmann::json* const found = find(key);
    if (found == nullptr)
        return {};
    if (!found->is_string())
        failHere("{} is {}, not a text", key, excerpt(*found));
    return found->get<std::string>();
}

std::optional<bool> GltfObject::truth(const char* key) const
{
    const nlohmann::json* const found = find(key);
    if (found == nullptr)
        return std::nullopt;
    if (!found->is_boolean())
        failHere("{} is {}, not true or false", key, excerpt(*found));
    return found->get<bool>();
}

const nlohmann::json* GltfObject::object(const char* key) const
{
    const nlohmann::json* const found = find(key);
    if (found != nullptr && !found->is_object())
        failHere("{} is {}, not an object", key, excerpt(*found));
    return found;
}

} // namespace sward::terrain
