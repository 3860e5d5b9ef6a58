#include "interchange/gltf/glb_container.h"

#include "core/expect.h"

#include <array>
#include <span>

namespace sward::interchange {

void writeGlbHeader(AtomicFile& file, std::string_view json, std::uint64_t binaryBytes)
{
    const std::uint64_t bytes = glbHeaderBytes + json.size() + binaryBytes;
    expect(bytes <= largestGlb, "the caller has refused files that are too large");
    const auto word = [](std::uint64_t value) { return static_cast<std::uint32_t>(value); };
    const std::array<std::uint32_t, 5> front = {0x46546c67U /* glTF */, 2, word(bytes),
                                                word(json.size()), 0x4e4f534aU /* JSON */};
    file.write(std::as_bytes(std::span(front)));
    file.write(json);
    const std::array<std::uint32_t, 2> binary = {word(binaryBytes), 0x004e4942U /* BIN */};
    file.write(std::as_bytes(std::span(binary)));
}

} // namespace sward::interchange
