#include "apps/lidar/lidar_options.h"

#include "apps/common/parse_text.h"
#include "apps/lidar/beam_file.h"
#include "core/error.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <string_view>

namespace sward::apps {
namespace {

constexpr double widestLidarPlace = 1e12; // [m]
constexpr double farthestRange = 1e7;     // [m]
constexpr std::uint32_t maxRings = 4096, maxColumns = 1u << 24;

glm::vec3 lidarUp(const field::FieldView& view)
{
    const glm::vec3 down = view.defaults->gravityDirection;
    return glm::length(down) > 0.0f ? -glm::normalize(down) : glm::vec3(0.0f, 1.0f, 0.0f);
}

// "A:B" in degrees, within bounds, as radians.
glm::vec2 parseAngles(const char* option, const std::string& text, double low, double high)
{
    const auto [from, to] = parseRange(option, text);
    if (from < low || to > high)
        fail(ErrorKind::usage, "{}: {} is beyond {:g}:{:g}", option, text, low, high);
    return glm::radians(glm::vec2(glm::dvec2(from, to)));
}

} // namespace

void LidarOptions::add(CLI::App& app, bool mustWrite, const char* standing)
{
    app.add_option("FIELD", field, "Field file")->type_name("")->required();
    CLI::Option* const out =
        app.add_option("-o,--output", output, "Points to write: .ply, .npy or .las")
            ->type_name("OUT")
            ->required(mustWrite);
    if (!mustWrite)
        out->default_str("none, only counts and rates");
    app.add_option(
           "--blades", poses,
           "How the blades stand: a file of 'sward-view render --dump-blades' of this field")
        ->type_name("FILE.csv")
        ->default_str(standing);
    app.add_option("--threads", threads, "Number of threads; 0: one for each CPU")
        ->type_name("N")
        ->check(CLI::Range(0, 1024).description(""))
        ->capture_default_str();
    app.add_flag("--force", overwrite, "Replace an existing file");
    addPattern(app);
    addSensor(app);
}

void LidarOptions::addPattern(CLI::App& app)
{
    const auto parsed = [&app](const char* name, const char* type, const char* text, auto&& take) {
        return app.add_option_function<std::string>(name, take, text)
            ->type_name(type)
            ->group("Beams");
    };
    app.add_option("--beams", beams,
                   "Beams of a file: N x 6 numbers x y z dx dy dz of the world, .npy or .csv")
        ->type_name("FILE")
        ->group("Beams");
    parsed("--scanner", "X,Y,Z", "A sensor that turns, at this place; X,Z with --above",
           [this](const std::string& text) {
               place_.clear();
               const std::vector<std::string_view> parts = splitText(text, ',');
               if (parts.size() != 2 && parts.size() != 3)
                   fail(ErrorKind::usage,
                        "--scanner: '{}' is not two or three numbers; write them like 1,2.5,-3",
                        text);
               for (const std::string_view part : parts)
                   place_.push_back(
                       parseNumber("--scanner", part, -widestLidarPlace, widestLidarPlace));
           });
    parsed("--above", "METRES", "Height of the scanner above the ground at its X,Z, 0 to 1e6",
           [this](const std::string& text) { above_ = parseNumber("--above", text, 0.0, 1e6); });
    parsed("--elevation", "A:B",
           "Angles of the scanner's lowest and highest ring, in degrees; one ring is midway",
           [this](const std::string& text) {
               spinning_.elevation = parseAngles("--elevation", text, -90.0, 90.0);
           })
        ->default_str("-25:15");
    parsed("--azimuth", "A:B",
           "Its turn in degrees from +X towards -Z: the first step is at A, the last before B",
           [this](const std::string& text) {
               spinning_.azimuth = parseAngles("--azimuth", text, -360.0, 360.0);
           })
        ->default_str("0:360");
    app.add_option("--rings", spinning_.rings, "Rings of the scanner, 1 to 4096")
        ->type_name("N")
        ->group("Beams")
        ->check(CLI::Range(1u, maxRings).description(""))
        ->capture_default_str();
    app.add_option("--columns", spinning_.columns, "Steps of its turn, 1 to 16777216")
        ->type_name("N")
        ->group("Beams")
        ->check(CLI::Range(1u, maxColumns).description(""))
        ->capture_default_str();
    parsed("--airborne", "METRES",
           "Parallel beams from this height above the whole field, downwards",
           [this](const std::string& text) {
               airborne_.height = parseNumber("--airborne", text, 0.01, 1e6);
               isAirborne_ = true;
           });
    parsed("--spacing", "METRES", "Distance between the airborne beams, 0.0001 to 1000",
           [this](const std::string& text) {
               airborne_.spacing = parseNumber("--spacing", text, 1e-4, 1e3);
           })
        ->default_str("0.1");
    parsed("--sweep", "DEGREES",
           "Angle to which airborne beams fan out on both sides of lines of flight along X, 0 to "
           "60; 0: all are parallel",
           [this](const std::string& text) {
               airborne_.sweep =
                   static_cast<float>(glm::radians(parseNumber("--sweep", text, 0.0, 60.0)));
           })
        ->default_str("0");
    parsed("--tilt", "DEGREES", "Angle of the airborne beams from straight down, -80 to 80",
           [this](const std::string& text) {
               airborne_.tilt =
                   static_cast<float>(glm::radians(parseNumber("--tilt", text, -80.0, 80.0)));
           })
        ->default_str("0");
    for (const char* name : {"--above", "--elevation", "--azimuth", "--rings", "--columns"})
        ownOptions_.push_back({app.get_option(name), "--scanner"});
    for (const char* name : {"--spacing", "--sweep", "--tilt"})
        ownOptions_.push_back({app.get_option(name), "--airborne"});
}

void LidarOptions::addSensor(CLI::App& app)
{
    const auto parsed = [&app](const char* name, const char* type, const char* text, auto&& take) {
        return app.add_option_function<std::string>(name, take, text)
            ->type_name(type)
            ->group("Sensor");
    };
    parsed("--divergence", "MRAD",
           "Full angle of a beam's cone in thousandths of a radian, 0 to 1000",
           [this](const std::string& text) {
               settings_.divergence =
                   static_cast<float>(1e-3 * parseNumber("--divergence", text, 0.0, 1000.0));
           })
        ->default_str("0.3");
    parsed("--exit-width", "METRES", "Width of a beam where it starts, 0 to 10",
           [this](const std::string& text) {
               settings_.exitWidth =
                   static_cast<float>(parseNumber("--exit-width", text, 0.0, 10.0));
           })
        ->default_str("0");
    app.add_option("--rays", settings_.rays,
                   "Rays of a beam, spread over its width, 1 to 4096; 1 is its axis")
        ->type_name("N")
        ->group("Sensor")
        ->check(CLI::Range(1u, 4096u).description(""))
        ->capture_default_str();
    app.add_option("--max-returns", settings_.maxReturns,
                   "Returns of a beam, the nearest first, 1 to 15")
        ->type_name("N")
        ->group("Sensor")
        ->check(CLI::Range(1u, 15u).description(""))
        ->capture_default_str();
    parsed("--resolution", "METRES",
           "What lies no farther behind the nearest is one return, 0 to 1000",
           [this](const std::string& text) {
               settings_.resolution =
                   static_cast<float>(parseNumber("--resolution", text, 0.0, 1000.0));
           })
        ->default_str("0.3");
    parsed("--range", "MIN:MAX", "Distances that give a return, in metres",
           [this](const std::string& text) {
               const auto [low, high] = parseRange("--range", text);
               if (low < 0.0 || high > farthestRange || !(low < high))
                   fail(ErrorKind::usage, "--range: {} is empty or beyond 0:{:g}", text,
                        farthestRange);
               settings_.nearest = static_cast<float>(low);
               settings_.farthest = static_cast<float>(high);
           })
        ->default_str("any");
    parsed("--leaf-reflectance", "[SPECIES=]F",
           "Reflectance of leaves at the sensor's wavelength, 0 to 1, of all or of a species; can "
           "be repeated",
           [this](const std::string& text) {
               const std::size_t equals = text.rfind('=');
               const std::string number =
                   equals == std::string::npos ? text : text.substr(equals + 1);
               const auto value =
                   static_cast<float>(parseNumber("--leaf-reflectance", number, 0.0, 1.0));
               if (equals == std::string::npos)
                   leaf_ = value;
               else
                   leafOf_.emplace_back(text.substr(0, equals), value);
           })
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->trigger_on_parse()
        ->default_str("0.45");
    parsed("--ground-reflectance", "F", "Reflectance of the ground, 0 to 1",
           [this](const std::string& text) {
               settings_.groundReflectance =
                   static_cast<float>(parseNumber("--ground-reflectance", text, 0.0, 1.0));
           })
        ->default_str("0.25");
}

void LidarOptions::check() const
{
    const int patterns = (beams.empty() ? 0 : 1) + (place_.empty() ? 0 : 1) + (isAirborne_ ? 1 : 0);
    if (patterns != 1)
        fail(ErrorKind::usage,
             "exactly one of --beams, --scanner and --airborne says where pulses go; here are {}",
             patterns);
    const char* const source = !beams.empty() ? "--beams"
                               : isAirborne_  ? "--airborne"
                                              : "--scanner";
    for (const OwnOption& own : ownOptions_)
        if (own.option->count() > 0 && std::string_view(own.source) != source)
            fail(ErrorKind::usage, "{} is of {}; here {} says where pulses go",
                 own.option->get_name(), own.source, source);
    if (!place_.empty() && (place_.size() == 2) != above_.has_value())
        fail(ErrorKind::usage, "--scanner takes X,Z with --above, and X,Y,Z without it");
    if (airborne_.sweep > 0.0f && airborne_.tilt != 0.0f)
        fail(ErrorKind::usage, "--sweep and --tilt are both given; beams fan out or are parallel");
}

lidar::LidarSettings LidarOptions::settingsFor(const field::FieldView& view) const
{
    lidar::LidarSettings settings = settings_;
    settings.leafReflectance.assign(view.species.size(), leaf_);
    for (const auto& [name, value] : leafOf_) {
        const auto found =
            std::find_if(view.species.begin(), view.species.end(),
                         [&, &name = name](const auto& species) { return species.name == name; });
        if (found == view.species.end()) {
            std::string known;
            for (const auto& species : view.species)
                known += (known.empty() ? "" : ", ") + species.name;
            fail(ErrorKind::usage, "--leaf-reflectance: the field has no species '{}'; it has {}",
                 name, known);
        }
        settings.leafReflectance[static_cast<std::size_t>(found - view.species.begin())] = value;
    }
    return settings;
}

lidar::Beams LidarOptions::beamsOver(const field::FieldView& view, const GroundAt& groundAt) const
{
    if (!beams.empty())
        return readBeams(beams);
    if (isAirborne_) {
        lidar::AirborneScanner scanner = airborne_;
        scanner.up = lidarUp(view);
        scanner.over = view.bounds();
        scanner.origin = view.origin;
        return beamsOf(scanner);
    }
    lidar::SpinningScanner scanner = spinning_;
    if (!above_) {
        scanner.up = lidarUp(view);
        scanner.place = {place_[0], place_[1], place_[2]};
        return beamsOf(scanner);
    }
    const std::optional<double> ground = groundAt(place_[0], place_[1]);
    if (!ground)
        fail(ErrorKind::usage, "--above: the field has no ground at {},{}", place_[0], place_[1]);
    scanner.place = {place_[0], *ground + *above_, place_[1]};
    return beamsOf(scanner);
}

} // namespace sward::apps
