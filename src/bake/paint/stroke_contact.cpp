#include "bake/paint/stroke_contact.h"

#include "bake/paint/box_tree.h"
#include "terrain/topology/triangle_geometry.h"

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace sward::bake {
namespace {

constexpr double maxBetween = 256.0;             ///< places between two points
constexpr std::size_t maxPlaces = 400'000;       ///< of all strokes, points aside: some 60 MB
constexpr std::size_t maxTests = 40'000'000;     ///< of a triangle and a place; some seconds
constexpr std::size_t maxVisits = 1'000'000'000; ///< of places by boxes; some seconds
constexpr std::size_t leftOut = 16;              ///< a tree is made anew without a part of 1/16
constexpr std::size_t firstBlock = 64;           ///< triangles before the tree is made anew …
constexpr std::size_t largestBlock = 1U << 18;   ///< … which grows up to this
constexpr std::size_t maxNamed = 20;             ///< strokes that a message names
constexpr double facingCosine = 0.3;             ///< as Painting has it

using PlacedCorners = std::array<glm::dvec3, 3>;

// A place that has touched nothing yet.
struct Wanted {
    StrokePlace place;
    double radius;
    double depth; // 0: no bound but the radius
    std::size_t stroke;
    std::size_t number;
};

DAabb boxAround(const Wanted& wanted)
{
    return {wanted.place.position - wanted.radius, wanted.place.position + wanted.radius};
}

// Cuts a convex polygon by the half-space dot(x, normal) <= bound.
void cutByPlane(std::vector<glm::dvec3>& polygon, const glm::dvec3& normal, double bound)
{
    std::vector<glm::dvec3> rest;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3& from = polygon[i];
        const glm::dvec3& to = polygon[(i + 1) % polygon.size()];
        const double a = glm::dot(from, normal) - bound;
        const double b = glm::dot(to, normal) - bound;
        if (a <= 0.0)
            rest.push_back(from);
        if ((a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0))
            rest.push_back(from + a / (a - b) * (to - from));
    }
    polygon = std::move(rest);
}

double distanceTo(const glm::dvec3& place, const PlacedCorners& t)
{
    return glm::length(terrain::nearestPoint({t[0], t[1], t[2]}, place) - place);
}

// Whether a triangle is within the radius and depth of a place.
bool isWithin(const Wanted& wanted, const PlacedCorners& triangle)
{
    const glm::dvec3& at = wanted.place.position;
    if (!(distanceTo(at, triangle) < wanted.radius))
        return false;
    const glm::dvec3& normal = wanted.place.normal;
    if (wanted.depth <= 0.0 || wanted.depth >= wanted.radius || normal == glm::dvec3(0.0))
        return true;
    std::vector<glm::dvec3> polygon(triangle.begin(), triangle.end());
    cutByPlane(polygon, normal, glm::dot(at, normal) + wanted.depth);
    cutByPlane(polygon, -normal, wanted.depth - glm::dot(at, normal));
    for (std::size_t i = 2; i < polygon.size(); ++i)
        if (distanceTo(at, {polygon[0], polygon[i - 1], polygon[i]}) < wanted.radius)
            return true;
    return false;
}

// Normals that a triangle has on its front: of its plane and corners.
using FrontNormals = std::array<glm::dvec3, 4>;

FrontNormals normalsOf(const terrain::GroundMesh& ground, std::size_t triangle)
{
    const glm::uvec3& c = ground.triangles[triangle];
    return {ground.faceNormal(triangle), glm::dvec3(ground.normals[c.x]),
            glm::dvec3(ground.normals[c.y]), glm::dvec3(ground.normals[c.z])};
}

// Whether normals, on the sides that bear, are those of a place's surface.
bool doFace(const FrontNormals& normals, Sides sides, const StrokePlace& place)
{
    return std::any_of(normals.begin(), normals.end(), [&](const glm::dvec3& normal) {
        return (sides != Sides::back && isFacedBy(place, normal)) ||
               (sides != Sides::front && isFacedBy(place, -normal));
    });
}

std::vector<Wanted> allWanted(std::span<const Stroke> strokes, const glm::dvec3& origin,
                              std::vector<StrokeContact>& contacts)
{
    std::vector<Wanted> wanted;
    std::size_t between = 0;
    for (std::size_t s = 0; s < strokes.size(); ++s) {
        const std::vector<StrokePlace> places = placesOf(strokes[s], origin);
        StrokeContact& contact = contacts[s];
        contact.points = strokes[s].points.size();
        const std::size_t more = places.size() - contact.points;
        const bool onlyPoints = between + more > maxPlaces;
        between += onlyPoints ? 0 : more;
        for (const StrokePlace& place : places)
            if (place.isPoint || !onlyPoints)
                wanted.push_back({place, strokes[s].radius, strokes[s].depth, s, contact.places++});
        contact.lostPlaces.assign(contact.places, true);
    }
    return wanted;
}

BoxTree treeOf(const std::vector<Wanted>& wanted)
{
    std::vector<DAabb> boxes;
    boxes.reserve(wanted.size());
    for (const Wanted& one : wanted)
        boxes.push_back(boxAround(one));
    return BoxTree(std::move(boxes));
}

std::string partText(const StrokeContact& contact)
{
    if (contact.lostPoints > 0)
        return fmt::format("{} of {} points", contact.lostPoints, contact.points);
    return fmt::format("{:.0f} % of its length",
                       100.0 * double(contact.lost()) / double(contact.places));
}

} // namespace

