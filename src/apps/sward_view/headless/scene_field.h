#pragma once

#include "apps/sward_view/fields/baking.h"
#include "apps/sward_view/scene/scene.h"

#include <filesystem>
#include <memory>

namespace sward::view {

/// The field of a scene: NAME.sward in a folder, or a new bake that is deleted with this object
/// unless a folder was given.
class SceneField {
public:
    /// Searches `folder`, or the scene's folder if it is empty. Keeps a new bake in `folder`.
    /// Throws as Baking does, and an Error of the baker's kind if the bake fails.
    SceneField(const Scene& scene, const std::filesystem::path& folder, bool showBar);

    const std::filesystem::path& file() const { return file_; }

private:
    std::unique_ptr<Baking> baking_; ///< its folder holds the field
    std::filesystem::path file_;
};

} // namespace sward::view
