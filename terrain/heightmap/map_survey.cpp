#include "core/error.h"
#include "terrain/blocks.h"
#include "terrain/heightmap/map_parts.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <span>
#include <utility>

namespace sward::terrain {
namespace {

constexpr std::uint32_t rowsAtOnce = 64; // cells, at least

// What a row of cells, or of samples, tells.
struct SurveyedRow {
    std::uint64_t triangles = 0;
    std::uint64_t missing = 0;
    double area = 0.0;
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    std::uint32_t west = std::numeric_limits<std::uint32_t>::max(); // point of the ground's box
    std::uint32_t east = 0;
};

class MapSurveyor {
public:
    MapSurveyor(MapHeights& heights, std::size_t limit, std::size_t overviewPoints)
        : heights_(heights)
        , grid_(heights.grid())
        , points_(grid_.cells + 1U)
        , step_(grid_.extent / glm::dvec2(grid_.cells))
    {
        survey_.grid = grid_;
        survey_.system = heights.system();
        const auto count = double(points_.x) * double(points_.y);
        if (grid_.points() > limit)
            survey_.stride = static_cast<std::uint32_t>(
                std::ceil(std::sqrt(count / double(std::max<std::size_t>(overviewPoints, 4)))));
        const std::uint32_t stride = survey_.stride;
        coarse_ = (grid_.cells + stride - 1U) / stride + 1U;
        if (stride > 1) {
            overview_.resize(std::size_t(coarse_.x) * coarse_.y);
            excess_.resize(2 * std::size_t(coarse_.x - 1) * (coarse_.y - 1), 0.0f);
        }
        blocks_ = (grid_.cells.x + MapSurvey::block - 1) / MapSurvey::block;
        checked_ = (points_ + MapSurvey::block - 1U) / MapSurvey::block;
        survey_.checks.resize(std::size_t(checked_.x) * checked_.y);
        survey_.trianglesOfBlock.resize(blocks_ * grid_.cells.y);
    }

    MapSurvey run()
    {
        const std::uint32_t stride = survey_.stride;
        const std::uint32_t band = stride * ((rowsAtOnce + stride - 1) / stride);
        XXH3_state_t* const all = XXH3_createState();
        XXH3_64bits_reset(all);
        for (std::uint32_t first = 0; first < grid_.cells.y; first += band) {
            const std::uint32_t cells = std::min(band, grid_.cells.y - first);
            // The last row of one band is the first one of the next.
            const std::uint32_t known = first > 0 ? 1 : 0;
            std::vector<double> rows(held_.end() - (known > 0 ? std::ptrdiff_t(points_.x) : 0),
                                     held_.end());
            const std::vector<double> next =
                heights_.read({0, first + known}, {points_.x, cells + 1 - known});
            rows.insert(rows.end(), next.begin(), next.end());
            held_ = std::move(rows);
            XXH3_64bits_update(all, next.data(), next.size() * sizeof(double));
            addBand(first, cells, known);
        }
        survey_.heightsHash = XXH3_64bits_digest(all);
        XXH3_freeState(all);
        finish();
        return std::move(survey_);
    }

private:
    double at(std::uint32_t i, std::uint32_t row) const
    {
        return held_[std::size_t(row) * points_.x + i];
    }

    // Rows of cells from `first` on, whose heights are held.
    void addBand(std::uint32_t first, std::uint32_t cells, std::uint32_t known)
    {
        std::vector<SurveyedRow> rows(cells + 1);
        forEachBlock(cells + 1, 1, [&](std::size_t row, std::size_t) {
            if (row >= known)
                countMissing(static_cast<std::uint32_t>(row), rows[row]);
            if (row < cells)
                addCells(first, static_cast<std::uint32_t>(row), rows[row]);
        });
        addChecks(first, cells, known);
        for (std::uint32_t row = 0; row <= cells; ++row) {
            survey_.missing += rows[row].missing;
            if (row == cells)
                break;
            survey_.firstOfRow.push_back(survey_.triangles);
            survey_.triangles += rows[row].triangles;
            survey_.area += rows[row].area;
            low_ = std::min(low_, rows[row].low);
            high_ = std::max(high_, rows[row].high);
            west_ = std::min(west_, rows[row].west);
            east_ = std::max(east_, rows[row].east);
            if (rows[row].triangles > 0) {
                north_ = std::min(north_, first + row);
                south_ = std::max(south_, first + row + 1);
            }
        }
        if (survey_.stride > 1)
            addOverview(first, cells);
    }

