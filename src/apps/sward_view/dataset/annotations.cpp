#include "apps/sward_view/dataset/annotations.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cstddef>
#include <map>

namespace sward::view {
namespace {

/// Collects the mask of an object column by column.
class Mask {
public:
    void add(std::size_t place, glm::uvec2 pixel)
    {
        if (object_.area == 0) {
            object_.low = pixel;
            object_.high = pixel + 1u;
        }
        object_.low = glm::min(object_.low, pixel);
        object_.high = glm::max(object_.high, pixel + 1u);
        ++object_.area;
        if (place == end_ && !object_.runs.empty()) {
            ++object_.runs.back();
        } else {
            object_.runs.push_back(place - end_);
            object_.runs.push_back(1);
        }
        end_ = place + 1;
    }

    /// `pixels`: of the picture.
    SeenObject finished(std::size_t pixels)
    {
        if (end_ < pixels)
            object_.runs.push_back(pixels - end_);
        return std::move(object_);
    }

    std::uint64_t area() const { return object_.area; }
    void name(std::uint64_t plant, std::uint32_t species)
    {
        object_.plant = plant;
        object_.species = species;
    }

private:
    SeenObject object_;
    std::size_t end_ = 0; ///< one past the last pixel inside
};

} // namespace

render::LayerMask layersForObjects(const DatasetScene& scene)
{
    using enum render::Layer;
    return (scene.listsPlants ? render::bitOf(plant) | render::bitOf(species) : 0) |
           (scene.listsSpecies ? render::bitOf(species) : 0);
}

std::vector<SeenObject> seenObjects(const DatasetScene& scene, const render::FrameLayers& layers)
{
    std::vector<SeenObject> objects;
    if (!scene.listsPlants && !scene.listsSpecies)
        return objects;
    const auto species = layers.as<std::uint8_t>(render::Layer::species);
    const auto plants = layers.as<std::uint64_t>(render::Layer::plant);
    const std::size_t pixels = species.size();
    std::map<std::uint64_t, Mask> byPlant;
    std::map<std::uint32_t, Mask> bySpecies;
    for (std::uint32_t x = 0; x < layers.size.x; ++x)
        for (std::uint32_t y = 0; y < layers.size.y; ++y) {
            const std::size_t pixel = std::size_t(y) * layers.size.x + x;
            if (species[pixel] == 0)
                continue;
            const std::size_t place = std::size_t(x) * layers.size.y + y;
            const std::uint32_t slot = species[pixel] - 1u;
            if (scene.listsSpecies) {
                Mask& mask = bySpecies[slot];
                mask.name(0, slot);
                mask.add(place, {x, y});
            }
            if (scene.listsPlants) {
                Mask& mask = byPlant[plants[pixel]];
                mask.name(plants[pixel], slot);
                mask.add(place, {x, y});
            }
        }
    const auto take = [&](auto& masks) {
        for (auto& [key, mask] : masks)
            if (double(mask.area()) >= scene.minArea)
                objects.push_back(mask.finished(pixels));
    };
    take(byPlant);
    take(bySpecies);
    return objects;
}

} // namespace sward::view
