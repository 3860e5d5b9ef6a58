#include "core/error.h"
#include "terrain/maps/map_reader.h"
#include "terrain/maps/map_shapes.h"
#include "terrain/maps/map_system.h"

#include <cpl_error.h>
#include <gdal.h>
#include <ogr_api.h>

#include <cmath>
#include <filesystem>

namespace sward::terrain {
namespace {

constexpr std::size_t maxCorners = 50'000'000;
constexpr int segmentsOfQuarter = 16; // of a round corner

struct CloseShapes {
    void operator()(void* file) const { GDALClose(static_cast<GDALDatasetH>(file)); }
};
struct DestroyFeature {
    void operator()(void* feature) const { OGR_F_Destroy(static_cast<OGRFeatureH>(feature)); }
};
struct DestroyGeometry {
    void operator()(void* geometry) const
    {
        OGR_G_DestroyGeometry(static_cast<OGRGeometryH>(geometry));
    }
};
using Geometry = std::unique_ptr<void, DestroyGeometry>;

// Whether GDAL has met an error since CPLErrorReset(): it then ends a layer early, or leaves out
// shapes.
bool hasFailed()
{
    return CPLGetLastErrorType() >= CE_Failure;
}

// Notes that GDAL meets an error; opening a file forgets them otherwise.
void CPL_STDCALL noteFailure(CPLErr kind, CPLErrorNum, const char*)
{
    if (kind >= CE_Failure)
        *static_cast<bool*>(CPLGetErrorHandlerUserData()) = true;
}

class ShapeReader {
public:
    ShapeReader(const std::string& path, double margin, const std::string& system)
        : path_(path)
        , margin_(margin)
        , target_(system.empty() ? nullptr : systemOf(system, path))
    {
    }

    std::vector<std::vector<MapShapes::Ring>> read()
    {
        std::error_code ignored;
        if (!std::filesystem::is_regular_file(path_, ignored))
            fail(ErrorKind::io, "{}: no such file", path_);
        const char* const drivers[] = {"GeoJSON", "GPKG", "ESRI Shapefile", nullptr};
        bool hasTrouble = false;
        CPLPushErrorHandlerEx(noteFailure, &hasTrouble);
        const std::unique_ptr<void, CloseShapes> file(GDALOpenEx(
            path_.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, drivers, nullptr, nullptr));
        CPLPopErrorHandler();
        if (file == nullptr)
            fail(ErrorKind::input,
                 "{}: cannot be read as GeoJSON, GeoPackage or Shapefile: it is damaged or of "
                 "another kind",
                 path_);
        if (hasTrouble)
            fail(ErrorKind::input,
                 "{}: names a coordinate system that is not known, or is damaged; ogr2ogr -a_srs "
                 "EPSG:N sets the system",
                 path_);
        const std::string driver = GDALGetDriverShortName(GDALGetDatasetDriver(file.get()));
        isGeoJson_ = driver == "GeoJSON";
        // Shapefiles count what is deleted, too.
        isCounted_ = driver != "ESRI Shapefile";
        for (int i = 0; i < GDALDatasetGetLayerCount(file.get()); ++i)
            if (const OGRLayerH layer = GDALDatasetGetLayer(file.get(), i);
                OGR_L_GetGeomType(layer) != wkbNone) // a table, as QGIS adds one for its styles
                readLayer(layer);
        return std::move(areas_);
    }

private:
    void readLayer(OGRLayerH layer)
    {
        layer_ = OGR_L_GetName(layer);
        MapSystem own = systemOf(OGR_L_GetSpatialRef(layer));
        // What GeoPackage calls a layer without a system.
        if (own != nullptr && nameOf(own).starts_with("Undefined "))
            own = nullptr;
        if (target_ != nullptr && own == nullptr)
            fail(ErrorKind::input,
                 "{}: layer \"{}\" names no coordinate system, and the ground has one; ogr2ogr "
                 "-a_srs EPSG:N sets it",
                 path_, layer_);
        if (target_ == nullptr && own != nullptr && !isInMetres(own))
            fail(ErrorKind::input,
                 "{}: layer \"{}\" is in {}, which is not in metres, and the ground names no "
                 "system to bring it into",
                 path_, layer_, nameOf(own));
        const MapChange change(own, target_, path_);
        CPLErrorReset();
        const GIntBig count = isCounted_ ? OGR_L_GetFeatureCount(layer, 1) : 0;
        OGR_L_ResetReading(layer);
        GIntBig read = 0;
        while (const std::unique_ptr<void, DestroyFeature> feature{next(layer, read)}) {
            ++read;
            const OGRGeometryH given = OGR_F_GetGeometryRef(feature.get());
            if (given == nullptr || OGR_G_IsEmpty(given) != 0)
                continue;
            feature_ = OGR_F_GetFID(feature.get());
            // Curves become chords.
            const Geometry geometry(OGR_G_GetLinearGeometry(given, 0.0, nullptr));
            if (geometry == nullptr ||
                (change.handle() != nullptr &&
                 OGR_G_Transform(geometry.get(), change.handle()) != OGRERR_NONE))
                failPlace(given, own);
            add(geometry.get());
        }
        if (read < count)
            failDamaged(read);
    }

