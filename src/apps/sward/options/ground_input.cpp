#include "apps/sward/options/ground_input.h"

#include "apps/common/interrupt.h"
#include "apps/sward/options/excluded_input.h"
#include "bake/bake.h"
#include "bake/filter/default_slope.h"
#include "bake/paint/stroke_move.h"
#include "bake/settings/stroke_file.h"
#include "core/error.h"
#include "core/log.h"
#include "terrain/files/file_kind.h"
#include "terrain/heightmap/heightmap.h"
#include "terrain/loading/placement.h"
#include "terrain/loading/plausibility.h"
#include "terrain/loading/repeated_ground.h"
#include "terrain/maps/map_places.h"

#include <glm/common.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

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
// `system`: of the ground before it.
terrain::GroundMesh loadBearing(const std::string& input, const BakeRequest& request,
                                const std::string& system, Diagnostics& diagnostics)
{
    terrain::ImportSettings settings = request.import;
    settings.heightmap.mapSystem = system;
    settings.mayMatchNothing = request.inputs.size() > 1;
    const GivenInputs& given = request.given;
    terrain::GroundMesh ground =
        given.ground ? given.ground(settings, diagnostics) : loadOne(input, settings, diagnostics);
    const std::string kind = given.ground ? "" : terrain::fileKind(input);
    const bool isGltf = kind == ".glb" || kind == ".gltf";
    if ((given.ground && !given.isHeightmap) || isGltf || kind == ".obj" || kind == ".ply" ||
        kind == ".stl" || kind == ".off")
        terrain::warnOfImplausible(ground, request.import, isGltf, input, diagnostics);
    // What coincides is said to, even if its name is a collider's.
    terrain::removeCoincident(ground, diagnostics);
    terrain::removeColliders(ground, request.import, input, diagnostics);
    return ground;
}

void warnWithoutHeightmap(const BakeRequest& request, Diagnostics& diagnostics)
{
    const terrain::HeightmapSettings& map = request.import.heightmap;
    const auto isMap = [](const std::string& file) { return terrain::isHeightmap(file); };
    if ((map.size || map.extent || map.height || !map.holeMask.empty() || map.noData ||
         map.flipRows || !map.endian.empty() || !map.encoding.empty()) &&
        !request.given.isHeightmap &&
        std::none_of(request.inputs.begin(), request.inputs.end(), isMap) &&
        std::none_of(request.occluders.begin(), request.occluders.end(), isMap))
        diagnostics.warn("--size, --extent, --height, --hole-mask, --endian, --encoding, "
                         "--flip-rows and --no-data are ignored: no INPUT is a heightmap (.png "
                         ".r16 .raw .r32 .hgt .asc .exr .tif .tiff)");
}

// Bounds of a ground in the world, and its input.
struct Placed {
    std::string input;
    glm::dvec3 low;
    glm::dvec3 high;
    bool hasPlace = false; // says where it lies
    std::string system;    // of a map
};

// A map without a system, or without a place, may lie anywhere in the system of others.
void requireOneSystem(const std::vector<Placed>& maps)
{
    const auto named =
        std::ranges::find_if(maps, [](const Placed& map) { return !map.system.empty(); });
    for (const Placed& map : maps)
        if (named != maps.end() && map.system.empty() && terrain::isMapRaster(map.input))
            fail(ErrorKind::input, "{}: {}, and {} is in {}; gdal_edit.py -{} sets it", map.input,
                 map.hasPlace ? "names no coordinate system" : "says nowhere where it lies",
                 named->input, terrain::systemName(named->system),
                 map.hasPlace ? "a_srs EPSG:N" : "a_ullr");
}

// A heightmap that is no map says nothing of its place: two of them lie around the same origin.
void warnOfOverlap(const std::vector<Placed>& maps, Diagnostics& diagnostics)
{
    for (std::size_t i = 0; i < maps.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const glm::dvec3 low = glm::max(maps[i].low, maps[j].low);
            const glm::dvec3 high = glm::min(maps[i].high, maps[j].high);
            if (low.x < high.x && low.z < high.z)
                diagnostics.warn("{} and {} lie on one another over {:.6g} x {:.6g} m: {}",
                                 maps[j].input, maps[i].input, high.x - low.x, high.z - low.z,
                                 maps[i].hasPlace && maps[j].hasPlace
                                     ? "grass grows on both; gdal_merge.py joins them"
                                     : "a heightmap without a map has no place of its own and lies "
                                       "around the origin; place them as nodes of a glTF");
        }
}

