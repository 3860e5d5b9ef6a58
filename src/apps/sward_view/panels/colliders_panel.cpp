#include "apps/sward_view/panels/panels.h"

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <optional>

namespace sward::view {
namespace {

void drawCollider(Controls& controls, ViewerState& state, render::Collider& collider)
{
    bool isCapsule = collider.from != collider.to;
    if (controls.toggle("Capsule", isCapsule, "A capsule has two ends, a ball one centre")) {
        if (isCapsule)
            collider.to = collider.from + glm::dvec3(3.0 * collider.radius, 0.0, 0.0);
        else
            collider.to = collider.from;
    }
    controls.number("Radius", collider.radius, {0.01f, 20.0f, "m", "%.2f", true},
                    "Radius of the ball or of the capsule's ends");
    const glm::dvec3 from = collider.from;
    if (controls.place(isCapsule ? "From" : "Centre", collider.from, "Position at rest") &&
        !isCapsule)
        collider.to += collider.from - from;
    if (isCapsule)
        controls.place("To", collider.to, "Position of the other end");
    if (!collider.path.empty() &&
        controls.button("Stop", "Ends its motion where it is now", true)) {
        const glm::dvec3 way = render::moveAt(collider, state.time.now);
        collider.from += way;
        collider.to += way;
        collider.path.clear();
    }
}

} // namespace

void drawCollidersPanel(Controls& controls, ViewerState& state)
{
    std::vector<render::Collider>& colliders = state.settings.colliders;
    controls.fact("Colliders", fmt::format("{} of {}", colliders.size(), render::maxColliders),
                  "Number of colliders, at most 256; they press blades down");
    ImGui::BeginDisabled(state.field == nullptr || colliders.size() >= render::maxColliders);
    const bool ball = controls.button("Add ball", "A ball on the ground where the camera looks");
    ImGui::SameLine();
    const bool capsule =
        controls.button("Add capsule", "A capsule on the ground where the camera looks");
    ImGui::EndDisabled();
    if (ball || capsule) {
        state.requests.addCapsule = capsule;
    }
    controls.toggle("Outlines", state.showColliders,
                    "Draws the outlines of colliders over the picture");
    controls.note(
        "Drag a collider with the left mouse button: it follows the ground. Released while "
        "it moves, it rolls on.");

    std::optional<std::size_t> removed;
    for (std::size_t i = 0; i < colliders.size(); ++i) {
        const char* kind = colliders[i].from == colliders[i].to ? "Ball" : "Capsule";
        const std::string name = fmt::format("{} {}", kind, i + 1);
        if (ImGui::Selectable(name.c_str(), state.hand.chosen == i))
            state.hand.chosen = i;
        const glm::dvec3 place = middleOf(colliders[i], state.time.now);
        controls.tell(fmt::format("Collider {}", i + 1).c_str(),
                      fmt::format("{:.3f} {:.3f} {:.3f}", place.x, place.y, place.z),
                      "Selects this collider");
    }
    if (state.hand.chosen >= colliders.size())
        return;
    controls.section("Selected");
    drawCollider(controls, state, colliders[state.hand.chosen]);
    if (controls.button("Remove", "Removes the selected collider", true))
        removed = state.hand.chosen;
    if (removed) {
        colliders.erase(colliders.begin() + static_cast<std::ptrdiff_t>(*removed));
        state.hand.forget();
    }
}

} // namespace sward::view