    OGRFeatureH next(OGRLayerH layer, GIntBig read) const
    {
        CPLErrorReset();
        const OGRFeatureH feature = OGR_L_GetNextFeature(layer);
        if (hasFailed()) {
            OGR_F_Destroy(feature);
            failDamaged(read);
        }
        return feature;
    }

    [[noreturn]] void failDamaged(GIntBig read) const
    {
        fail(ErrorKind::input,
             "{}: damaged: layer \"{}\" cannot be read beyond its first {} features", path_, layer_,
             read);
    }

    [[noreturn]] void failPlace(OGRGeometryH given, const MapSystem& own) const
    {
        OGREnvelope box = {};
        OGR_G_GetEnvelope(given, &box);
        const bool isDegrees = own != nullptr && OSRIsGeographic(own.get()) != 0;
        fail(
            ErrorKind::input,
            "{}: feature {} of layer \"{}\", {:.8g} to {:.8g} and {:.8g} to {:.8g} in {}{}, has no "
            "place in the ground's coordinate system {}",
            path_, feature_, layer_, box.MinX, box.MaxX, box.MinY, box.MaxY, nameOf(own),
            !isDegrees   ? ""
            : isGeoJson_ ? " (degrees, as GeoJSON is unless it names another system)"
                         : " (degrees)",
            nameOf(target_));
    }

    // Areas of a geometry, which may be a collection.
    void add(OGRGeometryH geometry)
    {
        const OGRwkbGeometryType type = wkbFlatten(OGR_G_GetGeometryType(geometry));
        if (OGR_G_IsEmpty(geometry) != 0)
            return;
        if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection) != 0 ||
            OGR_GT_IsSubClassOf(type, wkbPolyhedralSurface) != 0) {
            for (int i = 0; i < OGR_G_GetGeometryCount(geometry); ++i)
                add(OGR_G_GetGeometryRef(geometry, i));
            return;
        }
        const bool isArea = type == wkbPolygon || type == wkbTriangle;
        if (!isArea && !(margin_ > 0.0))
            fail(ErrorKind::input,
                 "{}: feature {} of layer \"{}\" is or holds a line or a point, which has no area; "
                 "FILE:margin M widens it",
                 path_, feature_, layer_);
        if (margin_ > 0.0)
            addWidened(geometry, isArea);
        else
            addRings(geometry);
    }

    void addWidened(OGRGeometryH geometry, bool isArea)
    {
        // What a line that crosses itself encloses is an area without a margin, too; a buffer loses
        // parts of it.
        Geometry valid;
        OGR_G_CloseRings(geometry);
        if (isArea && OGR_G_IsValid(geometry) == 0) {
            valid.reset(OGR_G_MakeValid(geometry));
            geometry = valid.get();
        }
        const Geometry wide(geometry != nullptr ? OGR_G_Buffer(geometry, margin_, segmentsOfQuarter)
                                                : nullptr);
        if (wide == nullptr)
            fail(
                ErrorKind::input,
                "{}: feature {} of layer \"{}\" cannot be widened by {} m: its outline encloses no "
                "area, or crosses itself",
                path_, feature_, layer_, margin_);
        addPolygons(wide.get());
    }

    // Of a polygon, or several.
    void addPolygons(OGRGeometryH geometry)
    {
        if (wkbFlatten(OGR_G_GetGeometryType(geometry)) == wkbPolygon)
            return addRings(geometry);
        for (int i = 0; i < OGR_G_GetGeometryCount(geometry); ++i)
            addPolygons(OGR_G_GetGeometryRef(geometry, i));
    }

    void addRings(OGRGeometryH polygon)
    {
        std::vector<MapShapes::Ring> rings;
        for (int r = 0; r < OGR_G_GetGeometryCount(polygon); ++r) {
            const OGRGeometryH ring = OGR_G_GetGeometryRef(polygon, r);
            const int count = OGR_G_GetPointCount(ring);
            corners_ += static_cast<std::size_t>(count);
            if (corners_ > maxCorners)
                fail(ErrorKind::unsupported, "{}: its areas have more than {} corners", path_,
                     maxCorners);
            MapShapes::Ring corners;
            for (int i = 0; i < count; ++i) {
                corners.emplace_back(OGR_G_GetX(ring, i), OGR_G_GetY(ring, i));
                if (!std::isfinite(corners.back().x) || !std::isfinite(corners.back().y))
                    fail(ErrorKind::input, "{}: a corner is {}, {}", path_, corners.back().x,
                         corners.back().y);
            }
            if (!corners.empty() && corners.front() != corners.back())
                corners.push_back(corners.front());
            rings.push_back(std::move(corners));
        }
        areas_.push_back(std::move(rings));
    }

    const std::string& path_;
    double margin_;
    MapSystem target_;
    bool isGeoJson_ = false;
    bool isCounted_ = false;
    std::string layer_; // that is read
    GIntBig feature_ = 0;
    std::vector<std::vector<MapShapes::Ring>> areas_;
    std::size_t corners_ = 0;
};

} // namespace

std::shared_ptr<const MapShapes> readShapesByGdal(const std::string& path, double margin,
                                                  const std::string& system,
                                                  Diagnostics& diagnostics)
{
    prepareMaps();
    const std::vector<std::vector<MapShapes::Ring>> areas =
        ShapeReader(path, margin, system).read();
    if (areas.empty())
        diagnostics.warn("{}: has no areas", path);
    return std::make_shared<const MapShapes>(areas);
}

} // namespace sward::terrain
