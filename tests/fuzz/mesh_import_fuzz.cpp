// Whatever bytes a mesh file holds, loading it yields valid ground or an Error, nothing else. The
// first byte chooses the format.

#include "core/diagnostics.h"
#include "core/error.h"
#include "fuzz/memory_file.h"
#include "terrain/load.h"

#include <filesystem>
#include <iterator>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static constexpr const char* extensions[] = {".glb", ".gltf", ".obj", ".ply",
                                                 ".stl", ".off",  ".json"};
    if (size == 0)
        return 0;
    const sward::tests::MemoryFile file(data + 1, size - 1);
    // Loaders go by the extension: a link beside carries it.
    const std::filesystem::path link =
        std::filesystem::temp_directory_path() /
        ("sward-fuzz-" + std::to_string(::getpid()) + extensions[data[0] % std::size(extensions)]);
    std::error_code ignored;
    std::filesystem::remove(link, ignored);
    std::filesystem::create_symlink(
        "/proc/" + std::to_string(::getpid()) + "/fd/" + file.path().filename().string(), link);
    try {
        sward::Diagnostics diagnostics;
        sward::terrain::load(link.string(), {}, diagnostics);
    } catch (const sward::Error&) {
        // The one way in which a bad file may end.
    }
    std::filesystem::remove(link, ignored);
    return 0;
}
