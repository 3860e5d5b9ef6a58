#pragma once

#include <string>
#include <vector>

namespace sward::golden {

/// A golden picture: what is baked, and how it is drawn.
struct Scene {
    std::string name;                ///< of the picture: images/NAME.png
    std::vector<std::string> bake;   ///< arguments of `sward bake`, without the output
    std::vector<std::string> render; ///< arguments of `sward-view render`, without files and size
};

/// One for each kind of ground, geometry, plant and colour. MESHES/ and CAMERAS/ at the beginning
/// of an argument stand for the folders assets/meshes and tests/golden/cameras.
const std::vector<Scene>& scenes();

/// The others: more of the same kinds. They are long.
const std::vector<Scene>& furtherScenes();

} // namespace sward::golden
