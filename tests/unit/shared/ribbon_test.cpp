// Outlines, and ribbons that are never drawn narrower than the sample spacing.
#include "shaders/shared/ribbon.h"
#include "shaders/shared/update_rate.h"
#include "shaders/shared/visibility.h"
#include "unit/shared/random_vectors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace sward::shared {
namespace {

constexpr float thresholds[] = {0.0f, 0.35f, 0.6f, 0.99f};

double areaOfChords(const Outline& outline)
{
    double sum = 0.0;
    for (float i = 0.0f; i < outline.segments; i += 1.0f) {
        const vec2 a = edgesAt(outline, i / outline.segments);
        const vec2 b = edgesAt(outline, (i + 1.0f) / outline.segments);
        sum += 0.5 * double(a.y - a.x + b.y - b.x) / double(outline.segments);
    }
    return sum;
}

TEST(Outline, HasTheStatedArea)
{
    for (uint shape = 0; shape < shapeCount; ++shape)
        for (const float threshold : thresholds) {
            constexpr int points = 200'000;
            double sum = 0.0;
            for (int i = 0; i < points; ++i) {
                const vec2 edges = outlineAt(shape, threshold, (float(i) + 0.5f) / float(points));
                sum += double(edges.y - edges.x) / points;
            }
            EXPECT_NEAR(sum, double(outlineArea(shape, threshold)), 2e-4) << "shape " << shape;
        }
}

TEST(Outline, KeepsItsAreaHoweverItIsCut)
{
    for (uint shape = 0; shape < shapeCount; ++shape)
        for (const float threshold : thresholds)
            for (float segments = 1.0f; segments <= 64.0f; segments += 1.0f) {
                const Outline outline = outlineOf(shape, threshold, segments);
                const double tolerance = segments <= exactSegments ? 1e-5 : 0.045;
                EXPECT_NEAR(areaOfChords(outline) / double(outlineArea(shape, threshold)), 1.0,
                            tolerance)
                    << "shape " << shape << ", " << segments << " segments";
                // Between its cross-sections an outline is not drawn.
                for (float i = 0.0f; i <= segments; i += 1.0f) {
                    const vec2 edges = edgesAt(outline, i / segments);
                    EXPECT_LE(edges.x, edges.y);
                    EXPECT_LE(std::max(-edges.x, edges.y), 0.5f * outlineMost);
                }
            }
}

TEST(Outline, HasItsFirstMomentInASingleSegment)
{
    for (uint shape = 0; shape < shapeCount; ++shape)
        for (const float threshold : thresholds) {
            const Outline single = outlineOf(shape, threshold, 1.0f);
            constexpr int points = 200'000;
            double excess = 0.0;
            for (int i = 0; i < points; ++i) {
                const float t = (float(i) + 0.5f) / float(points);
                const vec2 wanted = outlineAt(shape, threshold, t);
                const vec2 found = edgesAt(single, t);
                excess += double(t * (found.y - found.x - (wanted.y - wanted.x))) / points;
            }
            EXPECT_NEAR(excess, 0.0, 2e-4) << "shape " << shape << ", threshold " << threshold;
        }
}

/// Assumptions of the rasteriser about an outline: where it is widest from a point on, and whether
/// its middle lies on the curve.
TEST(Outline, TapersAndIsEvenWhereItIsSaidToBe)
{
    for (uint shape = 0; shape < shapeCount; ++shape)
        for (const float threshold : thresholds)
            for (const float segments : {1.0f, 2.0f, 5.0f, 16.0f, 64.0f}) {
                const Outline outline = outlineOf(shape, threshold, segments);
                float widest = 1e9f;
                bool tapers = true;
                bool even = true;
                for (float i = 0.0f; i <= 4.0f * segments; i += 1.0f) {
                    const vec2 edges = edgesAt(outline, i / (4.0f * segments));
                    const float own = std::max(-edges.x, edges.y);
                    tapers = tapers && own <= widest;
                    even = even && edges.x == -edges.y;
                    widest = own;
                }
                EXPECT_TRUE(tapers || !isTapering(shape)) << shape << ", " << segments;
                EXPECT_TRUE(even || !isEven(shape)) << shape << ", " << segments;
            }
}

TEST(Outline, OfTheQuadraticHasOneStraightEdge)
{
    for (float t = 0.0f; t <= 1.0f; t += 0.1f)
        EXPECT_EQ(outlineAt(shapeQuadratic, 0.5f, t).x, -0.5f);
}

Ribbon randomRibbon(tests::Dice& dice, float distance)
{
    Ribbon ribbon = {};
    const vec3 up = dice.direction();
    ribbon.axis = normalize(cross(up, dice.direction()));
    ribbon.v0 = distance * dice.direction();
    ribbon.v1 = ribbon.v0 + 0.6f * up;
    ribbon.v2 = ribbon.v1 + 0.4f * dice.direction();
    ribbon.width = dice.number(0.001f, 0.05f);
    ribbon.outline = outlineOf(uint(dice.number(0, 4.999f)), dice.number(0, 0.9f),
                               std::floor(dice.number(1, 7.99f)));
    return ribbon;
}

TEST(CrossSection, IsNeverNarrowerThanTheLeastAndWeighsWhatItIs)
{
    tests::Dice dice(11);
    const vec3 eye(0.0f);
    int widened = 0;
    for (int i = 0; i < 100'000; ++i) {
        const Ribbon ribbon = randomRibbon(dice, dice.number(1, 60));
        const float least = 0.001f;
        const float t = dice.number(0, 1);
        const CrossSection section = crossSectionAt(ribbon, t, eye, least);
        const vec3 centre = bezierPoint(ribbon.v0, ribbon.v1, ribbon.v2, t);
        const vec3 ray = normalize(centre);
        const float half = 0.5f / ribbon.outline.segments;
        const vec3 chord =
            bezierTangent(ribbon.v0, ribbon.v1, ribbon.v2, std::clamp(t, half, 1.0f - half));
        const vec3 across = normalize(cross(ray, chord));
        const vec2 edges = edgesAt(ribbon.outline, t);

        // As the view sees it: the part of the cross-section that is across the chord through it.
        const float seen = std::abs(dot(section.right - section.left, across));
        ASSERT_GE(seen, 0.999f * least * length(centre)) << "ribbon " << i;
        ASSERT_NEAR(seen, section.drawn, 2e-3f * section.drawn);
        const float true_ = ribbon.width * (edges.y - edges.x) * std::abs(dot(ribbon.axis, across));
        ASSERT_NEAR(section.wide, true_, 1e-3f * true_ + 1e-7f);
        widened += section.drawn > section.wide ? 1 : 0;
        // No point is farther out than culling assumes.
        const float reach =
            0.5f * outlineMost * ribbon.width + sectionMargin(length(centre), least);
        ASSERT_LE(length(section.left - centre), 1.001f * reach);
        ASSERT_LE(length(section.right - centre), 1.001f * reach);
    }
    EXPECT_GT(widened, 10'000);
    EXPECT_LT(widened, 90'000);
}

/// A curve that the rasteriser considers uncut by a plane has no point beyond it, for any outline,
/// fold, view direction and width.
TEST(CrossSection, OfACurveInsideAPlaneLiesInside)
{
    tests::Dice dice(29);
    float nearest = 1e30f; // in times the margin
    for (int run = 0; run < 20'000; ++run) {
        Ribbon ribbon;
        ribbon.v0 = 2.0f * dice.direction();
        ribbon.v1 = ribbon.v0 + 0.5f * dice.direction();
        ribbon.v2 = ribbon.v1 + 0.5f * dice.direction();
        ribbon.axis = normalize(cross(ribbon.v1 - ribbon.v0, dice.direction()));
        ribbon.width = dice.number(0.01f, 0.3f);
        ribbon.fold = run % 2 == 0 ? 0.0f : dice.number(0.0f, 1.0f);
        ribbon.outline = outlineOf(uint(run) % shapeCount, dice.number(0.0f, 1.0f), 8.0f);
        const vec3 eye = 3.0f * dice.direction();
        const float minWidth = run % 3 == 0 ? 0.0f : dice.number(0.0f, 0.02f);
        const float margin = marginBeside(ribbon.width, length(ribbon.v0 - eye) + 1.0f, minWidth);
        // At the smallest allowed distance.
        const vec3 normal = dice.direction();
        const float lowest =
            std::min({dot(normal, ribbon.v0), dot(normal, ribbon.v1), dot(normal, ribbon.v2)});
        const vec4 plane(normal, 1.001f * margin - lowest);
        ASSERT_TRUE(curveInside(plane, ribbon.v0, ribbon.v1, ribbon.v2, margin));
        for (float t = 0.0f; t <= 1.0f; t += 1.0f / 32.0f) {
            const CrossSection section = crossSectionAt(ribbon, t, eye, minWidth);
            for (const vec3& point : {section.left, section.right, section.ridge})
                nearest = std::min(nearest, planeDistance(plane, point) / margin);
        }
        ASSERT_GE(nearest, 0.0f) << "run " << run;
    }
    EXPECT_LT(nearest, 0.3f) << "and some nearly reach it";
}

TEST(CrossSection, StaysAsItIsWithoutALeastWidth)
{
    tests::Dice dice(12);
    for (int i = 0; i < 1000; ++i) {
        const Ribbon ribbon = randomRibbon(dice, 100.0f);
        const float t = dice.number(0, 1);
        const CrossSection section = crossSectionAt(ribbon, t, vec3(0.0f), 0.0f);
        const vec2 edges = edgesAt(ribbon.outline, t);
        EXPECT_EQ(section.wide, section.drawn);
        EXPECT_NEAR(length(section.right - section.left), ribbon.width * (edges.y - edges.x),
                    1e-5f);
    }
}

TEST(KeptSamples, AreTheWeightOnTheAverageAndGrowWithIt)
{
    for (const uint samples : {1u, 4u}) {
        for (const float weight : {0.0f, 0.01f, 0.1f, 0.25f, 0.4f, 0.77f, 0.99f, 1.0f}) {
            double kept = 0.0;
            std::array<double, 4> each{};
            constexpr uint blades = 65'536;
            for (uint seed = 0; seed < blades; ++seed) {
                const uint bits = keptSamples(weight, seed, samples);
                kept += double(std::popcount(bits)) / blades;
                for (uint s = 0; s < samples; ++s)
                    each[s] += double((bits >> s) & 1u) / blades;
                const uint more = keptSamples(std::min(weight + 0.1f, 1.0f), seed, samples);
                ASSERT_EQ(bits & ~more, 0u) << "a heavier blade loses no sample";
            }
            EXPECT_NEAR(kept, double(weight) * samples, 1e-4 * samples);
            for (uint s = 0; s < samples; ++s)
                EXPECT_NEAR(each[s], double(weight), 2e-4) << "sample " << s;
        }
    }
}

TEST(OrientationCulling, LeavesOutOnlyBladesWithoutASample)
{
    tests::Dice dice(13);
    int narrow = 0;
    for (uint i = 0; i < 100'000; ++i) {
        Blade blade = {};
        blade.up = dice.direction();
        blade.facing = dice.number(0, 6.28f);
        blade.height = dice.number(0.05f, 1.5f);
        blade.width = dice.number(0.001f, 0.03f);
        blade.root = dice.number(1.0f, 80.0f) * dice.direction();
        blade.seed = uint(dice.number(0.0f, 65535.9f));
        Eyepoint view = {};
        view.minWidth = dice.number(1e-4f, 2e-3f);
        view.maxEdgeOn = 1.0f;
        view.samples = i % 2 == 0 ? 1u : 4u;
        const vec3 axis = widthAxis(blade.up, blade.facing);
        const vec3 tip =
            poseBlade(blade.up, frontOf(blade.up, axis), blade.up + dice.direction()).v2;
        const PosedBlade posed =
            posedBlade(blade, stateOf(blade.up, frontOf(blade.up, axis), normalize(tip), 0.0f));
        if (!seenTooNarrow(view, posed, 1.0f))
            continue;
        ++narrow;
        Ribbon ribbon = {};
        ribbon.v0 = posed.v0;
        ribbon.v1 = posed.v1;
        ribbon.v2 = posed.v2;
        ribbon.axis = axis;
        ribbon.width = blade.width;
        ribbon.outline = outlineOf(i % shapeCount, 0.4f, float(1 + i % 5));
        for (float t = 0.0f; t <= 1.0f; t += 0.05f) {
            const CrossSection section = crossSectionAt(ribbon, t, view.eye, view.minWidth);
            ASSERT_EQ(keptSamples(section.wide / section.drawn, blade.seed, view.samples), 0u)
                << "blade " << i;
        }
    }
    EXPECT_GT(narrow, 10'000);
}

TEST(UpdateRate, MovesEveryPatchWithinThreeFramesAndTheNearOnesInEach)
{
    UpdateRate updateRate = {};
    updateRate.everyFrame = 10.0f;
    updateRate.everyThird = 20.0f;
    updateRate.longest = 5.0f;
    for (uint patch = 0; patch < 100; ++patch) {
        int moves = 0;
        for (updateRate.frame = 7; updateRate.frame < 10; ++updateRate.frame) {
            EXPECT_TRUE(movesNow(updateRate, patch, 9.9f, 0.01f));
            EXPECT_FALSE(movesNow(updateRate, patch, 20.1f, 0.01f));
            EXPECT_TRUE(movesNow(updateRate, patch, 20.1f, 5.0f));
            moves += movesNow(updateRate, patch, 15.0f, 0.01f) ? 1 : 0;
        }
        EXPECT_EQ(moves, 1);
    }
}

TEST(Segments, KeepChordsWithinAQuarterOfAPixelOfTheCurve)
{
    tests::Dice dice(71);
    float most = 0.0f;
    for (int i = 0; i < 2000; ++i) {
        const vec3 v0(0.0f);
        const vec3 v1 = dice.number(0.2f, 1.0f) * dice.direction();
        const vec3 v2 = v1 + dice.number(0.2f, 1.0f) * dice.direction();
        constexpr int parts = 256;
        float curveLength = 0.0f;
        for (int k = 0; k < parts; ++k)
            curveLength += glm::distance(bezierPoint(v0, v1, v2, float(k) / parts),
                                         bezierPoint(v0, v1, v2, float(k + 1) / parts));
        const float pixels = dice.number(2.0f, 600.0f);
        const float segments = segmentsFor(v0, v1, v2, curveLength, shapeQuad, pixels, 0.5f, 64.0f);
        // In the middle of a chord in its parameter the curve is farthest from it.
        for (float k = 0.0f; k < segments; k += 1.0f) {
            const vec3 chord = 0.5f * (bezierPoint(v0, v1, v2, k / segments) +
                                       bezierPoint(v0, v1, v2, (k + 1.0f) / segments));
            most = std::max(most,
                            glm::distance(chord, bezierPoint(v0, v1, v2, (k + 0.5f) / segments)) *
                                pixels / curveLength);
        }
    }
    EXPECT_LE(most, 0.2501f);
    EXPECT_GT(most, 0.2f);
}

TEST(Segments, OfStepsAreThoseOfTheFirstThatIsFartherAndTheLastOnesBeyond)
{
    LevelSteps steps{};
    steps.distance = vec4(5.0f, 10.0f, 15.0f, 20.0f);
    steps.segments = vec4(16.0f, 12.0f, 8.0f, 4.0f);
    for (steps.count = 1u; steps.count <= 4u; ++steps.count)
        for (float distance = 0.0f; distance < 40.0f; distance += 0.25f) {
            int first = 0;
            while (first + 1 < int(steps.count) && distance >= steps.distance[first])
                ++first;
            EXPECT_EQ(segmentsAt(steps, distance), steps.segments[first])
                << steps.count << " steps, " << distance << " m";
        }
}

} // namespace
} // namespace sward::shared
