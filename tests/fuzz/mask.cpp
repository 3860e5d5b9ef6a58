// An accepted mask is equal after writing and reading, and its image gives shares in [0, 1].

#include "bake/mask/mask.h"

#include "core/error.h"
#include "core/expect.h"
#include "fuzz/memory_file.h"
#include "terrain/image/channel_image.h"

#include <iterator>
#include <optional>

namespace sward::fuzz {

void mask(Bytes bytes)
{
    static constexpr const char* extensions[] = {".png", ".jpg", ".tga", ".bmp"};
    if (bytes.size() < 2)
        return;
    // Half of the inputs are texts of --mask, half are images.
    if ((bytes[0] & 0x80U) != 0) {
        const std::string text(reinterpret_cast<const char*>(bytes.data()) + 1, bytes.size() - 1);
        if (const std::optional<bake::Mask> read = bake::readMask(text)) {
            const std::string written = bake::textOf(*read);
            expect(bake::textOf(*bake::readMask(written)) == written,
                   "a mask that comes back as it was");
        }
        return;
    }
    const int channel = bytes[1] % 4;
    try {
        const terrain::ChannelImage image = terrain::readChannel(
            memoryFile().hold(bytes.subspan(2), extensions[bytes[0] % std::size(extensions)]),
            channel);
        for (const double u : {-1e9, -0.3, 0.0, 0.5, 1.0, 7.25, 1e9})
            for (const double v : {-2.5, 0.0, 0.49, 1.0}) {
                const double value = terrain::valueAt(image, {u, v});
                expect(value >= 0.0 && value <= 1.0, "a share");
            }
    } catch (const Error&) {
    }
}

} // namespace sward::fuzz
