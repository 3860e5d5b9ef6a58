#include "terrain/gltf/json.h"

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

void GltfObject::numbers(const char* key, std::size_t length) const
{
    const nlohmann::json* const found = find(key);
    if (found == nullptr)
        return;
    if (!found->is_array() || found->size() != length)
        failHere("{} is not an array of {} numbers", key, length);
    for (const nlohmann::json& entry : *found)
        if (!isFiniteNumber(entry))
            failHere("{} holds {}, not a finite number", key, excerpt(entry));
}

void GltfObject::number(const char* key) const
{
    const nlohmann::json* const found = find(key);
    if (found != nullptr && !isFiniteNumber(*found))
        failHere("{} is {}, not a finite number", key, excerpt(*found));
}

void GltfObject::text(const char* key) const
{
    const nlohmann::json* const found = find(key);
    if (found != nullptr && !found->is_string())
        failHere("{} is {}, not a text", key, excerpt(*found));
}

void GltfObject::truth(const char* key) const
{
    const nlohmann::json* const found = find(key);
    if (found != nullptr && !found->is_boolean())
        failHere("{} is {}, not true or false", key, excerpt(*found));
}

const nlohmann::json* GltfObject::object(const char* key) const
{
    const nlohmann::json* const found = find(key);
    if (found != nullptr && !found->is_object())
        failHere("{} is {}, not an object", key, excerpt(*found));
    return found;
}

void GltfObject::indices(const char* key, std::uint64_t limit) const
{
    const nlohmann::json* const found = find(key);
    if (found == nullptr)
        return;
    if (!found->is_array())
        failHere("{} is {}, not an array", key, excerpt(*found));
    for (const nlohmann::json& entry : *found) {
        if (!entry.is_number_unsigned())
            failHere("{} holds {}, not an index", key, excerpt(entry));
        if (entry.get<std::uint64_t>() >= limit)
            failHere("{} names {}, but must be below {}", key, entry.get<std::uint64_t>(), limit);
    }
}

nlohmann::json GltfObject::keep(std::initializer_list<const char*> keys) const
{
    nlohmann::json kept = nlohmann::json::object();
    for (const char* key : keys)
        if (const nlohmann::json* const found = find(key))
            kept[key] = *found;
    return kept;
}

} // namespace sward::terrain
