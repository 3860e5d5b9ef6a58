#include "presentation/viewpoint.h"

#include "core/bounds.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <unordered_set>
#include <utility>
#include <vector>

namespace sward::presentation {
namespace {

constexpr std::size_t standpoints = 48;      ///< places that are tried
constexpr std::size_t grassSamples = 20'000; ///< blades that say where grass grows
constexpr double grassCells = 48.0;          ///< along the longest side of the field
constexpr double steepest = 0.5;             ///< cosine of ground to stand on
constexpr double endless = std::numeric_limits<double>::infinity();

/// Directions around a place that are looked into first, and their angles of elevation [degrees].
constexpr std::size_t around = 16;
constexpr std::array<double, 4> tilts{5.0, -6.0, -16.0, -32.0};

/// Views that are compared in detail.
constexpr std::size_t finalists = 6;
constexpr int columns = 9;

/// Elevations of their rays [degrees]: rows from highest down to lowest.
constexpr double highestRow = 20.0;
constexpr double rowStep = 2.5;
constexpr int rows = 32;

/// Share of the picture that ground should take.
constexpr double wantedGround = 0.62;

/// Where blades stand, by cells of a grid.
class GrassCells {
public:
    explicit GrassCells(const field::FieldView& field)
        : origin_(field.origin)
    {
        const glm::vec3 size = field.bounds().size();
        const double longest = double(std::max({size.x, size.y, size.z}));
        cell_ = std::max(longest / grassCells, 1e-9);
        const std::size_t stride = std::max<std::size_t>(field.blades.size() / grassSamples, 1);
        for (const shared::Patch& patch : field.patches) {
            const std::size_t end = std::size_t(patch.firstBlade) + patch.bladeCount;
            for (std::size_t i = (patch.firstBlade + stride - 1) / stride * stride; i < end;
                 i += stride)
                cells_.insert(keyOf(glm::dvec3(shared::unpackBlade(field.blades[i], patch).root)));
        }
    }

    bool growsAt(const glm::dvec3& place) const { return cells_.count(keyOf(place - origin_)) > 0; }

private:
    std::uint64_t keyOf(const glm::dvec3& place) const
    {
        constexpr std::int64_t middle = 1 << 20; // 21 bits per axis
        std::uint64_t key = 0;
        for (glm::length_t i = 0; i < 3; ++i) {
            const auto cell = static_cast<std::int64_t>(std::floor(place[i] / cell_)) + middle;
            key = (key << 21u) | (static_cast<std::uint64_t>(cell) & 0x1fffffu);
        }
        return key;
    }

    glm::dvec3 origin_;
    double cell_;
    std::unordered_set<std::uint64_t> cells_;
};

struct Standpoint {
    glm::dvec3 eye{0.0};
    bool isCovered = false; ///< there is ground above
};

/// A direction from a standpoint, and what it promises.
struct Prospect {
    Standpoint from;
    double azimuth = 0.0; ///< [radians] in the plane across the up-vector
    double score = 0.0;
};

/// The search, with what all its steps need.
class ViewpointSearch {
public:
    ViewpointSearch(const field::FieldView& field, const GroundSurface& ground,
                    const ViewpointSettings& settings)
        : field_(field)
        , ground_(ground)
        , settings_(settings)
        , grass_(field)
    {
        const glm::dvec3 axis =
            std::abs(settings.up.x) < 0.9 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
        east_ = glm::normalize(glm::cross(settings.up, axis));
        north_ = glm::cross(east_, settings.up);
    }

    std::optional<Viewpoint> best() const
    {
        std::vector<Prospect> prospects = allProspects();
        if (prospects.empty())
            return std::nullopt;
        // Under cover only where there is nothing else. Equals keep their order.
        std::stable_sort(prospects.begin(), prospects.end(),
                         [](const Prospect& a, const Prospect& b) {
                             if (a.from.isCovered != b.from.isCovered)
                                 return b.from.isCovered;
                             return a.score > b.score;
                         });
        Viewpoint best;
        double bestScore = -endless;
        for (std::size_t i = 0; i < std::min(finalists, prospects.size()); ++i) {
            const auto [score, tilt] = framed(prospects[i]);
            if (prospects[i].from.isCovered != prospects[0].from.isCovered || !(score > bestScore))
                continue;
            bestScore = score;
            best = {prospects[i].from.eye, direction(prospects[i].azimuth, tilt)};
        }
        return bestScore > -endless ? std::optional(best) : std::nullopt;
    }

private:
    /// Unit direction at an azimuth [radians] and an elevation [degrees].
    glm::dvec3 direction(double azimuth, double tilt) const
    {
        const double elevation = glm::radians(tilt);
        return std::cos(elevation) * (std::cos(azimuth) * north_ + std::sin(azimuth) * east_) +
               std::sin(elevation) * settings_.up;
    }

