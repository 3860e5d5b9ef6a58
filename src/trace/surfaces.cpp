#include "trace/surfaces.h"

#include "core/error.h"
#include "core/math/srgb.h"
#include "field/measure/leaf_area.h"
#include "field/organs.h"
#include "field/poses/part_look.h"
#include "shaders/shared/look/blade_colors.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace sward::trace {
namespace {

// Appends the strip of a blade.
void addBlade(Surfaces& surfaces, std::uint32_t index, const field::PartLook& part,
              const field::BladePose& pose, const SurfaceSettings& settings)
{
    const float width = part.blade.width;
    if (!(width > 0.0f) || !(part.blade.height > 0.0f))
        return;
    field::RowErrors errors = settings.errors;
    if (settings.seen) {
        const float distance =
            std::max(glm::length(pose.v0 - settings.seen->eye) - part.blade.height, 0.0f);
        const float enough = pixelShare * settings.seen->pixel * distance / width;
        errors.curve = std::max(errors.curve, enough);
        errors.outline = std::max(errors.outline, enough);
    }
    const std::vector<float> rows = field::rowsOf(part.look, pose, width, errors);
    const bool isFolded = part.look.fold > 0.0f;
    const std::uint32_t columns = isFolded ? 2 : 1;
    if (surfaces.points.size() + rows.size() * (columns + 1) >
        std::numeric_limits<std::uint32_t>::max())
        fail(ErrorKind::runtime, "the field has more blades than a traced scene holds");

    const auto strip = static_cast<std::uint32_t>(surfaces.strips.size());
    const float leafArea = shared::leafAreaAt(surfaces.cover, part.blade.root);
    const shared::BladeColors colors =
        shared::bladeColors(surfaces.cover, part.blade, part.look, leafArea);
    surfaces.strips.push_back({.firstQuad = static_cast<std::uint32_t>(surfaces.quads.size()),
                               .firstRow = static_cast<std::uint32_t>(surfaces.along.size()),
                               .blade = index,
                               .columns = columns,
                               .finish = shared::finishOf(part.look),
                               .seed = part.blade.seed,
                               .root = colors.root,
                               .tip = colors.tip,
                               .translucency = settings.translucency * part.look.translucency,
                               .gloss = settings.gloss * part.look.gloss});
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto first = static_cast<std::uint32_t>(surfaces.points.size());
        const field::BladeRow row = field::rowAt(part.look, pose, width, rows[i]);
        surfaces.along.push_back(rows[i]);
        surfaces.points.push_back(row.left);
        if (isFolded)
            surfaces.points.push_back(row.ridge);
        surfaces.points.push_back(row.right);
        for (std::uint32_t column = 0; i > 0 && column < columns; ++column) {
            const std::uint32_t left = first - (columns + 1) + column;
            surfaces.quads.emplace_back(left, left + 1, first + column + 1, first + column);
            surfaces.quadStrip.push_back(strip);
        }
    }
}

glm::vec3 vertexColor(std::uint32_t bits)
{
    return glm::vec3(float(bits & 255u), float((bits >> 8u) & 255u), float((bits >> 16u) & 255u)) /
           255.0f;
}

void addGround(Surfaces& surfaces, const field::DisplayGround& ground)
{
    for (const shared::GroundVertex& corner : ground.vertices) {
        surfaces.groundPoints.push_back(corner.position);
        surfaces.groundColors.push_back(vertexColor(corner.color));
        surfaces.groundUvs.push_back(corner.uv);
    }
    for (const field::GroundRange& range : ground.ranges) {
        if (range.level != 0)
            continue;
        for (std::uint32_t i = 0; i + 2 < range.indexCount; i += 3) {
            const std::uint32_t* const corner = &ground.indices[range.firstIndex + i];
            surfaces.groundTriangles.emplace_back(corner[0], corner[1], corner[2]);
            surfaces.groundMaterials.push_back(range.material);
        }
    }
    surfaces.materials = ground.materials;
    surfaces.images = ground.images;
}

// Linear colours of the 256 values of an sRGB byte.
const std::array<float, 256>& linearBytes()
{
    static const std::array<float, 256> table = [] {
        std::array<float, 256> values{};
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = linearOf(float(i) / 255.0f);
        return values;
    }();
    return table;
}

