#include "render/host/host_view.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace sward::render {
namespace {

/// Eye distance of a parallel projection, in sizes of its content: distances then differ by less
/// than a thousandth, within single precision.
constexpr double parallelDistance = 1000.0;

/// A projection is parallel if its fourth row is below this share of its first row.
constexpr double parallelShare = 1e-9;

glm::dvec4 rowOf(const glm::dmat4& matrix, glm::length_t row)
{
    return {matrix[0][row], matrix[1][row], matrix[2][row], matrix[3][row]};
}

glm::vec4 normalisedPlane(const glm::dvec4& plane)
{
    // A plane at infinity culls nothing.
    const double size = glm::length(glm::dvec3(plane));
    return size > 0.0 ? glm::vec4(plane / size) : glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
}

/// The centre of a projection: the place where x, y and w are 0.
glm::dvec3 centreOf(const glm::dvec4& x, const glm::dvec4& y, const glm::dvec4& w)
{
    const glm::dmat3 rows = glm::transpose(glm::dmat3(glm::dvec3(x), glm::dvec3(y), glm::dvec3(w)));
    return glm::inverse(rows) * -glm::dvec3(x.w, y.w, w.w);
}

} // namespace

glm::dvec3 eyeOf(const glm::dmat4& toClip)
{
    return centreOf(rowOf(toClip, 0), rowOf(toClip, 1), rowOf(toClip, 3));
}

bool isParallel(const glm::dmat4& toClip)
{
    return glm::length(glm::dvec3(rowOf(toClip, 3))) <=
           parallelShare * glm::length(glm::dvec3(rowOf(toClip, 0)));
}

// The rows of the matrix are X, Y, Z and W; z(p) = Z · (p, 1), and w(p) likewise. At the eye E x, y
// and w are 0. Along a ray E + t d that is seen, w = t (W · d) with W · d > 0, and depth is
//   z / w = (Z · d) / (W · d) + z(E) / (t (W · d)),
// which falls with t exactly if z(E) > 0, whatever X and Y are and wherever the planes lie: they
// only move the first term. z(E) is not 0, since the matrix has an inverse.
std::optional<bool> isReversedZ(const glm::dmat4& toClip)
{
    if (isParallel(toClip))
        return std::nullopt;
    const glm::dvec3 eye = eyeOf(toClip);
    const glm::dvec4 z = rowOf(toClip, 2);
    const glm::dvec4 terms = z * glm::dvec4(eye, 1.0);
    const double atEye = terms.x + terms.y + terms.z + terms.w;
    const glm::dvec4 sizes = glm::abs(terms);
    constexpr double rounding = 1e-6; // of single precision, in which hosts multiply matrices
    if (!(std::abs(atEye) > rounding * (sizes.x + sizes.y + sizes.z + sizes.w)))
        return std::nullopt;
    return atEye > 0.0;
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
        view.eye = glm::vec3(centreOf(x, y, w));
        view.pixelsPerUnit = static_cast<float>(halfHeight * glm::length(glm::dvec3(y)) /
                                                glm::length(glm::dvec3(w)));
        return view;
    }

    // Towards the near side, in the direction of increasing reversed depth.
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
