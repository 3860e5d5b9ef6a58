// For builds without OpenEXR.
#include "core/error.h"
#include "terrain/heightmap/height_samples.h"

namespace sward::terrain {

HeightSamples readExrHeights(std::span<const std::byte>, const std::string& place, Diagnostics&)
{
    fail(ErrorKind::unsupported,
         "{}: this build reads no OpenEXR; a .png of 16 bits or an .r32 works", place);
}

} // namespace sward::terrain
