#include "bake/paint/stroke_move.h"

#include "bake/paint/stroke_contact.h"
#include "terrain/query/surface_query.h"
#include "terrain/topology/triangle_geometry.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>

namespace sward::bake {
namespace {

constexpr double onGround = 0.002; ///< [m] points are rounded to millimetres
constexpr int maxSurfaces = 64;   ///< that a ray passes because they face another way
constexpr double maxBent = 0.5;   ///< [radii] between the ground and a stroke's line

// The triangles that bear, and their numbers in the ground.
struct Bearing {
    explicit Bearing(const terrain::GroundMesh& ground)
    {
        for (std::uint32_t i = 0; i < ground.triangles.size(); ++i)
            if (ground.bears[i] != 0) {
                triangles.push_back(ground.triangles[i]);
                numbers.push_back(i);
            }
    }

    std::vector<glm::uvec3> triangles;
    std::vector<std::uint32_t> numbers;
};

class Mover {
public:
    Mover(const terrain::GroundMesh& ground, Sides sides, double distance)
        : ground_(ground)
        , sides_(sides)
        , distance_(distance)
        , bearing_(ground)
        , query_(ground.positions, bearing_.triangles)
    {
    }

    // Where a place is moved to; nothing if it stays.
    std::optional<glm::dvec3> target(const StrokePlace& place) const
    {
        if (query_.nearest(place.position, onGround).triangle != terrain::SurfaceQuery::none)
            return std::nullopt;
        std::optional<double> along;
        if (place.normal != glm::dvec3(0.0))
            for (const double way : {-1.0, 1.0})
                if (const auto far = alongNormal(place, way * place.normal))
                    if (!along || *far < std::fabs(*along))
                        along = way * *far;
        if (along)
            return place.position + *along * place.normal;
        const terrain::SurfaceQuery::Nearest near = query_.nearest(place.position, distance_);
        if (near.triangle == terrain::SurfaceQuery::none || !isFaced(place, near.triangle))
            return std::nullopt;
        return near.point;
    }

private:
    // Distance to the first surface on this way that faces the place's.
    std::optional<double> alongNormal(const StrokePlace& place, const glm::dvec3& way) const
    {
        double passed = 0.0;
        for (int i = 0; i < maxSurfaces; ++i) {
            const terrain::SurfaceQuery::Hit hit =
                query_.cast(place.position, way, distance_, passed);
            if (!hit.isHit())
                break;
            if (isFaced(place, hit.triangle))
                return hit.distance;
            passed = hit.distance;
        }
        return std::nullopt;
    }

    bool isFaced(const StrokePlace& place, std::uint32_t triangle) const
    {
        const std::uint32_t number = bearing_.numbers[triangle];
        const glm::uvec3& c = ground_.triangles[number];
        const std::array<glm::dvec3, 4> normals{
            ground_.faceNormal(number), glm::dvec3(ground_.normals[c.x]),
            glm::dvec3(ground_.normals[c.y]), glm::dvec3(ground_.normals[c.z])};
        return std::any_of(normals.begin(), normals.end(), [&](const glm::dvec3& normal) {
            return (sides_ != Sides::back && isFacedBy(place, normal)) ||
                   (sides_ != Sides::front && isFacedBy(place, -normal));
        });
    }

    const terrain::GroundMesh& ground_;
    Sides sides_;
    double distance_;
    Bearing bearing_;
    terrain::SurfaceQuery query_;
};

std::array<std::int64_t, 3> roundedPoint(const glm::dvec3& place, const glm::dvec3& origin)
{
    std::array<std::int64_t, 3> point{};
    for (glm::length_t axis = 0; axis < 3; ++axis)
        point[std::size_t(axis)] =
            std::llround(origin[axis] * 1000.0) + std::llround(place[axis] * 1000.0);
    return point;
}

std::array<std::int16_t, 3> roundedNormal(const glm::dvec3& normal)
{
    std::array<std::int16_t, 3> rounded{};
    for (glm::length_t axis = 0; axis < 3; ++axis)
        rounded[std::size_t(axis)] = static_cast<std::int16_t>(std::llround(normal[axis] * 1000.0));
    return rounded;
}

// A place of a stroke before and after.
struct Moved {
    StrokePlace place;
    glm::dvec3 now;
    bool isLost; // it touched no ground
    bool isMoved;

