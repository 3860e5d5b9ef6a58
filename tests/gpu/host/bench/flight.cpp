#include "flight.h"

#include <algorithm>
#include <cmath>

namespace sward::bench {

Circle::Circle(const field::FieldView& field, double speed)
    : field_(field)
    , speed_(speed)
{
    const Aabb box = field.bounds();
    middle_ = glm::dvec3(0.5f * (box.low + box.high));
    radius_ = 0.35 * double(std::min(box.size().x, box.size().z));
    height_ = ground(place(0.0));
}

nlohmann::json Circle::at(double time)
{
    const double angle = speed_ * time / radius_;
    const glm::dvec3 eye = place(angle);
    height_ += 0.05 * (ground(eye) - height_);
    const glm::dvec3 ahead(-40.0 * std::sin(angle), -2.5, 40.0 * std::cos(angle));
    const glm::dvec3 from = field_.origin + glm::dvec3(eye.x, height_ + 3.0, eye.z);
    const glm::dvec3 to = from + ahead;
    return {{"eye", {from.x, from.y, from.z}}, {"target", {to.x, to.y, to.z}}, {"fov_y_deg", 45.0}};
}

glm::dvec3 Circle::place(double angle) const
{
    return middle_ + radius_ * glm::dvec3(std::cos(angle), 0.0, std::sin(angle));
}

/// Top [m] of the smallest patch at a place.
double Circle::ground(glm::dvec3 place) const
{
    std::uint32_t patch = 0;
    for (bool isDeeper = !field_.patches.empty(); isDeeper;) {
        const shared::Patch& cell = field_.patches[patch];
        isDeeper = false;
        for (std::uint32_t child = 0; child < cell.childCount && !isDeeper; ++child) {
            const shared::Patch& below = field_.patches[cell.firstChild + child];
            isDeeper =
                place.x >= double(below.boundsLow.x) && place.x <= double(below.boundsHigh.x) &&
                place.z >= double(below.boundsLow.z) && place.z <= double(below.boundsHigh.z);
            if (isDeeper)
                patch = cell.firstChild + child;
        }
    }
    return field_.patches.empty() ? 0.0 : double(field_.patches[patch].boundsHigh.y);
}

void Flight::add(const render::StreamingStats& stats)
{
    copied_ += stats.copiedBytes;
    maxCopied_ = std::max(maxCopied_, stats.copiedBytes);
    nearestMissing_ = std::min(nearestMissing_, double(stats.nearestMissing));
    if (std::isfinite(stats.nearestMissing))
        copiedWhileMissing_.push_back(stats.copiedBytes);
}

nlohmann::json Flight::toJson() const
{
    const auto below = std::ranges::count_if(
        copiedWhileMissing_, [this](std::uint64_t bytes) { return bytes < maxCopied_; });
    nlohmann::json json{{"copied_bytes", copied_},
                        {"max_copied_bytes", maxCopied_},
                        {"nearest_missing_m", nullptr},
                        {"frames_with_missing", copiedWhileMissing_.size()},
                        {"of_these_below_max_copied", below}};
    if (std::isfinite(nearestMissing_))
        json["nearest_missing_m"] = nearestMissing_;
    return json;
}

} // namespace sward::bench
