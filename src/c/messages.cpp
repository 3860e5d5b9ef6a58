#include "c/messages.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

namespace sward::c {
namespace {

// Parts of names, the longest of a beginning first. What follows them goes on in snake case.
constexpr std::array<std::pair<std::string_view, std::string_view>, 22> namesInC{{
    {"gpu::describeDevice", "sward_context_create"},
    {"Grass::Settings::", "sward_grass_info::"},
    {"Grass::Settings", "sward_grass_info"},
    {"GrassFrame::", "sward_frame::"},
    {"Grass::", "sward_grass_"},
    {"HostView::", "sward_view::"},
    {"HostDepth::view", "sward_view::depth"},
    {"HostDepth::", "sward_view::depth_"},
    {"HostShadow::", "sward_shadow::"},
    {"StoredPicture::", "sward_stored_picture::"},
    {"HostTarget", "sward_target_info"},
    {"HostCollider::", "sward_collider::"},
    {"HostLamp::", "sward_lamp::"},
    {"HostCone::", "sward_lamp::"},
    {"HostLight::", "sward_frame::"},
    {"HostDevice::", "sward_context_info::"},
    {"FieldBudget::", "sward_budget::"},
    {"FieldInstance::field", "resident"},
    {"Placement::", "sward_placement::"},
    {"ResidentField::", "sward_resident_"},
    {"recordUpload()", "sward_resident_record_upload()"},
    {"record", "sward_grass_record_"}, // of a function alone: recordCull()
}};

bool isLower(char c)
{
    return c >= 'a' && c <= 'z';
}

bool isUpper(char c)
{
    return c >= 'A' && c <= 'Z';
}

bool isInName(char c)
{
    return isLower(c) || isUpper(c) || (c >= '0' && c <= '9') || c == '_';
}

/// Length of the name at the beginning of `text`: identifiers between `::`, and `()` after them.
std::size_t nameLength(std::string_view text)
{
    std::size_t end = 0;
    while (end < text.size() && (isInName(text[end]) || text.substr(end, 2) == "::"))
        end += isInName(text[end]) ? 1U : 2U;
    return text.substr(end, 2) == "()" ? end + 2 : end;
}

std::string inSnakeCase(std::string_view name)
{
    std::string result;
    for (const char c : name) {
        if (isUpper(c) && !result.empty() && isInName(result.back()) && result.back() != '_')
            result += '_';
        result += isUpper(c) ? static_cast<char>(c - 'A' + 'a') : c;
    }
    return result;
}

/// Two small letters or more, then a capital: not sRGB, not VK_FORMAT_UNDEFINED.
bool isCamelCase(std::string_view name)
{
    const auto humps = std::ranges::find_if(name, isUpper);
    return humps - name.begin() >= 2 && humps != name.end() &&
           std::all_of(name.begin(), humps, isLower) && name.substr(0, 2) != "vk";
}

std::string nameInC(std::string_view name, bool hasMembersAlone)
{
    const bool isQualified = name.find("::") != std::string_view::npos;
    for (const auto& [ours, theirs] : namesInC) {
        const bool isFunctionAlone = isLower(ours.front()) && ours.find("::") == ours.npos;
        if (!name.starts_with(ours) ||
            (isFunctionAlone && (!hasMembersAlone || !name.ends_with("()"))))
            continue;
        std::string rest = inSnakeCase(name.substr(ours.size()));
        if (theirs.ends_with('_') && rest.starts_with('_'))
            rest.erase(0, 1);
        return std::string(theirs) + rest;
    }
    return hasMembersAlone && !isQualified && isCamelCase(name) ? inSnakeCase(name)
                                                                : std::string(name);
}

} // namespace

std::string inWordsOfC(const std::string& message, bool hasMembersAlone)
{
    std::string result;
    std::string_view rest = message;
    while (!rest.empty()) {
        const std::size_t length = nameLength(rest);
        if (length == 0) {
            result += rest.front();
            rest.remove_prefix(1);
            continue;
        }
        result += nameInC(rest.substr(0, length), hasMembersAlone);
        rest.remove_prefix(length);
    }
    return result;
}

} // namespace sward::c
