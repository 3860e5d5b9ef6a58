#include "render/field/edited_cover.h"
#include "support/fields/edited_meadow.h"

#include <glm/packing.hpp>
#include <gtest/gtest.h>

namespace sward::render {
namespace {

TEST(EditedCover, IsThatOfTheFieldJoinedAnew)
{
    test::EditedMeadow meadow(200.0f);
    meadow.sow({0, 0, 0}, 2000);
    meadow.sow({1, 0, 1}, 900);
    meadow.changes();
    const field::Field first = meadow.whole();
    field::LeafAreaGrid grid = field::leafAreaOf(field::viewOf(first));
    EditedCover edited(field::viewOf(first), grid, 1.0);
    shared::Cover colors = grid.shape;
    for (std::uint64_t step = 0; step < 6; ++step) {
        meadow.sow({std::int64_t(step % 3) - 1, 0, 0}, 700 * step, 0.7, step);
        meadow.sow({1, 0, 1}, 900, 0.2 * double(step), step);
        const PlaceRange changed = edited.apply(meadow.changes(), colors);
        const field::Field whole = meadow.whole();
        const field::LeafAreaGrid expected = field::leafAreaOf(field::viewOf(whole));
        ASSERT_EQ(expected.values.size(), edited.values().size());
        double sum = 0.0;
        for (std::uint32_t i = 0; i < expected.values.size(); ++i) {
            // Halves.
            const float area = glm::unpackHalf2x16(expected.values[i]).x;
            const glm::vec2 now = glm::unpackHalf2x16(edited.values()[i]);
            ASSERT_NEAR(now.x, area, 1e-4f + 1e-3f * area);
            // Heights are relative to the mean of the field as it was.
            const float height = glm::unpackHalf2x16(expected.values[i]).y;
            ASSERT_NEAR(now.y, height, 1e-4f + 0.02f * height);
            if (i < changed.first || i >= changed.end()) {
                ASSERT_EQ(edited.values()[i], grid.values[i]) << "no change is told of it";
            }
            grid.values[i] = edited.values()[i];
            sum += double(area);
        }
        EXPECT_GT(sum, 0.0);
        shared::Cover wanted = expected.shape;
        field::describeUndergrowth(field::viewOf(whole), wanted);
        EXPECT_NEAR(colors.sward.y, wanted.sward.y, 1e-4f);
        EXPECT_NEAR(colors.undergrowth.x, wanted.undergrowth.x, 1e-4f);
    }
}

} // namespace
} // namespace sward::render
