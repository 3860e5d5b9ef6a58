#include "bake/settings/stroke_file.h"

#include "core/error.h"
#include "core/files/mapped_file.h"
#include "core/json/json_text.h"
#include "core/json/settings_json.h"
#include "core/random.h"

#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sward::bake {
namespace {

using nlohmann::json;

constexpr std::string_view strokeFormat = "sward strokes ";
constexpr std::string_view strokeVersion = "1";
constexpr std::size_t strokeFileLimit = std::size_t(64) << 20;

constexpr std::array<std::string_view, 9> kindNames{
    "add", "erase", "set", "smooth", "species", "height", "dryness", "trodden", "clear"};

// The key of a kind's value and its range; an empty key if the kind has none.
struct ValueKey {
    const char* key;
    double usual;
    double low;
    double high;
};

ValueKey valueKeyOf(StrokeKind kind)
{
    switch (kind) {
    case StrokeKind::add:
        return {"ceiling", 1.0, 0.0, maxPaintedDensity};
    case StrokeKind::set:
        return {"density", 1.0, 0.0, maxPaintedDensity};
    case StrokeKind::height:
        return {"factor", 1.0, lowestPaint, highestPaint};
    case StrokeKind::dryness:
        return {"share", 1.0, 0.0, 1.0};
    case StrokeKind::trodden:
        return {"height", 0.4, lowestPaint, 1.0};
    case StrokeKind::erase:
    case StrokeKind::smooth:
    case StrokeKind::species:
    case StrokeKind::clear:
        break;
    }
    return {"", 1.0, 0.0, 0.0};
}

double numberIn(const json& value, double low, double high, const std::string& place)
{
    const double number =
        value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
    if (!(number >= low && number <= high))
        fail(ErrorKind::input, "{}: {} is no number in [{}, {}]", place,
             value.is_number() ? jsonText(value) : value.type_name(), low, high);
    return number;
}

// Reads vectors of three numbers in [-high, high], times `scale` and rounded.
template <typename Int>
std::vector<std::array<Int, 3>> readVectors(const json& list, double high, double scale,
                                            std::size_t most, const std::string& place)
{
    if (!list.is_array() || list.empty())
        fail(ErrorKind::input, "{}: is no list of [x, y, z]", place);
    if (list.size() > most)
        fail(ErrorKind::input, "{}: has {} entries, more than {} in all strokes together", place,
             list.size(), maxStrokePoints);
    std::vector<std::array<Int, 3>> vectors;
    vectors.reserve(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
        const json& entry = list[i];
        if (!entry.is_array() || entry.size() != 3)
            fail(ErrorKind::input, "{}[{}]: is not [x, y, z]", place, i);
        std::array<Int, 3> vector{};
        for (std::size_t axis = 0; axis < 3; ++axis)
            vector[axis] = static_cast<Int>(std::llround(
                scale * numberIn(entry[axis], -high, high, fmt::format("{}[{}]", place, i))));
        vectors.push_back(vector);
    }
    return vectors;
}

void readNormals(SettingsReader& reader, Stroke& stroke)
{
    const std::string place = reader.placeOf("normals");
    stroke.normals =
        readVectors<std::int16_t>(reader.child("normals"), 2.0, 1000.0, maxStrokePoints, place);
    if (stroke.normals.size() != 1 && stroke.normals.size() != stroke.points.size())
        fail(ErrorKind::input, "{}: has {} entries for {} points; expected one for each, or one",
             place, stroke.normals.size(), stroke.points.size());
    for (std::size_t i = 0; i < stroke.normals.size(); ++i) {
        double squared = 0.0;
        for (const std::int16_t c : stroke.normals[i])
            squared += double(c) * double(c) * 1e-6;
        if (!(squared >= 0.25 && squared <= 4.0))
            fail(ErrorKind::input, "{}[{}]: is {:.3g} long, outside [0.5, 2]", place, i,
                 std::sqrt(squared));
    }
}

Stroke readStroke(const json& object, std::size_t room, const std::string& place)
{
    if (!object.is_object())
        fail(ErrorKind::input, "{}: is no stroke, which is an object", place);
    Stroke stroke;
    SettingsReader reader(object, place);
    if (!reader.has("kind"))
        fail(ErrorKind::input, "{}: kind is missing; expected one of {}", place,
             fmt::join(kindNames, ", "));
    stroke.kind = static_cast<StrokeKind>(reader.readWord("kind", kindNames, 0));
    reader.read("name", stroke.name);
    if (stroke.name.size() > longestStrokeName)
        fail(ErrorKind::input, "{}: name: has {} bytes, more than {}", place, stroke.name.size(),
             longestStrokeName);
    reader.read("radius_m", stroke.radius, shortestRadius, longestRadius);
    reader.read("hardness", stroke.hardness, 0.0, 1.0);
    reader.read("strength", stroke.strength, 0.0, 1.0);
    if (reader.has("depth_m"))
        reader.read("depth_m", stroke.depth, shortestRadius, longestRadius);
    const ValueKey value = valueKeyOf(stroke.kind);
    stroke.value = value.usual;
    if (*value.key != '\0')
        reader.read(value.key, stroke.value, value.low, value.high);
    if (stroke.kind == StrokeKind::trodden)
        reader.read("lean", stroke.lean, 0.0, 1.0);
    if (stroke.kind == StrokeKind::species) {
        reader.read("species", stroke.species);
        if (stroke.species.empty())
            fail(ErrorKind::input, "{}: species is missing or empty", place);
    }
    if (!reader.has("points"))
        fail(ErrorKind::input, "{}: points are missing", place);
    stroke.points = readVectors<std::int64_t>(reader.child("points"), farthestPoint, 1000.0, room,
                                              reader.placeOf("points"));
    if (reader.has("normals"))
        readNormals(reader, stroke);
    reader.finish();
    return stroke;
}

void requireFormat(const json& object, const std::string& place)
{
    const auto format = object.is_object() ? object.find("format") : object.end();
    if (!object.is_object() || format == object.end() || !format->is_string() ||
        !format->get_ref<const std::string&>().starts_with(strokeFormat))
        fail(ErrorKind::input, "{}: is no stroke file: \"format\": \"{}{}\" is missing", place,
             strokeFormat, strokeVersion);
    const auto& text = format->get_ref<const std::string&>();
    if (text.substr(strokeFormat.size()) != strokeVersion)
        fail(ErrorKind::unsupported, "{}: is \"{}\", not \"{}{}\"", place, text, strokeFormat,
             strokeVersion);
}

template <typename Int>
std::string vectorsText(const std::vector<std::array<Int, 3>>& vectors)
{
    std::string text = "[";
    for (std::size_t i = 0; i < vectors.size(); ++i)
        text += fmt::format("{}[{},{},{}]", i > 0 ? "," : "", double(vectors[i][0]) / 1000.0,
                            double(vectors[i][1]) / 1000.0, double(vectors[i][2]) / 1000.0);
    return text + "]";
}

std::string strokeText(const Stroke& stroke, bool withName)
{
    std::string text = fmt::format(R"({{"kind":"{}")", nameOf(stroke.kind));
    if (withName && !stroke.name.empty())
        text += fmt::format(R"(,"name":{})", jsonText(json(stroke.name)));
    text += fmt::format(R"(,"radius_m":{},"hardness":{},"strength":{})", stroke.radius,
                        stroke.hardness, stroke.strength);
    if (stroke.depth > 0.0)
        text += fmt::format(R"(,"depth_m":{})", stroke.depth);
    if (const ValueKey value = valueKeyOf(stroke.kind); *value.key != '\0')
        text += fmt::format(R"(,"{}":{})", value.key, stroke.value);
    if (stroke.kind == StrokeKind::trodden)
        text += fmt::format(R"(,"lean":{})", stroke.lean);
    if (stroke.kind == StrokeKind::species)
        text += fmt::format(R"(,"species":{})", jsonText(json(stroke.species)));
    text += R"(,"points":)" + vectorsText(stroke.points);
    if (!stroke.normals.empty())
        text += R"(,"normals":)" + vectorsText(stroke.normals);
    return text + "}";
}

std::string fileText(const Strokes& strokes, bool withNames)
{
    std::string text =
        fmt::format("{{\"format\":\"{}{}\",\"strokes\":[", strokeFormat, strokeVersion);
    for (std::size_t i = 0; i < strokes.list.size(); ++i)
        text += (i > 0 ? ",\n" : "\n") + strokeText(strokes.list[i], withNames);
    return text + "\n]}\n";
}

} // namespace

