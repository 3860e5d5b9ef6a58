#include "terrain/maps/map_places.h"

#include "core/error.h"
#include "terrain/maps/map_reader.h"
#include "terrain/maps/map_system.h"

#include <algorithm>
#include <cctype>

namespace sward::terrain {
namespace {

// Whether a text is a system and no file or address, which GDAL would open.
bool isSystemText(const std::string& text)
{
    const std::size_t colon = text.find(':');
    const auto isCode = [](unsigned char c) { return std::isalnum(c) != 0; };
    return text.starts_with("+proj=") || text.find('[') != std::string::npos ||
           (colon != std::string::npos && colon > 0 && colon + 1 < text.size() &&
            std::all_of(text.begin(), text.begin() + std::ptrdiff_t(colon), isCode) &&
            std::all_of(text.begin() + std::ptrdiff_t(colon) + 1, text.end(), isCode));
}

MapSystem metricSystem(const std::string& text, const std::string& option)
{
    MapSystem system(OSRNewSpatialReference(nullptr));
    if (!isSystemText(text) || OSRSetFromUserInput(system.get(), text.c_str()) != OGRERR_NONE)
        fail(ErrorKind::usage, "{}: {}: no such coordinate system is known; expected EPSG:N",
             option, text);
    if (OSRGetAxesCount(system.get()) > 2 || OSRIsCompound(system.get()) != 0)
        fail(ErrorKind::usage,
             "{}: {} ({}) has heights of its own; expected one of east and north alone, as "
             "EPSG:32633",
             option, text, nameOf(system));
    if (!isInMetres(system))
        fail(ErrorKind::usage,
             "{}: {} ({}) is not in metres on a plane; expected a projected system, as EPSG:32633",
             option, text, nameOf(system));
    for (int axis = 0; axis < 2; ++axis) {
        OGRAxisOrientation direction = OAO_Other;
        OSRGetAxis(system.get(), nullptr, axis, &direction);
        if (direction == OAO_West)
            fail(ErrorKind::usage, "{}: {} ({}) counts to the west; expected one of east and north",
                 option, text, nameOf(system));
    }
    OSRSetAxisMappingStrategy(system.get(), OAMS_TRADITIONAL_GIS_ORDER);
    return system;
}

MapSystem degreeSystem()
{
    return systemOf("EPSG:4326", "WGS 84");
}

} // namespace

MapSystemFacts mapSystemFactsByGdal(const std::string& text, const std::string& option)
{
    prepareMaps();
    const MapSystem system = metricSystem(text, option);
    MapSystemFacts facts{.name = nameOf(system), .area = {}};
    MapBounds area;
    // Systems without one have -1000 in its place.
    if (OSRGetAreaOfUse(system.get(), &area.low.x, &area.low.y, &area.high.x, &area.high.y,
                        nullptr) != 0 &&
        area.low.x >= -180.0)
        facts.area = area;
    return facts;
}

std::vector<glm::dvec2> changedPlacesByGdal(const std::string& text, std::vector<glm::dvec2> places,
                                            bool toDegrees, const std::string& option)
{
    prepareMaps();
    const MapSystem map = metricSystem(text, option);
    const MapSystem globe = degreeSystem();
    const MapChange change(toDegrees ? map : globe, toDegrees ? globe : map, option);
    change.apply(places);
    return places;
}

} // namespace sward::terrain