std::size_t StrokeContact::lost() const
{
    return static_cast<std::size_t>(std::count(lostPlaces.begin(), lostPlaces.end(), true));
}

bool StrokeContact::isWorthTelling() const
{
    return double(lostPoints) > toldLoss * double(points) ||
           double(lost()) > toldLoss * double(places);
}

std::vector<StrokePlace> placesOf(const Stroke& stroke, const glm::dvec3& origin)
{
    const auto at = [&](std::size_t i) {
        glm::dvec3 place;
        for (glm::length_t axis = 0; axis < 3; ++axis)
            place[axis] =
                double(stroke.points[i][std::size_t(axis)] - std::llround(origin[axis] * 1000.0)) /
                1000.0;
        return place;
    };
    const auto normalAt = [&](std::size_t i) {
        if (stroke.normals.empty())
            return glm::dvec3(0.0);
        const auto& n = stroke.normals[stroke.normals.size() == 1 ? 0 : i];
        return glm::normalize(glm::dvec3(double(n[0]), double(n[1]), double(n[2])));
    };
    std::vector<StrokePlace> places;
    for (std::size_t i = 0; i < stroke.points.size(); ++i) {
        places.push_back({at(i), normalAt(i), true});
        if (i + 1 == stroke.points.size())
            break;
        const StrokePlace from = places.back();
        const glm::dvec3 to = at(i + 1);
        const double pieces = std::clamp(
            std::ceil(glm::distance(from.position, to) / stroke.radius), 1.0, maxBetween + 1.0);
        for (double piece = 1.0; piece < pieces; piece += 1.0) {
            StrokePlace between{glm::mix(from.position, to, piece / pieces), glm::dvec3(0.0),
                                false};
            const glm::dvec3 mixed = glm::mix(from.normal, normalAt(i + 1), piece / pieces);
            if (glm::dot(mixed, mixed) > 0.0)
                between.normal = glm::normalize(mixed);
            places.push_back(between);
        }
    }
    return places;
}

bool isFacedBy(const StrokePlace& place, const glm::dvec3& normal)
{
    return place.normal == glm::dvec3(0.0) || glm::dot(place.normal, normal) > facingCosine;
}

