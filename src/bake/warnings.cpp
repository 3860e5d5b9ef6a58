#include "bake/warnings.h"

#include <glm/geometric.hpp>

#include <string>

namespace sward::bake {

void warnAboutRoots(const Sampling& sampling, const terrain::GroundMesh& ground,
                    const BakeSettings& settings, Diagnostics& diagnostics)
{
    if (sampling.roots.empty()) {
        std::string reasons;
        for (std::size_t i = 0; i < rejectCount; ++i)
            if (sampling.rejected[i] > 0)
                reasons += fmt::format("{}{} {}", reasons.empty() ? "" : ", ",
                                       nameOf(static_cast<Reject>(i)), sampling.rejected[i]);
        diagnostics.warn("no blade grows: {} roots proposed, rejected by {}", sampling.proposed,
                         reasons.empty() ? "no filter (no area bears grass, or none was asked for)"
                                         : reasons);
        return;
    }
    std::size_t under = 0;
    for (const RootSample& root : sampling.roots) {
        const glm::dvec3 up = settings.groundUp.at(ground.origin + glm::dvec3(root.position));
        under += std::size_t(glm::dot(glm::dvec3(root.normal), up) < 0.0);
    }
    const double share = double(under) / double(sampling.roots.size());
    if (share > 0.01)
        diagnostics.warn("{:.1f} % of the blades grow on undersides; --slope 0:90 removes them, "
                         "--ground-up radial is for planets",
                         100.0 * share);
}

} // namespace sward::bake
