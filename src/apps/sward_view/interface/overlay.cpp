#include "apps/sward_view/interface/overlay.h"

#include <fmt/core.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec4.hpp>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace sward::view {
namespace {

constexpr int circlePieces = 40;
constexpr double nearestDepth = 1e-3; ///< [m] near clipping depth
constexpr int arrowsAcross = 5;       ///< wind arrows along each side of the field

} // namespace

Overlay::Overlay(const Style& style, const render::Camera& camera, glm::uvec2 size,
                 const ShownField& field)
    : style_(style)
    , camera_(camera)
    , size_(size)
    , origin_(field.view.origin)
    , content_(field.summary.bounds)
    , clip_(render::viewMatrices(camera, origin_, size, content_).viewProjection)
{
}

void Overlay::draw(const ViewerState& state) const
{
    if (state.showWindArrows)
        drawWinds(state);
    if (state.showColliders)
        for (std::size_t i = 0; i < state.settings.colliders.size(); ++i)
            drawCollider(state.settings.colliders[i], state.time.now, i == state.hand.chosen);
    if (state.settings.cullingCamera)
        drawFrustum(*state.settings.cullingCamera);
    if (state.picked)
        drawPicked(*state.picked);
    drawRings(state);
}

glm::dvec2 Overlay::onScreen(const glm::dvec4& clip) const
{
    return (glm::dvec2(clip.x, clip.y) / clip.w * 0.5 + 0.5) * size_;
}

void Overlay::tell(const ViewerState& state, ControlMap& map) const
{
    for (std::size_t i = 0; i < state.settings.colliders.size(); ++i) {
        const glm::dvec3 middle = middleOf(state.settings.colliders[i], state.time.now);
        const glm::dvec4 clip = clip_ * glm::dvec4(middle - origin_, 1.0);
        if (clip.w < nearestDepth)
            continue;
        const glm::vec2 place(onScreen(clip));
        map.add(fmt::format("Picture/Collider {}", i + 1),
                {place.x, place.y, 0.0f, 0.0f, {}, {}, {}});
    }
}

void Overlay::line(const glm::dvec3& from, const glm::dvec3& to, ImU32 color, float width) const
{
    // w is the view depth: clip parts behind the eye.
    glm::dvec4 a = clip_ * glm::dvec4(from - origin_, 1.0);
    glm::dvec4 b = clip_ * glm::dvec4(to - origin_, 1.0);
    if (a.w < nearestDepth && b.w < nearestDepth)
        return;
    if (a.w < nearestDepth)
        a += (b - a) * ((nearestDepth - a.w) / (b.w - a.w));
    if (b.w < nearestDepth)
        b += (a - b) * ((nearestDepth - b.w) / (a.w - b.w));
    const auto point = [this](const glm::dvec4& clip) {
        const glm::dvec2 at = onScreen(clip);
        return ImVec2(static_cast<float>(at.x), static_cast<float>(at.y));
    };
    ImGui::GetBackgroundDrawList()->AddLine(point(a), point(b), color, style_.scaled(width));
}

void Overlay::circle(const glm::dvec3& centre, const glm::dvec3& right, const glm::dvec3& up,
                     ImU32 color) const
{
    glm::dvec3 before = centre + right;
    for (int i = 1; i <= circlePieces; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / circlePieces;
        const glm::dvec3 place = centre + right * std::cos(angle) + up * std::sin(angle);
        line(before, place, color, 1.5f);
        before = place;
    }
}

