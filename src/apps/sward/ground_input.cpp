#include "apps/sward/ground_input.h"

#include "apps/common/interrupt.h"
#include "core/log.h"
#include "terrain/file_kind.h"
#include "terrain/heightmap/heightmap.h"
#include "terrain/plausibility.h"

#include <algorithm>

namespace sward::apps {
namespace {

terrain::GroundMesh loadOne(const std::string& input, const terrain::ImportSettings& settings,
                            Diagnostics& diagnostics)
{
    throwIfInterrupted("load");
    terrain::GroundMesh mesh = terrain::load(input, settings, diagnostics);
    log::debug("{}: {} triangles, {} vertices, {} materials, {} nodes", input,
               mesh.triangles.size(), mesh.positions.size(), mesh.materials.size(),
               mesh.nodes.size());
    return mesh;
}

// Check modelled ground for orientation and units; generated ground and occluders need no check.
terrain::GroundMesh loadBearing(const std::string& input, const BakeRequest& request,
                                Diagnostics& diagnostics)
{
    terrain::GroundMesh ground = loadOne(input, request.import, diagnostics);
    const std::string kind = terrain::fileKind(input);
    const bool isGltf = kind == ".glb" || kind == ".gltf";
    if (isGltf || kind == ".obj" || kind == ".ply" || kind == ".stl" || kind == ".off")
        terrain::warnOfImplausible(ground, request.import, isGltf, input, diagnostics);
    return ground;
}

void warnWithoutHeightmap(const BakeRequest& request, Diagnostics& diagnostics)
{
    const terrain::HeightmapSettings& map = request.import.heightmap;
    const auto isMap = [](const std::string& file) { return terrain::isHeightmap(file); };
    if ((map.size || map.extent || map.height || !map.holeMask.empty()) &&
        std::none_of(request.inputs.begin(), request.inputs.end(), isMap) &&
        std::none_of(request.occluders.begin(), request.occluders.end(), isMap))
        diagnostics.warn("--size, --extent, --height and --hole-mask are ignored: no INPUT is a "
                         "heightmap (.png .r16 .exr)");
}

} // namespace

terrain::GroundMesh loadGround(const BakeRequest& request, Diagnostics& diagnostics)
{
    warnWithoutHeightmap(request, diagnostics);
    terrain::GroundMesh ground = loadBearing(request.inputs.front(), request, diagnostics);
    for (std::size_t i = 1; i < request.inputs.size(); ++i)
        terrain::append(ground, loadBearing(request.inputs[i], request, diagnostics));

    // Occluders are in the same space as the ground; ignore globs of bearing parts.
    terrain::ImportSettings occluding = request.import;
    occluding.bearingNodes.clear();
    occluding.bearingMaterials.clear();
    occluding.occluderNodes.clear();
    occluding.bareNames = false;
    occluding.masks = {};
    for (const std::string& file : request.occluders) {
        terrain::GroundMesh occluder = loadOne(file, occluding, diagnostics);
        std::fill(occluder.bears.begin(), occluder.bears.end(), std::uint8_t(0));
        terrain::append(ground, occluder);
    }
    return ground;
}

} // namespace sward::apps