    /// Distance to the ground [eye heights].
    double reach(const glm::dvec3& eye, const glm::dvec3& ray) const
    {
        const std::optional<GroundSurface::Hit> hit = ground_.hit(eye, ray);
        return hit ? hit->distance / settings_.height : endless;
    }

    /// The eye above `place` (relative to the origin), if one can stand there.
    std::optional<Standpoint> standOn(const glm::dvec3& place) const
    {
        const glm::dvec3 up = settings_.up;
        const double height = settings_.height;
        const auto below = ground_.hit(field_.origin + place + 0.5 * height * up, -up);
        if (!below || below->distance > 2.0 * height ||
            std::abs(glm::dot(below->normal, up)) < steepest)
            return std::nullopt;
        Standpoint result{below->place + height * up};
        // Ground above that is seen from its back is the skin of what the eye is inside of.
        const auto above = ground_.hit(below->place + 0.01 * height * up, up);
        if (above) {
            const double room = above->distance / height - 1.0;
            if (room < 0.25 || glm::dot(above->normal, up) > 0.0)
                return std::nullopt;
            result.isCovered = true;
        }
        return result;
    }

    std::vector<Standpoint> allStandpoints() const
    {
        std::vector<Standpoint> all;
        const auto tryAt = [&](const glm::vec3& place) {
            if (const auto standpoint = standOn(glm::dvec3(place)))
                all.push_back(*standpoint);
        };
        const std::size_t blades = field_.blades.size();
        const std::size_t stride = std::max<std::size_t>(blades / standpoints, 1);
        for (const shared::Patch& patch : field_.patches) {
            const std::size_t end = std::size_t(patch.firstBlade) + patch.bladeCount;
            for (std::size_t i = (patch.firstBlade + stride - 1) / stride * stride; i < end;
                 i += stride) {
                const shared::Blade blade = shared::unpackBlade(field_.blades[i], patch);
                if (glm::dot(glm::dvec3(blade.up), settings_.up) > 0.0)
                    tryAt(blade.root);
            }
        }
        const auto& corners = field_.ground->vertices;
        const std::size_t step = std::max<std::size_t>(corners.size() / standpoints, 1);
        for (std::size_t i = step / 2; all.empty() && i < corners.size(); i += step)
            tryAt(corners[i].position);
        return all;
    }

    static double azimuthOf(std::size_t i)
    {
        return glm::radians(360.0) * static_cast<double>(i) / static_cast<double>(around);
    }

    /// How much one direction of a fan promises.
    static double promiseOf(const std::array<double, tilts.size()>& distances)
    {
        double sum = 0.0;
        // A wall ahead, at eye level or above. Far slopes are a background.
        if (distances[0] < 8.0)
            sum -= 2.0;
        else if (distances[0] < endless)
            sum += 0.3;
        if (distances[1] < 4.0)
            sum -= 1.0;
        else if (distances[1] < endless)
            sum += 1.0;
        if (distances[2] < 1.8)
            sum -= 1.0;
        else if (distances[2] < endless)
            sum += 1.0;
        if (distances[3] < endless)
            sum += 0.5;
        // Mixed distances.
        double nearest = endless;
        double farthest = 0.0;
        for (const double distance : distances)
            if (distance < endless) {
                nearest = std::min(nearest, distance);
                farthest = std::max(farthest, distance);
            }
        if (farthest > 0.0)
            sum += 0.25 * std::min(std::log2(farthest / std::max(nearest, 0.1)), 6.0);
        return sum;
    }

    /// Best with the sun beside or behind; into the sun, grass is dark.
    double lightOf(double azimuth) const
    {
        const double towards = glm::dot(direction(azimuth, 0.0), settings_.sun);
        return -2.5 * std::max(towards, 0.0) - 0.5 * std::max(-towards - 0.6, 0.0);
    }

