#pragma once

#include "field/field.h"
#include "trace/camera.h"
#include "trace/light.h"
#include "trace/ray_scene.h"
#include "trace/tracer.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace sward::apps {

/// The layers of a traced picture by name, as --layers and the EXR's channels call them.
inline constexpr const char* traceLayers[] = {"albedo",   "normal",     "depth", "blade", "direct",
                                              "indirect", "visibility", "sun",   "sky"};

/// The options of `sward trace`. Must not move while a CLI::App refers to it.
struct TraceOptions {
    std::string field;               ///< file
    std::string output;              ///< .exr or .png
    std::string poses;               ///< CSV of --dump-blades; empty: at rest
    std::uint32_t samples = 64;      ///< per pixel
    int threads = 0;                 ///< 0: one for each CPU
    bool overwrite = false;          ///< --force
    bool progressive = false;        ///< writes the picture while it grows
    std::optional<double> exposure;  ///< of a PNG; unset: by the picture's mean
    std::vector<std::string> layers; ///< of an EXR, checked
    trace::SurfaceSettings surfaces; ///< --gloss, --translucency, --thatch
    trace::Light light;              ///< `up` and an unset sun follow the field

    /// Adds the options to `app`.
    void add(CLI::App& app);

    /// Throws Error{usage} for options that exclude each other.
    void check() const;

    /// The light over a field: its sun stands as high above the field's ground as above a level
    /// one, as in the viewer, unless --sun says where.
    trace::Light lightOver(const field::FieldView& view) const;

    /// The camera; `scene` has the ground. Throws Error{usage}; Error{io} or Error{input} if its
    /// file cannot be read.
    trace::Camera cameraOf(const field::FieldView& view, const trace::RayScene& scene,
                           const trace::Light& over) const;

    /// Size, bounces, seed.
    const trace::TraceSettings& settings() const { return settings_; }

private:
    void addView(CLI::App& app);
    void addLight(CLI::App& app);
    void addRun(CLI::App& app);

    trace::TraceSettings settings_;
    std::string camera_;
    std::optional<glm::dvec3> eye_;
    std::optional<glm::dvec3> target_;
    std::optional<glm::dvec3> up_;
    std::optional<double> fovY_;
    std::optional<glm::vec3> sun_;
};

} // namespace sward::apps
