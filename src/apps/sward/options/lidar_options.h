#pragma once

#include "field/field.h"
#include "trace/beam_patterns.h"
#include "trace/lidar.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace sward::apps {

/// The options of `sward lidar`. Must not move while a CLI::App refers to it.
struct LidarOptions {
    std::string field;      ///< file
    std::string output;     ///< .ply, .npy or .las
    std::string poses;      ///< CSV of --dump-blades; empty: at rest
    std::string beams;      ///< .npy or .csv; empty: a pattern
    int threads = 0;        ///< 0: one for each CPU
    bool overwrite = false; ///< --force

    /// Adds the options to `app`.
    void add(CLI::App& app);

    /// Throws Error{usage} unless the options say where the beams come from, once.
    void check() const;

    /// How the sensor measures this field. Throws Error{usage} for a species that it does not have.
    trace::LidarSettings settingsFor(const field::FieldView& view) const;

    /// The beams of --scanner or --airborne; `ground` has the ground, for --above. Throws
    /// Error{usage} if there is none below the scanner.
    trace::Beams patternOver(const field::FieldView& view, const trace::RayScene& ground) const;

private:
    void addPattern(CLI::App& app);
    void addSensor(CLI::App& app);

    trace::LidarSettings settings_{.divergence = 0.0003f, .rays = 7};
    trace::SpinningScanner spinning_;
    trace::AirborneScanner airborne_;
    std::vector<double> place_; ///< x, z or x, y, z; empty: no scanner
    std::optional<double> above_;
    bool isAirborne_ = false;
    float leaf_ = 0.45f;
    std::vector<std::pair<std::string, float>> leafOf_; ///< by species
};

} // namespace sward::apps
