#include "render/streaming/page_reader.h"

#include "core/files/mapped_file.h"
#include "shaders/shared/pages.h"

#include <algorithm>

namespace sward::render {
namespace {

/// Frames after which the system is asked again.
constexpr std::uint32_t askedFrames = 8;

} // namespace

PageReader::PageReader(const field::FieldView& field, bool waits)
    : field_(field)
    , waits_(waits)
    , asked_(waits ? 0 : field.blades.size() / shared::pageBlades + 1)
{
}

bool PageReader::isReadable(std::uint32_t page)
{
    if (waits_)
        return true;
    if (asked_[page] != 0 && frame_ - asked_[page] < askedFrames)
        return false;
    if (isInMemory(bytes(page)))
        return true;
    bringIntoMemory(bytes(page));
    asked_[page] = frame_;
    return false;
}

std::span<const std::byte> PageReader::bytes(std::uint32_t page) const
{
    const std::size_t first = std::size_t(page) * shared::pageBlades;
    return std::as_bytes(field_.blades.subspan(
        first, std::min<std::size_t>(shared::pageBlades, field_.blades.size() - first)));
}

} // namespace sward::render
