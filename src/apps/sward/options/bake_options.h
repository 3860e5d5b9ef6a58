#pragma once

#include "apps/common/terminal/log_switches.h"
#include "bake/settings/settings.h"
#include "core/diagnostics.h"
#include "terrain/load.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace sward::apps {

/// What --sky-rays was called.
constexpr const char* formerSkyRays = "--exposure";

/// What a caller holds in memory instead of in files that options name.
struct GivenInputs {
    /// Makes the ground in place of INPUT; null: from files.
    std::function<terrain::GroundMesh(const terrain::ImportSettings&, Diagnostics&)> ground;
    std::string groundName = "ground";    ///< in messages
    bool isHeightmap = false;             ///< the options of heightmaps apply to it
    std::vector<bake::Mask> masks;        ///< after those of --mask, with their images
    std::optional<bake::Meadow> meadow;   ///< in place of --meadow
    std::optional<bake::Strokes> strokes; ///< in place of --paint; species not resolved
};

/// A parsed `sward bake` command.
struct BakeRequest {
    GivenInputs given;                  ///< in place of files
    std::vector<std::string> inputs;    ///< files or built-in names; joined to one ground
    std::vector<std::string> occluders; ///< the same; block rays, bear nothing
    terrain::ImportSettings import;
    bake::BakeSettings settings;
    std::string meadow;                 ///< file or name of --meadow
    int threads = 0;                    ///< 0: all threads of the machine
    std::string output;                 ///< empty in a dry run
    std::string report;                 ///< empty: none
    std::string paintMask;              ///< image of the strokes; empty: none
    std::uint32_t paintMaskSize = 1024; ///< texels on a side
    double moveStrokes = 0.0;           ///< [m] that strokes are moved onto the ground; 0: stay
    bool choosesSlope = false; ///< no --slope, front sides: bake::defaultSlope() of the ground
    bool choosesMask =
        false; ///< no --mask: bake::defaultMasks() of the ground; false if it has none
    bool dryRun = false;
    bool overwrite = false;

    std::vector<std::string> sources() const; ///< inputs and occluders: no output replaces them
};

/// The command-line options of `sward bake`.
class BakeOptions {
public:
    /// Adds every option to `app`; this object must outlive the parsing.
    void add(CLI::App& app);

    /// Reads and checks everything except the ground and the meshes of excluded areas. Throws
    /// Error{usage} naming the option, Error{io, input} for a meadow or a mask.
    BakeRequest request() const;

    /// The same for a ground whose field is there: all settings that its provenance holds are taken
    /// from there (bake::bakedSettings()). `place` names the field.
    BakeRequest requestAsBaked(const std::string& provenance, const std::string& place) const;

    bool printConfig = false;
    bool needsOutput = true; ///< --output, unless --dry-run is there
    GivenInputs given;       ///< in place of files
    LogSwitches log;

private:
    BakeRequest requestWith(const std::string* provenance, const std::string& place) const;
    void addGround(CLI::App& app);
    void addAmount(CLI::App& app);
    void addPlaces(CLI::App& app);
    void addBlades(CLI::App& app);
    void addRun(CLI::App& app);

    // Values that need no further parsing; others are text until request().
    BakeRequest direct_;
    double density_ = 0.0;
    double spacing_ = 0.0;
    std::uint64_t count_ = 0;
    bool hasDensity_ = false;
    bool hasCount_ = false;
    bool hasSpacing_ = false;
    bool hasSampling_ = false;
    std::optional<int> scene_;
    std::string bladeScale_ = "auto";
    std::string sampling_ = "uniform";
    std::string bareNames_ = "auto";
    std::string sides_ = "front";
    std::string groundUp_ = "y";
    std::string slope_;
    std::string altitude_;
    std::string curvature_;
    std::string border_;
    std::string water_;
    std::string sky_;
    std::vector<std::string> masks_;
    std::vector<std::string> excluded_;
    std::string paint_;
    std::string meadow_ = "meadow";
    std::vector<std::string> assignments_;
    std::string align_ = "normal";
    std::string seeds_ = "auto";
};

} // namespace sward::apps
