#include "core/error.h"
#include "core/process/program_path.h"
#include "core/system/shared_library.h"
#include "terrain/files/file_kind.h"
#include "terrain/maps/map_reader.h"

#include <array>
#include <filesystem>
#include <string_view>
#include <utility>

namespace sward::terrain {
namespace {

constexpr const char* mapLibrary = "libsward_maps.so";

// The reader of the library beside this program, or where the system looks; null without one.
const MapReader* openReader()
{
    using Door = const MapReader* (*)();
    const std::filesystem::path own = ownFolder();
    const std::array<std::filesystem::path, 5> places{own / mapLibrary, own / "../lib" / mapLibrary,
                                                      own / "../lib/sward" / mapLibrary,
                                                      own / "../../lib" / mapLibrary, mapLibrary};
    for (const std::filesystem::path& place : places)
        if (void* const door = functionOf(place.string().c_str(), mapReaderName))
            return reinterpret_cast<Door>(door)();
    return nullptr;
}

const MapReader* mapReader()
{
    static const MapReader* const reader = openReader();
    return reader;
}

const MapReader& readerFor(const std::string& path)
{
    if (mapReader() == nullptr)
        fail(ErrorKind::unsupported,
             "{}: maps are read by {}, which is not installed (it is built where there is GDAL, "
             "Debian: libgdal-dev)",
             path, mapLibrary);
    return *mapReader();
}

} // namespace

bool isMapShapes(const std::string& path)
{
    const std::string extension = fileKind(path);
    return extension == ".geojson" || extension == ".gpkg" || extension == ".shp";
}

bool readsMaps()
{
    return mapReader() != nullptr;
}

MapGrid readMap(const std::string& path, const MapRequest& request, const std::string& option,
                Diagnostics& diagnostics)
{
    return readerFor(path).readMap(path, request, option, diagnostics);
}

std::unique_ptr<MapRaster> openMap(const std::string& path, const MapRequest& request,
                                   const std::string& option, Diagnostics& diagnostics)
{
    return readerFor(path).openMap(path, request, option, diagnostics);
}

std::shared_ptr<const MapShapes> readMapShapes(const std::string& path, double margin,
                                               const std::string& system, Diagnostics& diagnostics)
{
    return readerFor(path).readShapes(path, margin, system, diagnostics);
}

MapSystemFacts mapSystemFacts(const std::string& system, const std::string& option)
{
    return readerFor(option).systemFacts(system, option);
}

std::vector<glm::dvec2> degreesOf(const std::string& system, std::vector<glm::dvec2> places,
                                  const std::string& option)
{
    return readerFor(option).changedPlaces(system, std::move(places), true, option);
}

std::vector<glm::dvec2> mapPlacesOf(const std::string& system, std::vector<glm::dvec2> degrees,
                                    const std::string& option)
{
    return readerFor(option).changedPlaces(system, std::move(degrees), false, option);
}

std::string systemName(const std::string& wkt)
{
    // WKT 1 ends in AUTHORITY["EPSG","25833"]].
    constexpr std::string_view start = "AUTHORITY[\"";
    constexpr std::string_view middle = "\",\"";
    constexpr std::string_view end = "\"]]";
    const std::size_t at = wkt.rfind(start);
    if (at == std::string::npos || !wkt.ends_with(end))
        return wkt;
    const std::string own =
        wkt.substr(at + start.size(), wkt.size() - end.size() - at - start.size());
    const std::size_t comma = own.find(middle);
    if (comma == std::string::npos || own.find('"', comma + middle.size()) != std::string::npos)
        return wkt;
    return own.substr(0, comma) + ":" + own.substr(comma + middle.size());
}

} // namespace sward::terrain
