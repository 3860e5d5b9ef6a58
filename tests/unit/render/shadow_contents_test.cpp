// What of the shadow map is drawn anew when colliders move. Counts, not time.

#include "core/random.h"
#include "render/preview/shadow_contents.h"
#include "render/preview/sun_shadow.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace sward::render {
namespace {

const Aabb ground{{-50.0f, 0.0f, -50.0f}, {50.0f, 3.0f, 50.0f}};
const glm::vec3 sun = glm::normalize(glm::vec3(0.5f, 1.0f, 0.3f));
const shared::SunShadow view = sunShadowOf(ground, sun, sunShadowSize);

shared::Collider colliderBall(glm::vec3 place, float radius = 0.5f)
{
    shared::Collider result = {};
    result.from = result.to = place;
    result.radius = radius;
    return result;
}

bool holds(const VkRect2D& rect, glm::vec2 pixel)
{
    const glm::vec2 first(rect.offset.x, rect.offset.y);
    const glm::vec2 end = first + glm::vec2(rect.extent.width, rect.extent.height);
    return glm::all(glm::greaterThanEqual(pixel, first)) && glm::all(glm::lessThan(pixel, end));
}

std::uint64_t pixelsOf(const ShadowChanges& changes)
{
    std::uint64_t sum = 0;
    for (const VkRect2D& part : changes.parts)
        sum += std::uint64_t(part.extent.width) * part.extent.height;
    return sum;
}

TEST(ShadowContents, DrawsTheGroundOnceForEachPlaceOfTheSun)
{
    ShadowContents contents;
    EXPECT_TRUE(contents.follow(view, sun, {}).ground);
    EXPECT_TRUE(contents.follow(view, sun, {}).isNone());
    EXPECT_TRUE(contents.follow(view, -sun, {}).ground);
    EXPECT_TRUE(contents.follow(view, -sun, {}).isNone());
}

TEST(ShadowContents, DrawsARestingColliderOnce)
{
    ShadowContents contents;
    shared::Collider one = colliderBall({0.0f, 0.5f, 0.0f});
    const ShadowChanges first = contents.follow(view, sun, {&one, 1});
    EXPECT_TRUE(first.ground);
    EXPECT_EQ(first.colliders.size(), 1u);
    // A velocity without a change of place, as in the frame in which it comes to rest.
    one.velocity = {1.0f, 0.0f, 0.0f};
    for (int frame = 0; frame < 3; ++frame)
        EXPECT_TRUE(contents.follow(view, sun, {&one, 1}).isNone());
    // It takes its shadow with it.
    const ShadowChanges last = contents.follow(view, sun, {});
    EXPECT_FALSE(last.ground);
    EXPECT_TRUE(last.colliders.empty());
    EXPECT_EQ(pixelsOf(last), pixelsOf(first));
}

TEST(ShadowContents, DrawsNoColliderWhoseShadowFallsBesideTheGround)
{
    ShadowContents contents;
    contents.follow(view, sun, {});
    for (const glm::vec3 place :
         {glm::vec3(0.0f, 500.0f, 0.0f), glm::vec3(200.0f, 0.0f, 0.0f), -300.0f * sun})
        for (float way = 0.0f; way < 3.0f; way += 1.0f) {
            const shared::Collider moving = colliderBall(place + glm::vec3(way, 0.0f, 0.0f));
            EXPECT_TRUE(contents.follow(view, sun, {&moving, 1}).isNone()) << place.x << ' ' << way;
        }
    // From 500 m along the sun's ray it shades the middle.
    const shared::Collider above = colliderBall(500.0f * sun);
    EXPECT_EQ(contents.follow(view, sun, {&above, 1}).colliders.size(), 1u);
}

TEST(ShadowContents, DrawsAroundWhatMovesAndNothingElse)
{
    ShadowContents contents;
    // The second touches the first, the third is far away.
    std::vector<shared::Collider> three{colliderBall({0.0f, 0.5f, 0.0f}),
                                        colliderBall({0.4f, 0.5f, 0.0f}),
                                        colliderBall({30.0f, 0.5f, 30.0f})};
    contents.follow(view, sun, three);
    three[0].from.x = three[0].to.x = -0.2f;
    const ShadowChanges changes = contents.follow(view, sun, three);
    EXPECT_FALSE(changes.ground);
    EXPECT_EQ(changes.colliders, (std::vector<std::uint32_t>{0, 1}));
    const auto whole = std::uint64_t(sunShadowSize) * sunShadowSize;
    EXPECT_LT(pixelsOf(changes), whole / 500);
    three[2].from.x = three[2].to.x = 30.1f;
    EXPECT_EQ(contents.follow(view, sun, three).colliders, (std::vector<std::uint32_t>{2}));
}

TEST(ShadowContents, PartsHoldTheWholeShadowAndDoNotOverlap)
{
    ShadowContents contents;
    contents.follow(view, sun, {});
    std::vector<shared::Collider> many;
    const auto dice = [](std::uint64_t i, std::uint32_t dimension) {
        return static_cast<float>(uniform(41, i, dimension));
    };
    for (std::uint64_t i = 0; i < 64; ++i) {
        many.push_back(colliderBall(
            100.0f * glm::vec3(dice(i, 0) - 0.5f, 0.1f * dice(i, 1), dice(i, 2) - 0.5f),
            0.1f + 4.0f * dice(i, 3)));
        many.back().to += 5.0f * glm::vec3(dice(i, 4), dice(i, 5), dice(i, 6));
    }
    const ShadowChanges changes = contents.follow(view, sun, many);
    for (std::size_t i = 0; i < changes.parts.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) {
            const VkRect2D& a = changes.parts[i];
            const VkRect2D& b = changes.parts[k];
            EXPECT_FALSE(holds(a, {b.offset.x, b.offset.y}) || holds(b, {a.offset.x, a.offset.y}));
        }
    for (std::uint64_t i = 0; i < 10000; ++i) {
        const shared::Collider& one = many[i % many.size()];
        const glm::vec3 out = glm::normalize(glm::vec3(dice(i, 7), dice(i, 8), dice(i, 9)) - 0.5f);
        const glm::vec4 place(glm::mix(one.from, one.to, dice(i, 10)) + one.radius * out, 1.0f);
        const glm::vec2 pixel(glm::dot(view.across, place), glm::dot(view.down, place));
        const bool isOnMap = glm::all(glm::greaterThanEqual(pixel, glm::vec2(0.0f))) &&
                             glm::all(glm::lessThan(pixel, glm::vec2(sunShadowSize)));
        EXPECT_TRUE(!isOnMap || std::ranges::any_of(changes.parts, [&](const VkRect2D& part) {
            return holds(part, pixel);
        })) << i;
    }
}

} // namespace
} // namespace sward::render
