// The sower of the viewer as a module of WebAssembly: what grows in a unit, and which units an eye
// wants. All that it computes is in src/field/seeds, src/render/sowing and shaders/shared;
// JavaScript (web/src/sow) brings the numbers.
#include "field/seeds/sow_unit.h"
#include "render/frame/frame.h"
#include "render/sowing/sow_choice.h"

#include <cstdint>
#include <cstdlib>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#define SWARD_EXPORT(name) extern "C" [[clang::export_name(name)]]

namespace sward {
namespace {

using field::SowUnit;

/// A unit, or a cell whose bearing cubes are not known, as JavaScript reads it.
struct WantedUnit {
    float score;
    std::uint32_t isCell;
    std::uint32_t index; ///< of the cell
    std::uint32_t level;
    std::uint32_t half;
    std::uint32_t place[3];
};
static_assert(sizeof(WantedUnit) == 32);

/// A grown unit, as JavaScript reads it.
struct UnitData {
    std::uint32_t patches; ///< address, 104 bytes each
    std::uint32_t patchCount;
    std::uint32_t blades; ///< address, 16 bytes each
    std::uint32_t bladeCount;
    std::uint32_t keys;  ///< address, 8 bytes each
    std::uint32_t whole; ///< address of the patch that bounds all
    float widest;        ///< [m]
};

/// Reads numbers that JavaScript has written, in the order of their use.
class Numbers {
public:
    explicit Numbers(const double* at)
        : at_(at)
    {
    }

    double next() { return *at_++; }
    std::uint32_t word() { return static_cast<std::uint32_t>(*at_++); }
    float single() { return static_cast<float>(*at_++); }

private:
    const double* at_;
};

struct Sowing {
    field::SeedMeadow meadow;
    std::vector<field::Species> species;
    std::vector<field::SeedEntry> entries;
    field::SeedsView seeds;
    std::optional<field::Sower> sower;
    std::optional<render::SowChoice> choice;
    std::map<std::uint32_t, std::unique_ptr<field::UnitCell>> cells;
    std::vector<render::SowChoice::Wanted> wanted;
    std::vector<WantedUnit> shown;
    field::GrownUnit grown;
    UnitData data = {};
};

// One field for each instance of the module.
Sowing& sowing()
{
    static Sowing one;
    return one;
}

SowUnit unitOf(const WantedUnit& wanted)
{
    SowUnit unit;
    unit.cell = sowing().entries[wanted.index].cell;
    unit.level = wanted.level;
    unit.half = wanted.half;
    unit.place = {wanted.place[0], wanted.place[1], wanted.place[2]};
    return unit;
}

std::uint32_t addressOf(const void* place)
{
    return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(place));
}

/// What decides which blades an eye draws.
shared::Eyepoint eyeOf(Numbers from)
{
    shared::Eyepoint eye = {};
    for (glm::length_t axis = 0; axis < 3; ++axis)
        eye.eye[axis] = from.single();
    eye.drawDistance = from.single();
    eye.pixelsPerUnit = from.single();
    eye.lodThreshold = from.single();
    eye.lodWidth = from.single();
    eye.sparseFrom = from.single();
    eye.sparseLeast = from.single();
    eye.cullMask = shared::cullDistance;
    return eye;
}

} // namespace

SWARD_EXPORT("take") void* take(std::size_t bytes)
{
    return ::operator new(bytes);
}

SWARD_EXPORT("give") void give(void* memory)
{
    ::operator delete(memory);
}

/// The meadow and the field's species: see numbersOf() of web/src/sow/module.ts. `entries`: the
/// chunk SEEDCELL.
SWARD_EXPORT("begin")
void begin(const double* numbers, const field::SeedEntry* entries, std::size_t count)
{
    Sowing& own = sowing();
    Numbers from(numbers);
    field::SeedMeadow& meadow = own.meadow;
    const std::uint64_t high = from.word();
    meadow.seed = high << 32U | from.word();
    meadow.density = from.next();
    meadow.scale = from.next();
    meadow.clumpSpacing = from.next();
    meadow.stored = from.next();
    meadow.unitBits = from.word();
    meadow.levels = from.word();
    meadow.isMixed = from.next() != 0.0;
    meadow.heightWaves = from.single();
    meadow.drifts = from.single();
    meadow.sparseHeight = from.single();
    meadow.wideVariation = from.single();
    meadow.creaseReach = from.single();
    meadow.creaseBlend = from.single();
    meadow.vertical = from.single();
    meadow.isRadial = from.next() != 0.0;
    for (glm::length_t axis = 0; axis < 3; ++axis)
        meadow.up[axis] = from.next();
    meadow.highest = from.single();
    meadow.widest = from.single();
    glm::dvec3 origin;
    for (glm::length_t axis = 0; axis < 3; ++axis)
        origin[axis] = from.next();
    const std::uint32_t speciesCount = from.word();
    for (std::uint32_t i = 0; i < speciesCount; ++i) {
        shared::SowSpecies one = {};
        one.share = from.single();
        one.heightLow = from.single();
        one.heightRange = from.single();
        one.widthLow = from.single();
        one.widthRange = from.single();
        one.stiffnessLow = from.single();
        one.stiffnessRange = from.single();
        one.clumping = from.single();
        one.facing = from.word();
        one.ribbons = from.word();
        meadow.species.push_back(one);
        field::Species& species = own.species.emplace_back();
        const std::uint32_t organs = from.word();
        for (std::uint32_t k = 0; k < organs; ++k) {
            field::Organ& organ = species.organs.emplace_back();
            organ.count = from.word();
            organ.length.x = from.single();
            organ.length.y = from.single();
            organ.width = from.single();
            organ.variation = from.single();
        }
    }
    own.entries.assign(entries, entries + count);
    own.seeds = {&meadow, own.entries, {}};
    own.sower.emplace(meadow, own.species, origin);
    own.choice.emplace(own.seeds);
}

