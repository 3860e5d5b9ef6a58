// A host's matrix tells the convention of its depth.

#include "render/host/host_view.h"

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <utility>

namespace sward::render {
namespace {

constexpr double near = 0.1;
constexpr double far = 500.0;

/// A perspective of either hand from 0.1 m to 500 m, or without end. The depth of a place at a
/// distance d is near / d of the endless reversed one.
glm::dmat4 perspective(bool isReversed, bool isEndless, bool isLeftHanded)
{
    glm::dmat4 clip = isLeftHanded ? glm::perspectiveLH_ZO(0.9, 1.6, near, far)
                                   : glm::perspectiveRH_ZO(0.9, 1.6, near, far);
    const double away = isLeftHanded ? 1.0 : -1.0;
    if (isEndless) {
        clip[2][2] = away;
        clip[3][2] = -near;
    }
    if (isReversed)
        for (glm::length_t column = 0; column < 4; ++column)
            clip[column][2] = clip[column][3] - clip[column][2];
    return clip;
}

TEST(HostViewConvention, IsSeenInEveryPerspective)
{
    const std::array eyes{glm::dvec3(0.0), glm::dvec3(3.0, 2.0, 5.0),
                          glm::dvec3(-40'000.0, 120.0, 9'000.0)};
    for (const glm::dvec3 eye : eyes)
        for (int kind = 0; kind < 32; ++kind) {
            const bool isReversed = (kind & 1) != 0;
            const bool isLeftHanded = (kind & 4) != 0;
            glm::dmat4 clip = perspective(isReversed, (kind & 2) != 0, isLeftHanded);
            if ((kind & 8) != 0) // y downwards
                clip = glm::scale(glm::dmat4(1.0), {1.0, -1.0, 1.0}) * clip;
            if ((kind & 16) != 0) { // a jitter, and a near plane that leans, as of a mirror
                clip[2][0] += 0.01;
                clip[0][2] += 0.3 * clip[2][2];
                clip[1][2] -= 0.2 * clip[2][2];
            }
            const glm::dvec3 target = eye + glm::dvec3(1.0, -0.3, 0.4);
            const glm::dmat4 look = isLeftHanded ? glm::lookAtLH(eye, target, {0.0, 1.0, 0.0})
                                                 : glm::lookAtRH(eye, target, {0.0, 1.0, 0.0});
            EXPECT_EQ(isReversedZ(clip * look), std::optional(isReversed)) << kind;
            // As a host that multiplies in single precision hands it over: right, or not told.
            const glm::dmat4 rounded(glm::mat4(clip) * glm::mat4(look));
            EXPECT_NE(isReversedZ(rounded), std::optional(!isReversed)) << kind;
            if (eye.x == 0.0) {
                EXPECT_EQ(isReversedZ(rounded), std::optional(isReversed)) << kind;
            }
        }
}

TEST(HostViewConvention, IsUntoldByParallelRays)
{
    const glm::dmat4 clip = glm::orthoRH_ZO(-5.0, 5.0, -5.0, 5.0, 0.1, 100.0);
    EXPECT_EQ(isReversedZ(clip), std::nullopt);
    EXPECT_EQ(isReversedZ(glm::dmat4(1.0)), std::nullopt);
}

} // namespace
} // namespace sward::render
