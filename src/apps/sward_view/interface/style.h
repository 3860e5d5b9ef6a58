#pragma once

#include <glm/vec3.hpp>
#include <imgui.h>

#include <cstdint>

namespace sward::view {

/// Colours of the interface as 0xRRGGBB, sRGB.
namespace palette {
constexpr std::uint32_t panel = 0x15191a;
constexpr std::uint32_t raised = 0x232a2a;
constexpr std::uint32_t hovered = 0x303a39;
constexpr std::uint32_t text = 0xe4e8e1;
constexpr std::uint32_t dim = 0x93a09a;
constexpr std::uint32_t accent = 0x8fbf6a;
constexpr std::uint32_t warm = 0xe2b45c;
constexpr std::uint32_t alarm = 0xe0705a;
constexpr std::uint32_t cool = 0x6fb3d8;
} // namespace palette

/// Colours, spacings and fonts of the interface. Colours are sRGB; Interface converts what is drawn
/// for targets that take linear ones. Requires an ImGui context.
class Style {
public:
    /// Sizes of a text, in pixels of the screen, and of the window's coordinates.
    struct Scale {
        float interface = 1.0f; ///< pixels per pixel of an interface with 15-pixel text
        float density = 1.0f;   ///< pixels per unit of the window's coordinates

        bool operator==(const Scale&) const = default;
    };

    /// Sets spacings, and replaces the fonts in the ImGui context.
    void resize(const Scale& scale);

    /// `pixels` of an unscaled interface in the window's coordinates.
    float scaled(float pixels) const { return pixels * scale_.interface / scale_.density; }

    const Scale& scale() const { return scale_; }

    ImVec4 color(std::uint32_t rgb, float alpha = 1.0f) const;
    ImU32 packed(std::uint32_t rgb, float alpha = 1.0f) const;

    ImFont* heading() const { return heading_; }

private:
    void colors() const;

    Scale scale_;
    ImFont* heading_ = nullptr;
};

/// The sRGB encoding of a linear colour, at most white; and back.
glm::vec3 encodedColor(const glm::vec3& linear);
glm::vec3 linearColor(const glm::vec3& encoded);

/// A linear colour, at most white, as it is packed for drawing.
ImU32 packedLinear(const glm::vec3& linear);

} // namespace sward::view
