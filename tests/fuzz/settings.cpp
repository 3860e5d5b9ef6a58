// Accepted settings are accepted again after writing.

#include "core/error.h"
#include "core/expect.h"
#include "fuzz/memory_file.h"
#include "render/settings/settings_text.h"
#include "render/settings_file.h"

#include <string>

namespace sward::fuzz {

void settings(Bytes bytes)
{
    render::FrameSettings read;
    try {
        render::readSettings(memoryFile().hold(bytes, ".json"), read);
    } catch (const Error&) {
        return;
    }
    const std::string text = render::settingsText(read);
    render::FrameSettings again;
    render::readSettings(
        memoryFile().hold({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()},
                          ".json"),
        again);
    expect(again.cullMask == read.cullMask && again.levelSteps.size() == read.levelSteps.size() &&
               again.buckets.count == read.buckets.count &&
               again.winds.size() == read.winds.size() &&
               again.colliders.size() == read.colliders.size(),
           "settings that come back as they were");
}

} // namespace sward::fuzz
