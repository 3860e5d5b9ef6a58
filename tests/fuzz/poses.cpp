// A dump of blades gives a pose for each blade of its field, or an Error.

#include "core/error.h"
#include "core/expect.h"
#include "field/poses/blade_poses.h"
#include "fuzz/entries.h"
#include "fuzz/memory_file.h"
#include "support/fields/fields.h"

#include <cmath>

namespace sward::fuzz {

void poses(Bytes bytes)
{
    static const field::Field field = test::makeField({.blades = posesBlades});
    try {
        const std::vector<field::BladePose> read =
            field::readPoses(field::viewOf(field), memoryFile().hold(bytes, ".csv"));
        expect(read.size() == posesBlades, "a pose for each blade");
        for (const field::BladePose& pose : read)
            expect(std::isfinite(pose.axis.x), "an axis");
    } catch (const Error&) {
    }
}

} // namespace sward::fuzz