    void countMissing(std::uint32_t row, SurveyedRow& result) const
    {
        for (std::uint32_t i = 0; i < points_.x; ++i)
            result.missing += std::uint64_t(std::isnan(at(i, row)));
    }

    void addCells(std::uint32_t first, std::uint32_t row, SurveyedRow& result)
    {
        const double flat = step_.x * step_.y;
        for (std::uint32_t i = 0; i < grid_.cells.x; ++i) {
            const std::array<double, 4> z{at(i, row), at(i, row + 1), at(i + 1, row),
                                          at(i + 1, row + 1)};
            std::uint32_t triangles = 0;
            // As heightfield(): north-west, south-west, north-east; then these two and the fourth.
            const auto take = [&](double a, double b, double c, double alongX, double alongZ) {
                if (std::isnan(a) || std::isnan(b) || std::isnan(c))
                    return;
                ++triangles;
                const double x = alongX / step_.x, y = alongZ / step_.y;
                result.area += 0.5 * flat * std::sqrt(1.0 + x * x + y * y);
                result.low = std::min({result.low, a, b, c});
                result.high = std::max({result.high, a, b, c});
            };
            take(z[0], z[1], z[2], z[2] - z[0], z[1] - z[0]);
            take(z[2], z[1], z[3], z[3] - z[1], z[3] - z[2]);
            if (triangles == 0)
                continue;
            result.triangles += triangles;
            // Either triangle has corners on all four sides of the cell.
            result.west = std::min(result.west, i);
            result.east = std::max(result.east, i + 1);
            std::uint8_t& ofBlock =
                survey_.trianglesOfBlock[std::size_t(first + row) * blocks_ + i / MapSurvey::block];
            ofBlock = static_cast<std::uint8_t>(ofBlock + triangles);
        }
    }

    void addChecks(std::uint32_t first, std::uint32_t cells, std::uint32_t known)
    {
        for (std::uint32_t row = known; row <= cells; ++row) {
            const std::uint32_t y = (first + row) / MapSurvey::block;
            for (std::uint32_t x = 0; x < checked_.x; ++x) {
                std::uint64_t& check = survey_.checks[std::size_t(y) * checked_.x + x];
                const std::uint32_t begin = x * MapSurvey::block,
                                    count = std::min(MapSurvey::block, points_.x - begin);
                check = XXH3_64bits_withSeed(&held_[std::size_t(row) * points_.x + begin],
                                             count * sizeof(double), check);
            }
        }
    }

    // Point of the grid of a column or row of the overview.
    std::uint32_t fine(std::uint32_t i, std::uint32_t cells) const
    {
        return std::min(i * survey_.stride, cells);
    }

    // A sample of the overview, or one near it in its row.
    double coarseHeight(std::uint32_t i, std::uint32_t row) const
    {
        const std::uint32_t column = fine(i, grid_.cells.x);
        for (std::uint32_t away = 0; away <= survey_.stride / 2; ++away) {
            if (column >= away && !std::isnan(at(column - away, row)))
                return at(column - away, row);
            if (column + away < points_.x && !std::isnan(at(column + away, row)))
                return at(column + away, row);
        }
        return std::numeric_limits<double>::quiet_NaN();
    }

    // Rows of the overview in a band, and how far it lies above the samples.
    void addOverview(std::uint32_t first, std::uint32_t cells)
    {
        const std::uint32_t stride = survey_.stride;
        const std::uint32_t begin = first / stride;
        const std::uint32_t end = (first + cells + stride - 1) / stride;
        for (std::uint32_t j = begin; j <= end; ++j)
            for (std::uint32_t i = 0; i < coarse_.x; ++i)
                overview_[std::size_t(j) * coarse_.x + i] =
                    coarseHeight(i, fine(j, grid_.cells.y) - first);
        forEachBlock(end - begin, 1, [&](std::size_t k, std::size_t) {
            const auto j = begin + static_cast<std::uint32_t>(k);
            for (std::uint32_t i = 0; i + 1 < coarse_.x; ++i)
                compare(i, j, first);
        });
    }

