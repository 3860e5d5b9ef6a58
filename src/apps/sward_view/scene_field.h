#pragma once

#include "apps/sward_view/baking.h"
#include "apps/sward_view/scene.h"

#include <filesystem>
#include <memory>

namespace sward::view {

/// The field of a scene: NAME.sward in a folder, or one that grows first and is taken away with
/// this object, unless the folder was asked for.
class SceneField {
public:
    /// Looks in `folder`, or, if that is empty, beside the scene. What is baked is kept in
    /// `folder`. Throws what Baking throws, and an Error of the baker's kind where none has grown.
    SceneField(const Scene& scene, const std::filesystem::path& folder, bool showBar);

    const std::filesystem::path& file() const { return file_; }

private:
    std::unique_ptr<Baking> baking_; ///< whose folder holds the field
    std::filesystem::path file_;
};

} // namespace sward::view
