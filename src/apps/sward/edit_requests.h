#pragma once

#include "bake/session/session.h"
#include "core/diagnostics.h"
#include "core/progress.h"
#include "core/stopwatch.h"
#include "terrain/ground_mesh.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace sward::apps {

/// Bytes of a request, at most.
inline constexpr std::size_t longestRequest = std::size_t(64) << 20;

/// The strokes that touch no ground, wholly or in a part that is worth telling, as answers list
/// them. `first`: number of the first of them.
nlohmann::json lostStrokes(const std::vector<bake::StrokeContact>& contacts, std::size_t first);

/// Answers the requests of `sward edit`, see docs/editing.md. Include from .cpp files only.
class EditRequests {
public:
    using LoadGround = std::function<terrain::GroundMesh(Diagnostics& diagnostics)>;

    /// `deltas` is an existing folder. `sources`: files of the ground, which no output replaces.
    /// `maxBlades`: bound of the field's blades, unless there are more already. `load` reads the
    /// ground again from its files.
    EditRequests(bake::Session& session, std::vector<std::string> species,
                 std::filesystem::path deltas, std::vector<std::string> sources,
                 std::uint64_t maxBlades, LoadGround load);
    EditRequests(const EditRequests&) = delete;
    EditRequests& operator=(const EditRequests&) = delete;
    ~EditRequests(); ///< deletes its deltas

    /// The answer to a line, without its end. A request that fails changes nothing, and is answered
    /// by its error. Throws Error{interrupted} if `progress` is cancelled.
    std::string answer(const std::string& line, Progress& progress);

    /// The answer to a line that is longer than longestRequest.
    static std::string answerToLongLine();

    bool hasEnded() const { return hasEnded_; } ///< by a request

private:
    nlohmann::json paint(const nlohmann::json& request, Progress& progress);
    nlohmann::json moveStrokes(const nlohmann::json& request, Progress& progress);
    nlohmann::json applied(bake::Strokes next, std::size_t firstNew, Progress& progress);
    void tellLost(nlohmann::json& answer, std::size_t first, Diagnostics& diagnostics) const;
    nlohmann::json replaceGround(const nlohmann::json& request, Progress& progress);
    nlohmann::json answerOf(const bake::Session::Change& change, Stopwatch& watch);
    nlohmann::json species(const nlohmann::json& request) const;
    nlohmann::json save(const nlohmann::json& request);
    nlohmann::json saveStrokes(const nlohmann::json& request);
    nlohmann::json carryOut(const nlohmann::json& request, Progress& progress);
    bake::Strokes strokesOf(const nlohmann::json& request) const;

    bake::Session& session_;
    std::vector<std::string> species_;
    std::filesystem::path deltas_;
    std::vector<std::string> sources_;
    std::uint64_t maxBlades_;
    std::uint64_t bladesBefore_; ///< at the start
    LoadGround load_;
    std::unique_ptr<const terrain::GroundMesh> ground_; ///< that replaced the session's first one
    std::uint64_t deltaNumber_ = 0;
    std::vector<std::filesystem::path> written_;
    bool hasEnded_ = false;
};

} // namespace sward::apps
