#pragma once

#include "apps/sward_view/dataset/annotations.h"
#include "apps/sward_view/dataset/bake_draws.h"
#include "apps/sward_view/dataset/dataset_scene.h"
#include "apps/sward_view/dataset/frame_draws.h"
#include "apps/sward_view/headless/layered_drawing.h"
#include "field/field.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace sward::view {

/// The files of a set, in its folder. A frame is finished once its .json is there, which is written
/// last; every file appears whole.
class DatasetFiles {
public:
    /// A class of objects: a species of one or more fields.
    struct Category {
        std::string name;
    };

    /// `fields`: as DatasetScene::fields; their species become categories. `bakes`: what made some
    /// of them. All must outlive it. Makes the folder. Throws Error{io} if that is impossible.
    DatasetFiles(const DatasetScene& scene, std::span<const field::FieldView> fields,
                 std::span<const DrawnBake> bakes, std::filesystem::path folder);

    /// Throws Error{usage} if the folder has the manifest of another scene.
    static void requireScene(const DatasetScene& scene, const std::filesystem::path& folder);

    bool isFinished(std::uint64_t frame) const;

    /// Writes manifest.json, which says how to make the set again. If there is one, it must be of
    /// the same set: throws Error{usage} that names what differs. `device`: name and driver.
    void writeManifest(const std::string& device) const;

    /// Writes a frame, its layers and then its description; on any thread. Returns the bytes of its
    /// files.
    std::uint64_t write(std::uint64_t frame, const DrawnFrame& what, LayeredFrame drawn) const;

    /// Whether every frame of the set is finished, by whatever process.
    bool isComplete() const;

    /// Writes coco.json, the objects of all frames.
    void writeObjects() const;

private:
    std::filesystem::path nameOf(std::uint64_t frame, const char* extension) const;
    std::string descriptionOf(std::uint64_t frame, const DrawnFrame& what,
                              std::span<const SeenObject> objects) const;

    const DatasetScene& scene_;
    std::span<const DrawnBake> bakes_;
    std::filesystem::path folder_;
    std::vector<Category> categories_;
    std::vector<std::vector<std::uint32_t>> categoryOf_; ///< [field][slot]
    std::vector<std::string> contents_;                  ///< of each field: a hash, as text
};

} // namespace sward::view