std::vector<StrokeContact> contactsOf(const terrain::GroundMesh& ground, Sides sides,
                                      std::span<const Stroke> strokes,
                                      std::optional<std::span<const std::uint32_t>> among)
{
    std::vector<StrokeContact> contacts(strokes.size());
    std::vector<Wanted> wanted = allWanted(strokes, ground.origin, contacts);
    BoxTree tree = treeOf(wanted);
    std::vector<bool> touches(wanted.size(), false);
    std::size_t touching = 0;
    std::size_t tests = 0;
    std::size_t visits = 0;
    const auto isTouched = [&](const Wanted& one) {
        return !contacts[one.stroke].lostPlaces[one.number];
    };
    const std::size_t count = among ? among->size() : ground.triangles.size();
    std::size_t block = firstBlock;
    for (std::size_t i = 0;
         i < count && touching < wanted.size() && tests < maxTests && visits < maxVisits; ++i) {
        const std::size_t triangle = among ? (*among)[i] : i;
        if (ground.bears[triangle] == 0)
            continue;
        const glm::uvec3& c = ground.triangles[triangle];
        const PlacedCorners corners{glm::dvec3(ground.positions[c.x]),
                                    glm::dvec3(ground.positions[c.y]),
                                    glm::dvec3(ground.positions[c.z])};
        DAabb box;
        for (const glm::dvec3& corner : corners)
            box.add(corner);
        std::optional<FrontNormals> normals;
        tree.visit(box, [&](std::size_t index) {
            const Wanted& one = wanted[index];
            ++visits;
            if (touches[index])
                return;
            ++tests;
            if (!normals)
                normals = normalsOf(ground, triangle);
            if (!doFace(*normals, sides, one.place) || !isWithin(one, corners))
                return;
            touches[index] = true;
            contacts[one.stroke].lostPlaces[one.number] = false;
            ++touching;
        });
        // Leave out what has touched, where that is much: neighbours are near in a mesh.
        if (i + 1 >= block) {
            block += std::min(std::max(block, firstBlock), largestBlock);
            if (leftOut * touching > wanted.size()) {
                std::erase_if(wanted, isTouched);
                tree = treeOf(wanted);
                touches.assign(wanted.size(), false);
                touching = 0;
            }
        }
    }
    const bool isUnknown = tests >= maxTests || visits >= maxVisits;
    for (std::size_t s = 0; s < strokes.size(); ++s) {
        StrokeContact& contact = contacts[s];
        if (isUnknown || contact.lost() == 0) {
            contact.lostPlaces.clear();
            continue;
        }
        std::size_t place = 0;
        for (const StrokePlace& one : placesOf(strokes[s], ground.origin)) {
            const bool isKept = one.isPoint || contact.places > contact.points;
            if (isKept && contact.lostPlaces[place++] && one.isPoint)
                ++contact.lostPoints;
        }
    }
    return contacts;
}

std::string nameOf(const Stroke& stroke, std::size_t index)
{
    return stroke.name.empty() ? fmt::format("strokes[{}]", index)
                               : fmt::format("strokes[{}] \"{}\"", index, stroke.name);
}

void warnOfContacts(std::span<const Stroke> strokes, std::span<const StrokeContact> contacts,
                    std::size_t first, const std::string& place, const std::string& advice,
                    Diagnostics& diagnostics)
{
    std::string lost;
    std::string partly;
    std::size_t lostCount = 0;
    std::size_t partlyCount = 0;
    std::size_t points = 0;
    std::size_t lostPoints = 0;
    for (std::size_t i = 0; i < strokes.size(); ++i) {
        points += contacts[i].points;
        lostPoints += contacts[i].lostPoints;
        if (!contacts[i].isWorthTelling())
            continue;
        const bool isLost = contacts[i].isLost();
        std::size_t& count = isLost ? lostCount : partlyCount;
        std::string& names = isLost ? lost : partly;
        if (count++ >= maxNamed)
            continue;
        names += (names.empty() ? "" : ", ") + nameOf(strokes[i], first + i);
        if (!isLost)
            names += " (" + partText(contacts[i]) + ")";
    }
    const auto more = [](std::size_t count) {
        return count > maxNamed ? fmt::format(" and {} more", count - maxNamed) : std::string();
    };
    if (lostCount > 0)
        diagnostics.warn("{}: {} of {} strokes touch no ground and paint nothing: {}{}; {:.3g} % "
                         "of all points are lost. {}",
                         place, lostCount, strokes.size(), lost, more(lostCount),
                         100.0 * double(lostPoints) / double(points), advice);
    if (partlyCount > 0)
        diagnostics.warn("{}: {} of {} strokes touch no ground in a part: {}{}. {}", place,
                         partlyCount, strokes.size(), partly, more(partlyCount), advice);
}

} // namespace sward::bake
