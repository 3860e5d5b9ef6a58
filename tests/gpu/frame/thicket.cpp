#include "thicket.h"

#include "support/fields/fields.h"

#include <cmath>

namespace sward::test {

field::Field thicket()
{
    return makeField({.blades = 6000,
                      .extent = 8.0f,
                      .heightLow = 1.2f,
                      .heightHigh = 2.4f,
                      .widthLow = 0.1f,
                      .widthHigh = 0.2f});
}

render::Camera onTheWay(int step)
{
    render::Camera camera;
    const double turn = 0.35 * step;
    camera.eye = {3.0 * std::sin(0.1 * step), 1.5 + 0.4 * std::sin(0.3 * step), 5.0 - 0.25 * step};
    camera.target =
        camera.eye + glm::dvec3(std::sin(turn), step % 5 == 0 ? -0.6 : -0.1, -std::cos(turn));
    return camera;
}

} // namespace sward::test
