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

/// The files of a set, in its folder. Every file appears whole, and a frame's .json last. A frame
/// is finished if its .json is whole, and its other files have the sizes that it states. Each .json
/// names its set: a hash of the manifest, but for the number of frames, which may grow, and
/// "about".
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

    /// Throws Error{usage} if the folder has the manifest of another scene, or of one with more
    /// frames; it names what differs.
    static void requireScene(const DatasetScene& scene, const std::filesystem::path& folder);

    /// Throws Error{usage} if there are files of the frame that are of another set, or if no
    /// manifest says of which.
    bool isFinished(std::uint64_t frame);

    /// Writes manifest.json, which says how to make the set again. If there is one, it must be of
    /// the same set: throws Error{usage} that names what differs. `device`: name and driver.
    void writeManifest(const std::string& device);

    /// Writes a frame, its layers and then its description; on any thread, after the manifest.
    /// Returns the bytes of its files.
    std::uint64_t write(std::uint64_t frame, const DrawnFrame& what, LayeredFrame drawn);

    /// Whether every frame of the set is finished, by whatever process.
    bool isComplete();

    /// Writes coco.json, the objects of all frames. The set must be complete.
    void writeObjects() const;

private:
    std::filesystem::path nameOf(std::uint64_t frame, const char* extension) const;
    std::filesystem::path pictureOf(std::uint64_t frame) const;
    const std::string& knownSet(const std::filesystem::path& file);
    bool isWhole(std::uint64_t frame);
    std::string descriptionOf(std::uint64_t frame, const DrawnFrame& what,
                              std::span<const SeenObject> objects,
                              std::span<const std::filesystem::path> files) const;

    const DatasetScene& scene_;
    std::span<const DrawnBake> bakes_;
    std::filesystem::path folder_;
    std::vector<Category> categories_;
    std::vector<std::vector<std::uint32_t>> categoryOf_; ///< [field][slot]
    std::vector<std::string> contents_;                  ///< of each field: a hash, as text
    std::string set_;                                    ///< that frames name; empty: not yet known
    std::vector<std::uint8_t>
        finished_; ///< not 0: a frame that is known to be; threads write theirs
};

} // namespace sward::view
