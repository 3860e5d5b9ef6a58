#pragma once

#include "apps/sward_view/dataset/bake_draws.h"
#include "render/layers/frame_layers.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sward::view {

/// Files of a set's frames.
enum class DatasetFormat : std::uint32_t { exr, npz, png };

/// What a set of labelled pictures holds: docs/layers.md has the keys. Ranges are of uniform random
/// numbers; equal ends fix a value.
struct DatasetScene {
    std::filesystem::path file;      ///< of the scene
    std::string text;                ///< of it, for the manifest
    std::vector<std::string> fields; ///< field files; each frame shows one, or one of …
    BakeRanges bakes;                ///< … these; count 0: none
    glm::uvec2 size{640, 360};       ///< [pixels]
    std::uint32_t samples = 1;       ///< 1 or 4
    std::uint64_t frames = 1;        ///< 1 to 10 million
    std::uint64_t seed = 1;          ///< of all random numbers
    render::LayerMask layers = 0;    ///< to write; 0: pictures alone
    DatasetFormat format = DatasetFormat::exr;
    bool isCompressed = true; ///< of OpenEXR

    /// Cameras on the ground.
    struct Cameras {
        glm::dvec2 height{1.5, 1.7};    ///< [m] above the ground
        glm::dvec2 pitch{-30.0, -5.0};  ///< [degrees] above the horizon
        glm::dvec2 heading{0.0, 360.0}; ///< [degrees] clockwise from north, −z
        glm::dvec2 roll{0.0};           ///< [degrees]
        glm::dvec2 fovY{45.0};          ///< [degrees]
        glm::dvec2 speed{0.0};          ///< [m/s] forwards
        glm::dvec2 turn{0.0};           ///< [degrees/s] clockwise
        std::optional<glm::dvec2> x;    ///< [m] world; unset: anywhere on the ground
        std::optional<glm::dvec2> z;    ///< likewise
    } cameras;

    std::string path;         ///< file of a camera path instead; empty: none
    double pathStep = 0.1;    ///< [s] on the path from frame to frame
    double jitter = 0.0;      ///< [m] of the eye, to each side
    double jitterAngle = 0.0; ///< [degrees] of the view on a path

    std::optional<glm::dvec2> sunHeight;    ///< [degrees]; unset: that of the settings' sun
    std::optional<glm::dvec2> sunHeading;   ///< [degrees] clockwise from north; unset: likewise
    std::optional<glm::dvec2> windStrength; ///< as --wind-strength; unset: the field's
    glm::dvec2 time{0.0, 60.0};             ///< [s] of the wind in the frame
    double step = 1.0 / 60.0;               ///< [s] between a frame and its neighbours, for flow
    std::uint32_t settling = 4;             ///< frames before, whose motion a frame has
    double minArea = 64.0;                  ///< [pixels] of an object
    bool listsPlants = true;                ///< as objects
    bool listsSpecies = true;               ///< likewise
    std::string settings;                   ///< settings file; empty: none
};

/// Reads a scene; files are looked for in its folder. Throws Error{io} if it cannot be read,
/// Error{input} naming file, key, value and bound.
DatasetScene readDatasetScene(const std::filesystem::path& file);

} // namespace sward::view
