#pragma once

#include "core/error.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sward::terrain {

/// An object of a glTF document and its name for messages. Included by gltf/*.cpp only.
struct GltfObject {
    /// Of what there is once in a file; with an empty `kind` it is the document itself.
    static constexpr std::size_t onlyOne = ~std::size_t(0);

    const nlohmann::json& value;
    const std::string& file;
    const char* kind = "";
    std::size_t index = onlyOne;
    std::string inner = {}; ///< a part of it: ", primitive 2"

    /// What messages call it: "scene.glb: mesh 1, primitive 2".
    std::string name() const;

    template <typename... Args>
    [[noreturn]] void failHere(fmt::format_string<Args...> format, Args&&... args) const
    {
        fail(ErrorKind::input, "{}: {}", name(), fmt::format(format, std::forward<Args>(args)...));
    }

    /// A part of it with the same name in messages.
    GltfObject part(const nlohmann::json& within) const
    {
        return {within, file, kind, index, inner};
    }

    /// The member `key` if it is there.
    const nlohmann::json* find(const char* key) const;

    /// A whole number in [0, limit).
    std::optional<std::uint64_t> count(const char* key, std::uint64_t limit = 1ULL << 53) const;
    std::uint64_t requiredCount(const char* key, std::uint64_t limit = 1ULL << 53) const;

    /// The index under `key` of one of `entries`, which messages call `what`; −1 without the key.
    int reference(const char* key, std::size_t entries, const char* what) const;
    int requiredReference(const char* key, std::size_t entries, const char* what) const;

    /// Indices of `entries`; none without the key.
    std::vector<int> references(const char* key, std::size_t entries, const char* what) const;

    /// `length` finite numbers, or any number of them if it is 0; none without the key.
    std::vector<double> numbers(const char* key, std::size_t length) const;

    // Each checks the type of what is under `key`; nothing without it.
    std::optional<double> number(const char* key) const;
    std::string text(const char* key) const;
    std::optional<bool> truth(const char* key) const;
    const nlohmann::json* object(const char* key) const;
};

} // namespace sward::terrain
