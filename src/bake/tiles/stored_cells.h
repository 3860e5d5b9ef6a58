#pragma once

#include "bake/patches/cell_tree.h"
#include "bake/patches/patch_tree.h"
#include "core/files/piece_file.h"
#include "field/field.h"
#include "field/file/blade_pieces.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <vector>

namespace sward::bake {

/// Where the blades and keys of a tile's cells lie in a file: the first level of all cells, then
/// the second …; of the keys first byte 0 of all, then byte 1 ….
struct TileStretch {
    std::uint64_t blades = 0; ///< [bytes] from the file's beginning
    std::uint64_t keys = 0;   ///< [bytes] from the file's beginning
    std::uint64_t count = 0;  ///< of blades, and of keys
};

/// Hands over the blades of a tile's cells in the order of a TileStretch.
void eachStoredBlade(std::span<const CellTree> cells,
                     const std::function<void(std::span<const shared::PackedBlade>)>& take);

/// Hands over all bytes of the keys of a tile's cells in the order of a TileStretch.
void eachStoredKeyByte(std::span<const CellTree> cells, const field::TakeBytes& take);

/// The cells of tiles whose blades and keys lie in files. In memory are their patches alone.
class StoredCells : public field::BladePieces {
public:
    /// Adds the cells of a tile, without blades and keys, that lie in an open file.
    void add(std::vector<CellTree>&& cells, const TileStretch& stretch,
             std::shared_ptr<const PieceFile> file);
    /// The same for a file that is opened when it is read. Throws Error{input} that names it, and
    /// the other file, if a cell is there already.
    void add(std::vector<CellTree>&& cells, const TileStretch& stretch, std::filesystem::path file);

    /// Lays the patches of all cells out in `field`, once, after the last tile. Then the blades can
    /// be asked for. Throws as layOutCells() does.
    void layOut(field::Field& field);

    /// Of all tiles. Below, Error{io} is thrown if a file cannot be read.
    std::uint64_t count() const override { return count_; }
    void eachBlade(const TakeBlades& take) const override;
    void eachKeyByte(std::size_t byte, const field::TakeBytes& take) const override;

private:
    struct Tile {
        TileStretch stretch;
        std::shared_ptr<const PieceFile> open; ///< null: at `path`
        std::filesystem::path path;
    };
    // Blades of a level of a cell, from `first` of the cell on, lie from `place` of the tile on.
    struct Level {
        std::uint32_t first;
        std::uint32_t place;
    };
    struct Place {
        std::uint32_t tile;
        std::vector<Level> levels;
    };
    class Files;

    void addTile(std::vector<CellTree>&& cells, Tile tile);
    std::uint64_t placeOf(const BladeRun& run) const;

    std::vector<Tile> tiles_;
    std::vector<CellTree> cells_;                ///< until they are laid out
    std::vector<Place> places_;                  ///< one per cell
    std::map<CellNumber, std::uint32_t> tileOf_; ///< of cells in files, until they are laid out
    std::vector<BladeRun> runs_;
    std::uint64_t count_ = 0;
};

} // namespace sward::bake
