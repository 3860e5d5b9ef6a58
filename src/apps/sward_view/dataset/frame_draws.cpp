#include "apps/sward_view/dataset/frame_draws.h"

#include "apps/sward_view/scene/camera_file.h"
#include "core/error.h"
#include "core/random.h"
#include "render/frame/wind.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace sward::view {
namespace {

/// Dimensions of a frame's random numbers. Each keeps its number in all versions, so that a set can
/// be made again.
enum Dimension : std::uint32_t {
    ofField = 0,
    ofHeight = 1,
    ofPitch = 2,
    ofHeading = 3,
    ofRoll = 4,
    ofFovY = 5,
    ofSpeed = 6,
    ofTurn = 7,
    ofSunHeight = 8,
    ofSunHeading = 9,
    ofWind = 10,
    ofTime = 11,
    ofJitter = 12, ///< and the two after it
    ofPitchJitter = 15,
    ofHeadingJitter = 16,
    ofPlace = 32, ///< and all after it: three for each try
};

constexpr std::uint32_t maxTries = 4096; ///< to find ground in the scene's area
constexpr double steepestStand = 0.5;    ///< cosine of ground that a camera stands on

/// A vector turnedAbout about a unit axis.
glm::dvec3 turnedAbout(glm::dvec3 v, glm::dvec3 axis, double degrees)
{
    const double angle = glm::radians(degrees);
    return std::cos(angle) * v + std::sin(angle) * glm::cross(axis, v) +
           (1.0 - std::cos(angle)) * glm::dot(axis, v) * axis;
}

} // namespace

std::size_t fieldOfFrame(const DatasetScene& scene, std::uint64_t frame)
{
    const double share = uniform(scene.seed, frame, ofField);
    return std::min(static_cast<std::size_t>(share * double(scene.fields.size())),
                    scene.fields.size() - 1);
}

FrameDraws::FrameDraws(const DatasetScene& scene, const field::FieldView& field,
                       const render::FrameSettings& settings)
    : scene_(scene)
    , field_(field)
    , settings_(settings)
    , up_(glm::dvec3(groundUpOf(field)))
{
    // North is −z; where that is up or down, −x.
    glm::dvec3 north = glm::dvec3(0.0, 0.0, -1.0) + up_.z * up_;
    if (glm::length(north) < 1e-3)
        north = glm::dvec3(-1.0, 0.0, 0.0) + up_.x * up_;
    north_ = glm::normalize(north);
    east_ = glm::cross(north_, up_);
    if (!scene.path.empty()) {
        path_ = readCameraPath(std::filesystem::path(scene.path), glm::vec3(up_));
        return;
    }
    double sum = 0.0;
    const field::DisplayGround& ground = *field.ground;
    for (const field::GroundRange& range : ground.ranges) {
        if (range.level != 0)
            continue;
        for (std::uint32_t i = 0; i + 2 < range.indexCount; i += 3) {
            std::array<glm::dvec3, 3> corners{};
            for (std::uint32_t c = 0; c < 3; ++c)
                corners[c] =
                    glm::dvec3(ground.vertices[ground.indices[range.firstIndex + i + c]].position);
            const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
            if (glm::dot(normal, up_) < steepestStand * glm::length(normal) ||
                !(glm::length(normal) > 0.0))
                continue;
            sum += 0.5 * glm::length(normal);
            areas_.push_back(sum);
            triangles_.push_back(range.firstIndex + i);
        }
    }
    if (areas_.empty())
        fail(ErrorKind::input, "{}: cameras: no field has level ground for them to stand on",
             scene.file.string());
}

double FrameDraws::between(glm::dvec2 range, std::uint64_t frame, std::uint32_t dimension) const
{
    return glm::mix(range.x, range.y, uniform(scene_.seed, frame, dimension));
}

/// Level direction, clockwise from north.
glm::dvec3 FrameDraws::headingOf(double degrees) const
{
    return std::cos(glm::radians(degrees)) * north_ + std::sin(glm::radians(degrees)) * east_;
}

