#include "terrain/maps/map_grid.h"

#include "core/error.h"
#include "core/lower_case.h"
#include "terrain/maps/map_reader.h"
#include "terrain/maps/map_system.h"

#include <fmt/core.h>
#include <gdal.h>
#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <string_view>
#include <utility>

namespace sward::terrain {
namespace {

// Points on each side of a rectangle, which systems bend.
constexpr int pointsOfSide = 21;

// Most samples of a window, of a file that is turned.
constexpr std::size_t maxWindow = 25'000'000;

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

using Units = std::initializer_list<std::pair<std::string_view, double>>;

// [m] of a unit; none: it is none of these.
std::optional<double> metresOf(const std::string& unit, Units units)
{
    for (const auto& [name, metres] : units)
        if (lowerCase(unit) == name)
            return metres;
    return std::nullopt;
}

std::optional<double> feetOf(const std::string& unit)
{
    constexpr double foot = 0.3048, surveyFoot = 1200.0 / 3937.0;
    return metresOf(unit, {{"ft", foot},
                           {"foot", foot},
                           {"feet", foot},
                           {"international foot", foot},
                           {"us survey foot", surveyFoot},
                           {"us survey feet", surveyFoot},
                           {"ftus", surveyFoot},
                           {"foot_us", surveyFoot},
                           {"us-ft", surveyFoot}});
}

std::optional<double> metricOf(const std::string& unit)
{
    return metresOf(unit, {{"", 1.0},
                           {"m", 1.0},
                           {"metre", 1.0},
                           {"metres", 1.0},
                           {"meter", 1.0},
                           {"meters", 1.0},
                           {"dm", 0.1},
                           {"cm", 0.01},
                           {"centimetre", 0.01},
                           {"centimeter", 0.01},
                           {"mm", 0.001},
                           {"millimetre", 0.001},
                           {"millimeter", 0.001},
                           {"km", 1000.0},
                           {"kilometre", 1000.0},
                           {"kilometer", 1000.0}});
}

// The part of a raster's grid that is wanted.
struct GridPart {
    glm::dvec2 from{0.0};  // whole column and row
    glm::dvec2 count{0.0}; // of columns and rows
    double thin = 1.0;     // step of the points taken
};

class Raster : public MapRaster {
public:
    Raster(std::string path, MapRequest request, std::string option, Diagnostics& diagnostics)
        : path_(std::move(path))
        , request_(std::move(request))
        , option_(std::move(option))
    {
        open();
        if (isCategory())
            takeClasses();
        else
            takeNumbers(diagnostics);
        if (hasPlace_)
            place(diagnostics);
        else if (request_.system || request_.within)
            fail(ErrorKind::input,
                 "{}: says nowhere where it lies (no geotransform); gdal_edit.py -a_ullr sets it",
                 named());
        else
            grid_.size = size_;
    }

    const MapGrid& grid() const override { return grid_; }

    void read(glm::uvec2 from, glm::uvec2 count, std::span<float> values) override
    {
        fill({glm::dvec2(from), glm::dvec2(count)}, maxWindow, values);
    }

    // All, or what is wanted.
    MapGrid wanted() const
    {
        GridPart part{{0.0, 0.0}, glm::dvec2(grid_.size)};
        if (request_.within)
            part = partWithin(*request_.within);
        const double count = part.count.x * part.count.y;
        if (request_.mayThin)
            part.thin = std::max(1.0, std::ceil(std::sqrt(count / double(request_.maxSamples))));
        else
            requireFew(count);
        MapGrid grid = grid_;
        grid.from = part.from / part.thin;
        grid.step *= part.thin;
        grid.size = glm::uvec2(glm::ceil(part.count / part.thin));
        grid.values.resize(std::size_t(grid.size.x) * grid.size.y);
        fill(part, request_.maxSamples, grid.values);
        return grid;
    }

private:
    // The file, behind the option that asks for it.
    std::string named() const
    {
        return option_ == heightsOption ? path_ : fmt::format("{}: {}", option_, path_);
    }

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
        if (own_ != nullptr && OSRIsGeocentric(own_.get()) != 0)
            fail(ErrorKind::input,
                 "{}: is in {}, which is geocentric: no coordinates of a map; gdal_edit.py "
                 "-a_srs EPSG:N sets the one that it is in",
                 path_, nameOf(own_));
    }