// Linear colour of an image between four texels; images repeat.
glm::vec3 imageAt(const field::Image& image, glm::vec2 uv)
{
    const glm::vec2 size(image.width, image.height);
    const glm::vec2 place = (uv - glm::floor(uv)) * size - 0.5f;
    const glm::vec2 low = glm::floor(place);
    const glm::vec2 f = place - low;
    const auto texel = [&](int dx, int dy) {
        const auto wrap = [](int i, std::uint32_t count) {
            const int n = static_cast<int>(count);
            return static_cast<std::size_t>(((i % n) + n) % n);
        };
        const std::size_t x = wrap(static_cast<int>(low.x) + dx, image.width);
        const std::size_t y = wrap(static_cast<int>(low.y) + dy, image.height);
        const std::uint8_t* const bytes = &image.rgba[4 * (y * image.width + x)];
        const std::array<float, 256>& linear = linearBytes();
        return glm::vec3(linear[bytes[0]], linear[bytes[1]], linear[bytes[2]]);
    };
    return glm::mix(glm::mix(texel(0, 0), texel(1, 0), f.x),
                    glm::mix(texel(0, 1), texel(1, 1), f.x), f.y);
}

} // namespace

Surfaces surfacesOf(const field::FieldView& field, const std::vector<field::BladePose>& poses,
                    const SurfaceSettings& settings)
{
    Surfaces surfaces;
    // What grows around a blade or place colours it.
    field::LeafAreaGrid grid = field::leafAreaOf(field);
    surfaces.grass = std::move(grid.values);
    surfaces.cover = grid.shape;
    surfaces.cover.grass.at = surfaces.grass.data();
    field::describeUndergrowth(field, surfaces.cover);
    surfaces.cover.thatch = settings.thatch;
    surfaces.cover.farthest = std::numeric_limits<float>::max();

    const std::vector<shared::Organ> organs = field::organTable(field.species);
    const shared::OrganTable table = field::viewOf(organs);
    for (const shared::Patch& cell : field.patches)
        for (std::uint32_t i = 0; i < cell.bladeCount; ++i) {
            const std::uint32_t index = cell.firstBlade + i;
            const shared::Blade blade = shared::unpackBlade(field.blades[index], cell);
            addBlade(surfaces, index, field::partLookOf(field, table, blade), poses[index],
                     settings);
        }
    addGround(surfaces, *field.ground);
    surfaces.points.emplace_back(0.0f);
    surfaces.groundPoints.emplace_back(0.0f);
    return surfaces;
}

Surfaces groundOf(const field::FieldView& field)
{
    Surfaces surfaces;
    addGround(surfaces, *field.ground);
    surfaces.points.emplace_back(0.0f);
    surfaces.groundPoints.emplace_back(0.0f);
    return surfaces;
}

Leaf leafAt(const Surfaces::Strip& strip, glm::vec2 place)
{
    const float along = place.y;
    // Wide enough for all veins: their means do not depend on that.
    constexpr float pixels = 255.0f;
    const glm::vec3 albedo = glm::mix(strip.root, strip.tip, shared::tipShareAt(along)) *
                             shared::toneAlong(strip.finish, along, strip.seed) *
                             shared::veinsAt(strip.finish, place, pixels, strip.seed).tone;
    // The upper half shines, as in the renderer.
    return leafOf(albedo,
                  albedo * shared::throughTint * (shared::throughShare * strip.translucency),
                  strip.gloss * along);
}

glm::vec3 groundAlbedo(const Surfaces& surfaces, std::uint32_t triangle, glm::vec3 shares)
{
    const glm::uvec3 corners = surfaces.groundTriangles[triangle];
    const auto between = [&](const auto& values) {
        return shares.x * values[corners.x] + shares.y * values[corners.y] +
               shares.z * values[corners.z];
    };
    const shared::GroundMaterial& material = surfaces.materials[surfaces.groundMaterials[triangle]];
    glm::vec3 albedo = glm::vec3(material.baseColor) * between(surfaces.groundColors);
    if (material.image < surfaces.images.size())
        albedo *= imageAt(surfaces.images[material.image], between(surfaces.groundUvs));
    if (surfaces.cover.countX > 0) {
        const glm::vec3 place = between(surfaces.groundPoints);
        const glm::vec3 grass = shared::grassAt(surfaces.cover, place);
        albedo = shared::groundUnder(surfaces.cover, albedo,
                                     shared::meadowShade(place, shared::toneOf(grass)),
                                     surfaces.cover.thinned * grass.x);
    }
    return glm::clamp(albedo, 0.0f, 1.0f);
}

} // namespace sward::trace
