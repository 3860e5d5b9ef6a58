#include "terrain/maps/map_grid.h"

#include "core/error.h"
#include "terrain/maps/map_reader.h"
#include "terrain/maps/map_system.h"

#include <fmt/core.h>
#include <gdal.h>
#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>

namespace sward::terrain {
namespace {

// Points on each side of a rectangle, which systems bend.
constexpr int pointsOfSide = 21;

constexpr float none = std::numeric_limits<float>::quiet_NaN();

struct CloseMap {
    void operator()(void* file) const { GDALClose(static_cast<GDALDatasetH>(file)); }
};
using MapFile = std::unique_ptr<void, CloseMap>;

// Pixels to places, of GDAL: x = a0 + a1·column + a2·row, y = a3 + a4·column + a5·row, from
// corners.
struct Placement {
    std::array<double, 6> a{0, 1, 0, 0, 0, 1};

    bool isNorthUp() const { return a[2] == 0.0 && a[4] == 0.0 && a[1] > 0.0 && a[5] < 0.0; }
    double determinant() const { return a[1] * a[5] - a[2] * a[4]; }

    glm::dvec2 place(glm::dvec2 pixel) const
    {
        return {a[0] + a[1] * pixel.x + a[2] * pixel.y, a[3] + a[4] * pixel.x + a[5] * pixel.y};
    }

    glm::dvec2 pixel(glm::dvec2 place) const
    {
        const double x = place.x - a[0], y = place.y - a[3];
        return glm::dvec2(a[5] * x - a[2] * y, a[1] * y - a[4] * x) / determinant();
    }
};

// Points along the edges of a rectangle.
std::vector<glm::dvec2> edgeOf(glm::dvec2 low, glm::dvec2 high)
{
    std::vector<glm::dvec2> points;
    for (int i = 0; i < pointsOfSide; ++i) {
        const glm::dvec2 at = glm::mix(low, high, double(i) / (pointsOfSide - 1));
        points.insert(points.end(), {{at.x, low.y}, {at.x, high.y}, {low.x, at.y}, {high.x, at.y}});
    }
    return points;
}

MapBounds boundsOf(const std::vector<glm::dvec2>& points)
{
    MapBounds bounds{glm::dvec2(1e300), glm::dvec2(-1e300)};
    for (const glm::dvec2 point : points)
        if (std::isfinite(point.x) && std::isfinite(point.y)) {
            bounds.low = glm::min(bounds.low, point);
            bounds.high = glm::max(bounds.high, point);
        }
    return bounds;
}

std::string textOfBounds(const MapBounds& bounds)
{
    return fmt::format("east {:.8g} to {:.8g}, north {:.8g} to {:.8g}", bounds.low.x, bounds.high.x,
                       bounds.low.y, bounds.high.y);
}

class Raster {
public:
    Raster(const std::string& path, const MapRequest& request, const std::string& option,
           Diagnostics& diagnostics)
        : path_(path)
        , request_(request)
        , option_(option)
        , diagnostics_(diagnostics)
    {
        open();
    }

