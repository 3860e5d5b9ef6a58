#pragma once

#include "core/uninitialized.h"
#include "shaders/shared/sow/seeds.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sward::field {

/// What all cells of a field's seeds have in common (decision 0044).
struct SeedMeadow {
    std::uint64_t seed = 0;       ///< of all random numbers
    double density = 0.0;         ///< [1/m²] of candidates
    double scale = 1.0;           ///< of blades and waves
    double clumpSpacing = 0.0;    ///< [m] typical distance of clumps; 0: none
    double stored = 0.0;          ///< [0, 1] the field's own blades have the ranks below this share
    double storedWidening = 1.0;  ///< [1, 2] factor on the widths of the field's own blades
    std::uint32_t unitBits = 20;  ///< 11 to 24: lengths in cells are in units of 2^−unitBits m
    std::uint32_t levels = 0;     ///< 0 to 10, see shared::sowLevel()
    bool isMixed = false;         ///< shares and vigour of species vary from place to place
    float heightWaves = 0.0f;     ///< [0, 0.5]
    float drifts = 0.0f;          ///< [0, 1]
    float sparseHeight = 1.0f;    ///< [0, 1]
    float wideVariation = 0.0f;   ///< [0, 1] in patches of 5 to 50 m
    float creaseReach = 0.0f;     ///< [m] from convex creases
    float creaseBlend = 0.0f;     ///< [0, 1] how far blades lean over them
    float vertical = 0.0f;        ///< [0, 1] how far blades grow along the ground's up-vector
    bool isRadial = false;        ///< that points away from a centre
    glm::dvec3 up{0.0, 1.0, 0.0}; ///< unit, or that centre in the world [m]
    float highest = 1.0f;         ///< [m] largest height of a blade
    float widest = 1.0f;          ///< [m] largest width of a blade or ribbon
    std::vector<shared::SowSpecies> species; ///< one per species of the field
};

/// Where the seeds of one 32 m cell lie. Stored as it is.
struct SeedEntry {
    std::array<std::int32_t, 3> cell; ///< low corner: origin + 32 m · cell
    std::uint32_t vertices;           ///< number of elements
    std::uint32_t pieces;             ///< the same
    std::uint32_t clumps;             ///< the same
    std::uint32_t conditions;         ///< the same
    std::uint32_t words;              ///< of 32 bits each
    std::uint64_t offset;             ///< of its frame in the data [bytes]
    std::uint64_t bytes;              ///< of its frame
};
static_assert(sizeof(SeedEntry) == 48);

/// Seeds that are verified but for the insides of cells, which readSeedCell() verifies.
struct SeedsView {
    const SeedMeadow* meadow = nullptr; ///< never null
    std::span<const SeedEntry> cells;   ///< in rising order of their cells
    std::span<const std::byte> data;    ///< frames, in the same order
    std::uint64_t elsewhere = 0;        ///< [bytes] of them, if they come in SeedPieces instead

    std::uint64_t bytes() const { return data.empty() ? elsewhere : data.size(); }
};

/// The seeds of a field: what bears, instead of all that is borne.
struct Seeds {
    SeedMeadow meadow;                   ///< common to all cells
    std::vector<SeedEntry> cells;        ///< as SeedsView::cells
    UninitializedVector<std::byte> data; ///< as SeedsView::data
    std::uint64_t elsewhere = 0;         ///< as SeedsView::elsewhere
};

SeedsView viewOf(const Seeds& seeds);

/// Seeds that copies of a field share, and their view.
struct SharedSeeds {
    explicit SharedSeeds(Seeds&& owned)
        : seeds(std::move(owned))
        , view(viewOf(seeds))
    {
    }
    SharedSeeds(const SharedSeeds&) = delete;
    SharedSeeds& operator=(const SharedSeeds&) = delete;

    const Seeds seeds;    ///< never change
    const SeedsView view; ///< of these
};

/// What bears in a cell.
struct SeedCell {
    std::array<std::int32_t, 3> cell{};             ///< as SeedEntry::cell
    std::vector<shared::SeedVertex> vertices;       ///< of triangles
    std::vector<shared::SeedPiece> pieces;          ///< triangles and parts of such
    std::vector<shared::SeedClump> clumps;          ///< centres in the cell and within reach of it
    std::vector<shared::SeedConditions> conditions; ///< of the grids of all pieces
    std::vector<std::uint32_t> words;               ///< one bit an entry, of some pieces
};

/// Appends a cell; cells come in rising order. Its bytes depend on the cell alone.
void addSeedCell(Seeds& seeds, const SeedCell& cell);

/// The same in steps, of which the first two may run in several threads. An entry has the number
/// and the counts of a cell; its offset and bytes are filled in.
SeedEntry entryOf(const SeedCell& cell);
UninitializedVector<std::byte> packSeedCell(const SeedCell& cell, bool isMixed);
void addSeedCell(Seeds& seeds, SeedEntry entry, std::span<const std::byte> packed);

/// Reads the cell `index` and verifies every number. Throws Error{input} naming `place`.
SeedCell readSeedCell(const SeedsView& seeds, std::size_t index, const std::string& place);

/// Verifies every number of a cell. Throws Error{input} naming `place`.
void verifySeedCell(const SeedCell& cell, const std::string& place);

/// Verifies the meadow and the entries against the data. `speciesCount` is that of the field.
/// Throws Error{input} naming `place`.
void verifySeeds(const SeedsView& seeds, std::size_t speciesCount, const std::string& place);

/// The meadow as JSON text, and back. Throws Error{input} naming `place`.
std::string seedMeadowText(const SeedMeadow& meadow);
SeedMeadow parseSeedMeadow(std::string_view text, const std::string& place);

} // namespace sward::field
