#include "interchange/compact/compact_instances.h"
#include "interchange/compact/morton_order.h"
#include "support/fields/fields.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <set>

namespace sward::interchange {
namespace {

// Instances of a field of blades in a cube, with up-vectors of every direction and some species.
std::vector<Instance> instances(float extent = 20.0f)
{
    const field::Field field =
        test::makeField({.surface = test::Surface::cloud, .blades = 5000, .extent = extent});
    const field::FieldView view = field::viewOf(field);
    std::vector<Instance> all;
    for (const BladeGroup& group : groupBlades(view, 1000000))
        for (const Instance& instance : instancesOf(view, group, "field")) {
            all.push_back(instance);
            all.back().blade.species = static_cast<std::uint32_t>(all.size() % 3);
        }
    return all;
}

// Decodes a stream of elements of type T by the library.
template <typename T>
std::vector<T> decoded(const CompactInstances& compact, std::size_t stream)
{
    std::vector<T> elements(compact.count);
    const std::vector<std::byte>& bytes = compact.streams[stream];
    EXPECT_EQ(meshopt_decodeVertexBuffer(elements.data(), compact.count, sizeof(T),
                                         reinterpret_cast<const unsigned char*>(bytes.data()),
                                         bytes.size()),
              0);
    return elements;
}

std::vector<glm::vec3> decodedTriples(const CompactInstances& compact, std::size_t stream)
{
    auto elements = decoded<std::array<std::uint32_t, 3>>(compact, stream);
    std::vector<glm::vec3> triples;
    for (const auto& element : elements) {
        glm::vec3 triple;
        for (int axis = 0; axis < 3; ++axis) {
            const std::uint32_t bits = element[static_cast<std::size_t>(axis)];
            triple[axis] = std::ldexp(float(static_cast<std::int32_t>(bits << 8U) >> 8),
                                      static_cast<std::int32_t>(bits) >> 24);
        }
        triples.push_back(triple);
    }
    return triples;
}

TEST(CompactInstances, KeepPlacesWithinHalfAStep)
{
    // The last two are wider than 23 bits of the usual step.
    for (const float extent : {0.5f, 20.0f, 20000.0f, 1e6f}) {
        std::vector<Instance> all = instances(extent);
        sortForCompression(all, std::ldexp(1.0f, compactPlaceExponent));
        const CompactInstances compact = compressInstances(all, false);
        float largest = 0.0f;
        for (const Instance& one : all)
            largest = std::max(
                {largest, std::fabs(one.place.x), std::fabs(one.place.y), std::fabs(one.place.z)});
        const float step = std::ldexp(1.0f, placeExponent(largest));
        EXPECT_EQ(step == std::ldexp(1.0f, compactPlaceExponent), largest < 4096.0f);
        EXPECT_LE(step, std::max(std::ldexp(1.0f, compactPlaceExponent), largest / 4.0e6f));
        const std::vector<glm::vec3> places = decodedTriples(compact, 0);
        for (const SpeciesRange& range : compact.ranges) {
            Aabb bounds;
            for (std::size_t i = range.first; i < range.first + range.count; ++i) {
                for (int axis = 0; axis < 3; ++axis)
                    EXPECT_LE(std::fabs(places[i][axis] - all[i].place[axis]), 0.5f * step);
                bounds.add(places[i]);
            }
            EXPECT_EQ(bounds.low, range.places.low);
            EXPECT_EQ(bounds.high, range.places.high);
        }
    }
}

TEST(CompactInstances, TurnByNoMoreThanStated)
{
    const std::vector<Instance> all = instances();
    const CompactInstances compact = compressInstances(all, false);
    auto rotations = decoded<std::array<std::int16_t, 4>>(compact, 1);
    meshopt_decodeFilterQuat(rotations.data(), rotations.size(), sizeof rotations[0]);
    float largest = 0.0f;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const auto& r = rotations[i];
        const glm::quat found =
            glm::normalize(glm::quat(float(r[3]), float(r[0]), float(r[1]), float(r[2])));
        // Twice the angle between quaternions, exact for small ones.
        const glm::quat real = all[i].rotation;
        const glm::quat difference = glm::dot(found, real) < 0.0f ? found + real : found - real;
        largest = std::max(largest, 4.0f * std::asin(0.5f * glm::length(difference)));
    }
    EXPECT_LE(largest, compactTurn);
    EXPECT_GT(largest, 0.5f * compactTurn) << "the bound says something";
}

TEST(CompactInstances, ScaleByNoMoreThanStated)
{
    std::vector<Instance> all = instances();
    sortForCompression(all, std::ldexp(1.0f, compactPlaceExponent));
    all[0].scale = glm::vec3(1e-9f); // never 0
    const CompactInstances compact = compressInstances(all, false);
    const std::vector<glm::vec3> scales = decodedTriples(compact, 2);
    for (const SpeciesRange& range : compact.ranges)
        for (int axis = 0; axis < 3; ++axis) {
            float largest = 0.0f;
            for (std::size_t i = range.first; i < range.first + range.count; ++i)
                largest = std::max(largest, all[i].scale[axis]);
            for (std::size_t i = range.first; i < range.first + range.count; ++i) {
                EXPECT_GT(scales[i][axis], 0.0f);
                const float allowed = all[i].scale[axis] < 1e-6f ? 2.0f : 1.0f;
                EXPECT_LE(std::fabs(scales[i][axis] - all[i].scale[axis]),
                          1.0001f * allowed * compactScaleError * largest);
            }
        }
}

TEST(CompactInstances, LoseNothingElse)
{
    const std::vector<Instance> all = instances();
    const CompactInstances compact = compressInstances(all, true);
    ASSERT_EQ(compact.streams.size(), compactAttributes(true).size());
    const auto traits = decoded<std::array<std::uint8_t, 4>>(compact, 3);
    const auto tints = decoded<std::array<std::uint8_t, 4>>(compact, 4);
    const auto ids = decoded<std::array<std::uint16_t, 4>>(compact, 5);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const shared::Blade& blade = all[i].blade;
        EXPECT_NEAR(float(traits[i][0]) / stiffnessSteps, blade.stiffness, 1e-6f);
        EXPECT_NEAR(float(traits[i][1]) / exposureSteps, blade.exposure, 1e-6f);
        EXPECT_EQ(traits[i][2], blade.clump);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(float(tints[i][static_cast<std::size_t>(c)]) / tintSteps[c], blade.tint[c],
                        1e-6f);
        std::uint64_t id = 0;
        for (std::size_t word = 0; word < 4; ++word)
            id |= std::uint64_t(ids[i][word]) << (16 * word);
        EXPECT_EQ(id, all[i].id);
    }
}

