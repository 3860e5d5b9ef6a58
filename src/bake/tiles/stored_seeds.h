#pragma once

#include "field/seeds/seeds.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace sward::bake {

/// Seeds of tiles whose bytes lie in files. In memory are their entries alone, until they are
/// joined.
class StoredSeeds {
public:
    /// Adds the cells of a tile, whose bytes begin at byte `at` of a file.
    void add(std::vector<field::SeedEntry>&& cells, std::uint64_t at, std::filesystem::path file);

    /// All of them, cell by cell in rising order, as one bake has them. Throws Error{io} if a file
    /// cannot be read, Error{input} naming it if it holds a cell of another tile, too.
    field::Seeds join(const field::SeedMeadow& meadow) const;

private:
    struct Tile {
        std::vector<field::SeedEntry> cells;
        std::uint64_t at;
        std::filesystem::path file;
    };
    std::vector<Tile> tiles_;
};

} // namespace sward::bake