    bool isCategory() const { return !request_.classes.empty(); }

    // Classes as the numbers of the band. Whole ones that these do not tell apart are refused.
    void takeClasses()
    {
        constexpr double exactDoubles = 9007199254740992.0; // 2^53
        const GDALDataType type = GDALGetRasterDataType(band_);
        const bool isFloat = type == GDT_Float32;
        const bool isLong = GDALDataTypeIsInteger(type) != 0 && GDALGetDataTypeSizeBits(type) > 53;
        for (const double value : request_.classes) {
            const auto single = static_cast<double>(static_cast<float>(value));
            if ((isFloat && single != value && value == std::round(value)) ||
                (isLong && !(std::abs(value) < exactDoubles)))
                fail(ErrorKind::input, "{}: {}: class {:.0f} is not exact: {}", option_, path_,
                     value,
                     isFloat ? "the band has floats of 32 bits, with whole numbers up to 2^24"
                             : "whole numbers are told apart up to 2^53");
            classes_.push_back(isFloat ? single : value);
        }
        std::ranges::sort(classes_);
    }

    // Scale, offset and unit of numbers.
    void takeNumbers(Diagnostics& diagnostics)
    {
        int hasScale = 0, hasOffset = 0;
        const double scale = GDALGetRasterScale(band_, &hasScale),
                     offset = GDALGetRasterOffset(band_, &hasOffset);
        scale_ = hasScale != 0 ? scale : 1.0;
        offset_ = hasOffset != 0 ? offset : 0.0;
        if (!std::isfinite(scale_) || !std::isfinite(offset_))
            fail(ErrorKind::input,
                 "{}: band {} has the scale {} and the offset {}, which must be finite; "
                 "gdal_edit.py -scale and -offset set them",
                 named(), request_.band, scale_, offset_);
        if (scale_ == 0.0)
            diagnostics.warn("{}: band {} has the scale 0: each value is its offset, {}", path_,
                             request_.band, offset_);
        const std::string name = GDALGetRasterUnitType(band_);
        // Millimetres of rain are no height.
        std::optional<double> metres = feetOf(name);
        if (!metres && option_ == heightsOption)
            metres = metricOf(name);
        metres_ = metres.value_or(1.0);
        if (!metres && option_ == heightsOption)
            diagnostics.warn("{}: its heights are in \"{}\", which is not a known unit; they are "
                             "taken for metres",
                             path_, name);
    }

