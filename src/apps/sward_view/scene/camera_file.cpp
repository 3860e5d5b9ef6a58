#include "apps/sward_view/scene/camera_file.h"

#include "core/error.h"
#include "core/files/mapped_file.h"
#include "core/json/settings_json.h"
#include "presentation/camera_presets.h"

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace sward::view {
namespace {

constexpr double largestPlace = 1e12;               ///< [m], far beyond the Moon
constexpr std::size_t largestCameraFile = 1u << 20; ///< [bytes] a camera takes a hundred
constexpr double alongUpCosine = 0.99999;           ///< within 0.25 degrees of the up-vector

// Checks that the view direction is nonzero and not parallel to up.
void checkDirections(const render::Camera& camera, const std::string& place)
{
    const glm::dvec3 view = camera.target - camera.eye;
    if (glm::length(view) < 1e-9)
        fail(ErrorKind::input, "{}: target: is the same place as eye", place);
    if (glm::length(camera.up) < 1e-9f)
        fail(ErrorKind::input, "{}: up: has no length", place);
    const glm::dvec3 up = glm::normalize(glm::dvec3(camera.up));
    if (std::abs(glm::dot(glm::normalize(view), up)) > alongUpCosine)
        fail(ErrorKind::input, "{}: up: is the direction of view; choose another one", place);
}

} // namespace

render::Camera readCamera(SettingsReader& reader, const std::string& place, glm::vec3 up)
{
    render::Camera camera;
    camera.up = up;
    for (const char* key : {"eye", "target"})
        if (!reader.has(key))
            fail(ErrorKind::input, "{}: missing", reader.placeOf(key));
    reader.read("eye", camera.eye, -largestPlace, largestPlace);
    reader.read("target", camera.target, -largestPlace, largestPlace);
    reader.read("up", camera.up, -1e6, 1e6);
    reader.read("fov_y_deg", camera.fovY, 0.01, 170.0);
    reader.finish();
    checkDirections(camera, place);
    return camera;
}

render::Camera readCamera(const std::filesystem::path& path, glm::vec3 up)
{
    const std::vector<std::byte> bytes = readFile(path, largestCameraFile);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const nlohmann::json json = parseJson(text, path.string());
    SettingsReader reader(json, path.string());
    return readCamera(reader, path.string(), up);
}

CameraPath chooseCamera(const std::string& name, const field::FieldView& field, float aspect,
                        glm::vec3 sunDirection)
{
    using presentation::CameraPreset;
    struct Named {
        const char* name;
        CameraPreset preset;
    };
    constexpr Named presets[] = {{"fit", CameraPreset::fit},
                                 {"eye", CameraPreset::eye},
                                 {"top", CameraPreset::top},
                                 {"edge", CameraPreset::edge}};
    const Named* found = std::find_if(std::begin(presets), std::end(presets),
                                      [&name](const Named& entry) { return name == entry.name; });
    if (found != std::end(presets))
        return CameraPath(presentation::presetCamera(
            found->preset, field,
            {.groundUp = groundUpOf(field), .aspect = aspect, .sunDirection = sunDirection}));

    // A word that is neither a preset nor a file is probably a misspelt preset.
    if (!std::filesystem::exists(name) && name.find_first_of("./") == std::string::npos)
        fail(ErrorKind::usage, "--camera: '{}' is not fit, eye, top or edge, and no such file",
             name);
    return readCameraPath(name, groundUpOf(field));
}

glm::vec3 groundUpOf(const field::FieldView& field)
{
    const glm::vec3 down = field.defaults->gravityDirection;
    return glm::length(down) > 0.0f ? -glm::normalize(down) : glm::vec3(0.0f, 1.0f, 0.0f);
}

} // namespace sward::view
