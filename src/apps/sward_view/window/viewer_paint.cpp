// The brush: strokes on the ground, and the session that bakes them.
#include "apps/sward_view/child_process.h"
#include "apps/sward_view/paint/ring.h"
#include "apps/sward_view/panels/panels.h"
#include "apps/sward_view/window/free_name.h"
#include "apps/sward_view/window/viewer.h"
#include "core/error.h"
#include "field/delta.h"

#include <fmt/core.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string_view>
#include <utility>

namespace sward::view {
namespace {

namespace fs = std::filesystem;

constexpr float radiusStep = 1.15f;  ///< factor on the brush's radius, by a step of the wheel
constexpr float pixelsPerRay = 8.0f; ///< way of the cursor between two points of a stroke …
constexpr int raysPerFrame = 32;     ///< … of which a frame casts no more
constexpr std::string_view paintPanel = "Paint";

// Whether the field was baked with strokes, according to its provenance.
bool wasPainted(const std::string& provenance)
{
    const auto json = nlohmann::json::parse(provenance, nullptr, false);
    return json.is_object() && json.contains("settings") && json["settings"].is_object() &&
           json["settings"].contains("paint");
}

// Beside the field; that of a mesh is where its field would be saved.
fs::path autosaveOf(const OpenedField& field)
{
    const fs::path name = fs::path(field.source.input).stem().string() + ".strokes.autosave.json";
    return field.source.requests ? name : field.source.file.parent_path() / name;
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
    const render::GroundSurface& ground = loadedField_->field().ground;
    const auto pointAt = [&](glm::vec2 pixel) {
        const Sight sight = sightAt(pixel);
        return paintPointAt(ground, sight.eye, sight.direction, static_cast<double>(brush.radius));
    };
    // Left with Shift moves the camera.
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
        viewerState_.error += "\nThe strokes are in " + painter.autosave().string();
    }
    endPainting();
}

void Viewer::fulfilPainting(const Requests& requests)
{
    if (requests.startPainting && !viewerState_.painter) {
        const fs::path autosave = autosaveOf(*loadedField_->field().members[0]);
        std::error_code ignored;
        if (!fs::exists(autosave, ignored))
            return startPainting(std::nullopt);
        viewerState_.question = Question{
            fmt::format("{} has strokes of a painting that was not saved.", autosave.string()),
            {{"Load them", "Begins with these strokes",
              [this, autosave] { startPainting(autosave); }},
             {"Delete them", "These strokes are lost",
              [this, autosave] {
                  std::error_code unknown;
                  fs::remove(autosave, unknown);
                  startPainting(std::nullopt);
              }},
             {"Cancel", "Does not begin to paint (Escape)", {}}}};
    }
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

void Viewer::startPainting(std::optional<fs::path> strokes)
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
    auto folder = std::make_unique<apps::TemporaryFolder>("sward-view");
    fs::path base = field.source.file;
    if (field.source.requests || !field.bytes.empty()) {
        base = folder->path() / "field.sward";
        writeCopy(field, base);
    }
    command.insert(command.end(), {"--field", base.string(), "--progress", "always"});
    viewerState_.painter =
        std::make_unique<Painter>(std::move(command), held, autosaveOf(field), std::move(folder));
    if (strokes)
        viewerState_.painter->strokes.reset(more, strokes == fs::path(file));
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
