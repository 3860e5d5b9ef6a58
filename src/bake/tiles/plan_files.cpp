#include "bake/tiles/plan_files.h"

#include "bake/settings/meadow.h"
#include "core/error.h"
#include "core/files/file_hash.h"
#include "terrain/load.h"

#include <algorithm>

namespace sward::bake {
namespace {

void addMasks(const std::vector<Mask>& masks, std::vector<PlanFile>& files)
{
    for (const Mask& mask : masks) {
        if (mask.image != nullptr)
            files.push_back({mask.file, terrain::contentHash(*mask.image)});
        if (mask.map != nullptr)
            files.push_back({mask.file, terrain::mapFileHash(mask.file)});
    }
}

} // namespace

std::vector<PlanFile> planFiles(const BakeSettings& settings, const std::string& meadow)
{
    std::vector<PlanFile> files{{meadow, hashOfText(toJson(settings.meadow))}};
    addMasks(settings.masks, files);
    for (const SpeciesTraits& species : settings.meadow.species)
        addMasks(species.habitat.masks, files);
    for (const ExcludedArea& area : settings.excluded) {
        if (area.mesh != nullptr)
            files.push_back({area.file, terrain::contentHash(*area.mesh)});
        if (area.map != nullptr)
            files.push_back({area.file, terrain::mapFileHash(area.file)});
    }
    return files;
}

void requireUnchanged(std::span<const PlanFile> planned, std::span<const PlanFile> found,
                      const std::string& plan)
{
    for (std::size_t i = 0; i < std::max(planned.size(), found.size()); ++i) {
        if (i < planned.size() && i < found.size() && planned[i].name == found[i].name &&
            planned[i].hash == found[i].hash)
            continue;
        fail(ErrorKind::input,
             "{}: has changed since {} was made, so this tile would not fit the others; plan "
             "again, or bring back what it was",
             i < found.size() ? found[i].name : planned[i].name, plan);
    }
}

} // namespace sward::bake