/// Opens a cell of which JavaScript has undone zstd. Its bearing cubes are known from now on.
SWARD_EXPORT("openCell")
void openCell(std::uint32_t index, const std::byte* bytes, std::size_t count)
{
    Sowing& own = sowing();
    field::SeedEntry entry = own.entries[index];
    entry.offset = 0;
    entry.bytes = count;
    const field::SeedsView alone{&own.meadow, {&entry, 1}, {bytes, count}};
    auto cell =
        std::make_unique<field::UnitCell>(field::readSeedCell(alone, 0, "seeds"), *own.sower);
    own.choice->know(entry.cell, cell->cubes());
    own.cells[index] = std::move(cell);
}

SWARD_EXPORT("closeCell") void closeCell(std::uint32_t index)
{
    sowing().cells.erase(index);
}

/// Grows a unit of an open cell. The result is valid until the next call.
SWARD_EXPORT("grow") const UnitData* grow(const WantedUnit* unit)
{
    Sowing& own = sowing();
    own.grown = field::growUnit(*own.sower, own.species, *own.cells.at(unit->index), unitOf(*unit));
    own.data.patches = addressOf(own.grown.patches.data());
    own.data.patchCount = static_cast<std::uint32_t>(own.grown.patches.size());
    own.data.blades = addressOf(own.grown.blades.data());
    own.data.bladeCount = own.grown.bladeCount;
    own.data.keys = addressOf(own.grown.keys.data());
    own.data.whole = addressOf(&own.grown.whole);
    own.data.widest = own.grown.widest;
    return &own.data;
}

/// All that eyes want, in falling order of scores: a WantedUnit each. `numbers`: nine of each eye.
SWARD_EXPORT("find")
std::uint32_t find(const double* numbers, std::uint32_t eyes)
{
    Sowing& own = sowing();
    std::vector<shared::Eyepoint> all;
    for (std::uint32_t i = 0; i < eyes; ++i)
        all.push_back(eyeOf(Numbers(numbers + 9 * i)));
    own.choice->find(all, own.wanted);
    own.shown.clear();
    for (const render::SowChoice::Wanted& one : own.wanted) {
        const auto index = static_cast<std::uint32_t>(own.choice->indexOf(one.unit.cell));
        own.shown.push_back({one.score,
                             one.isCell ? 1U : 0U,
                             index,
                             one.unit.level,
                             one.unit.half,
                             {one.unit.place[0], one.unit.place[1], one.unit.place[2]}});
    }
    return static_cast<std::uint32_t>(own.shown.size());
}

/// Address of what find() has found.
SWARD_EXPORT("found") const WantedUnit* found()
{
    return sowing().shown.data();
}

/// Score of any unit for an eye.
SWARD_EXPORT("score") float score(const WantedUnit* unit, const double* numbers, std::uint32_t eyes)
{
    std::vector<shared::Eyepoint> all;
    for (std::uint32_t i = 0; i < eyes; ++i)
        all.push_back(eyeOf(Numbers(numbers + 9 * i)));
    return sowing().choice->scoreOf(unitOf(*unit), all);
}

/// render::sparseDistance() of this field. `room`: blades that may be in memory; `blades`: of the
/// whole meadow.
SWARD_EXPORT("sparseDistance")
float sparseDistance(double room, double bladesPerArea, double blades, float lowX, float lowY,
                     float lowZ, float highX, float highY, float highZ, float full, float nearest)
{
    render::FieldShape shape;
    shape.content.low = {lowX, lowY, lowZ};
    shape.content.high = {highX, highY, highZ};
    const field::SeedMeadow& meadow = sowing().meadow;
    shape.sown = {.room = room,
                  .bladesPerArea = bladesPerArea,
                  .stored = meadow.stored,
                  .blades = blades,
                  .levels = double(meadow.levels)};
    return render::sparseDistance(shape, full, nearest);
}

} // namespace sward
