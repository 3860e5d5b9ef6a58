#include "bake/bake.h"
#include "bake/patches/patch_tree.h"
#include "bake/patches/split_cells.h"
#include "support/meshes.h"
#include "unit/bake/bake_settings.h"
#include "unit/bake/paint/strokes.h"

#include <gtest/gtest.h>

#include <cstring>

namespace sward::bake {
namespace {

template <typename T>
bool holdSame(const T& a, const T& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

// Cells that are split from a field are those that were joined.
TEST(SplitCells, AreJoinedToTheSameField)
{
    terrain::GroundMesh far = meshes::hills(150.0, 30);
    far.origin = {64'000.0, -32.0, 96.0};
    const std::vector<terrain::GroundMesh> grounds{meshes::square(9.0), meshes::cube(90.0),
                                                   meshes::sphere(24, 40.0), far};
    for (const terrain::GroundMesh& ground : grounds) {
        BakeSettings settings = tests::plainSettings(1.5);
        settings.meadow.species[0].tuftSpacing = 4.0; // tufts cross the borders of cells
        settings.meadow.species[0].tuftRadius = 1.0;
        const field::Field field = tests::paintedField(ground, settings).field;
        std::vector<CellTree> cells = splitCells(field::viewOf(field));
        for (std::size_t i = 1; i < cells.size(); ++i)
            EXPECT_LT(cells[i - 1].cell, cells[i].cell);
        for (const CellTree& cell : cells) {
            EXPECT_EQ(cell.patches[0].parent, shared::noPatch);
            EXPECT_EQ(cell.patches[0].level, 0U);
        }
        field::Field joined;
        joinCells(std::move(cells), joined);
        EXPECT_TRUE(holdSame(joined.patches, field.patches));
        EXPECT_TRUE(holdSame(joined.blades, field.blades));
        EXPECT_TRUE(holdSame(joined.keys, field.keys));
    }
    EXPECT_TRUE(splitCells(field::FieldView{}).empty());
}

} // namespace
} // namespace sward::bake
