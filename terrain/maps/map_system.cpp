#include "terrain/maps/map_system.h"

#include "core/error.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <fmt/core.h>
#include <gdal.h>

#include <limits>
#include <mutex>
#include <numbers>

namespace sward::terrain {

void prepareMaps()
{
    static std::once_flag once;
    std::call_once(once, [] {
        CPLSetErrorHandler(CPLQuietErrorHandler);
        OSRSetPROJEnableNetwork(0);
        // Nothing is written beside a file.
        CPLSetConfigOption("GDAL_PAM_ENABLED", "NO");
        // Blocks of a file that stay in memory, unless somebody says otherwise.
        if (CPLGetConfigOption("GDAL_CACHEMAX", nullptr) == nullptr)
            GDALSetCacheMax64(GIntBig(192) << 20);
        GDALAllRegister();
    });
}

MapSystem systemOf(OGRSpatialReferenceH system)
{
    if (system == nullptr)
        return nullptr;
    MapSystem copy(OSRClone(system));
    OSRStripVertical(copy.get());
    OSRSetAxisMappingStrategy(copy.get(), OAMS_TRADITIONAL_GIS_ORDER);
    return copy;
}

MapSystem systemOf(const std::string& wkt, const std::string& path)
{
    MapSystem made(OSRNewSpatialReference(nullptr));
    if (OSRSetFromUserInput(made.get(), wkt.c_str()) != OGRERR_NONE)
        fail(ErrorKind::input, "{}: its coordinate system means nothing", path);
    OSRSetAxisMappingStrategy(made.get(), OAMS_TRADITIONAL_GIS_ORDER);
    return made;
}

std::string wktOf(const MapSystem& system)
{
    char* text = nullptr;
    if (system == nullptr || OSRExportToWkt(system.get(), &text) != OGRERR_NONE)
        return {};
    std::string wkt(text);
    CPLFree(text);
    return wkt;
}

bool isInMetres(const MapSystem& system)
{
    return system != nullptr && OSRIsGeographic(system.get()) == 0 &&
           OSRIsGeocentric(system.get()) == 0 && OSRGetLinearUnits(system.get(), nullptr) == 1.0;
}

double turnOf(const MapSystem& system)
{
    if (system == nullptr || OSRIsGeographic(system.get()) == 0)
        return 0.0;
    return 2.0 * std::numbers::pi / OSRGetAngularUnits(system.get(), nullptr);
}

std::string nameOf(const MapSystem& system)
{
    const char* const own = system != nullptr ? OSRGetName(system.get()) : nullptr;
    const std::string name = own != nullptr ? own : "";
    // What is made of a PROJ string is called "unknown".
    char* text = nullptr;
    if (system != nullptr && (name.empty() || name == "unknown") &&
        OSRExportToProj4(system.get(), &text) == OGRERR_NONE && text != nullptr && *text != '\0') {
        const std::string proj(text);
        CPLFree(text);
        return proj;
    }
    return name.empty() ? "a system without a name" : name;
}

bool isSame(const MapSystem& a, const MapSystem& b)
{
    return a != nullptr && b != nullptr && OSRIsSame(a.get(), b.get()) != 0;
}

MapSystem localSystem(const MapSystem& system, glm::dvec2 place, const std::string& path)
{
    const MapSystem globe = systemOf("EPSG:4326", path);
    const glm::dvec2 degrees = MapChange(system, globe, path).at(place);
    if (!(degrees.x >= -360.0 && degrees.x <= 360.0 && degrees.y >= -89.9 && degrees.y <= 89.9))
        fail(ErrorKind::input, "{}: its middle is nowhere on the Earth", path);
    MapSystem local(OSRNewSpatialReference(nullptr));
    const std::string text = fmt::format(
        "+proj=tmerc +lat_0={:.6f} +lon_0={:.6f} +k=1 +x_0=0 +y_0=0 +datum=WGS84 +units=m +no_defs",
        degrees.y, degrees.x);
    if (OSRImportFromProj4(local.get(), text.c_str()) != OGRERR_NONE)
        fail(ErrorKind::input, "{}: its middle is nowhere on the Earth", path);
    OSRSetAxisMappingStrategy(local.get(), OAMS_TRADITIONAL_GIS_ORDER);
    return local;
}

MapChange::MapChange(const MapSystem& from, const MapSystem& to, const std::string& path)
{
    if (from == nullptr || to == nullptr || isSame(from, to))
        return;
    change_ = OCTNewCoordinateTransformation(from.get(), to.get());
    if (change_ == nullptr)
        fail(ErrorKind::input, "{}: there is no way from its coordinate system {} to {}", path,
             nameOf(from), nameOf(to));
}

MapChange::~MapChange()
{
    if (change_ != nullptr)
        OCTDestroyCoordinateTransformation(change_);
}

void MapChange::apply(std::vector<glm::dvec2>& places) const
{
    if (change_ == nullptr || places.empty())
        return;
    std::vector<double> x, y;
    x.reserve(places.size());
    y.reserve(places.size());
    for (const glm::dvec2 place : places) {
        x.push_back(place.x);
        y.push_back(place.y);
    }
    std::vector<int> isDone(places.size(), 0);
    OCTTransformEx(change_, static_cast<int>(places.size()), x.data(), y.data(), nullptr,
                   isDone.data());
    for (std::size_t i = 0; i < places.size(); ++i)
        places[i] = isDone[i] != 0 ? glm::dvec2(x[i], y[i])
                                   : glm::dvec2(std::numeric_limits<double>::infinity());
}

glm::dvec2 MapChange::at(glm::dvec2 place) const
{
    std::vector<glm::dvec2> one{place};
    apply(one);
    return one.front();
}

} // namespace sward::terrain
