// The brush: strokes on the ground, and the session that bakes them.
#include "apps/sward_view/files/free_name.h"
#include "apps/sward_view/files/state_file.h"
#include "apps/sward_view/files/sward_program.h"
#include "apps/sward_view/paint/ring.h"
#include "apps/sward_view/panels/panels.h"
#include "apps/sward_view/window/viewer.h"
#include "core/error.h"
#include "field/delta.h"

#include <fmt/chrono.h>
#include <fmt/core.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <string_view>
#include <utility>

namespace sward::view {
namespace {

namespace fs = std::filesystem;

constexpr float radiusStep = 1.15f;  ///< factor on the brush's radius, by a step of the wheel
constexpr float pixelsPerRay = 8.0f; ///< way of the cursor between two points of a stroke …
constexpr double farthestLook = 1e4; ///< [m] for a blade before the sky
constexpr int raysPerFrame = 32;     ///< … of which a frame casts no more
constexpr std::string_view paintPanel = "Paint";

// Whether the field was baked with strokes, according to its provenance.
bool wasPainted(const std::string& provenance)
{
    const auto json = nlohmann::json::parse(provenance, nullptr, false);
    return json.is_object() && json.contains("settings") && json["settings"].is_object() &&
           json["settings"].contains("paint");
}

// What is painted, and the hash of its ground according to the field's provenance.
AutosaveSubject subjectOf(const OpenedField& field)
{
    AutosaveSubject subject{
        fs::path(field.source.input).stem().string(), stateNameOf(field.source.input), {}};
    const auto json = nlohmann::json::parse(*field.mapped.view().provenance, nullptr, false);
    if (json.is_object() && json.contains("input_hash") && json["input_hash"].is_string())
        subject.ground = json["input_hash"].get<std::string>();
    return subject;
}

// Beside the field; of a mesh, where its field would be saved. Else where state is kept.
std::vector<fs::path> autosaveFolders(const OpenedField& field)
{
    std::error_code error;
    std::vector<fs::path> folders{field.source.requests
                                      ? fs::current_path(error)
                                      : fs::absolute(field.source.file, error).parent_path()};
    if (const fs::path state = stateFile("autosaves"); !state.empty())
        folders.push_back(state);
    return folders;
}

std::string timeText(fs::file_time_type time)
{
    const auto system = std::chrono::time_point_cast<std::chrono::system_clock::duration>(
        time - fs::file_time_type::clock::now() + std::chrono::system_clock::now());
    const std::time_t seconds = std::chrono::system_clock::to_time_t(system);
    const std::tm local = fmt::localtime(seconds);
    return fmt::format("{:04}-{:02}-{:02} {:02}:{:02}", local.tm_year + 1900, local.tm_mon + 1,
                       local.tm_mday, local.tm_hour, local.tm_min);
}

// What the user is asked about strokes that are left.
std::string textOfLeft(const std::vector<LeftStrokes>& left)
{
    const LeftStrokes& newest = left.front();
    std::string count = "strokes";
    try {
        const std::size_t strokes = readStrokeFile(newest.path).size();
        count = fmt::format("{} stroke{}", strokes, strokes == 1 ? "" : "s");
    } catch (const Error&) {
        count = "strokes that cannot be read";
    }
    std::string text =
        fmt::format("{} has {} of a painting that was not saved and has ended, written at {}.",
                    newest.path.string(), count, timeText(newest.written));
    if (newest.isOtherGround)
        text += "\nThe ground had another shape then.";
    if (left.size() > 1)
        text += fmt::format("\n{} more such file{} after it.", left.size() - 1,
                            left.size() == 2 ? " is asked for" : "s are asked for");
    return text;
}

// The field for the session alone, so that its own file may be replaced by the painted one.
void writeCopy(OpenedField& field, const fs::path& path)
{
    if (field.bytes.empty())
        return field.write(path, false);
    std::ofstream out(path, std::ios::binary);
    out.write(reinterpret_cast<const char*>(field.bytes.data()),
              static_cast<std::streamsize>(field.bytes.size()));
    if (!out.flush())
        fail(ErrorKind::io, "{}: cannot be written", path.string());
}

} // namespace

void Viewer::steerBrush(Input& input, bool mouse)
{
    viewerState_.rings.clear();
    if (!viewerState_.painter)
        return;
    StrokeList& strokes = viewerState_.painter->strokes;
    if (!viewerState_.painter->isReady() || !layout_.open ||
        panels[*layout_.open].name != paintPanel) {
        strokes.finish();
        return;
    }
    Brush& brush = viewerState_.brush;
    if (mouse && input.alt)
        brush.radius =
            std::clamp(brush.radius * std::pow(radiusStep, std::exchange(input.wheel, 0.0f)),
                       shortestBrush, longestBrush);
    const presentation::GroundSurface& ground = loadedField_->field().ground;
    const auto pointAt = [&](glm::vec2 pixel) {
        const Sight sight = sightAt(pixel);
        return paintPointAt(ground, sight.eye, sight.direction, static_cast<double>(brush.radius));
    };
    if (const auto hovered = std::exchange(viewerState_.desk.hovered, std::nullopt))
        if (*hovered < strokes.entries().size())
            viewerState_.rings = outlineOf(ground, sketchOf(strokes.entries()[*hovered].text));
    // The eyedropper takes the next press; it looks a little farther than the ground.
    if (mouse && input.leftPressed && std::exchange(viewerState_.desk.takesSpecies, false)) {
        const Sight sight = sightAt(input.pressedAt);
        const auto hit = ground.hit(sight.eye, sight.direction);
        viewerState_.painter->lookForSpecies(sight, hit ? hit->distance + 0.1 : farthestLook);
        input.leftPressed = false;
    }
    // Dragging with Shift moves the camera; a click with it draws on from the last stroke's end.
    if (mouse && input.clicked && input.hurry) {
        if (const auto point = pointAt(*input.clicked))
            strokes.draw(brush, strokes.end() ? straightOn(ground, *strokes.end(), *point,
                                                           static_cast<double>(brush.radius))
                                              : std::vector<PaintPoint>{*point});
    }
    if (mouse && input.leftPressed && !input.hurry) {
        if (const auto point = pointAt(input.pressedAt))
            strokes.begin(brush, *point);
        viewerState_.brushAt = input.pressedAt;
    }
    if (strokes.isGrowing()) {
        // Follow the ground between the places of the cursor.
        const glm::vec2 way = input.cursor - viewerState_.brushAt;
        const int rays =
            std::clamp(static_cast<int>(glm::length(way) / pixelsPerRay), 1, raysPerFrame);
        for (int i = 1; i <= rays; ++i)
            if (const auto point = pointAt(viewerState_.brushAt + way * (static_cast<float>(i) /
                                                                         static_cast<float>(rays))))
                strokes.extend(*point);
        viewerState_.brushAt = input.cursor;
        if (!input.leftHeld)
            strokes.finish();
    }
    input.rotate = glm::vec2(0.0f);
    input.leftPressed = false;
    input.clicked.reset();
    if (!mouse || input.rightHeld)
        return;
    if (const auto point = pointAt(input.cursor)) {
        const auto radius = static_cast<double>(brush.radius);
        viewerState_.rings.push_back(ringOn(ground, *point, radius));
        if (brush.hardness > 0.0f && brush.hardness < 1.0f)
            viewerState_.rings.push_back(
                ringOn(ground, *point, radius * static_cast<double>(brush.hardness)));
        if (input.hurry && strokes.end()) {
            std::vector<glm::dvec3>& line = viewerState_.rings.emplace_back();
            for (const PaintPoint& on : straightOn(ground, *strokes.end(), *point, radius))
                line.push_back(on.place);
        }
    }
}

void Viewer::followPainter()
{
    if (!viewerState_.painter || !loadedField_)
        return;
    Painter& painter = *viewerState_.painter;
    const bool wasReady = painter.session().isReady();
    painter.poll([this](const fs::path& delta) {
        loadedField_->renderer().apply(field::readDelta(delta, loadedField_->field().view.species));
        rest_.isDisturbed = true;
    });
    while (const auto told = painter.takeTold()) {
        if (told->isError) {
            complain(told->text);
            continue;
        }
        notice(told->text);
        if (!told->species.empty()) {
            viewerState_.brush.kind = PaintKind::species;
            viewerState_.brush.species = told->species;
        }
        if (!told->field.empty()) {
            loadedField_->field().members[0]->savedAs = told->field;
            recent_.add(told->field.string());
        }
    }
    const bool isOther =
        !wasReady && painter.session().isReady() && !painter.session().ready().reused;
    if (painter.session().failure().empty() && !isOther)
        return;
    if (isOther) {
        const auto& warnings = painter.session().ready().warnings;
        complain(fmt::format("{}: was not baked on {} as that is now{}{}. 'Bake again' in the "
                             "panel Meadow bakes it; then it can be painted.",
                             loadedField_->field().name, viewerState_.meadow.ground,
                             warnings.empty() ? "" : ": ",
                             warnings.empty() ? "" : warnings.front()));
    } else if (painter.strokes.isUnsaved()) {
        if (const fs::path autosave = painter.finishAutosave(); !autosave.empty())
            viewerState_.error += "\nThe strokes are in " + autosave.string();
    }
    endPainting();
}

void Viewer::fulfilPainting(const Requests& requests)
{
    if (requests.startPainting && !viewerState_.painter)
        return offerLeftStrokes();
    if (!viewerState_.painter)
        return;
    if (requests.stopPainting)
        askToSave({}, "stop", [this] { endPainting(); });
    if (requests.saveField)
        writeUnlessTaken(*requests.saveField, [this](const fs::path& path, bool replaces) {
            if (viewerState_.painter)
                viewerState_.painter->saveField(path, replaces);
        });
    if (requests.saveStrokes)
        writeUnlessTaken(*requests.saveStrokes, [this](const fs::path& path, bool replaces) {
            if (viewerState_.painter)
                viewerState_.painter->saveStrokes(path, replaces);
        });
}

// Asks about strokes that a painting has left, one file after the other; then begins.
void Viewer::offerLeftStrokes()
{
    const OpenedField& field = *loadedField_->field().members[0];
    const std::vector<LeftStrokes> left = leftStrokes(subjectOf(field), autosaveFolders(field));
    if (left.empty())
        return startPainting(std::nullopt);
    const fs::path path = left.front().path;
    viewerState_.question =
        Question{textOfLeft(left),
                 {{"Load them", "Begins with these strokes", [this, path] { startPainting(path); }},
                  {"Leave them", "Begins without them; they are offered again",
                   [this] { startPainting(std::nullopt); }},
                  {"Delete them", "The strokes of this file are lost",
                   [this, path] {
                       if (!removeLeft(path))
                           notice(path.string() + ": another window has it now");
                       offerLeftStrokes();
                   }},
                  {"Cancel", "Does not begin to paint (Escape)", {}}}};
}

void Viewer::startPainting(std::optional<fs::path> left)
{
    if (loadedField_->field().members.size() != 1)
        fail(ErrorKind::usage, "several fields are shown; painting takes one. The panel Field "
                               "takes the others away");
    OpenedField& field = *loadedField_->field().members[0];
    const MeadowRequests& requests =
        field.source.requests ? *field.source.requests : viewerState_.meadow;
    if (requests.ground.empty())
        fail(ErrorKind::usage, "{}: its ground is not known; name it in the panel Paint",
             field.name);
    std::vector<std::string> command{swardProgram("it bakes the strokes").string(), "edit",
                                     requests.ground, "--as-baked"};
    for (std::string& argument : unstoredArguments(requests))
        command.push_back(std::move(argument));
    // Strokes that the field was baked with are an input of the session; others come after it.
    const std::string& file = viewerState_.strokesFile;
    std::vector<std::string> held;
    std::optional<fs::path> strokes = left;
    if (wasPainted(*field.mapped.view().provenance)) {
        if (file.empty())
            fail(ErrorKind::usage, "{}: was baked with strokes; name their file in the panel Paint",
                 field.name);
        held = readStrokeFile(file);
        command.insert(command.end(), {"--paint", file});
    } else if (!file.empty() && !strokes) {
        strokes = file;
    }
    std::vector<std::string> more;
    if (strokes)
        more = readStrokeFile(*strokes);
    Autosave autosave(subjectOf(field), autosaveFolders(field));
    if (left && !autosave.adopt(*left))
        fail(ErrorKind::io, "{}: another window has loaded or removed it", left->string());
    auto folder = std::make_unique<apps::TemporaryFolder>("sward-view");
    fs::path base = field.source.file;
    if (field.source.requests || !field.bytes.empty()) {
        base = folder->path() / "field.sward";
        writeCopy(field, base);
    }
    command.insert(command.end(), {"--field", base.string(), "--progress", "always"});
    viewerState_.painter =
        std::make_unique<Painter>(std::move(command), held, std::move(autosave), std::move(folder));
    if (strokes)
        viewerState_.painter->strokes.reset(more, !left);
    viewerState_.picked.reset();
    drawEditable(true);
}

void Viewer::endPainting()
{
    const bool isPainted = viewerState_.painter->hasPainted();
    const fs::path saved = viewerState_.painter->savedField();
    viewerState_.painter.reset();
    viewerState_.rings.clear();
    if (isPainted && !saved.empty())
        return open({saved.string()});
    // Show the field as it was.
    drawEditable(false);
}

void Viewer::drawEditable(bool isEditable)
{
    device_.waitIdle();
    loadedField_->setEditable(isEditable);
    loadedField_->drawWith(goodShaders_);
    rest_.isDisturbed = true;
    times_.frames = times_.framesAtTitle = rest_.moving = 0;
}

} // namespace sward::view
