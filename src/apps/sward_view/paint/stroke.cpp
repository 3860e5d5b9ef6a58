#include "apps/sward_view/paint/stroke.h"

#include "apps/sward_view/paint/brush_values.h"
#include "core/error.h"
#include "core/files/mapped_file.h"
#include "core/json/json_check.h"
#include "core/json/json_text.h"

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sward::view {
namespace {

using nlohmann::json;

constexpr const char* strokesFormat = "sward strokes 1";
constexpr std::size_t largestStrokeFile = std::size_t(64) << 20; ///< [bytes]
constexpr double firstTolerance = 1.0 / 64.0;                    ///< of the radius …
constexpr double lastTolerance = 1.0 / 4.0;                      ///< … that points may be moved
constexpr double sameNormal = 0.999; ///< cosine of normals that are told once

// A number with three decimals at most, as short as it is.
std::string shortNumber(double value)
{
    std::string text = fmt::format("{:.3f}", value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.')
        text.pop_back();
    return text == "-0" ? "0" : text;
}

std::string triple(const glm::dvec3& v)
{
    return "[" + shortNumber(v.x) + "," + shortNumber(v.y) + "," + shortNumber(v.z) + "]";
}

double distanceToSegment(const glm::dvec3& place, const glm::dvec3& from, const glm::dvec3& to)
{
    const glm::dvec3 along = to - from;
    const double size = glm::dot(along, along);
    const double t = size > 0.0 ? std::clamp(glm::dot(place - from, along) / size, 0.0, 1.0) : 0.0;
    return glm::length(place - from - t * along);
}

// The keys of a brush: kind, size and its own value.
std::string brushKeys(const Brush& brush)
{
    std::string text =
        fmt::format("\"kind\":\"{}\",\"radius_m\":{},\"hardness\":{},\"strength\":{}",
                    paintKindNames[static_cast<std::size_t>(brush.kind)],
                    shortNumber(static_cast<double>(brush.radius)),
                    shortNumber(static_cast<double>(brush.hardness)),
                    shortNumber(static_cast<double>(brush.strength)));
    if (brush.kind == PaintKind::species)
        text += ",\"species\":" + jsonText(json(brush.species));
    for (const BrushValue& own : brushValues)
        if (own.kind == brush.kind)
            text += fmt::format(",\"{}\":{}", own.key,
                                shortNumber(static_cast<double>(brush.*own.value)));
    return text;
}

std::string textOfPoints(const Brush& brush, const std::vector<PaintPoint>& points)
{
    std::string text = "{" + brushKeys(brush) + ",\"points\":[";
    for (const PaintPoint& point : points)
        text += (&point == points.data() ? "" : ",") + triple(point.place);
    text += "],\"normals\":[";
    const bool isFlat = std::all_of(points.begin(), points.end(), [&points](const PaintPoint& one) {
        return glm::dot(one.normal, points.front().normal) >= sameNormal;
    });
    for (const PaintPoint& point : points) {
        text += (&point == points.data() ? "" : ",") + triple(point.normal);
        if (isFlat)
            break;
    }
    return text + "]}";
}

} // namespace

std::vector<PaintPoint> simplified(const std::vector<PaintPoint>& points, double tolerance)
{
    if (points.size() < 3)
        return points;
    // Douglas & Peucker, with a list of open pieces instead of recursion.
    std::vector<bool> stays(points.size(), false);
    stays.front() = stays.back() = true;
    std::vector<std::pair<std::size_t, std::size_t>> open{{0, points.size() - 1}};
    while (!open.empty()) {
        const auto [from, to] = open.back();
        open.pop_back();
        double most = tolerance;
        std::size_t farthest = from;
        for (std::size_t i = from + 1; i < to; ++i) {
            const double away =
                distanceToSegment(points[i].place, points[from].place, points[to].place);
            if (away > most) {
                most = away;
                farthest = i;
            }
        }
        if (farthest == from)
            continue;
        stays[farthest] = true;
        open.emplace_back(from, farthest);
        open.emplace_back(farthest, to);
    }
    std::vector<PaintPoint> kept;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (stays[i])
            kept.push_back(points[i]);
    return kept;
}

std::string strokeText(const Brush& brush, const std::vector<PaintPoint>& points)
{
    const auto radius = static_cast<double>(brush.radius);
    std::string text;
    for (double share = firstTolerance; share <= lastTolerance; share *= 2.0) {
        text = textOfPoints(brush, simplified(points, share * radius));
        if (text.size() <= strokeBytes)
            break;
    }
    return text;
}

std::string strokeFileText(const std::vector<std::string>& strokes)
{
    std::string text = fmt::format("{{\"format\":\"{}\",\"strokes\":[\n", strokesFormat);
    for (const std::string& stroke : strokes)
        text += stroke + (&stroke == &strokes.back() ? "\n" : ",\n");
    return text + "]}\n";
}

std::vector<std::string> readStrokeFile(const std::filesystem::path& path)
{
    const std::vector<std::byte> bytes = readFile(path, largestStrokeFile);
    const auto* const text = reinterpret_cast<const char*>(bytes.data());
    requireJson({text, bytes.size()}, path.string());
    const auto file = nlohmann::ordered_json::parse(text, text + bytes.size(), nullptr, false);
    const auto format = file.is_object() ? file.find("format") : file.end();
    const auto list = file.is_object() ? file.find("strokes") : file.end();
    if (!file.is_object() || format == file.end() || *format != strokesFormat ||
        list == file.end() || !list->is_array())
        fail(ErrorKind::input, "{}: not a file of the format \"{}\"", path.string(), strokesFormat);
    std::vector<std::string> strokes;
    for (const auto& stroke : *list)
        strokes.push_back(jsonText(stroke));
    return strokes;
}

std::string wordOfKind(const std::string& keyword)
{
    for (std::size_t i = 0; i < paintKinds; ++i)
        if (keyword == paintKindNames[i])
            return paintKindWords[i];
    return keyword;
}

double StrokeSketch::length() const
{
    double sum = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i)
        sum += glm::distance(points[i - 1].place, points[i].place);
    return sum;
}

glm::dvec3 StrokeSketch::middle() const
{
    if (points.empty())
        return glm::dvec3(0.0);
    glm::dvec3 low = points[0].place;
    glm::dvec3 high = low;
    for (const PaintPoint& point : points) {
        low = glm::min(low, point.place);
        high = glm::max(high, point.place);
    }
    return 0.5 * (low + high);
}

StrokeSketch sketchOf(std::string_view text)
{
    StrokeSketch sketch;
    const auto stroke = json::parse(text.begin(), text.end(), nullptr, false);
    if (!stroke.is_object())
        return sketch;
    const auto textUnder = [&stroke](const char* key) {
        const auto found = stroke.find(key);
        return found != stroke.end() && found->is_string() ? found->get<std::string>()
                                                           : std::string();
    };
    sketch.kind = textUnder("kind");
    sketch.name = textUnder("name");
    sketch.species = textUnder("species");
    if (const auto radius = stroke.find("radius_m"); radius != stroke.end() && radius->is_number())
        sketch.radius = radius->get<double>();
    const auto vectorsUnder = [&stroke](const char* key) {
        std::vector<glm::dvec3> vectors;
        const auto list = stroke.find(key);
        if (list == stroke.end() || !list->is_array())
            return vectors;
        for (const json& one : *list)
            if (one.is_array() && one.size() == 3 && one[0].is_number() && one[1].is_number() &&
                one[2].is_number())
                vectors.emplace_back(one[0].get<double>(), one[1].get<double>(),
                                     one[2].get<double>());
        return vectors;
    };
    const std::vector<glm::dvec3> normals = vectorsUnder("normals");
    for (const glm::dvec3& place : vectorsUnder("points")) {
        PaintPoint point{place, {0.0, 1.0, 0.0}};
        const std::size_t i = normals.size() == 1 ? 0 : sketch.points.size();
        if (i < normals.size() && glm::length(normals[i]) > 0.0)
            point.normal = glm::normalize(normals[i]);
        sketch.points.push_back(point);
    }
    return sketch;
}

std::string withName(const std::string& text, const std::string& name)
{
    const auto stroke = nlohmann::ordered_json::parse(text, nullptr, false);
    if (!stroke.is_object())
        return text;
    nlohmann::ordered_json named = nlohmann::ordered_json::object();
    for (const auto& [key, value] : stroke.items()) {
        if (key == "name")
            continue;
        named[key] = value;
        if (key == "kind" && !name.empty())
            named["name"] = name;
    }
    return jsonText(named);
}

} // namespace sward::view