void Overlay::drawCollider(const render::Collider& collider, double time, bool chosen) const
{
    const ImU32 color = style_.packed(chosen ? palette::warm : palette::cool, 0.9f);
    const glm::dvec3 move = render::moveAt(collider, time);
    const glm::dvec3 from = collider.from + move;
    const glm::dvec3 to = collider.to + move;
    const double r = collider.radius;
    for (const glm::dvec3& centre : {from, to}) {
        circle(centre, {r, 0.0, 0.0}, {0.0, r, 0.0}, color);
        circle(centre, {0.0, r, 0.0}, {0.0, 0.0, r}, color);
        circle(centre, {r, 0.0, 0.0}, {0.0, 0.0, r}, color);
        if (from == to)
            return;
    }
    const glm::dvec3 along = glm::normalize(to - from);
    const glm::dvec3 other =
        std::abs(along.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 right = glm::normalize(glm::cross(along, other)) * r;
    const glm::dvec3 up = glm::cross(right, along);
    for (const glm::dvec3& side : {right, -right, up, -up})
        line(from + side, to + side, color, 1.5f);
}

void Overlay::drawWinds(const ViewerState& state) const
{
    if (content_.isEmpty())
        return;
    const glm::dvec3 low(content_.low);
    const glm::dvec3 size(content_.size());
    const double length = 0.4 * std::max(size.x, size.z) / arrowsAcross;
    for (std::size_t i = 0; i < state.settings.winds.size(); ++i) {
        const render::WindSource& wind = state.settings.winds[i];
        const render::WindPattern& s = wind.source;
        if (s.strength <= 0.0f)
            continue;
        const bool isRound = s.kind == render::windRadial || s.kind == render::windSwirl;
        const ImU32 color = style_.packed(i % 2 == 0 ? palette::text : palette::warm, 0.85f);
        for (int x = 0; x < arrowsAcross; ++x)
            for (int z = 0; z < arrowsAcross; ++z) {
                const glm::dvec3 share((x + 0.5) / arrowsAcross, 1.05, (z + 0.5) / arrowsAcross);
                const glm::dvec3 place = origin_ + low + share * size;
                glm::dvec3 way = isRound ? place - wind.centre : glm::dvec3(s.direction);
                way = glm::length(way) > 1e-9 ? glm::normalize(way) : glm::dvec3(1.0, 0.0, 0.0);
                const glm::dvec3 end = place + way * length;
                const glm::dvec3 side =
                    glm::cross(way, glm::normalize(camera_.eye - place)) * (0.12 * length);
                line(place, end, color, 2.0f);
                line(end, end - way * (0.25 * length) + side, color, 2.0f);
                line(end, end - way * (0.25 * length) - side, color, 2.0f);
            }
    }
}

void Overlay::drawFrustum(const render::Camera& frozen) const
{
    // Corners of its picture at the far end of the field.
    const glm::dvec3 ahead = glm::normalize(frozen.target - frozen.eye);
    glm::dvec3 right = glm::cross(ahead, glm::dvec3(frozen.up));
    if (glm::length(right) < 1e-9)
        return;
    right = glm::normalize(right);
    const glm::dvec3 up = glm::cross(right, ahead);
    const double height = std::tan(0.5 * glm::radians(static_cast<double>(frozen.fovY)));
    const double width = height * size_.x / size_.y;
    const double reach = content_.isEmpty() ? 10.0
                                            : glm::length(frozen.target - frozen.eye) +
                                                  0.5 * glm::length(glm::dvec3(content_.size()));
    const ImU32 color = style_.packed(palette::warm, 0.9f);
    const std::array<glm::dvec2, 4> corners{{{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}};
    const auto corner = [&](std::size_t i, double distance) {
        return frozen.eye +
               (ahead + right * (corners[i % 4].x * width) + up * (corners[i % 4].y * height)) *
                   distance;
    };
    for (std::size_t i = 0; i < 4; ++i) {
        line(frozen.eye, corner(i, reach), color, 1.5f);
        line(corner(i, reach), corner(i + 1, reach), color, 1.5f);
        line(corner(i, 0.1 * reach), corner(i + 1, 0.1 * reach), color, 1.0f);
    }
}

void Overlay::drawRings(const ViewerState& state) const
{
    // The first is the brush's radius, the second where its strength begins to fall.
    for (std::size_t i = 0; i < state.rings.size(); ++i)
        for (std::size_t k = 0; k + 1 < state.rings[i].size(); ++k)
            line(state.rings[i][k], state.rings[i][k + 1],
                 style_.packed(palette::warm, i == 0 ? 0.95f : 0.5f), i == 0 ? 2.0f : 1.0f);
}

void Overlay::drawPicked(const PickedBlade& picked) const
{
    constexpr int pieces = 12;
    const ImU32 color = style_.packed(palette::warm, 1.0f);
    glm::dvec3 before = picked.now.root;
    for (int i = 1; i <= pieces; ++i) {
        const double t = static_cast<double>(i) / pieces;
        const glm::dvec3 place = (1.0 - t) * (1.0 - t) * picked.now.root +
                                 2.0 * t * (1.0 - t) * picked.now.v1 + t * t * picked.now.v2;
        line(before, place, color, 2.5f);
        before = place;
    }
}

} // namespace sward::view
