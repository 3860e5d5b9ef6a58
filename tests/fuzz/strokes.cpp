// Accepted strokes are accepted again after writing, and paint numbers within their bounds.

#include "bake/paint/painting.h"
#include "bake/settings/stroke_file.h"
#include "core/error.h"
#include "core/expect.h"
#include "fuzz/entries.h"

#include <string_view>

namespace sward::fuzz {

void strokes(Bytes bytes)
{
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    bake::Strokes read;
    try {
        read = bake::parseStrokes(text, "strokes");
    } catch (const Error&) {
        return;
    }
    const std::string written = bake::toJson(read);
    expect(bake::toJson(bake::parseStrokes(written, "written")) == written,
           "strokes that come back as they were");

    const bake::Painting painting(read, glm::dvec3(0.0), {glm::vec3(-50.0f), glm::vec3(50.0f)});
    const glm::vec3 up(0.0f, 1.0f, 0.0f);
    for (const float x : {-40.0f, -1.0f, 0.0f, 0.3f, 7.0f})
        for (const float z : {-3.0f, 0.0f, 1.5f}) {
            const glm::vec3 place(x, 0.0f, z);
            const double density = painting.densityAt(place, up, 0.5);
            expect(density >= 0.0 && density <= bake::maxPaintedDensity, "a painted density");
            const bake::PaintedLook look = painting.lookAt(place, up);
            expect(look.height >= bake::lowestPaint && look.height <= bake::highestPaint,
                   "a painted height");
            expect(look.dryness >= 0.0 && look.dryness <= 1.0, "a painted share of dried blades");
            const bake::PaintedSpecies species = painting.speciesAt(place, up);
            double sum = species.kept;
            for (const double share : species.share)
                sum += share;
            expect(sum > 0.999 && sum < 1.001, "shares of species that make a whole");
        }
}

} // namespace sward::fuzz