TEST(MortonOrder, KeepsEveryInstanceAndMakesNeighboursNeighbours)
{
    std::vector<Instance> all = instances();
    const auto idsOf = [&] {
        std::multiset<std::uint64_t> ids;
        for (const Instance& one : all)
            ids.insert(one.id);
        return ids;
    };
    const std::multiset<std::uint64_t> before = idsOf();
    sortForCompression(all, 0.001f);
    EXPECT_EQ(idsOf(), before);
    EXPECT_TRUE(std::ranges::is_sorted(all, {}, [](const Instance& i) { return i.blade.species; }));
    // Blades of a species are 1.7 m apart in the cube of 20 m, and 13 m in any order.
    double length = 0.0;
    for (std::size_t i = 1; i < all.size(); ++i)
        length += double(glm::distance(all[i].place, all[i - 1].place));
    EXPECT_LT(length / double(all.size()), 3.0);
}

TEST(MortonOrder, DoesNotDependOnTheOrderBefore)
{
    std::vector<Instance> one = instances();
    std::vector<Instance> other(one.rbegin(), one.rend());
    sortForCompression(one, 0.001f);
    sortForCompression(other, 0.001f);
    for (std::size_t i = 0; i < one.size(); ++i)
        EXPECT_EQ(one[i].id, other[i].id);
}

} // namespace
} // namespace sward::interchange
