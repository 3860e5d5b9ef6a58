#include "apps/sward_view/scene/camera_path.h"

#include "apps/sward_view/scene/camera_file.h"
#include "core/error.h"
#include "core/expect.h"
#include "core/files/mapped_file.h"
#include "core/json/json_text.h"
#include "core/json/settings_json.h"

#include <fmt/core.h>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace sward::view {
namespace {

constexpr std::size_t largestPathFile = 1u
                                        << 24; ///< [bytes] an hour at 10 places a second takes 7 MB
constexpr std::size_t maxStops = 200'000;
constexpr double longest = 1e9; ///< [s]

// Cubic Hermite curve through `a` and `b` at share `s`, with slopes from their neighbours (Catmull
// & Rom 1974, for non-uniform times).
template <typename V>
V curve(const V& before, const V& a, const V& b, const V& after, const double (&times)[4], double s)
{
    const double span = times[2] - times[1];
    const auto slope = [span](const V& low, const V& high, double duration) {
        return duration > 0.0 ? (high - low) * (span / duration) : V(0.0);
    };
    const V out = slope(before, b, times[2] - times[0]);
    const V in = slope(a, after, times[3] - times[1]);
    const double s2 = s * s;
    const double s3 = s2 * s;
    return a * (2.0 * s3 - 3.0 * s2 + 1.0) + out * (s3 - 2.0 * s2 + s) + b * (3.0 * s2 - 2.0 * s3) +
           in * (s3 - s2);
}

} // namespace

void CameraPath::add(double time, const render::Camera& camera)
{
    expect(stops_.empty() || time > stops_.back().time, "places of a path follow one another");
    stops_.push_back({time, camera});
}

render::Camera CameraPath::at(double time) const
{
    expect(!stops_.empty(), "a path has a place");
    const auto next = std::find_if(stops_.begin(), stops_.end(),
                                   [time](const Stop& stop) { return stop.time >= time; });
    if (next == stops_.begin())
        return next->camera;
    if (next == stops_.end())
        return stops_.back().camera;

    const Stop& b = *next;
    const Stop& a = *(next - 1);
    const Stop& before = next - 1 == stops_.begin() ? a : *(next - 2);
    const Stop& after = next + 1 == stops_.end() ? b : *(next + 1);
    const double times[4] = {before.time, a.time, b.time, after.time};
    const double s = (time - a.time) / (b.time - a.time);
    render::Camera camera = a.camera;
    camera.eye = curve(before.camera.eye, a.camera.eye, b.camera.eye, after.camera.eye, times, s);
    camera.target = curve(before.camera.target, a.camera.target, b.camera.target,
                          after.camera.target, times, s);
    camera.up = glm::mix(a.camera.up, b.camera.up, static_cast<float>(s));
    camera.fovY = glm::mix(a.camera.fovY, b.camera.fovY, static_cast<float>(s));
    return camera;
}

CameraPath readCameraPath(const std::filesystem::path& path, glm::vec3 up)
{
    const std::vector<std::byte> bytes = readFile(path, largestPathFile);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return readCameraPath(text, path.string(), up);
}

CameraPath readCameraPath(std::string_view text, const std::string& name, glm::vec3 up)
{
    const nlohmann::json json = parseJson(text, name);
    if (!json.is_array()) {
        SettingsReader reader(json, name);
        return CameraPath(readCamera(reader, name, up));
    }
    if (json.empty() || json.size() > maxStops)
        fail(ErrorKind::input, "{}: {} places; a path has 1 to {}", name, json.size(), maxStops);
    CameraPath result;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const std::string place = fmt::format("{}[{}]", name, i);
        SettingsReader reader(json[i], place);
        if (!reader.has("time"))
            fail(ErrorKind::input, "{}: missing", reader.placeOf("time"));
        double time = 0.0;
        reader.read("time", time, -longest, longest);
        if (!result.isEmpty() && time <= result.end())
            fail(ErrorKind::input, "{}: {} is not later than the place before",
                 reader.placeOf("time"), time);
        result.add(time, readCamera(reader, place, up));
    }
    return result;
}

std::string cameraPathText(const CameraPath& path, double step)
{
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    const auto count = static_cast<std::size_t>(std::floor(path.end() / step + 0.5)) + 1;
    for (std::size_t i = 0; i < count; ++i) {
        const double time = static_cast<double>(i) * step;
        const render::Camera c = path.at(time);
        // Round below the precision of the recording: 1e-5 s and 1e-5 m.
        const auto rounded = [](double value) { return std::round(value * 1e5) / 1e5; };
        json.push_back({{"time", rounded(time)},
                        {"eye", {rounded(c.eye.x), rounded(c.eye.y), rounded(c.eye.z)}},
                        {"target", {rounded(c.target.x), rounded(c.target.y), rounded(c.target.z)}},
                        {"up", {c.up.x, c.up.y, c.up.z}},
                        {"fov_y_deg", c.fovY}});
    }
    std::string text = "[\n";
    for (std::size_t i = 0; i < json.size(); ++i)
        text += jsonText(json[i]) + (i + 1 < json.size() ? ",\n" : "\n");
    return text + "]\n";
}

} // namespace sward::view
