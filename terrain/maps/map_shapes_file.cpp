#include "core/error.h"
#include "terrain/maps/map_reader.h"
#include "terrain/maps/map_shapes.h"
#include "terrain/maps/map_system.h"

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
        const std::unique_ptr<void, CloseShapes> file(GDALOpenEx(
            path_.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, drivers, nullptr, nullptr));
        if (file == nullptr)
            fail(ErrorKind::input,
                 "{}: cannot be read as GeoJSON, GeoPackage or Shapefile: it is damaged or of "
                 "another kind",
                 path_);
        for (int i = 0; i < GDALDatasetGetLayerCount(file.get()); ++i)
            readLayer(GDALDatasetGetLayer(file.get(), i));
        return std::move(areas_);
    }

private:
    void readLayer(OGRLayerH layer)
    {
        const MapSystem own = systemOf(OGR_L_GetSpatialRef(layer));
        if (target_ != nullptr && own == nullptr)
            fail(ErrorKind::input,
                 "{}: names no coordinate system, and the ground has one; ogr2ogr -a_srs EPSG:N "
                 "sets it",
                 path_);
        if (target_ == nullptr && own != nullptr && !isInMetres(own))
            fail(ErrorKind::input,
                 "{}: is in {}, which is not in metres, and the ground names no system to bring it "
                 "into",
                 path_, nameOf(own));
        const MapChange change(own, target_, path_);
        OGR_L_ResetReading(layer);
        while (const std::unique_ptr<void, DestroyFeature> feature{OGR_L_GetNextFeature(layer)}) {
            const OGRGeometryH given = OGR_F_GetGeometryRef(feature.get());
            if (given == nullptr || OGR_G_IsEmpty(given) != 0)
                continue;
            // Curves become chords.
            Geometry geometry(OGR_G_GetLinearGeometry(given, 0.0, nullptr));
            if (geometry == nullptr ||
                (change.handle() != nullptr &&
                 OGR_G_Transform(geometry.get(), change.handle()) != OGRERR_NONE))
                fail(ErrorKind::input,
                     "{}: feature {} has no place in the ground's coordinate system", path_,
                     OGR_F_GetFID(feature.get()));
            if (OGR_G_GetDimension(geometry.get()) < 2 && !(margin_ > 0.0))
                fail(ErrorKind::input,
                     "{}: feature {} is a line or a point, which has no area; FILE:margin M widens "
                     "it",
                     path_, OGR_F_GetFID(feature.get()));
            if (margin_ > 0.0)
                geometry.reset(OGR_G_Buffer(geometry.get(), margin_, segmentsOfQuarter));
            if (geometry == nullptr)
                fail(ErrorKind::input,
                     "{}: feature {} cannot be widened by {} m: its outline crosses itself", path_,
                     OGR_F_GetFID(feature.get()), margin_);
            add(geometry.get());
        }
    }

    // Areas of a geometry, which may be a collection.
    void add(OGRGeometryH geometry)
    {
        const OGRwkbGeometryType type = wkbFlatten(OGR_G_GetGeometryType(geometry));
        if (type != wkbPolygon) {
            for (int i = 0; i < OGR_G_GetGeometryCount(geometry); ++i)
                add(OGR_G_GetGeometryRef(geometry, i));
            return;
        }
        std::vector<MapShapes::Ring> rings;
        for (int r = 0; r < OGR_G_GetGeometryCount(geometry); ++r) {
            const OGRGeometryH ring = OGR_G_GetGeometryRef(geometry, r);
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
