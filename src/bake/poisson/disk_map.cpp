#include "bake/poisson/disk_map.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace sward::bake {
namespace {

// Cells around a disk's own that may have it for their nearest, in rows of eight.
constexpr int rim = DiskMap::cellsPerSpacing;
constexpr std::size_t stampRows = 2 * rim + 1;
constexpr std::size_t stampColumns = 8;
static_assert(stampRows <= stampColumns);

// Four cells at once.
using Four = std::int32_t __attribute__((vector_size(16)));
using StampRow = std::array<Four, 2>;
using Stamp = std::array<StampRow, stampRows>;

// Distance classes, shifted to where a map's cell keeps them.
Stamp makeStamp()
{
    Stamp made{};
    for (int y = -rim; y <= rim; ++y)
        for (int x = -rim; x <= rim + 1; ++x)
            made[static_cast<std::size_t>(y + rim)][static_cast<std::size_t>(x + rim) / 4]
                [(x + rim) % 4] =
                    (x <= rim && x * x + y * y < 14 ? 4 * (x * x + y * y) : 0x7f) << 24;
    return made;
}

const Stamp stamp = makeStamp();

// Relative margin for the rounding of local coordinates.
constexpr double localSlack = 1e-4;

// Rounding must not let a root stand nearer than the radius; the same as in DiskGrid.
constexpr float generous = 1.000002f;

} // namespace

void DiskMap::clear(const RegionFrame& frame)
{
    frame_ = frame;
    const double sure =
        std::max(cellsPerSpacing * ((1.0 - localSlack) - frame.rounding / frame.spacing), 0.0);
    sure_ = static_cast<float>(sure * sure);
    perMetre_ = static_cast<float>(cellsPerSpacing / frame.spacing);
    reachSlack_ = static_cast<float>(frame.rounding) * perMetre_ + 0.01f;
    width_ = static_cast<std::size_t>(frame.cells.x);
    const auto rows = static_cast<std::size_t>(frame.cells.y);
    bytesPerRow_ = width_ / 8 + 8;
    nearest_.assign(width_ * rows, empty);
    centres_.assign(bytesPerRow_ * rows, 0);
    constexpr float far = 1e9f;
    entries_.assign(1, {glm::vec3(far), 0.0f, glm::vec3(far), 0.0f});
    normals_.assign(1, glm::vec3(0.0f));
}

bool DiskMap::insert(const Disk& disk, const glm::vec3& local)
{
    const auto border = static_cast<float>(margin);
    if (!(local.x >= border && local.y >= border &&
          local.x < static_cast<float>(frame_.cells.x - margin) &&
          local.y < static_cast<float>(frame_.cells.y - margin)))
        return true;
    const auto number = static_cast<std::int32_t>(entries_.size());
    const auto column = static_cast<std::size_t>(local.x);
    const auto row = static_cast<std::size_t>(local.y);
    std::uint8_t& centres = centres_[row * bytesPerRow_ + column / 8];
    const auto bit = static_cast<std::uint8_t>(1U << (column % 8));
    if ((centres & bit) != 0 || number >= numberMask)
        return false;
    centres = static_cast<std::uint8_t>(centres | bit);
    entries_.push_back({local, disk.radius, disk.position, 0.0f});
    normals_.push_back(disk.normal);
    std::int32_t* cells = nearest_.data() + (row - rim) * width_ + (column - rim);
    for (const StampRow& classes : stamp) {
        Four four[2];
        std::memcpy(four, cells, sizeof four);
        for (std::size_t i = 0; i < 2; ++i) {
            const Four own = classes[i] + number;
            four[i] = own < four[i] ? own : four[i];
        }
        std::memcpy(cells, four, sizeof four);
        cells += width_;
    }
    return true;
}

bool DiskMap::surelyCovers(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) const
{
    const Look look(*this);
    const glm::vec3 middle = (a + b + c) * (1.0f / 3.0f);
    const glm::vec3& disk = look.nearestTo(middle.x, middle.y);
    return look.isSurelyNear(a, disk) && look.isSurelyNear(b, disk) && look.isSurelyNear(c, disk);
}

bool DiskMap::blocksAt(std::size_t cell, const glm::vec3& position, float radius) const
{
    const Entry& disk = entries_[static_cast<std::size_t>(nearest_[cell] & numberMask)];
    const float dx = disk.position.x - position.x;
    const float dy = disk.position.y - position.y;
    const float dz = disk.position.z - position.z;
    const float reach = std::min(disk.radius, radius);
    return dx * dx + dy * dy + dz * dz < reach * reach * generous;
}

bool DiskMap::blocks(const glm::vec3& position, const glm::vec3& local, float radius) const
{
    const float reach = radius * perMetre_ + reachSlack_;
    const auto firstRow = static_cast<std::size_t>(static_cast<std::int32_t>(local.y - reach));
    const auto lastRow = static_cast<std::size_t>(static_cast<std::int32_t>(local.y + reach));
    const auto firstColumn = static_cast<std::size_t>(static_cast<std::int32_t>(local.x - reach));
    const auto lastColumn = static_cast<std::size_t>(static_cast<std::int32_t>(local.x + reach));
    const auto centresAt = [&](std::size_t row, std::size_t column, std::size_t count) {
        std::uint64_t bits;
        std::memcpy(&bits, centres_.data() + row * bytesPerRow_ + column / 8, sizeof bits);
        return bits >> (column % 8) & ((std::uint64_t(1) << count) - 1);
    };
    // The usual window: eight by eight cells.
    if (lastRow - firstRow < 8 && lastColumn - firstColumn < 8) {
        std::uint64_t centres = 0;
        const std::size_t count = lastColumn + 1 - firstColumn;
        for (std::size_t row = firstRow; row <= lastRow; ++row)
            centres |= centresAt(row, firstColumn, count) << (8 * (row - firstRow));
        for (; centres != 0; centres &= centres - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(centres));
            if (blocksAt((firstRow + i / 8) * width_ + firstColumn + i % 8, position, radius))
                return true;
        }
        return false;
    }
    constexpr std::size_t step = 48;
    for (std::size_t row = firstRow; row <= lastRow; ++row)
        for (std::size_t column = firstColumn; column <= lastColumn; column += step) {
            std::uint64_t centres = centresAt(row, column, std::min(step, lastColumn + 1 - column));
            for (; centres != 0; centres &= centres - 1)
                if (blocksAt(row * width_ + column +
                                 static_cast<std::size_t>(std::countr_zero(centres)),
                             position, radius))
                    return true;
        }
    return false;
}

} // namespace sward::bake