    MapSystem targetSystem(Diagnostics& diagnostics) const
    {
        if (request_.system && !request_.system->empty()) {
            if (own_ == nullptr)
                fail(ErrorKind::input,
                     "{}: names no coordinate system, and the ground has one; gdal_edit.py "
                     "-a_srs EPSG:N sets it",
                     named());
            return systemOf(*request_.system, path_);
        }
        if (own_ == nullptr) {
            diagnostics.warn("{}: names no coordinate system; its units are taken for metres",
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
        const glm::dvec2 degrees = MapChange(own_, systemOf("EPSG:4326", path_), path_).at(middle);
        diagnostics.warn("{}: {} is not in metres; the ground is in those of a transverse "
                         "Mercator at its middle, longitude {:.6f}, latitude {:.6f}",
                         path_, nameOf(own_), degrees.x, degrees.y);
        return local;
    }

    // Lays the grid.
    void place(Diagnostics& diagnostics)
    {
        const MapSystem target = targetSystem(diagnostics);
        toTarget_.emplace(own_, target, path_);
        toOwn_.emplace(target, own_, path_);
        turn_ = turnOf(own_);
        grid_.system = wktOf(target);
        // What the file covers, in the target's metres.
        std::vector<glm::dvec2> edge = edgeOf({0, 0}, glm::dvec2(size_));
        for (glm::dvec2& point : edge)
            point = placement_.place(point);
        toTarget_->apply(edge);
        covered_ = boundsOf(edge);
        if (!(covered_.low.x < covered_.high.x && covered_.low.y < covered_.high.y))
            fail(ErrorKind::input, "{}: is in {}, and lies nowhere in {}", path_, nameOf(own_),
                 nameOf(target));
        isDirect_ = toTarget_->handle() == nullptr && placement_.isNorthUp();
        if (isDirect_) {
            grid_.size = size_;
            grid_.first = placement_.place(glm::dvec2(0.5));
            grid_.step = {placement_.a[1], -placement_.a[5]};
            return;
        }
        // Steps as long as the file's pixels are wide in its middle, counted from a pixel there.
        const glm::dvec2 middle = glm::floor(0.5 * glm::dvec2(size_)) + 0.5;
        centre_ = toTarget_->at(placement_.place(middle));
        const glm::dvec2 right =
            toTarget_->at(placement_.place(middle + glm::dvec2(1, 0))) - centre_;
        const glm::dvec2 below =
            toTarget_->at(placement_.place(middle + glm::dvec2(0, 1))) - centre_;
        const double step = std::sqrt(std::abs(right.x * below.y - right.y * below.x));
        if (!(step > 1e-6 && step < 1e7))
            fail(ErrorKind::input, "{}: its pixels have no size in metres", path_);
        low_ = glm::ceil((covered_.low - centre_) / step - 1e-6);
        high_ = glm::floor((covered_.high - centre_) / step + 1e-6);
        const glm::dvec2 size = glm::max(high_ - low_ + 1.0, glm::dvec2(1.0));
        if (!(size.x * size.y < 1e15 && std::max(size.x, size.y) < 4e9))
            fail(ErrorKind::input, "{}: {:.0f} x {:.0f} samples in {}", path_, size.x, size.y,
                 nameOf(target));
        grid_.size = glm::uvec2(size);
        grid_.step = glm::dvec2(step);
        grid_.first = centre_ + glm::dvec2(low_.x, high_.y) * step;
    }

    // The samples that cover bounds, and those beside them, for interpolation.
    GridPart partWithin(const MapBounds& within) const
    {
        MapBounds wanted = covered_;
        wanted.low = glm::max(wanted.low, within.low);
        wanted.high = glm::min(wanted.high, within.high);
        if (!(wanted.low.x < wanted.high.x && wanted.low.y < wanted.high.y))
            fail(ErrorKind::input, "{}: {}: covers {}, and the ground {}: they do not meet",
                 option_, path_, textOfBounds(covered_), textOfBounds(within));
        if (!isDirect_) {
            const glm::dvec2 low = glm::floor((wanted.low - centre_) / grid_.step),
                             high = glm::ceil((wanted.high - centre_) / grid_.step);
            return {{low.x - low_.x, high_.y - high.y}, high - low + 1.0};
        }
        const glm::dvec2 a = placement_.pixel({wanted.low.x, wanted.high.y}),
                         b = placement_.pixel({wanted.high.x, wanted.low.y});
        const glm::dvec2 size(size_);
        const glm::dvec2 from =
            glm::clamp(glm::floor(glm::min(a, b)) - 1.0, glm::dvec2(0.0), size - 1.0);
        return {from, glm::clamp(glm::ceil(glm::max(a, b)) + 1.0, from + 1.0, size) - from};
    }

    void fill(const GridPart& part, std::size_t maxSamples, std::span<float> values) const
    {
        if (hasPlace_ && !isDirect_)
            resample(part, maxSamples, values);
        else
            samples(part, values);
    }

    void requireFew(double count) const
    {
        if (count <= double(request_.maxSamples))
            return;
        if (option_ == heightsOption)
            fail(ErrorKind::unsupported,
                 "{}: {:.0f} samples, more than the {} of one ground; sward plan --tiles {:.0f}, "
                 "tile and merge bake it window by window (docs/maps.md); gdal_translate -tr makes "
                 "it coarser, -projwin takes a part",
                 path_, count, request_.maxSamples, std::ceil(count / samplesOfTile));
        fail(ErrorKind::unsupported,
             "{}: {:.0f} samples, more than {}; gdal_translate -tr makes them wider, -projwin "
             "takes a part",
             path_, count, request_.maxSamples);
    }

    // Pixels of the file, as numbers.
    void samples(const GridPart& part, std::span<float> values) const
    {
        const int x = static_cast<int>(part.from.x), y = static_cast<int>(part.from.y),
                  width = static_cast<int>(part.count.x), height = static_cast<int>(part.count.y),
                  thin = static_cast<int>(part.thin);
        const auto columns = static_cast<std::size_t>((width + thin - 1) / thin);
        const bool changes = scale_ != 1.0 || offset_ != 0.0;
        const bool isMasked = (GDALGetMaskFlags(band_) & GMF_ALL_VALID) == 0;
        const GDALRasterBandH mask = isMasked ? GDALGetMaskBand(band_) : nullptr;
        // Row by row: double precision is needed for one row at a time.
        std::vector<double> row(static_cast<std::size_t>(width));
        std::vector<std::uint8_t> valid(row.size(), 255);
        for (int j = 0; j < height; j += thin) {
            if (GDALRasterIO(band_, GF_Read, x, y + j, width, 1, row.data(), width, 1, GDT_Float64,
                             0, 0) != CE_None ||
                (isMasked && GDALRasterIO(mask, GF_Read, x, y + j, width, 1, valid.data(), width, 1,
                                          GDT_Byte, 0, 0) != CE_None))
                fail(ErrorKind::input,
                     "{}: row {} cannot be read: the file is damaged or truncated", path_, y + j);
            float* const out = values.data() + std::size_t(j / thin) * columns;
            for (std::size_t i = 0; i < columns; ++i) {
                const std::size_t from = i * std::size_t(thin);
                const double value = changes ? row[from] * scale_ + offset_ : row[from];
                if (valid[from] == 0 || !std::isfinite(value))
                    out[i] = none;
                else if (isCategory())
                    out[i] = std::ranges::binary_search(classes_, value) ? 1.0f : 0.0f;
                else
                    out[i] = static_cast<float>(value * metres_);
            }
        }
    }

    // From the grid's system to the file's. Longitudes turn towards the file's middle: PROJ gives
    // them within half a turn of Greenwich, and files may reach beyond.
    void applyToOwn(std::vector<glm::dvec2>& places) const
    {
        toOwn_->apply(places);
        if (turn_ == 0.0)
            return;
        const double middle = placement_.place(0.5 * glm::dvec2(size_)).x;
        for (glm::dvec2& place : places)
            if (const double away = place.x - middle;
                std::isfinite(away) && std::abs(away) > 0.5 * turn_)
                place.x -= turn_ * std::round(away / turn_);
    }

    // A part of the file, thinned.
    struct Source {
        std::vector<float> values;
        glm::dvec2 from; // column and row of the file
        glm::uvec2 size; // of the values
        double thin;
    };

    void resample(const GridPart& part, std::size_t maxSamples, std::span<float> values) const
    {
        const auto columns = static_cast<std::size_t>(std::ceil(part.count.x / part.thin));
        const auto rows = static_cast<std::size_t>(std::ceil(part.count.y / part.thin));
        const glm::dvec2 west = glm::dvec2(low_.x, high_.y) + glm::dvec2(part.from.x, -part.from.y);
        // The part of the file that covers the grid.
        const glm::dvec2 north = centre_ + west * grid_.step;
        std::vector<glm::dvec2> edge =
            edgeOf(north, north + glm::dvec2(part.count.x, -part.count.y) * grid_.step);
        applyToOwn(edge);
        for (glm::dvec2& point : edge)
            if (std::isfinite(point.x) && std::isfinite(point.y))
                point = placement_.pixel(point);
        const MapBounds box = boundsOf(edge);
        const glm::dvec2 size(size_);
        const glm::dvec2 from =
            glm::clamp(glm::floor(box.low) - 2.0 * part.thin, glm::dvec2(0.0), size - 1.0);
        const glm::dvec2 count =
            glm::clamp(glm::ceil(box.high) + 2.0 * part.thin, from + 1.0, size) - from;
        if (part.thin == 1.0 && !(count.x * count.y <= 4.0 * double(maxSamples) + 1e4))
            fail(ErrorKind::unsupported,
                 "{}: a window of {:.0f} samples needs {:.0f} of the file, which is turned or in "
                 "another system; gdalwarp lays it along the ground's east and north",
                 path_, part.count.x * part.count.y, count.x * count.y);
        Source source{{}, from, glm::uvec2(glm::ceil(count / part.thin)), part.thin};
        source.values.resize(std::size_t(source.size.x) * source.size.y);
        samples({from, count, part.thin}, source.values);
        std::vector<glm::dvec2> row(columns);
        for (std::size_t j = 0; j < rows; ++j) {
            for (std::size_t i = 0; i < columns; ++i)
                row[i] = centre_ + (west + part.thin * glm::dvec2(i, -double(j))) * grid_.step;
            applyToOwn(row);
            for (std::size_t i = 0; i < columns; ++i)
                values[j * columns + i] = valueAt(source, placement_.pixel(row[i]) - 0.5);
        }
    }

    // At a place between samples of the file; none if one that counts is missing.
    float valueAt(const Source& source, glm::dvec2 place) const
    {
        if (!(place.x > -0.5 - 1e-9 && place.y > -0.5 - 1e-9 &&
              place.x < double(size_.x) - 0.5 + 1e-9 && place.y < double(size_.y) - 0.5 + 1e-9))
            return none;
        // Whole steps are taken off after the shares are known: these are the same in all windows.
        const auto sample = [&](glm::dvec2 index) {
            const glm::dvec2 own =
                glm::clamp(index - (source.thin == 1.0 ? source.from : glm::dvec2(0.0)),
                           glm::dvec2(0.0), glm::dvec2(source.size) - 1.0);
            return source.values[static_cast<std::size_t>(own.y) * source.size.x +
                                 static_cast<std::size_t>(own.x)];
        };
        const glm::dvec2 at = source.thin == 1.0 ? place : (place - source.from) / source.thin;
        if (isCategory())
            return sample(glm::round(at));
        const glm::dvec2 low = glm::floor(at), share = at - low;
        double sum = 0.0;
        for (const int j : {0, 1})
            for (const int i : {0, 1}) {
                const double weight =
                    (i == 0 ? 1.0 - share.x : share.x) * (j == 0 ? 1.0 - share.y : share.y);
                if (weight > 1e-9)
                    sum += weight * double(sample(low + glm::dvec2(i, j)));
            }
        return static_cast<float>(sum);
    }

    std::string path_;
    MapRequest request_;
    std::string option_;
    MapFile file_;
    GDALRasterBandH band_ = nullptr;
    std::vector<double> classes_; // rising
    double scale_ = 1.0;
    double offset_ = 0.0;
    double metres_ = 1.0; // of a unit
    glm::uvec2 size_{0U};
    Placement placement_;
    bool hasPlace_ = false;
    MapSystem own_;
    MapGrid grid_;          // of the whole file
    MapBounds covered_;     // of the file, in the grid's system
    bool isDirect_ = false; // the grid's samples are the file's
    std::optional<MapChange> toTarget_;
    std::optional<MapChange> toOwn_;
    double turn_ = 0.0; // turnOf() the file's system
    // Of a grid that is resampled: its middle, and its least and greatest whole steps from there.
    glm::dvec2 centre_{0.0};
    glm::dvec2 low_{0.0};
    glm::dvec2 high_{0.0};
};

} // namespace

MapGrid readMapByGdal(const std::string& path, const MapRequest& request, const std::string& option,
                      Diagnostics& diagnostics)
{
    return Raster(path, request, option, diagnostics).wanted();
}

std::unique_ptr<MapRaster> openMapByGdal(const std::string& path, const MapRequest& request,
                                         const std::string& option, Diagnostics& diagnostics)
{
    return std::make_unique<Raster>(path, request, option, diagnostics);
}

} // namespace sward::terrain
