// For builds without OpenEXR.
#include "apps/common/picture/exr_file.h"
#include "core/error.h"

namespace sward::apps {

void writeExrParts(glm::uvec2, std::span<const ExrPart>, ExrCompression,
                   const std::filesystem::path& path, bool)
{
    fail(ErrorKind::unsupported,
         "{}: this build writes no OpenEXR; names that end in .npz and .png work", path.string());
}

void writeExr(glm::uvec2, std::span<const ExrChannel>, const std::filesystem::path& path, bool)
{
    fail(ErrorKind::unsupported, "{}: this build writes no OpenEXR; a name that ends in .png works",
         path.string());
}

} // namespace sward::apps
