#pragma once

#include "field/field.h"
#include "lidar/beam_patterns.h"
#include "lidar/lidar.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace sward::apps {

/// The highest ground at X and Z of the world: its Y [m]; nothing where there is none.
using GroundAt = std::function<std::optional<double>(double, double)>;

/// The options of `sward lidar` and `sward-view lidar`. Must not move while a CLI::App refers to
/// it.
struct LidarOptions {
    std::string field;      ///< file
    std::string output;     ///< .ply, .npy or .las; empty: none
    std::string poses;      ///< CSV of --dump-blades; empty: at rest
    std::string beams;      ///< .npy or .csv; empty: a pattern
    int threads = 0;        ///< 0: one for each CPU
    bool overwrite = false; ///< --force

    /// Adds the options to `app`. `mustWrite`: --output is needed; `standing`: help of --blades.
    void add(CLI::App& app, bool mustWrite, const char* standing);

    /// Throws Error{usage} unless the options say where the beams come from, once, and all of them
    /// mean something there. The CLI::App must still be there.
    void check() const;

    /// How the sensor measures this field. Throws Error{usage} for a species that it does not have.
    lidar::LidarSettings settingsFor(const field::FieldView& view) const;

    /// The beams of --beams, --scanner or --airborne; `groundAt` is asked for --above. Throws
    /// Error{usage} if there is no ground below the scanner, and as readBeams().
    lidar::Beams beamsOver(const field::FieldView& view, const GroundAt& groundAt) const;

private:
    /// An option that means something for one source of beams alone.
    struct OwnOption {
        const CLI::Option* option;
        const char* source; ///< such as "--scanner"
    };

    void addPattern(CLI::App& app);
    void addSensor(CLI::App& app);

    lidar::LidarSettings settings_{.divergence = 0.0003f, .rays = 7};
    lidar::SpinningScanner spinning_;
    lidar::AirborneScanner airborne_;
    std::vector<double> place_; ///< x, z or x, y, z; empty: no scanner
    std::optional<double> above_;
    bool isAirborne_ = false;
    std::vector<OwnOption> ownOptions_;
    float leaf_ = 0.45f;
    std::vector<std::pair<std::string, float>> leafOf_; ///< by species
};

} // namespace sward::apps
