#pragma once

#include "field/field.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sward::render {

/// Reads pages of a field's blades, usually from a mapped file, without waiting for the disk.
class PageReader {
public:
    /// `waits`: for the disk, if a page is not in memory. The data viewed by `field` must outlive
    /// it.
    PageReader(const field::FieldView& field, bool waits);

    void begin() { ++frame_; } ///< a frame

    /// Whether a page can be read at once. Else asks the system to read it, and says so for some
    /// frames without asking again.
    bool isReadable(std::uint32_t page);

    std::span<const std::byte> bytes(std::uint32_t page) const; ///< shared::PackedBlade

private:
    field::FieldView field_;
    bool waits_;
    std::uint32_t frame_ = 0;
    std::vector<std::uint32_t> asked_; ///< by page: the frame that asked for it, or 0
};

} // namespace sward::render
