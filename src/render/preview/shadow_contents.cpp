#include "render/preview/shadow_contents.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>

namespace sward::render {
namespace {

bool isEmptyRect(const VkRect2D& rect)
{
    return rect.extent.width == 0 || rect.extent.height == 0;
}

glm::ivec2 firstOf(const VkRect2D& rect)
{
    return {rect.offset.x, rect.offset.y};
}

glm::ivec2 endOf(const VkRect2D& rect)
{
    return firstOf(rect) +
           glm::ivec2(static_cast<int>(rect.extent.width), static_cast<int>(rect.extent.height));
}

VkRect2D rectOf(glm::ivec2 first, glm::ivec2 end)
{
    const glm::ivec2 size = glm::max(end - first, glm::ivec2(0));
    return {{first.x, first.y},
            {static_cast<std::uint32_t>(size.x), static_cast<std::uint32_t>(size.y)}};
}

bool overlap(const VkRect2D& a, const VkRect2D& b)
{
    return !isEmptyRect(a) && !isEmptyRect(b) && glm::all(glm::lessThan(firstOf(a), endOf(b))) &&
           glm::all(glm::lessThan(firstOf(b), endOf(a)));
}

/// Adds a rectangle; it grows by all that it overlaps.
void addTo(std::vector<VkRect2D>& parts, VkRect2D rect)
{
    if (isEmptyRect(rect))
        return;
    for (std::size_t i = 0; i < parts.size();) {
        if (!overlap(parts[i], rect)) {
            ++i;
            continue;
        }
        rect = rectOf(glm::min(firstOf(parts[i]), firstOf(rect)),
                      glm::max(endOf(parts[i]), endOf(rect)));
        parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(i));
        i = 0;
    }
    parts.push_back(rect);
}

} // namespace

VkRect2D shadowRect(const shared::SunShadow& view, const shared::Collider& collider)
{
    const glm::vec4 from(collider.from, 1.0f);
    const glm::vec4 to(collider.to, 1.0f);
    const float size = static_cast<float>(view.size);
    // What lies behind all of the ground shades none of it.
    const float nearest = std::max(glm::dot(view.depth, from), glm::dot(view.depth, to)) +
                          collider.radius * glm::length(glm::vec3(view.depth));
    if (view.size == 0 || !(nearest > 0.0f))
        return {};
    const auto span = [&](const glm::vec4& row) {
        const float a = glm::dot(row, from);
        const float b = glm::dot(row, to);
        // A pixel more, for the rounding.
        const float reach = collider.radius * glm::length(glm::vec3(row)) + 1.0f;
        return glm::ivec2(glm::clamp(
            glm::vec2(std::floor(std::min(a, b) - reach), std::ceil(std::max(a, b) + reach)), 0.0f,
            size));
    };
    const glm::ivec2 across = span(view.across);
    const glm::ivec2 down = span(view.down);
    const VkRect2D rect = rectOf({across.x, down.x}, {across.y, down.y});
    return isEmptyRect(rect) ? VkRect2D{} : rect;
}

ShadowChanges ShadowContents::follow(const shared::SunShadow& view, glm::vec3 sun,
                                     std::span<const shared::Collider> colliders)
{
    ShadowChanges changes;
    changes.ground = sun != sun_;
    if (changes.ground) {
        shapes_.clear();
        rects_.clear();
    }
    sun_ = sun;

    std::vector<Shape> shapes;
    std::vector<VkRect2D> rects;
    for (const shared::Collider& collider : colliders) {
        shapes.push_back({collider.from, collider.to, collider.radius});
        rects.push_back(shadowRect(view, collider));
    }
    for (std::size_t i = 0; i < std::max(shapes.size(), shapes_.size()); ++i) {
        if (i < shapes.size() && i < shapes_.size() && shapes[i] == shapes_[i])
            continue;
        if (i < shapes_.size())
            addTo(changes.parts, rects_[i]);
        if (i < shapes.size())
            addTo(changes.parts, rects[i]);
    }
    for (std::size_t i = 0; i < shapes.size(); ++i)
        if (std::ranges::any_of(changes.parts,
                                [&](const VkRect2D& part) { return overlap(part, rects[i]); }))
            changes.colliders.push_back(static_cast<std::uint32_t>(i));
    shapes_ = std::move(shapes);
    rects_ = std::move(rects);
    return changes;
}

} // namespace sward::render