    bool hasGround() const { return isMoved || !isLost; }
};

// The places of a stroke that contactsOf() has looked at, where they are now. Those between two
// points are moved where one of these is, or where one of them is lost.
std::vector<Moved> movedPlaces(const Stroke& stroke, const StrokeContact& contact,
                               const glm::dvec3& origin, const Mover& mover)
{
    std::vector<Moved> places;
    for (const StrokePlace& place : placesOf(stroke, origin)) {
        if (!place.isPoint && contact.places == contact.points)
            continue;
        const bool isLost = !contact.lostPlaces.empty() && contact.lostPlaces[places.size()];
        places.push_back({place, place.position, isLost, false});
    }
    const auto move = [&](Moved& one) {
        if (const auto to = mover.target(one.place)) {
            one.now = *to;
            one.isMoved = true;
        }
    };
    for (Moved& one : places)
        if (one.place.isPoint)
            move(one);
    for (std::size_t from = 0, to = 1; to < places.size(); ++to) {
        if (!places[to].place.isPoint)
            continue;
        bool isLookedAt = places[from].isMoved || places[to].isMoved;
        for (std::size_t i = from + 1; i < to; ++i)
            isLookedAt = isLookedAt || places[i].isLost;
        for (std::size_t i = from + 1; i < to && isLookedAt; ++i)
            move(places[i]);
        from = to;
    }
    return places;
}

// Whether the ground between two points leaves their line, where they or it have moved.
bool isBent(const std::vector<Moved>& places, std::size_t from, std::size_t to, double tolerance)
{
    const auto isMoved = [](const Moved& one) { return one.isMoved; };
    const auto first = places.begin() + static_cast<std::ptrdiff_t>(from);
    const auto last = places.begin() + static_cast<std::ptrdiff_t>(to) + 1;
    if (std::none_of(first, last, isMoved))
        return false;
    return std::any_of(first + 1, last - 1, [&](const Moved& one) {
        const glm::dvec3 on =
            terrain::nearestPoint({first->now, (last - 1)->now, (last - 1)->now}, one.now);
        return one.hasGround() && glm::distance(on, one.now) > tolerance;
    });
}

Stroke movedStroke(const Stroke& stroke, const std::vector<Moved>& places, const glm::dvec3& origin)
{
    Stroke next = stroke;
    next.points.clear();
    std::vector<std::array<std::int16_t, 3>> normals;
    std::size_t point = 0;
    for (std::size_t i = 0; i < places.size();) {
        next.points.push_back(places[i].isMoved ? roundedPoint(places[i].now, origin)
                                                : stroke.points[point]);
        if (!stroke.normals.empty())
            normals.push_back(stroke.normals[stroke.normals.size() == 1 ? 0 : point]);
        ++point;
        std::size_t end = i + 1;
        while (end < places.size() && !places[end].place.isPoint)
            ++end;
        if (end < places.size() && isBent(places, i, end, maxBent * stroke.radius))
            for (std::size_t k = i + 1; k < end; ++k)
                if (places[k].hasGround()) {
                    next.points.push_back(roundedPoint(places[k].now, origin));
                    normals.push_back(roundedNormal(places[k].place.normal));
                }
        i = end;
    }
    if (stroke.normals.size() > 1)
        next.normals = std::move(normals);
    return next;
}

} // namespace

MovedStrokes moveOnto(const terrain::GroundMesh& ground, Sides sides,
                      std::span<const Stroke> strokes, double distance)
{
    const Mover mover(ground, sides, distance);
    const std::vector<StrokeContact> contacts = contactsOf(ground, sides, strokes);
    MovedStrokes result;
    for (std::size_t s = 0; s < strokes.size(); ++s) {
        const std::vector<Moved> places =
            movedPlaces(strokes[s], contacts[s], ground.origin, mover);
        for (const Moved& one : places)
            if (one.isMoved && one.place.isPoint) {
                ++result.points;
                result.farthest =
                    std::max(result.farthest, glm::distance(one.place.position, one.now));
            }
        result.list.push_back(movedStroke(strokes[s], places, ground.origin));
        if (result.list.back() != strokes[s])
            result.moved.push_back(s);
    }
    return result;
}

} // namespace sward::bake
