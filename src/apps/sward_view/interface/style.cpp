#include "apps/sward_view/interface/style.h"

#include "core/embedded.h"
#include "core/expect.h"
#include "core/math/srgb.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>

namespace sward::embedded {
std::span<const EmbeddedFile> fonts();
} // namespace sward::embedded

namespace sward::view {
namespace {

constexpr float textSize = 15.0f;    ///< [pixels]
constexpr float headingSize = 19.0f; ///< [pixels]

// Latin letters, and the signs of units: micro, degree, squared, times, arrows and dashes.
constexpr std::array<ImWchar, 7> glyphs{0x0020, 0x00ff, 0x2010, 0x2027, 0x2190, 0x2193, 0};

ImFont* addFont(std::string_view name, float size)
{
    const std::span<const EmbeddedFile> files = embedded::fonts();
    const auto found = std::find_if(files.begin(), files.end(),
                                    [name](const EmbeddedFile& file) { return file.name == name; });
    expect(found != files.end(), "the interface's letters are part of the program");
    ImFontConfig config;
    config.FontDataOwnedByAtlas = false;
    config.OversampleH = 2;
    // ImGui takes a non-const pointer, but does not write to it.
    return ImGui::GetIO().Fonts->AddFontFromMemoryTTF(
        const_cast<unsigned char*>(found->bytes.data()), static_cast<int>(found->bytes.size()),
        size, &config, glyphs.data());
}

} // namespace

void Style::resize(const Scale& scale)
{
    scale_ = scale;
    ImGuiIO& io = ImGui::GetIO();
    io.Fonts->Clear();
    // The first font is ImGui's default. Each has as many pixels as the screen shows of it.
    addFont("Roboto-Regular.ttf", textSize * scale.interface);
    heading_ = addFont("Roboto-Medium.ttf", headingSize * scale.interface);
    io.FontGlobalScale = 1.0f / scale.density;
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle();
    style.WindowPadding = {16.0f, 14.0f};
    style.FramePadding = {8.0f, 4.0f};
    style.ItemSpacing = {8.0f, 7.0f};
    style.ItemInnerSpacing = {8.0f, 4.0f};
    style.ScrollbarSize = 10.0f;
    style.GrabMinSize = 10.0f;
    style.WindowBorderSize = 0.0f;
    style.FrameBorderSize = 0.0f;
    style.PopupBorderSize = 0.0f;
    style.WindowRounding = 0.0f;
    style.ChildRounding = 6.0f;
    style.FrameRounding = 5.0f;
    style.GrabRounding = 5.0f;
    style.PopupRounding = 6.0f;
    style.ScrollbarRounding = 5.0f;
    style.TabRounding = 5.0f;
    style.DisabledAlpha = 0.45f;
    style.ScaleAllSizes(scaled(1.0f));
    colors();
}

void Style::colors() const
{
    using namespace palette;
    auto& table = ImGui::GetStyle().Colors;
    for (ImVec4& entry : table)
        entry = color(raised);
    const auto set = [&](ImGuiCol which, std::uint32_t rgb, float alpha = 1.0f) {
        table[which] = color(rgb, alpha);
    };
    set(ImGuiCol_Text, text);
    set(ImGuiCol_TextDisabled, dim);
    set(ImGuiCol_TextSelectedBg, accent, 0.35f);
    set(ImGuiCol_WindowBg, panel, 0.985f);
    set(ImGuiCol_ChildBg, panel, 0.0f);
    set(ImGuiCol_PopupBg, raised, 0.98f);
    set(ImGuiCol_Border, hovered);
    set(ImGuiCol_BorderShadow, panel, 0.0f);
    set(ImGuiCol_FrameBgHovered, hovered);
    set(ImGuiCol_FrameBgActive, hovered);
    set(ImGuiCol_CheckMark, accent);
    set(ImGuiCol_SliderGrab, accent, 0.55f);
    set(ImGuiCol_SliderGrabActive, accent, 0.85f);
    set(ImGuiCol_ButtonHovered, hovered);
    set(ImGuiCol_ButtonActive, accent, 0.6f);
    set(ImGuiCol_Header, accent, 0.22f);
    set(ImGuiCol_HeaderHovered, accent, 0.32f);
    set(ImGuiCol_HeaderActive, accent, 0.42f);
    set(ImGuiCol_Separator, hovered);
    set(ImGuiCol_ScrollbarBg, panel, 0.0f);
    set(ImGuiCol_ScrollbarGrab, hovered);
    set(ImGuiCol_PlotLines, accent);
    set(ImGuiCol_PlotLinesHovered, text);
    set(ImGuiCol_PlotHistogram, accent);
    set(ImGuiCol_ModalWindowDimBg, panel, 0.6f);
    set(ImGuiCol_NavHighlight, accent);
}

ImVec4 Style::color(std::uint32_t rgb, float alpha) const
{
    const auto channel = [&](std::uint32_t shift) {
        return static_cast<float>((rgb >> shift) & 255u) / 255.0f;
    };
    return {channel(16), channel(8), channel(0), alpha};
}

ImU32 Style::packed(std::uint32_t rgb, float alpha) const
{
    return ImGui::ColorConvertFloat4ToU32(color(rgb, alpha));
}

glm::vec3 encodedColor(const glm::vec3& linear)
{
    const glm::vec3 clamped = glm::clamp(linear, glm::vec3(0.0f), glm::vec3(1.0f));
    return {encodedOf(clamped.x), encodedOf(clamped.y), encodedOf(clamped.z)};
}

glm::vec3 linearColor(const glm::vec3& encoded)
{
    const glm::vec3 clamped = glm::clamp(encoded, glm::vec3(0.0f), glm::vec3(1.0f));
    return {linearOf(clamped.x), linearOf(clamped.y), linearOf(clamped.z)};
}

ImU32 packedLinear(const glm::vec3& linear)
{
    const glm::vec3 encoded = encodedColor(linear);
    return ImGui::ColorConvertFloat4ToU32({encoded.x, encoded.y, encoded.z, 1.0f});
}

} // namespace sward::view
