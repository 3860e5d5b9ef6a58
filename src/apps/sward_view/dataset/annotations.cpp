#include "apps/sward_view/dataset/annotations.h"

#include "core/random.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace sward::view {
namespace {

/// Side of the tiles in which a picture is turned into columns [pixels]: their lines stay in the
/// cache.
constexpr std::uint32_t turnedTile = 32;

constexpr std::size_t maxSpecies = 256; ///< numbers of render::Layer::species

/// Numbers of plants, from 1 on, in the order in which they were first seen.
class PlantNumbers {
public:
    PlantNumbers()
        : places_(1024)
    {
    }

    std::uint32_t of(std::uint64_t plant)
    {
        // Neighbouring pixels mostly show one plant.
        if (plant == last_)
            return lastNumber_;
        last_ = plant;
        if (2 * plants_.size() >= places_.size())
            grow();
        std::uint32_t& number = placeOf(plant);
        if (number == 0) {
            plants_.push_back(plant);
            number = static_cast<std::uint32_t>(plants_.size());
        }
        return lastNumber_ = number;
    }

    /// By number − 1.
    const std::vector<std::uint64_t>& plants() const { return plants_; }

private:
    /// The place of a plant, or the empty one that it takes.
    std::uint32_t& placeOf(std::uint64_t plant)
    {
        std::size_t at = mixBits(plant) & (places_.size() - 1);
        while (places_[at] != 0 && plants_[places_[at] - 1] != plant)
            at = (at + 1) & (places_.size() - 1);
        return places_[at];
    }

    void grow()
    {
        places_.assign(2 * places_.size(), 0);
        for (std::uint32_t i = 0; i < plants_.size(); ++i)
            placeOf(plants_[i]) = i + 1;
    }

    std::vector<std::uint64_t> plants_;
    std::vector<std::uint32_t> places_; ///< numbers by hash; a power of two
    std::uint64_t last_ = 0;
    std::uint32_t lastNumber_ = 0;
};

/// Collects the mask of an object column by column.
class Mask {
public:
    /// Adds `count` pixels of column `x` from row `y` on.
    void add(std::uint32_t x, std::uint32_t y, std::uint32_t count, std::uint32_t height)
    {
        const std::size_t place = std::size_t(x) * height + y;
        if (object_.area == 0) {
            object_.low = {x, y};
            object_.high = {x + 1, y + count};
        }
        object_.low = glm::min(object_.low, glm::uvec2(x, y));
        object_.high = glm::max(object_.high, glm::uvec2(x + 1, y + count));
        object_.area += count;
        if (place == end_ && !object_.runs.empty()) {
            object_.runs.back() += count;
        } else {
            object_.runs.push_back(place - end_);
            object_.runs.push_back(count);
        }
        end_ = place + count;
    }

    /// `pixels`: of the picture.
    SeenObject finished(std::size_t pixels)
    {
        if (end_ < pixels)
            object_.runs.push_back(pixels - end_);
        return std::move(object_);
    }

    void name(std::uint64_t plant, std::uint32_t species)
    {
        object_.plant = plant;
        object_.species = species;
    }

private:
    SeenObject object_;
    std::size_t end_ = 0; ///< one past the last pixel inside
};

/// What a picture shows, column after column.
struct Columns {
    std::vector<std::uint32_t> plants; ///< numbers of PlantNumbers; 0: none, or not wanted
    std::vector<std::uint8_t> species; ///< as the layer
};

/// Calls `use` with label, first row and end of each run of equal labels in column `x`.
template <typename Label, typename Use>
void forEachRun(const std::vector<Label>& labels, std::uint32_t x, std::uint32_t height,
                const Use& use)
{
    const Label* const column = labels.data() + std::size_t(x) * height;
    for (std::uint32_t y = 0; y < height;) {
        const Label label = column[y];
        std::uint32_t end = y + 1;
        while (end < height && column[end] == label)
            ++end;
        if (label != 0)
            use(label, y, end);
        y = end;
    }
}

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
    const glm::uvec2 size = layers.size;
    const std::size_t pixels = species.size();

    // Number the plants, count their pixels, and turn rows into columns.
    Columns columns;
    columns.plants.resize(scene.listsPlants ? pixels : 0);
    columns.species.resize(pixels);
    PlantNumbers numbers;
    std::vector<std::uint32_t> areas(1, 0); ///< by number
    std::array<std::uint64_t, maxSpecies> ofSpecies{};
    for (std::uint32_t top = 0; top < size.y; top += turnedTile)
        for (std::uint32_t left = 0; left < size.x; left += turnedTile)
            for (std::uint32_t y = top; y < std::min(top + turnedTile, size.y); ++y)
                for (std::uint32_t x = left; x < std::min(left + turnedTile, size.x); ++x) {
                    const std::size_t pixel = std::size_t(y) * size.x + x;
                    const std::size_t place = std::size_t(x) * size.y + y;
                    columns.species[place] = species[pixel];
                    ++ofSpecies[species[pixel]];
                    if (species[pixel] == 0 || !scene.listsPlants)
                        continue;
                    const std::uint32_t number = numbers.of(plants[pixel]);
                    columns.plants[place] = number;
                    if (number == areas.size())
                        areas.push_back(0);
                    ++areas[number];
                }

    // Make masks of what is large enough.
    const auto isLarge = [&](std::uint64_t area) { return double(area) >= scene.minArea; };
    std::vector<std::uint32_t> maskOf(areas.size(), 0); ///< 1 + its place; 0: none
    std::vector<Mask> masks;
    for (std::size_t i = 1; i < areas.size(); ++i)
        if (isLarge(areas[i])) {
            masks.emplace_back();
            maskOf[i] = static_cast<std::uint32_t>(masks.size());
        }
    std::array<Mask, maxSpecies> speciesMasks;
    for (std::uint32_t x = 0; x < size.x; ++x) {
        if (scene.listsPlants)
            forEachRun(columns.plants, x, size.y, [&](std::uint32_t number, auto y, auto end) {
                if (maskOf[number] == 0)
                    return;
                Mask& mask = masks[maskOf[number] - 1];
                const std::size_t last = std::size_t(x) * size.y + end - 1;
                mask.name(numbers.plants()[number - 1], columns.species[last] - 1u);
                mask.add(x, y, end - y, size.y);
            });
        if (scene.listsSpecies)
            forEachRun(columns.species, x, size.y, [&](std::uint32_t one, auto y, auto end) {
                speciesMasks[one].add(x, y, end - y, size.y);
            });
    }
    for (Mask& mask : masks)
        objects.push_back(mask.finished(pixels));
    std::ranges::sort(objects, {}, &SeenObject::plant);
    for (std::size_t one = 1; one < maxSpecies && scene.listsSpecies; ++one)
        if (ofSpecies[one] > 0 && isLarge(ofSpecies[one])) {
            speciesMasks[one].name(0, static_cast<std::uint32_t>(one - 1));
            objects.push_back(speciesMasks[one].finished(pixels));
        }
    return objects;
}

} // namespace sward::view
