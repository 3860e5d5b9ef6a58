#include "apps/sward_view/window/opening.h"

#include "apps/sward_view/interface/units.h"
#include "core/error.h"
#include "core/json/json_text.h"
#include "core/log.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <utility>
#include <vector>

namespace sward::view {
void Opening::open(Order order, MeadowRequests requests)
{
    loader_.reset();
    bakings_.clear();
    sources_.clear();
    order_ = std::move(order);
    requests_ = std::move(requests);
    goOn();
}

// Starts the next bake; when there is none, reads all fields.
void Opening::goOn()
{
    while (sources_.size() < order_.inputs.size()) {
        const std::string& input = order_.inputs[sources_.size()];
        sources_.push_back({input, input, {}, WatchedFile(input), {}, {}});
        if (!wantsBaking(input))
            continue;
        log::info("{}: is a ground without grass; baking it first", input);
        requests_.ground = input;
        try {
            bakings_.push_back(std::make_unique<Baking>(bakeArguments(requests_)));
        } catch (...) {
            bakings_.clear();
            throw;
        }
        sources_.back().file = bakings_.back()->field();
        sources_.back().requests = requests_;
        if (!requests_.meadowFile.empty())
            sources_.back().watchedMeadow = WatchedFile(requests_.meadowFile);
        return;
    }
    loader_ = std::make_unique<FieldLoader>(sources_, order_.among, order_.place);
}

const Baking* Opening::baking() const
{
    return loader_ || bakings_.empty() ? nullptr : bakings_.back().get();
}

void Opening::cancel()
{
    if (baking() != nullptr)
        bakings_.back()->cancel();
}

std::optional<Opening::Opened> Opening::poll()
{
    if (baking() != nullptr && bakings_.back()->poll()) {
        const Baking& ended = *bakings_.back();
        if (!ended.succeeded()) {
            const ErrorKind kind = ended.errorKind();
            const std::string complaint = ended.complaint();
            bakings_.clear();
            fail(kind, "Bake failed: {}: {}", sources_.back().input, complaint);
        }
        sources_.back().report = reportText(ended.report());
        goOn();
    }
    if (!loader_ || !loader_->isDone())
        return std::nullopt;
    // The mapping stays valid after the file is deleted.
    const std::unique_ptr<FieldLoader> done = std::move(loader_);
    const std::vector<std::unique_ptr<Baking>> baked = std::move(bakings_);
    bakings_.clear();
    order_.among.clear();
    return Opened{done->take(), order_.place, sources_.size()};
}

std::string reportText(const std::filesystem::path& report)
{
    std::ifstream in(report);
    const auto json = nlohmann::json::parse(in, nullptr, false);
    if (json.is_discarded() || !json.contains("roots"))
        return {};
    const auto& roots = json["roots"];
    std::string text = fmt::format("{} of {} roots kept", countText(roots.value("kept", 0ull)),
                                   countText(roots.value("proposed", 0ull)));
    std::vector<std::pair<std::uint64_t, std::string>> reasons;
    if (roots.contains("rejected") && roots["rejected"].is_object())
        for (const auto& [reason, count] : roots["rejected"].items())
            if (count.is_number_unsigned() && count.get<std::uint64_t>() > 0)
                reasons.emplace_back(count.get<std::uint64_t>(), reason);
    std::sort(reasons.rbegin(), reasons.rend());
    for (const auto& [count, reason] : reasons)
        text += fmt::format("\n{} rejected: {}", countText(count), reason);
    if (json.contains("warnings") && json["warnings"].is_array())
        for (const auto& warning : json["warnings"])
            text += "\n" + (warning.is_string() ? warning.get<std::string>() : jsonText(warning));
    return text;
}

} // namespace sward::view
