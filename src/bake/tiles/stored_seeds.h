#pragma once

#include "field/file/blade_pieces.h"
#include "field/seeds/seeds.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace sward::bake {

/// Seeds of tiles whose bytes lie in files. In memory are their entries alone, unless they are
/// joined.
class StoredSeeds : public field::SeedPieces {
public:
    /// Adds the cells of a tile, whose bytes begin at byte `at` of a file.
    void add(std::vector<field::SeedEntry>&& cells, std::uint64_t at, std::filesystem::path file);

    /// The entries of all of them, cell by cell in rising order, as one bake has them, once, after
    /// the last tile; their frames lie elsewhere. Throws Error{input} naming a file that holds a
    /// cell of another tile, too.
    field::Seeds layOut(const field::SeedMeadow& meadow);

    /// Error{io} is thrown if a file cannot be read.
    void eachSeedByte(const field::TakeBytes& take) const override;

    /// The same with their frames.
    field::Seeds join(const field::SeedMeadow& meadow);

private:
    struct Tile {
        std::vector<field::SeedEntry> cells; ///< until they are laid out
        std::uint64_t at;
        std::filesystem::path file;
    };
    // Frames that follow one another both in a file and in the field.
    struct Run {
        std::uint32_t tile;
        std::uint64_t at;
        std::uint64_t bytes;
    };
    std::vector<Tile> tiles_;
    std::vector<Run> runs_;
};

} // namespace sward::bake