    MapGrid read()
    {
        if (!hasPlace_) {
            if (request_.system || request_.within)
                fail(ErrorKind::input,
                     "{}: {}: says nowhere where it lies (no geotransform); gdal_edit.py -a_ullr "
                     "sets it",
                     option_, path_);
            MapGrid grid;
            grid.size = size_;
            requireFew(double(size_.x) * double(size_.y));
            grid.values = samples({0, 0}, size_);
            return grid;
        }
        const MapSystem target = targetSystem();
        const MapChange toTarget(own_, target, path_), toOwn(target, own_, path_);
        // What the file covers, in the target's metres.
        std::vector<glm::dvec2> edge = edgeOf({0, 0}, glm::dvec2(size_));
        for (glm::dvec2& point : edge)
            point = placement_.place(point);
        toTarget.apply(edge);
        const MapBounds covered = boundsOf(edge);
        if (!(covered.low.x < covered.high.x && covered.low.y < covered.high.y))
            fail(ErrorKind::input, "{}: lies nowhere in the coordinate system {}", path_,
                 nameOf(target));
        MapBounds wanted = covered;
        if (request_.within) {
            wanted.low = glm::max(wanted.low, request_.within->low);
            wanted.high = glm::min(wanted.high, request_.within->high);
            if (!(wanted.low.x < wanted.high.x && wanted.low.y < wanted.high.y))
                fail(ErrorKind::input, "{}: {}: covers {}, and the ground {}: they do not meet",
                     option_, path_, textOfBounds(covered), textOfBounds(*request_.within));
        }
        MapGrid grid = toTarget.handle() == nullptr && placement_.isNorthUp()
                           ? direct(wanted)
                           : resampled(wanted, toTarget, toOwn);
        grid.system = wktOf(target);
        return grid;
    }

private:
    void open()
    {
        prepareMaps();
        std::error_code ignored;
        if (!std::filesystem::is_regular_file(path_, ignored))
            fail(ErrorKind::io, "{}: no such file", path_);
        const char* const drivers[] = {"GTiff", nullptr};
        file_.reset(GDALOpenEx(path_.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, drivers, nullptr,
                               nullptr));
        if (file_ == nullptr)
            fail(ErrorKind::input,
                 "{}: cannot be read as a GeoTIFF: it is damaged or of another kind", path_);
        const int bands = GDALGetRasterCount(file_.get());
        if (request_.band < 1 || request_.band > bands)
            fail(ErrorKind::input, "{}: has {} bands, and no number {}", path_, bands,
                 request_.band);
        band_ = GDALGetRasterBand(file_.get(), request_.band);
        if (GDALDataTypeIsComplex(GDALGetRasterDataType(band_)) != 0)
            fail(ErrorKind::unsupported, "{}: band {} has complex numbers", path_, request_.band);
        size_ = {GDALGetRasterXSize(file_.get()), GDALGetRasterYSize(file_.get())};
        hasPlace_ = GDALGetGeoTransform(file_.get(), placement_.a.data()) == CE_None;
        for (const double number : placement_.a)
            if (!std::isfinite(number) || !(std::abs(number) < 1e9))
                fail(ErrorKind::input, "{}: its geotransform has {}", path_, number);
        if (hasPlace_ && !(std::abs(placement_.determinant()) > 0.0))
            fail(ErrorKind::input, "{}: its geotransform gives pixels no area", path_);
        own_ = systemOf(GDALGetSpatialRef(file_.get()));
    }

    MapSystem targetSystem() const
    {
        if (request_.system && !request_.system->empty()) {
            if (own_ == nullptr)
                fail(ErrorKind::input,
                     "{}: {}: names no coordinate system, and the ground has one; gdal_edit.py "
                     "-a_srs EPSG:N sets it",
                     option_, path_);
            return systemOf(*request_.system, path_);
        }
        if (own_ == nullptr) {
            diagnostics_.warn("{}: names no coordinate system; its units are taken for metres",
                              path_);
            return nullptr;
        }
        if (isInMetres(own_))
            return systemOf(own_.get());
        if (request_.system)
            fail(ErrorKind::input,
                 "{}: {}: is in {}, which is not in metres, and the ground names no system to "
                 "bring it into",
                 option_, path_, nameOf(own_));
        const glm::dvec2 middle = placement_.place(0.5 * glm::dvec2(size_));
        MapSystem local = localSystem(own_, middle, path_);
        diagnostics_.warn("{}: {} is not in metres; the ground is in those of a transverse "
                          "Mercator at its middle, {:.6g}, {:.6g}",
                          path_, nameOf(own_), middle.x, middle.y);
        return local;
    }

    void requireFew(double count) const
    {
        if (!(count <= double(request_.maxSamples)))
            fail(ErrorKind::unsupported,
                 "{}: {:.0f} samples, more than {}; gdal_translate -tr makes them wider, -projwin "
                 "takes a part",
                 path_, count, request_.maxSamples);
    }