    // Excess of both triangles of a cell of the overview over the samples in it.
    void compare(std::uint32_t i, std::uint32_t j, std::uint32_t first)
    {
        const double* const above = &overview_[std::size_t(j) * coarse_.x + i];
        const std::array<double, 4> z{above[0], above[coarse_.x], above[1], above[coarse_.x + 1]};
        const std::uint32_t west = fine(i, grid_.cells.x), east = fine(i + 1, grid_.cells.x),
                            north = fine(j, grid_.cells.y), south = fine(j + 1, grid_.cells.y);
        float* const excess = &excess_[2 * (std::size_t(j) * (coarse_.x - 1) + i)];
        for (std::uint32_t y = north; y <= south; ++y)
            for (std::uint32_t x = west; x <= east; ++x) {
                const double own = at(x, y - first);
                const double u = double(x - west) / double(east - west),
                             v = double(y - north) / double(south - north);
                const bool isUpper = u + v <= 1.0;
                const double plane =
                    isUpper ? z[0] + u * (z[2] - z[0]) + v * (z[1] - z[0])
                            : z[3] + (1.0 - u) * (z[1] - z[3]) + (1.0 - v) * (z[2] - z[3]);
                // NaN is no excess.
                if (plane - own > double(excess[isUpper ? 0 : 1]))
                    excess[isUpper ? 0 : 1] =
                        std::nextafter(float(plane - own), std::numeric_limits<float>::max());
            }
    }

    void lowerOverview()
    {
        std::vector<float> lower(overview_.size(), 0.0f);
        const std::size_t columns = coarse_.x;
        for (std::size_t j = 0; j + 1 < coarse_.y; ++j)
            for (std::size_t i = 0; i + 1 < columns; ++i) {
                const float* const excess = &excess_[2 * (j * (columns - 1) + i)];
                const std::size_t at = j * columns + i;
                for (const std::size_t corner : {at, at + columns, at + 1})
                    lower[corner] = std::max(lower[corner], excess[0]);
                for (const std::size_t corner : {at + 1, at + columns, at + columns + 1})
                    lower[corner] = std::max(lower[corner], excess[1]);
            }
        for (std::size_t i = 0; i < lower.size(); ++i)
            if (!std::isnan(overview_[i])) {
                overview_[i] -= double(lower[i]);
                survey_.lowered = std::max(survey_.lowered, double(lower[i]));
            }
    }

    void finish()
    {
        if (survey_.triangles == 0)
            fail(ErrorKind::input, "{}: no ground: each of its {} x {} cells is a hole",
                 heights_.path(), grid_.cells.x, grid_.cells.y);
        if (survey_.triangles == std::uint64_t(2) * grid_.cells.x * grid_.cells.y)
            std::vector<std::uint8_t>().swap(survey_.trianglesOfBlock);
        const glm::dvec2 cells(grid_.cells);
        survey_.low = {grid_.middle.x + heightLineAt(west_, cells.x, grid_.extent.x), low_,
                       grid_.middle.y + heightLineAt(north_, cells.y, grid_.extent.y)};
        survey_.high = {grid_.middle.x + heightLineAt(east_, cells.x, grid_.extent.x), high_,
                        grid_.middle.y + heightLineAt(south_, cells.y, grid_.extent.y)};
        DAabb bounds;
        bounds.add(survey_.low);
        bounds.add(survey_.high);
        survey_.origin = originFor(bounds);
        if (survey_.stride == 1)
            return;
        lowerOverview();
        HeightPart part;
        part.points = coarse_;
        part.stride = survey_.stride;
        part.cells = coarse_ - 1U;
        part.origin = survey_.origin;
        survey_.overview = heightfield(grid_, part, overview_, heights_.path());
        GroundMesh& mesh = survey_.overview;
        if (mesh.triangles.empty())
            fail(ErrorKind::input, "{}: one sample of {} along each side has no ground",
                 heights_.path(), survey_.stride);
        mesh.nodes[0] = std::filesystem::path(heights_.path()).stem().string();
        mesh.mapSystem = heights_.system();
        mesh.overview = survey_.stride;
        mesh.attributes.addGeneratedGaps(heights_.settings().masks, mesh.triangles.size(),
                                         heights_.path());
    }

    MapHeights& heights_;
    const HeightGrid& grid_;
    glm::uvec2 points_;
    glm::dvec2 step_;
    MapSurvey survey_;
    std::size_t blocks_ = 0;       // of a row of cells
    glm::uvec2 checked_{0U};       // blocks of samples
    glm::uvec2 coarse_{0U};        // points of the overview
    std::vector<double> overview_; // heights
    std::vector<float> excess_;    // [m] of each triangle of the overview
    std::vector<double> held_;     // rows of samples
    double low_ = std::numeric_limits<double>::infinity();
    double high_ = -std::numeric_limits<double>::infinity();
    std::uint32_t west_ = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t east_ = 0;
    std::uint32_t north_ = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t south_ = 0;
};

} // namespace

MapSurvey surveyMap(MapHeights& heights, std::size_t limit, std::size_t overviewPoints)
{
    return MapSurveyor(heights, limit, overviewPoints).run();
}

} // namespace sward::terrain
