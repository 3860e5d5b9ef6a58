// The user's work: what is not saved, and files that exist.
#include "apps/sward_view/files/free_name.h"
#include "apps/sward_view/window/viewer.h"
#include "core/files/atomic_file.h"
#include "core/log.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

namespace sward::view {
namespace {

namespace fs = std::filesystem;

std::string namesOf(const OpenedFields& fields)
{
    std::string names;
    for (const auto& field : fields)
        names += (names.empty() ? "" : ", ") + field->name;
    return names;
}

} // namespace

bool Viewer::isDone()
{
    if (!window_.isClosed())
        return false;
    OpenedFields unsaved = loadedField_ ? loadedField_->field().unsaved() : OpenedFields();
    const bool hasStrokes = viewerState_.painter && viewerState_.painter->strokes.isUnsaved();
    if (isClosing_ || (unsaved.empty() && !recorder_.isRecording() && !hasStrokes))
        return true;
    window_.keepOpen();
    isClosing_ = false;
    askToSave(std::move(unsaved), "close", [this] {
        isClosing_ = true;
        window_.close();
    });
    return false;
}

void Viewer::askToSave(OpenedFields fields, const std::string& verb, std::function<void()> act)
{
    const bool records = recorder_.isRecording() && verb == "close";
    const bool hasStrokes = viewerState_.painter && viewerState_.painter->strokes.isUnsaved();
    if (fields.empty() && !records && !hasStrokes)
        return act();
    std::string text;
    if (!fields.empty())
        text = fmt::format("{}: baked in this window, and not saved as a field file.",
                           namesOf(fields));
    if (records)
        text += std::string(text.empty() ? "" : "\n") + "A camera path is being recorded.";
    if (hasStrokes)
        text += fmt::format("{}{}: strokes are not saved as a file.", text.empty() ? "" : "\n",
                            loadedField_->field().name);
    std::string about = "Writes";
    for (const auto& field : fields)
        about += " " + freeName(fieldNameFor(field->source.input)).string();
    if (records)
        about += " " + freeName(viewerState_.pathFile).string();
    if (hasStrokes)
        about +=
            " " + freeName(strokesNameFor(loadedField_->field().members[0]->source.input)).string();
    const auto save = [this, fields = std::move(fields), records, hasStrokes, act] {
        for (const auto& field : fields)
            saveField(*field, freeName(fieldNameFor(field->source.input)), false);
        if (hasStrokes)
            viewerState_.painter->writeStrokes(
                freeName(strokesNameFor(loadedField_->field().members[0]->source.input)));
        if (records)
            record();
        act();
    };
    viewerState_.question =
        Question{std::move(text),
                 {{"Save and " + verb, std::move(about), save},
                  {fmt::format("{}{} without saving", static_cast<char>(verb[0] - 'a' + 'A'),
                               verb.substr(1)),
                   "What is not saved is lost",
                   [this, hasStrokes, act = std::move(act)] {
                       if (hasStrokes && viewerState_.painter)
                           viewerState_.painter->discard();
                       act();
                   }},
                  {"Cancel", "Changes nothing (Escape)", {}}}};
}

void Viewer::saveField(OpenedField& field, const fs::path& path, bool replaces)
{
    // A painted field is that of the session.
    if (viewerState_.painter && viewerState_.painter->isReady()) {
        viewerState_.painter->saveFieldNow(path, replaces);
        field.savedAs = path;
    } else {
        field.save(path, replaces);
    }
    log::info("{}: saved as {}", field.source.input, path.string());
    notice(path.string() + ": written");
    recent_.add(path.string());
}

void Viewer::writeUnlessTaken(const fs::path& path,
                              std::function<void(const fs::path&, bool)> write)
{
    if (freeName(path) == path)
        write(path, false);
    else
        viewerState_.question = replaceQuestion(path, std::move(write));
}

void Viewer::writeText(const fs::path& path, std::string text)
{
    writeUnlessTaken(path, [this, text = std::move(text)](const fs::path& chosen, bool replaces) {
        writeTextFile(chosen, text, replaces);
        notice(chosen.string() + ": written");
    });
}

void Viewer::startSequence()
{
    const auto pictures = static_cast<std::uint64_t>(viewerState_.sequenceLength);
    const auto step = static_cast<double>(viewerState_.sequenceStep);
    if (viewerState_.makesVideo)
        return writeUnlessTaken(viewerState_.videoFile,
                                [this, pictures, step](const fs::path& path, bool) {
                                    capture_.takeVideo(path, pictures, step);
                                });
    const std::string names = viewerState_.sequenceFiles;
    const auto start = [this, names, pictures, step] {
        capture_.takeSequence(names, pictures, step);
    };
    const FrameNames numbered(names);
    std::uint64_t taken = 0;
    for (std::uint64_t i = 0; numbered.numbered() && i < pictures; ++i)
        taken += freeName(numbered.of(i)) != numbered.of(i) ? 1u : 0u;
    if (taken == 0)
        return start();
    viewerState_.question =
        Question{fmt::format("{}: {} of these {} pictures exist already.", names, taken, pictures),
                 {{"Replace", "Writes the new pictures; the old ones are lost", start},
                  {"Cancel", "Writes nothing (Escape)", {}}}};
}

bool Viewer::closeTopmost()
{
    if (std::exchange(viewerState_.question, std::nullopt)) {
        interface_.closePopup();
        return true;
    }
    if (std::exchange(viewerState_.files, std::nullopt)) {
        interface_.closePopup();
        return true;
    }
    if (interface_.closePopup() || std::exchange(layout_.keySheet, false))
        return true;
    if (!std::exchange(viewerState_.error, {}).empty())
        return true;
    if (layout_.shown && std::exchange(viewerState_.picked, std::nullopt))
        return true;
    return layout_.shown && std::exchange(layout_.open, std::nullopt);
}

} // namespace sward::view