// Names that match in none of several inputs would leave all ground bare.
void requireMatches(const std::vector<std::string>& unmatched,
                    const std::vector<std::string>& inputs)
{
    if (std::ranges::all_of(unmatched, [](const std::string& reason) { return !reason.empty(); }))
        fail(ErrorKind::input, "{}: {}", inputs.front(), unmatched.front());
}

Placed placeOf(const std::string& input, const terrain::GroundMesh& ground)
{
    const Aabb box = ground.bounds();
    return {input, ground.origin + glm::dvec3(box.low), ground.origin + glm::dvec3(box.high),
            ground.hasPlace, ground.mapSystem};
}

void moveStrokes(const terrain::GroundMesh& ground, BakeRequest& request)
{
    bake::Strokes& strokes = request.settings.strokes;
    bake::MovedStrokes moved =
        bake::moveOnto(ground, request.settings.sides, strokes.list, request.moveStrokes);
    log::info("{}: {} of {} strokes are moved onto the ground: {} points, by up to {:.3g} m",
              strokes.file, moved.moved.size(), strokes.list.size(), moved.points, moved.farthest);
    strokes.list = std::move(moved.list);
    bake::requireStrokeCount(strokes, strokes.file);
}

} // namespace

terrain::GroundMesh loadGround(BakeRequest& request, Diagnostics& diagnostics)
{
    warnWithoutHeightmap(request, diagnostics);
    terrain::GroundMesh ground = loadBearing(request.inputs.front(), request, {}, diagnostics);
    std::vector<std::string> unmatched{terrain::unmatchedGlobs(ground, request.import)};
    std::vector<Placed> maps;
    if (!request.given.ground && terrain::isHeightmap(request.inputs.front()))
        maps.push_back(placeOf(request.inputs.front(), ground));
    for (std::size_t i = 1; i < request.inputs.size(); ++i) {
        const std::string& input = request.inputs[i];
        const terrain::GroundMesh next = loadBearing(input, request, ground.mapSystem, diagnostics);
        unmatched.push_back(terrain::unmatchedGlobs(next, request.import));
        if (terrain::isHeightmap(input))
            maps.push_back(placeOf(input, next));
        terrain::append(ground, next);
    }
    requireMatches(unmatched, request.inputs);
    requireOneSystem(maps);
    warnOfOverlap(maps, diagnostics);
    if (request.inputs.size() > 1)
        terrain::removeCoincident(ground, diagnostics);

    // Occluders are in the same space as the ground; ignore globs of bearing parts.
    terrain::ImportSettings occluding = request.import;
    occluding.bearingNodes.clear();
    occluding.bearingMaterials.clear();
    occluding.occluderNodes.clear();
    occluding.bareNames = false;
    occluding.masks = {};
    for (const std::string& file : request.occluders) {
        occluding.heightmap.mapSystem = ground.mapSystem;
        terrain::GroundMesh occluder = loadOne(file, occluding, diagnostics);
        if (terrain::isHeightmap(file)) {
            maps.push_back(placeOf(file, occluder));
            requireOneSystem(maps);
        }
        std::fill(occluder.bears.begin(), occluder.bears.end(), std::uint8_t(0));
        terrain::append(ground, occluder);
    }
    if (request.moveStrokes > 0.0)
        moveStrokes(ground, request);
    if (request.choosesSlope)
        request.settings.slope = bake::defaultSlope(ground, request.settings.groundUp);
    if (request.choosesMask)
        request.settings.masks = bake::defaultMasks(ground, request.settings);
    request.choosesMask = request.choosesMask && !request.settings.masks.empty();
    loadExcluded(request, diagnostics);
    return ground;
}

} // namespace sward::apps
