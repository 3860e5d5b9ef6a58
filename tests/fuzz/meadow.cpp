// An accepted meadow is accepted again after writing.

#include "bake/settings/meadow.h"

#include "core/error.h"
#include "core/expect.h"
#include "fuzz/entries.h"

#include <string_view>

namespace sward::fuzz {

void meadow(Bytes bytes)
{
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    std::string written;
    try {
        written = bake::toJson(bake::parseMeadow(text, "meadow"));
    } catch (const Error&) {
        return;
    }
    expect(bake::toJson(bake::parseMeadow(written, "written")) == written,
           "a meadow that comes back as it was");
}

} // namespace sward::fuzz
