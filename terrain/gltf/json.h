#pragma once

#include "core/error.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>

namespace sward::terrain {

/// An object of a glTF document and its name for messages. Included by gltf_*.cpp only.
struct GltfObject {
    const nlohmann::json& value;
    const std::string& file;
    const char* kind;
    std::size_t index;

    template <typename... Args>
    [[noreturn]] void failHere(fmt::format_string<Args...> format, Args&&... args) const
    {
        fail(ErrorKind::input, "{}: {} {}: {}", file, kind, index,
             fmt::format(format, std::forward<Args>(args)...));
    }

    /// A part of it with the same name in messages.
    GltfObject part(const nlohmann::json& inner) const { return {inner, file, kind, index}; }

    /// The member `key` if it is there.
    const nlohmann::json* find(const char* key) const;

    /// A whole number in [0, limit).
    std::optional<std::uint64_t> count(const char* key, std::uint64_t limit = 1ULL << 53) const;
    std::uint64_t requiredCount(const char* key, std::uint64_t limit = 1ULL << 53) const;

    /// Checks that `key`, if it is there, is an array of `length` finite numbers, or a number, a
    /// text, a truth value, an object.
    void numbers(const char* key, std::size_t length) const;
    void number(const char* key) const;
    void text(const char* key) const;
    void truth(const char* key) const;
    const nlohmann::json* object(const char* key) const;

    /// Checks that `key`, if it is there, is an array of whole numbers below `limit`.
    void indices(const char* key, std::uint64_t limit) const;

    /// A copy with these keys only.
    nlohmann::json keep(std::initializer_list<const char*> keys) const;
};

} // namespace sward::terrain