    std::vector<Prospect> allProspects() const
    {
        std::vector<Prospect> prospects;
        for (const Standpoint& from : allStandpoints()) {
            std::array<double, around> promises{};
            for (std::size_t i = 0; i < around; ++i) {
                std::array<double, tilts.size()> distances{};
                for (std::size_t k = 0; k < tilts.size(); ++k)
                    distances[k] = reach(from.eye, direction(azimuthOf(i), tilts[k]));
                promises[i] = promiseOf(distances);
            }
            // The best direction: a picture is about three of them wide.
            Prospect best{from, 0.0, -endless};
            for (std::size_t i = 0; i < around; ++i) {
                const double score = promises[(i + around - 1) % around] + 1.5 * promises[i] +
                                     promises[(i + 1) % around] + lightOf(azimuthOf(i));
                if (score > best.score)
                    best = {from, azimuthOf(i), score};
            }
            prospects.push_back(best);
        }
        return prospects;
    }

    /// A ray's end.
    struct Seen {
        double distance = endless; ///< [eye heights]
        bool isGrass = false;
        bool isLit = false; ///< faces the sun
    };
    using Grid = std::vector<Seen>; ///< rows × columns

    /// What the picture at a tilt shows, as a number.
    double scoreOf(const Grid& grid, double tilt) const
    {
        const double half = glm::degrees(std::atan(settings_.tanY));
        int all = 0;
        int ground = 0;
        int grass = 0;
        int lit = 0;
        int walls = 0;
        std::array<int, 5> bands{};
        for (int row = 0; row < rows; ++row) {
            const double elevation = highestRow - rowStep * row;
            if (std::abs(elevation - tilt) > half)
                continue;
            for (int column = 0; column < columns; ++column) {
                const Seen& seen = grid[static_cast<std::size_t>(row * columns + column)];
                ++all;
                if (seen.distance == endless)
                    continue;
                ++ground;
                grass += seen.isGrass ? 1 : 0;
                lit += seen.isLit ? 1 : 0;
                walls += elevation > -5.0 && seen.distance < 6.0 ? 1 : 0;
                const double band = std::log2(std::max(seen.distance, 2.0)) - 1.0; // from 2 heights
                ++bands[std::min<std::size_t>(static_cast<std::size_t>(band), 4)];
            }
        }
        if (ground == 0)
            return -endless;
        const double whole = all;
        const double share = ground / whole;
        double mixture = 0.0;
        for (const int band : bands)
            mixture += band > 0.05 * whole ? 0.15 : 0.0;
        return 1.5 * std::min(share / wantedGround, 1.0) -
               1.2 * std::max(share - wantedGround, 0.0) + (0.6 * grass + 0.6 * lit) / whole +
               mixture - 2.0 * walls / whole - 0.01 * std::abs(tilt + 8.0);
    }

    /// Score and tilt [degrees] of the best picture of a prospect.
    std::pair<double, double> framed(const Prospect& prospect) const
    {
        Grid grid;
        for (int row = 0; row < rows; ++row)
            for (int column = 0; column < columns; ++column) {
                const double across =
                    settings_.tanX * (2.0 * (column + 0.5) / double(columns) - 1.0);
                const glm::dvec3 ray =
                    direction(prospect.azimuth + std::atan(across), highestRow - rowStep * row);
                Seen seen;
                if (const auto hit = ground_.hit(prospect.from.eye, ray))
                    seen = {hit->distance / settings_.height, grass_.growsAt(hit->place),
                            glm::dot(hit->normal, settings_.sun) * glm::dot(hit->normal, ray) <
                                0.0};
                grid.push_back(seen);
            }
        double best = -endless;
        double tilt = 0.0;
        for (double t = -4.0; t >= -40.0; t -= 2.0)
            if (const double score = scoreOf(grid, t); score > best) {
                best = score;
                tilt = t;
            }
        return {best + 0.3 * lightOf(prospect.azimuth), tilt};
    }

    const field::FieldView& field_;
    const GroundSurface& ground_;
    const ViewpointSettings& settings_;
    GrassCells grass_;
    glm::dvec3 east_, north_;
};

} // namespace

std::optional<Viewpoint> findViewpoint(const field::FieldView& field, const GroundSurface& ground,
                                       const ViewpointSettings& settings)
{
    if (ground.isEmpty())
        return std::nullopt;
    return ViewpointSearch(field, ground, settings).best();
}

} // namespace sward::presentation