const char* nameOf(StrokeKind kind)
{
    return kindNames[static_cast<std::size_t>(kind)].data();
}

Strokes parseStrokes(std::string_view text, const std::string& place)
{
    const json object = parseJson(text, place);
    requireFormat(object, place);
    SettingsReader reader(object, place);
    reader.has("format");
    if (!reader.has("strokes") || !reader.child("strokes").is_array())
        fail(ErrorKind::input, "{}: strokes: is no list", place);
    const json& list = reader.child("strokes");
    reader.finish();
    if (list.size() > maxStrokes)
        fail(ErrorKind::input, "{}: strokes: has {} strokes, more than {}", place, list.size(),
             maxStrokes);
    Strokes strokes;
    strokes.file = place;
    strokes.list.reserve(list.size());
    std::size_t room = maxStrokePoints;
    for (std::size_t i = 0; i < list.size(); ++i) {
        strokes.list.push_back(readStroke(list[i], room, fmt::format("{}: strokes[{}]", place, i)));
        room -= strokes.list.back().points.size();
    }
    return strokes;
}

void requireStrokeCount(const Strokes& strokes, const std::string& place)
{
    if (strokes.list.size() > maxStrokes)
        fail(ErrorKind::input, "{}: {} strokes, more than {}", place, strokes.list.size(),
             maxStrokes);
    std::size_t points = 0;
    for (const Stroke& stroke : strokes.list)
        points += stroke.points.size();
    if (points > maxStrokePoints)
        fail(ErrorKind::input, "{}: {} points in all strokes, more than {}", place, points,
             maxStrokePoints);
}

Strokes loadStrokes(const std::filesystem::path& path)
{
    const std::vector<std::byte> bytes = readFile(path, strokeFileLimit);
    return parseStrokes({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path.string());
}

std::string toJson(const Strokes& strokes)
{
    return fileText(strokes, true);
}

std::string textOf(const Stroke& stroke)
{
    return strokeText(stroke, true);
}

std::string hashOf(const Strokes& strokes)
{
    if (strokes.empty())
        return {};
    const std::string text = fileText(strokes, false);
    std::uint64_t digest = text.size();
    for (const char c : text)
        digest = hashBits(digest, static_cast<unsigned char>(c));
    return fmt::format("{:016x}", digest);
}

void resolveSpecies(Strokes& strokes, std::span<const std::string> names)
{
    for (std::size_t i = 0; i < strokes.list.size(); ++i) {
        Stroke& stroke = strokes.list[i];
        if (stroke.kind != StrokeKind::species)
            continue;
        const auto found = std::find(names.begin(), names.end(), stroke.species);
        if (found == names.end())
            fail(ErrorKind::input, "{}: strokes[{}]: species: the meadow has no \"{}\"; it has {}",
                 strokes.file, i, stroke.species, fmt::join(names, ", "));
        stroke.slot = static_cast<std::uint32_t>(found - names.begin());
    }
}

} // namespace sward::bake
