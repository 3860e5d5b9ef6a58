#include "apps/sward_view/headless/scene_field.h"

#include "apps/common/interrupt.h"
#include "apps/common/temporary_folder.h"
#include "apps/common/terminal/progress_bar.h"
#include "core/error.h"
#include "core/files/atomic_file.h"
#include "core/log.h"

#include <chrono>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace sward::view {
namespace {

namespace fs = std::filesystem;

// Writes JSON inside the scene to files, because the baker reads files.
class InputFiles {
public:
    explicit InputFiles(const fs::path& folder)
        : folder_(folder)
    {
    }

    std::string add(const SceneText& input, const std::string& name)
    {
        if (!input.isJson)
            return input.text;
        const std::string file = (folder_ / (name + ".json")).string();
        writeTextFile(file, input.text, true);
        written_.emplace_back(file, input.place);
        return file;
    }

    // Replaces temporary file names in a message by places in the scene.
    std::string translated(std::string message) const
    {
        for (const auto& [file, place] : written_)
            for (std::size_t at = message.find(file); at != std::string::npos;
                 at = message.find(file, at + place.size()))
                message.replace(at, file.size(), place);
        return message;
    }

private:
    fs::path folder_;
    std::vector<std::pair<std::string, std::string>> written_; ///< file, place
};

// Waits for the bake; a signal cancels it.
void finish(Baking& baking, bool showBar)
{
    apps::ProgressBar bar(showBar);
    const Progress::Callback show = bar.callback();
    while (!baking.poll()) {
        if (apps::interruptRequested())
            baking.cancel();
        if (show)
            show(baking.progress().state, baking.progress().share);
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
}

} // namespace

SceneField::SceneField(const Scene& scene, const fs::path& folder, bool showBar)
{
    const std::string name = scene.fieldName + ".sward";
    file_ = (folder.empty() ? scene.file.parent_path() : folder) / name;
    if (fs::exists(file_))
        return;
    log::info("{}: {} is missing; baking it first", scene.file.string(), file_.string());

    const apps::TemporaryFolder inputs{"sward-view"};
    InputFiles files(inputs.path());
    std::vector<std::string> arguments{files.add(scene.ground, "ground")};
    if (scene.meadow) {
        arguments.emplace_back("--meadow");
        arguments.push_back(files.add(*scene.meadow, "meadow"));
    }
    arguments.insert(arguments.end(), scene.bake.begin(), scene.bake.end());
    baking_ = std::make_unique<Baking>(std::move(arguments));
    finish(*baking_, showBar);
    if (!baking_->succeeded())
        fail(baking_->errorKind(), "{}: the bake failed: {}", scene.file.string(),
             files.translated(baking_->complaint()));
    if (folder.empty()) {
        file_ = baking_->field();
        return;
    }
    // Copy if the folder is on another file system.
    fs::create_directories(folder);
    std::error_code error;
    fs::rename(baking_->field(), file_, error);
    if (error) {
        const fs::path copy = file_.string() + ".part";
        fs::copy_file(baking_->field(), copy, fs::copy_options::overwrite_existing);
        fs::rename(copy, file_);
    }
}

} // namespace sward::view
