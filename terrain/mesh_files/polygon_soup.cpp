#include "terrain/mesh_files/polygon_soup.h"

#include "core/error.h"
#include "terrain/unit_colors.h"

#include <cmath>
#include <map>
#include <tuple>

namespace sward::terrain {
namespace {

// Formats of polygons count v from the lower edge of an image. Invalid numbers become 0.
glm::vec2 imageUv(const glm::vec2& uv)
{
    return {std::isfinite(uv.x) ? uv.x : 0.0f, std::isfinite(uv.y) ? 1.0f - uv.y : 0.0f};
}

} // namespace

void PolygonSoup::addFace(std::span<const std::uint32_t> corners, std::span<const glm::vec2> uvs)
{
    const std::size_t face = faces_++;
    if (corners.size() < 3) {
        if (shortFaces_++ == 0)
            firstShort_ = face;
        return;
    }
    const std::size_t firstTriangle = soup_.triangles.size();
    places_.clear();
    for (const std::uint32_t corner : corners)
        places_.push_back(soup_.positions[corner]);
    bool crosses = false;
    parts_ = triangulate(places_, crosses);
    const bool isLong = crosses && corners.size() > earLimit;
    if (isLong && longFaces_++ == 0)
        firstLong_ = face;
    if (crosses && !isLong && crossedFaces_++ == 0)
        firstCrossed_ = face;
    for (const PolygonTriangle& part : parts_) {
        soup_.triangles.emplace_back(corners[part[0]], corners[part[1]], corners[part[2]]);
        faceOf_.push_back(static_cast<std::uint32_t>(face));
    }
    if (uvs.size() != corners.size())
        return;
    cornerUvs_.resize(3 * soup_.triangles.size(), glm::vec2(0.0f));
    isFaceMapped_.resize(firstTriangle, false);
    isFaceMapped_.resize(soup_.triangles.size(), true);
    for (std::size_t i = 0; i < parts_.size(); ++i)
        for (std::size_t corner = 0; corner < 3; ++corner)
            cornerUvs_[3 * (firstTriangle + i) + corner] = imageUv(uvs[parts_[i][corner]]);
}

void PolygonSoup::finishFaces(Diagnostics& diagnostics) const
{
    if (faces_ == 0)
        fail(ErrorKind::input, "{}: no faces", place_);
    if (soup_.triangles.empty())
        fail(ErrorKind::input, "{}: none of its {} faces has three corners", place_, faces_);
    if (crossedFaces_ > 0)
        diagnostics.warn("{}: the edges of {} polygons cross, of face {} first; where they bear "
                         "grass is undefined",
                         place_, crossedFaces_, firstCrossed_);
    if (longFaces_ > 0)
        diagnostics.warn("{}: {} polygons that are no fans have more than {} corners, face {} "
                         "first; they are divided as fans, and where they bear grass is undefined",
                         place_, longFaces_, earLimit, firstLong_);
    if (shortFaces_ > 0)
        diagnostics.warn("{}: {} of {} faces have fewer than three corners, face {} first (from "
                         "0); they are left out",
                         place_, shortFaces_, faces_, firstShort_);
}

void PolygonSoup::setNormal(std::size_t vertex, const glm::vec3& normal)
{
    soup_.normals.resize(soup_.positions.size(), glm::vec3(0.0f));
    normalsDisagree_.resize(soup_.positions.size(), false);
    // Normals are per corner; different normals at one vertex mean an edge.
    glm::vec3& own = soup_.normals[vertex];
    if (own != glm::vec3(0.0f) && own != normal)
        normalsDisagree_[vertex] = true;
    own = normal;
}

void PolygonSoup::setColor(std::size_t vertex, const glm::vec4& color)
{
    soup_.colors.resize(soup_.positions.size(), glm::vec4(1.0f));
    isColored_.resize(soup_.positions.size(), false);
    for (glm::length_t c = 0; c < 4; ++c)
        soup_.colors[vertex][c] = std::isfinite(color[c]) ? color[c] : 0.0f;
    isColored_[vertex] = true;
    soup_.hasColors = true;
}

void PolygonSoup::setUv(std::size_t vertex, const glm::vec2& uv)
{
    soup_.uvs.resize(soup_.positions.size(), glm::vec2(0.0f));
    isMapped_.resize(soup_.positions.size(), false);
    soup_.uvs[vertex] = imageUv(uv);
    isMapped_[vertex] = true;
}

// Brings colours into [0, 1]. Vertices without one stay white.
void PolygonSoup::finishColors(Diagnostics& diagnostics)
{
    if (!soup_.hasColors)
        return;
    isColored_.resize(soup_.colors.size(), false);
    for (std::size_t v = 0; v < soup_.colors.size(); ++v)
        if (!isColored_[v])
            soup_.colors[v] = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
    bringToUnit(soup_.colors, place_, "the colour of its vertices", diagnostics);
    for (std::size_t v = 0; v < soup_.colors.size(); ++v)
        if (!isColored_[v])
            soup_.colors[v] = glm::vec4(1.0f);
}

void PolygonSoup::noteGaps(const MaskInputs& read, const PartName& partOf)
{
    isColored_.resize(soup_.positions.size(), false);
    isMapped_.resize(soup_.positions.size(), false);
    isFaceMapped_.resize(soup_.triangles.size(), false);
    const auto holds = [&](const std::vector<bool>& has, std::size_t triangle) {
        const glm::uvec3 t = soup_.triangles[triangle];
        return has[t.x] && has[t.y] && has[t.z];
    };
    for (const std::string& name : read.attributes)
        for (std::size_t t = 0; t < soup_.triangles.size(); ++t) {
            const bool isThere = name == "COLOR_0" ? holds(isColored_, t)
                                 : name == "TEXCOORD_0" || name == materialCoordinates
                                     ? isFaceMapped_[t] || holds(isMapped_, t)
                                     : false;
            if (!isThere)
                soup_.attributes.addGap(name, t, t + 1, partOf ? partOf(faceOf_[t]) : place_);
        }
}

Soup PolygonSoup::take(const MaskInputs& read, Diagnostics& diagnostics, const PartName& partOf)
{
    finishColors(diagnostics);
    noteGaps(read, partOf);
    const std::size_t vertices = soup_.positions.size();
    soup_.normals.resize(vertices, glm::vec3(0.0f));
    for (std::size_t i = 0; i < normalsDisagree_.size(); ++i)
        if (normalsDisagree_[i])
            soup_.normals[i] = glm::vec3(0.0f); // topology computes it and finds edges
    soup_.uvs.resize(vertices, glm::vec2(0.0f));
    soup_.colors.resize(vertices, glm::vec4(1.0f));
    if (cornerUvs_.empty())
        return std::move(soup_);

    // Split a vertex whose triangles have different texture coordinates.
    cornerUvs_.resize(3 * soup_.triangles.size(), glm::vec2(0.0f));
    std::vector<bool> taken(vertices, false);
    std::map<std::tuple<std::uint32_t, float, float>, std::uint32_t> copies;
    for (std::size_t i = 0; i < cornerUvs_.size(); ++i) {
        std::uint32_t& corner = soup_.triangles[i / 3][int(i % 3)];
        const glm::vec2 uv = cornerUvs_[i];
        if (!taken[corner]) {
            taken[corner] = true;
            soup_.uvs[corner] = uv;
        }
        if (soup_.uvs[corner] == uv)
            continue;
        const auto next = static_cast<std::uint32_t>(soup_.positions.size());
        const auto [copy, isNew] = copies.try_emplace({corner, uv.x, uv.y}, next);
        if (isNew) {
            soup_.positions.push_back(glm::dvec3(soup_.positions[corner]));
            soup_.normals.push_back(glm::vec3(soup_.normals[corner]));
            soup_.colors.push_back(glm::vec4(soup_.colors[corner]));
            soup_.uvs.push_back(uv);
        }
        corner = copy->second;
    }
    return std::move(soup_);
}

} // namespace sward::terrain