    // Pixels of the file, as numbers.
    std::vector<float> samples(glm::uvec2 from, glm::uvec2 count) const
    {
        std::vector<float> values(std::size_t(count.x) * count.y);
        const int x = static_cast<int>(from.x), y = static_cast<int>(from.y),
                  width = static_cast<int>(count.x), height = static_cast<int>(count.y);
        int hasScale = 0, hasOffset = 0;
        const double scale = GDALGetRasterScale(band_, &hasScale),
                     offset = GDALGetRasterOffset(band_, &hasOffset);
        const bool changes = !request_.isCategory &&
                             ((hasScale != 0 && scale != 1.0) || (hasOffset != 0 && offset != 0.0));
        const bool isMasked = (GDALGetMaskFlags(band_) & GMF_ALL_VALID) == 0;
        const GDALRasterBandH mask = isMasked ? GDALGetMaskBand(band_) : nullptr;
        // Row by row: double precision is needed for one row at a time.
        std::vector<double> row(count.x);
        std::vector<std::uint8_t> valid(count.x, 255);
        for (int j = 0; j < height; ++j) {
            if (GDALRasterIO(band_, GF_Read, x, y + j, width, 1, row.data(), width, 1, GDT_Float64,
                             0, 0) != CE_None ||
                (isMasked && GDALRasterIO(mask, GF_Read, x, y + j, width, 1, valid.data(), width, 1,
                                          GDT_Byte, 0, 0) != CE_None))
                fail(ErrorKind::input,
                     "{}: row {} cannot be read: the file is damaged or truncated", path_, y + j);
            float* const out = values.data() + std::size_t(j) * count.x;
            for (std::size_t i = 0; i < count.x; ++i) {
                const double value = changes ? row[i] * scale + offset : row[i];
                out[i] = valid[i] != 0 && std::isfinite(value) ? static_cast<float>(value * unit())
                                                               : none;
            }
        }
        return values;
    }

    // [m] of one, for heights in feet.
    double unit() const
    {
        const std::string name = GDALGetRasterUnitType(band_);
        if (request_.isCategory || name.empty())
            return 1.0;
        if (name == "ft" || name == "foot" || name == "feet" || name == "Foot")
            return 0.3048;
        if (name == "US survey foot" || name == "ftUS" || name == "foot_us" || name == "us-ft")
            return 1200.0 / 3937.0;
        return 1.0;
    }

    MapGrid direct(const MapBounds& wanted) const
    {
        const glm::dvec2 a = placement_.pixel({wanted.low.x, wanted.high.y}),
                         b = placement_.pixel({wanted.high.x, wanted.low.y});
        const glm::dvec2 size(size_);
        // A pixel more on each side, for interpolation.
        const glm::dvec2 from =
            glm::clamp(glm::floor(glm::min(a, b)) - 1.0, glm::dvec2(0.0), size - 1.0);
        const glm::dvec2 end = glm::clamp(glm::ceil(glm::max(a, b)) + 1.0, from + 1.0, size);
        requireFew((end.x - from.x) * (end.y - from.y));
        MapGrid grid;
        grid.size = glm::uvec2(end - from);
        grid.first = placement_.place(from + 0.5);
        grid.step = {placement_.a[1], -placement_.a[5]};
        grid.values = samples(glm::uvec2(from), grid.size);
        return grid;
    }

