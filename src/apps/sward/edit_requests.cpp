#include "apps/sward/edit_requests.h"

#include "apps/sward/edit_pick.h"
#include "apps/sward/files/output_files.h"
#include "bake/paint/stroke_contact.h"
#include "bake/paint/stroke_move.h"
#include "bake/settings/stroke_file.h"
#include "core/error_name.h"
#include "core/files/atomic_file.h"
#include "core/json/json_text.h"
#include "core/json/settings_json.h"
#include "field/delta.h"
#include "field/write.h"

#include <fmt/core.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <system_error>
#include <utility>

namespace sward::apps {
namespace {

using nlohmann::json;

constexpr const char* requestPlace = "request";

json errorAnswer(ErrorKind kind, const std::string& message)
{
    return {{"id", nullptr}, {"error", nameOf(kind)}, {"message", message}};
}

void requireKeys(const json& request, std::initializer_list<const char*> known)
{
    for (const auto& [key, value] : request.items())
        if (std::none_of(known.begin(), known.end(),
                         [&key = key](const char* name) { return key == name; }))
            fail(ErrorKind::usage, "{}: has no key \"{}\"", requestPlace, key);
}

std::string textOf(const json& request, const char* key)
{
    const auto found = request.find(key);
    if (found == request.end() || !found->is_string() || found->get<std::string>().empty())
        fail(ErrorKind::usage, "{}: {}: is no text", requestPlace, key);
    return found->get<std::string>();
}

bool switchOf(const json& request, const char* key)
{
    const auto found = request.find(key);
    if (found == request.end())
        return false;
    if (!found->is_boolean())
        fail(ErrorKind::usage, "{}: {}: is not true or false", requestPlace, key);
    return found->get<bool>();
}

} // namespace

json lostStrokes(const std::vector<bake::StrokeContact>& contacts, std::size_t first)
{
    json list = json::array();
    for (std::size_t i = 0; i < contacts.size(); ++i)
        if (const bake::StrokeContact& one = contacts[i]; one.isWorthTelling())
            list.push_back({{"stroke", first + i},
                            {"points", one.points},
                            {"lost", one.lostPoints},
                            {"share", double(one.lost()) / double(one.places)}});
    return list;
}

EditRequests::EditRequests(bake::Session& session, std::vector<std::string> species,
                           std::filesystem::path deltas, std::vector<std::string> sources,
                           std::uint64_t maxBlades, LoadGround load)
    : session_(session)
    , species_(std::move(species))
    , deltas_(std::move(deltas))
    , sources_(std::move(sources))
    , maxBlades_(maxBlades)
    , bladesBefore_(session.bladeCount())
    , load_(std::move(load))
{
}

EditRequests::~EditRequests()
{
    std::error_code ignored;
    for (const std::filesystem::path& path : written_)
        std::filesystem::remove(path, ignored);
}

// The session's strokes after a request.
bake::Strokes EditRequests::strokesOf(const json& request) const
{
    bake::Strokes strokes = session_.strokes();
    const auto keep = request.find("keep");
    if (keep == request.end() || !keep->is_number_unsigned() ||
        keep->get<std::uint64_t>() > strokes.list.size())
        fail(ErrorKind::usage, "{}: keep: is no whole number in [0, {}], the number of strokes",
             requestPlace, strokes.list.size());
    strokes.list.resize(keep->get<std::size_t>());
    if (const auto added = request.find("strokes"); added != request.end()) {
        const json file = {{"format", "sward strokes 1"}, {"strokes", *added}};
        bake::Strokes next = bake::parseStrokes(jsonText(file), requestPlace);
        bake::resolveSpecies(next, species_);
        std::move(next.list.begin(), next.list.end(), std::back_inserter(strokes.list));
    }
    bake::requireStrokeCount(strokes, requestPlace);
    return strokes;
}

// Writes the delta of a change and tells about both.
json EditRequests::answerOf(const bake::Session::Change& change, Stopwatch& watch)
{
    const std::uint64_t total = session_.bladeCount();
    bake::requireBlades(total, bladesBefore_, maxBlades_);
    json delta;
    if (!change.cells.empty()) {
        const std::filesystem::path path = deltas_ / fmt::format("{}.swdelta", deltaNumber_ + 1);
        field::writeDelta(path, session_.deltaOf(change.cells));
        ++deltaNumber_;
        written_.push_back(path);
        delta = path.string();
    }
    return {{"delta", delta},
            {"cells", change.cells.size()},
            {"blades", change.blades},
            {"total", total},
            {"strokes", session_.strokes().list.size()},
            {"seconds", watch.lap()}};
}

// Which of the strokes from `first` on touch no ground, and in words.
void EditRequests::tellLost(json& answer, std::size_t first, Diagnostics& diagnostics) const
{
    const std::vector<bake::StrokeContact> contacts = session_.contacts(first);
    bake::warnOfContacts(std::span(session_.strokes().list).subspan(first), contacts, first,
                         "strokes", "The request \"move\" moves strokes onto the ground",
                         diagnostics);
    answer["lost"] = lostStrokes(contacts, first);
    answer["warnings"] = diagnostics.warnings();
}

// Replaces the strokes, of which those from `firstNew` on are new.
json EditRequests::applied(bake::Strokes next, std::size_t firstNew, Progress& progress)
{
    Stopwatch watch;
    bake::Strokes before = session_.strokes();
    const bake::Session::Change change = session_.apply(std::move(next), progress);
    try {
        json answer = answerOf(change, watch);
        Diagnostics diagnostics;
        tellLost(answer, firstNew, diagnostics);
        return answer;
    } catch (const Error&) {
        session_.apply(std::move(before), progress);
        throw;
    }
}

json EditRequests::paint(const json& request, Progress& progress)
{
    requireKeys(request, {"id", "do", "keep", "strokes"});
    bake::Strokes next = strokesOf(request);
    return applied(std::move(next), request["keep"].get<std::size_t>(), progress);
}

json EditRequests::moveStrokes(const json& request, Progress& progress)
{
    requireKeys(request, {"id", "do", "distance"});
    const auto given = request.find("distance");
    const double distance =
        given != request.end() && given->is_number() ? given->get<double>() : 0.0;
    if (!(distance >= bake::shortestRadius && distance <= bake::longestRadius))
        fail(ErrorKind::usage, "{}: distance: is no number in [{}, {}]", requestPlace,
             bake::shortestRadius, bake::longestRadius);
    bake::Strokes next = session_.strokes();
    bake::MovedStrokes moved =
        bake::moveOnto(session_.ground(), session_.sides(), next.list, distance);
    next.list = std::move(moved.list);
    bake::requireStrokeCount(next, requestPlace);
    json list = json::array();
    for (const std::size_t i : moved.moved)
        list.push_back({{"index", i}, {"stroke", json::parse(bake::textOf(next.list[i]))}});
    json answer = applied(std::move(next), 0, progress);
    answer["moved"] = std::move(list);
    return answer;
}

json EditRequests::replaceGround(const json& request, Progress& progress)
{
    requireKeys(request, {"id", "do"});
    Stopwatch watch;
    Diagnostics diagnostics;
    auto next = std::make_unique<const terrain::GroundMesh>(load_(diagnostics));
    const terrain::GroundMesh& before = session_.ground();
    const bake::Session::Change change = session_.replaceGround(*next, progress);
    json answer;
    try {
        answer = answerOf(change, watch);
    } catch (const Error&) {
        session_.replaceGround(before, progress);
        throw;
    }
    ground_ = std::move(next);
    answer["origin"] = {ground_->origin.x, ground_->origin.y, ground_->origin.z};
    tellLost(answer, 0, diagnostics);
    return answer;
}

json EditRequests::species(const json& request) const
{
    requireKeys(request, {"id", "do", "eye", "direction", "distance", "spread"});
    const auto number = [&](const json& value, const char* key) {
        const double found = value.is_number() ? value.get<double>() : HUGE_VAL;
        if (!(std::fabs(found) <= bake::farthestPoint))
            fail(ErrorKind::usage, "{}: {}: is no number up to {}", requestPlace, key,
                 bake::farthestPoint);
        return found;
    };
    const auto vector = [&](const char* key) {
        const auto list = request.find(key);
        if (list == request.end() || !list->is_array() || list->size() != 3)
            fail(ErrorKind::usage, "{}: {}: is not [x, y, z]", requestPlace, key);
        return glm::dvec3(number((*list)[0], key), number((*list)[1], key),
                          number((*list)[2], key));
    };
    EditSight sight{vector("eye"), vector("direction"),
                    number(request.value("distance", json()), "distance"),
                    number(request.value("spread", json(0.002)), "spread")};
    const double length = glm::length(sight.direction);
    if (!(length > 0.0 && sight.farthest >= 0.0 && sight.spread >= 0.0 && sight.spread <= 1.0))
        fail(ErrorKind::usage,
             "{}: direction has no length, distance is below 0, or spread outside of [0, 1]",
             requestPlace);
    sight.direction /= length;
    const std::optional<std::uint32_t> found = speciesAlong(session_, sight);
    json name;
    if (found && *found < species_.size())
        name = species_[*found];
    return {{"species", name}};
}

json EditRequests::save(const json& request)
{
    requireKeys(request, {"id", "do", "path", "overwrite"});
    const std::string path = textOf(request, "path");
    const bool overwrite = switchOf(request, "overwrite");
    checkOutput(path, ".sward", sources_, overwrite);
    const std::uint64_t bytes = field::writeField(session_.field(), path, overwrite);
    return {{"saved", path}, {"bytes", bytes}};
}

json EditRequests::saveStrokes(const json& request)
{
    requireKeys(request, {"id", "do", "path", "overwrite"});
    const std::string path = textOf(request, "path");
    const bool overwrite = switchOf(request, "overwrite");
    checkOutput(path, ".json", sources_, overwrite);
    const std::string text = bake::toJson(session_.strokes());
    writeTextFile(path, text, overwrite);
    return {{"saved", path}, {"bytes", text.size()}};
}

json EditRequests::carryOut(const json& request, Progress& progress)
{
    const std::string wish = textOf(request, "do");
    if (wish == "paint")
        return paint(request, progress);
    if (wish == "move")
        return moveStrokes(request, progress);
    if (wish == "ground")
        return replaceGround(request, progress);
    if (wish == "species")
        return species(request);
    if (wish == "save")
        return save(request);
    if (wish == "save_strokes")
        return saveStrokes(request);
    if (wish != "quit")
        fail(ErrorKind::usage,
             "{}: do: is \"{}\"; known are paint, move, ground, species, save, save_strokes and "
             "quit",
             requestPlace, wish);
    requireKeys(request, {"id", "do"});
    hasEnded_ = true;
    return {{"ended", true}};
}

std::string EditRequests::answerToLongLine()
{
    return jsonText(errorAnswer(ErrorKind::input, fmt::format("{}: is longer than {} bytes",
                                                              requestPlace, longestRequest)));
}

std::string EditRequests::answer(const std::string& line, Progress& progress)
{
    json id;
    json given;
    try {
        const json request = parseJson(line, requestPlace);
        if (!request.is_object())
            fail(ErrorKind::input, "{}: is no object", requestPlace);
        if (const auto found = request.find("id"); found != request.end()) {
            if (!found->is_number() && !found->is_string())
                fail(ErrorKind::usage, "{}: id: is no number and no text", requestPlace);
            id = *found;
        }
        given = carryOut(request, progress);
    } catch (const Error& error) {
        if (progress.isCancelled())
            throw;
        given = errorAnswer(error.kind(), error.what());
    }
    given["id"] = id;
    return jsonText(given);
}

} // namespace sward::apps