/// World place, uniform by area.
glm::dvec3 FrameDraws::placeOnGround(std::uint64_t frame) const
{
    const auto isWithin = [](const std::optional<glm::dvec2>& range, double value) {
        return !range || (range->x <= value && value <= range->y);
    };
    for (std::uint32_t i = 0; i < maxTries; ++i) {
        const auto number = [&](std::uint32_t n) {
            return uniform(scene_.seed, frame, ofPlace + 3 * i + n);
        };
        const auto found = std::ranges::upper_bound(areas_, number(0) * areas_.back());
        const std::size_t at =
            std::min(static_cast<std::size_t>(found - areas_.begin()), areas_.size() - 1);
        const std::uint32_t first = triangles_[at];
        const field::DisplayGround& ground = *field_.ground;
        const auto corner = [&](std::uint32_t c) {
            return glm::dvec3(ground.vertices[ground.indices[first + c]].position);
        };
        const double root = std::sqrt(number(1));
        const double share = number(2);
        const glm::dvec3 place = field_.origin + (1.0 - root) * corner(0) +
                                 root * (1.0 - share) * corner(1) + root * share * corner(2);
        if (isWithin(scene_.cameras.x, place.x) && isWithin(scene_.cameras.z, place.z))
            return place;
    }
    fail(ErrorKind::input,
         "{}: cameras: x_m and z_m: {} random places of the ground of {} lie "
         "outside",
         scene_.file.string(), maxTries, scene_.fields[fieldOfFrame(scene_, frame)]);
}

/// The camera `after` seconds after the frame.
render::Camera FrameDraws::onGround(std::uint64_t frame, double after) const
{
    const DatasetScene::Cameras& cameras = scene_.cameras;
    const double heading = between(cameras.heading, frame, ofHeading);
    const double pitch = between(cameras.pitch, frame, ofPitch);
    const glm::dvec3 forwards = headingOf(heading);
    const glm::dvec3 view = headingOf(heading + after * between(cameras.turn, frame, ofTurn));
    const glm::dvec3 direction =
        std::cos(glm::radians(pitch)) * view + std::sin(glm::radians(pitch)) * up_;
    render::Camera camera;
    camera.eye = placeOnGround(frame) + between(cameras.height, frame, ofHeight) * up_ +
                 after * between(cameras.speed, frame, ofSpeed) * forwards;
    camera.target = camera.eye + direction;
    camera.up = glm::vec3(turnedAbout(up_, direction, between(cameras.roll, frame, ofRoll)));
    camera.fovY = static_cast<float>(between(cameras.fovY, frame, ofFovY));
    return camera;
}

render::Camera FrameDraws::onPath(std::uint64_t frame, double after) const
{
    render::Camera camera = path_.at(std::max(double(frame) * scene_.pathStep + after, 0.0));
    const glm::dvec2 angles(-scene_.jitterAngle, scene_.jitterAngle);
    glm::dvec3 view = camera.target - camera.eye;
    const glm::dvec3 right = glm::cross(view, glm::dvec3(camera.up));
    if (glm::length(right) > 1e-9)
        view = turnedAbout(view, glm::normalize(right), between(angles, frame, ofPitchJitter));
    view = turnedAbout(view, up_, between(angles, frame, ofHeadingJitter));
    camera.target = camera.eye + view;
    return camera;
}

DrawnFrame FrameDraws::draw(std::uint64_t frame) const
{
    const auto cameraAt = [&](double after) {
        render::Camera camera = path_.isEmpty() ? onGround(frame, after) : onPath(frame, after);
        const glm::dvec2 ways(-scene_.jitter, scene_.jitter);
        const glm::dvec3 shift(between(ways, frame, ofJitter), between(ways, frame, ofJitter + 1),
                               between(ways, frame, ofJitter + 2));
        camera.eye += shift;
        camera.target += shift;
        return camera;
    };
    DrawnFrame drawn{.before = cameraAt(-scene_.step),
                     .camera = cameraAt(0.0),
                     .next = cameraAt(scene_.step),
                     .settings = settings_};
    drawn.time = between(scene_.time, frame, ofTime);
    if (scene_.sunHeight || scene_.sunHeading) {
        const glm::dvec3 stated = glm::normalize(glm::dvec3(settings_.sunDirection));
        const double height = scene_.sunHeight
                                  ? glm::radians(between(*scene_.sunHeight, frame, ofSunHeight))
                                  : std::asin(std::clamp(glm::dot(stated, up_), -1.0, 1.0));
        const double heading =
            scene_.sunHeading
                ? between(*scene_.sunHeading, frame, ofSunHeading)
                : glm::degrees(std::atan2(glm::dot(stated, east_), glm::dot(stated, north_)));
        drawn.settings.sunDirection =
            glm::vec3(std::cos(height) * headingOf(heading) + std::sin(height) * up_);
    }
    if (scene_.windStrength) {
        drawn.windStrength = between(*scene_.windStrength, frame, ofWind);
        render::scaleWind(drawn.settings.winds, static_cast<float>(drawn.windStrength));
    } else {
        drawn.windStrength = double(render::windStrength(drawn.settings.winds));
    }
    return drawn;
}

} // namespace sward::view
