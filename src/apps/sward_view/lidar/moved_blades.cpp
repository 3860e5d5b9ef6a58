#include "apps/sward_view/lidar/moved_blades.h"

#include "apps/sward_view/graphics.h"
#include "apps/sward_view/headless/headless.h"
#include "core/error.h"
#include "core/expect.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace sward::view {
namespace {

// Frames for which the blades are moved at most: 2 s, after which nothing is left of how they
// began.
constexpr std::uint64_t framesBefore = 120;

} // namespace

std::vector<field::BladePose> movedPoses(const std::string& file, const field::FieldView& field,
                                         const MovedBy& by)
{
    // A picture of a few pixels, for which every blade is moved.
    FrameOptions options;
    options.fields = {file};
    options.size = {16, 16};
    options.samples = 1;
    options.cullMask = 0;
    options.levelOfDetail = false;
    options.windStrength = by.windStrength;
    options.settingsFile = by.settingsFile;
    options.sownMemory = 0;
    options.device = by.device;
    options.validation = by.validation;
    const auto frame = static_cast<std::uint64_t>(std::llround(by.time / options.fixedStep));
    Headless headless(options, {.blades = true});
    if (headless.isStreamed())
        fail(ErrorKind::unsupported,
             "{}: the device's memory does not hold all {} blades, so their poses are not known",
             file, field.blades.size());
    for (std::uint64_t i = frame - std::min(frame, framesBefore); i < frame; ++i)
        headless.skip(i);
    headless.draw(frame);
    const std::vector<render::FieldRenderer::BladeRecord> blades = headless.blades();
    failOnValidationMessages(headless.instance());
    expect(blades.size() == field.blades.size(), "each blade has a record");

    std::vector<field::BladePose> poses(blades.size());
    for (std::size_t i = 0; i < blades.size(); ++i) {
        poses[i].v0 = glm::vec3(blades[i].root - field.origin);
        poses[i].v1 = glm::vec3(blades[i].v1 - field.origin);
        poses[i].v2 = glm::vec3(blades[i].v2 - field.origin);
    }
    field::setAxes(field, poses);
    return poses;
}

} // namespace sward::view
