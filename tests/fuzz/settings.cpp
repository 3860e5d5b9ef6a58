// Accepted settings are accepted again after writing.

#include "core/error.h"
#include "core/expect.h"
#include "fuzz/memory_file.h"
#include "presentation/settings_file.h"
#include "presentation/settings_text.h"

#include <string>

namespace sward::fuzz {

void settings(Bytes bytes)
{
    render::FrameSettings read;
    try {
        presentation::readSettings(memoryFile().hold(bytes, ".json"), read);
    } catch (const Error&) {
        return;
    }
    const std::string text = presentation::settingsText(read);
    render::FrameSettings again;
    presentation::readSettings(
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
