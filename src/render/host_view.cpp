#include "render/host_view.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>

namespace sward::render {
namespace {

/// A parallel projection is looked at from so many sizes of its content away: distances to it are
/// the same within a thousandth, and single precision has digits left.
constexpr double parallelDistance = 1000.0;

/// Below this share of the picture's axes a projection's fourth row does not depend on the place.
constexpr double parallelShare = 1e-9;

glm::dvec4 rowOf(const glm::dmat4& matrix, glm::length_t row)
{
    return {matrix[0][row], matrix[1][row], matrix[2][row], matrix[3][row]};
}

glm::vec4 normalisedPlane(const glm::dvec4& plane)
{
    // A plane at infinity leaves nothing out.
    const double size = glm::length(glm::dvec3(plane));
    return size > 0.0 ? glm::vec4(plane / size) : glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
}

/// The place of which a projection sees all others: where x, y and w vanish.
glm::dvec3 eyeOf(const glm::dvec4& x, const glm::dvec4& y, const glm::dvec4& w)
{
    const glm::dmat3 rows = glm::transpose(glm::dmat3(glm::dvec3(x), glm::dvec3(y), glm::dvec3(w)));
    return glm::inverse(rows) * -glm::dvec3(x.w, y.w, w.w);
}

} // namespace

bool isParallel(const glm::dmat4& toClip)
{
    return glm::length(glm::dvec3(rowOf(toClip, 3))) <=
           parallelShare * glm::length(glm::dvec3(rowOf(toClip, 0)));
}

ViewMatrices viewMatricesOf(const glm::dmat4& fieldToClip, bool hasReversedZ, glm::uvec2 size,
                            const Aabb& content)
{
    const glm::dvec4 x = rowOf(fieldToClip, 0);
    const glm::dvec4 y = rowOf(fieldToClip, 1);
    const glm::dvec4 w = rowOf(fieldToClip, 3);
    const glm::dvec4 given = rowOf(fieldToClip, 2);
    const glm::dvec4 z = hasReversedZ ? given : w - given;

    ViewMatrices view;
    for (glm::length_t column = 0; column < 4; ++column)
        view.viewProjection[column] =
            glm::vec4(glm::dvec4(x[column], y[column], z[column], w[column]));
    view.planes = {normalisedPlane(w + x), normalisedPlane(w - x), normalisedPlane(w - y),
                   normalisedPlane(w + y), normalisedPlane(w - z), normalisedPlane(z)};
    const double halfHeight = 0.5 * static_cast<double>(size.y);
    if (!isParallel(fieldToClip)) {
        view.eye = glm::vec3(eyeOf(x, y, w));
        view.pixelsPerUnit = static_cast<float>(halfHeight * glm::length(glm::dvec3(y)) /
                                                glm::length(glm::dvec3(w)));
        return view;
    }

    // Towards the near side, where reversed depth grows.
    glm::dvec3 towards = glm::normalize(glm::cross(glm::dvec3(x), glm::dvec3(y)));
    if (glm::dot(towards, glm::dvec3(z)) < 0.0)
        towards = -towards;
    const glm::dvec3 middle = content.isEmpty() ? glm::dvec3(0.0) : glm::dvec3(content.centre());
    const double away =
        parallelDistance *
        std::max(content.isEmpty() ? 1.0 : double(glm::length(content.size())), 1e-3);
    view.eye = glm::vec3(middle + away * towards);
    view.pixelsPerUnit = static_cast<float>(halfHeight * glm::length(glm::dvec3(y)) / w.w * away);
    return view;
}

} // namespace sward::render
