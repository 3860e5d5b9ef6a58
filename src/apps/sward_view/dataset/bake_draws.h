#pragma once

#include <glm/vec2.hpp>
#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sward::view {

/// A setting of bakes that is drawn at random for each: one of some words, or a number.
struct BakeSetting {
    std::string name;    ///< option of `sward bake` without dashes, "set KEY", or "ground"
    bool isFlag = false; ///< an option without a value
    /// Words with equal or stated weights. A "{LOW..HIGH}" in a word is a number from this range.
    std::vector<std::string> words{};
    std::vector<double> weights{};     ///< of the words; one is above 0
    std::optional<glm::dvec2> range{}; ///< instead of words
};

/// Fields that are baked for a set: docs/layers.md has the keys.
struct BakeRanges {
    std::uint32_t count = 0; ///< of fields
    BakeSetting ground;      ///< input of `sward bake`
    std::vector<BakeSetting> settings{};
};

/// Reads the object `bakes` of a scene; `place` names it in messages. Throws Error{input} naming
/// place, key, value and bound.
BakeRanges readBakeRanges(const nlohmann::json& object, const std::string& place,
                          std::uint32_t maxFields);

/// A bake of a set.
struct DrawnBake {
    std::vector<std::string> shown; ///< arguments of `sward bake` as in the scene, for the manifest
    std::vector<std::string> arguments; ///< the same, with files in the scene's folder found there
    std::string file; ///< name of the field: its number, and a hash of arguments and files
};

/// The bakes of a scene in `folder`: a function of ranges, seed, files and program. Throws
/// Error{io} if a file cannot be read.
std::vector<DrawnBake> drawBakes(const BakeRanges& ranges, std::uint64_t seed,
                                 const std::filesystem::path& folder);

/// Bakes the fields that `folder` lacks, by the program `sward`, from number `first` on and then
/// from the beginning, so that several processes begin at different ones. Each appears whole.
/// `scene` is named in messages. Throws Error as `sward bake` does; Error{interrupted}.
void bakeMissing(const std::vector<DrawnBake>& bakes, const std::filesystem::path& folder,
                 std::size_t first, const std::string& scene, bool showBar);

} // namespace sward::view