    MapGrid resampled(const MapBounds& wanted, const MapChange& toTarget,
                      const MapChange& toOwn) const
    {
        // Steps as long as the file's pixels are wide in its middle, counted from a pixel there: a
        // sample is the same whatever part is wanted.
        const glm::dvec2 middle = glm::floor(0.5 * glm::dvec2(size_)) + 0.5;
        const glm::dvec2 centre = toTarget.at(placement_.place(middle));
        const glm::dvec2 right = toTarget.at(placement_.place(middle + glm::dvec2(1, 0))) - centre;
        const glm::dvec2 below = toTarget.at(placement_.place(middle + glm::dvec2(0, 1))) - centre;
        const double step = std::sqrt(std::abs(right.x * below.y - right.y * below.x));
        if (!(step > 1e-6 && step < 1e7))
            fail(ErrorKind::input, "{}: its pixels have no size in metres", path_);
        const bool isPart = request_.within.has_value();
        const glm::dvec2 west = (wanted.low - centre) / step, east = (wanted.high - centre) / step;
        const glm::dvec2 low = isPart ? glm::floor(west) : glm::ceil(west - 1e-6);
        const glm::dvec2 high = isPart ? glm::ceil(east) : glm::floor(east + 1e-6);
        MapGrid grid;
        const glm::dvec2 size = glm::max(high - low + 1.0, glm::dvec2(1.0));
        requireFew(size.x * size.y);
        grid.size = glm::uvec2(size);
        grid.step = glm::dvec2(step);
        grid.first = centre + glm::dvec2(low.x, high.y) * step;

        // The part of the file that covers the grid.
        std::vector<glm::dvec2> edge = edgeOf(wanted.low, wanted.high);
        toOwn.apply(edge);
        for (glm::dvec2& point : edge)
            if (std::isfinite(point.x) && std::isfinite(point.y))
                point = placement_.pixel(point);
        const MapBounds part = boundsOf(edge);
        const glm::dvec2 from =
            glm::clamp(glm::floor(part.low) - 2.0, glm::dvec2(0.0), glm::dvec2(size_) - 1.0);
        const glm::dvec2 end =
            glm::clamp(glm::ceil(part.high) + 2.0, from + 1.0, glm::dvec2(size_));
        requireFew((end.x - from.x) * (end.y - from.y));
        const glm::uvec2 partSize(end - from);
        const std::vector<float> source = samples(glm::uvec2(from), partSize);
        grid.values.reserve(std::size_t(grid.size.x) * grid.size.y);
        std::vector<glm::dvec2> row(grid.size.x);
        for (std::uint32_t j = 0; j < grid.size.y; ++j) {
            for (std::uint32_t i = 0; i < grid.size.x; ++i)
                row[i] = grid.first + glm::dvec2(i, -double(j)) * step;
            toOwn.apply(row);
            for (const glm::dvec2 place : row)
                grid.values.push_back(
                    valueAt(source, partSize, placement_.pixel(place) - from - 0.5));
        }
        return grid;
    }

    // At a place between samples; none if one that counts is missing.
    float valueAt(const std::vector<float>& source, glm::uvec2 size, glm::dvec2 at) const
    {
        if (!(at.x > -0.5 - 1e-9 && at.y > -0.5 - 1e-9 && at.x < double(size.x) - 0.5 + 1e-9 &&
              at.y < double(size.y) - 0.5 + 1e-9))
            return none;
        const auto sample = [&](double column, double row) {
            const auto i = static_cast<std::size_t>(std::clamp(column, 0.0, double(size.x) - 1.0));
            const auto j = static_cast<std::size_t>(std::clamp(row, 0.0, double(size.y) - 1.0));
            return source[j * size.x + i];
        };
        if (request_.isCategory)
            return sample(std::round(at.x), std::round(at.y));
        const glm::dvec2 low = glm::floor(at), share = at - low;
        double sum = 0.0;
        for (const int j : {0, 1})
            for (const int i : {0, 1}) {
                const double weight =
                    (i == 0 ? 1.0 - share.x : share.x) * (j == 0 ? 1.0 - share.y : share.y);
                if (weight > 1e-9)
                    sum += weight * double(sample(low.x + i, low.y + j));
            }
        return static_cast<float>(sum);
    }

    const std::string& path_;
    const MapRequest& request_;
    const std::string& option_;
    Diagnostics& diagnostics_;
    MapFile file_;
    GDALRasterBandH band_ = nullptr;
    glm::uvec2 size_{0U};
    Placement placement_;
    bool hasPlace_ = false;
    MapSystem own_;
};

} // namespace

MapGrid readMapByGdal(const std::string& path, const MapRequest& request, const std::string& option,
                      Diagnostics& diagnostics)
{
    return Raster(path, request, option, diagnostics).read();
}

} // namespace sward::terrain
