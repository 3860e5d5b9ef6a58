#include "apps/sward_view/fields/field_group.h"
#include "apps/sward_view/graphics.h"
#include "apps/sward_view/headless/picture_target.h"
#include "apps/sward_view/picture/layer_list.h"
#include "apps/sward_view/scene/camera_file.h"
#include "apps/sward_view/scene/camera_path.h"
#include "apps/sward_view/scene/frame_options.h"
#include "core/diagnostics.h"
#include "core/error.h"
#include "gpu/device/device.h"
#include "gpu/memory/image_use.h"
#include "gpu/memory/readback.h"
#include "gpu/recording/frame_ring.h"
#include "presentation/settings_file.h"
#include "python/field.h"
#include "python/option_table.h"
#include "python/python_module.h"
#include "python/work.h"
#include "render/frame/frame_time.h"
#include "render/layers/frame_layers.h"

#include <CLI/CLI.hpp>
#include <glm/gtc/packing.hpp>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sward::python {
namespace {

namespace py = pybind11;

constexpr std::uint32_t onlySlot = 0; ///< one frame at a time

/// One picture to draw.
struct Shot {
    std::string camera;           ///< a preset's name, a file, or JSON
    bool isJson = false;          ///< of the camera
    double time = 0.0;            ///< [s]
    glm::uvec2 size{0};           ///< [pixels]
    std::string settings;         ///< settings of this picture alone, JSON; or empty
    render::LayerMask layers = 0; ///< that are wanted besides
};

bool needsMotion(render::LayerMask layers)
{
    return (layers & render::flowLayers) != 0;
}

/// A moment that pictures of either kind show: flow leads to the one before.
struct Moment {
    double time = 0.0; ///< [s]
    render::FrameSettings settings;
    std::optional<render::Camera> camera; ///< none before the first picture
    std::array<bool, 2> isDrawn{};        ///< on film; linear
};

/// The fields that are drawn together.
class DrawnFields {
public:
    explicit DrawnFields(std::vector<std::shared_ptr<Field>> fields)
        : fields_(std::move(fields))
        , group_(membersOf(fields_))
    {
        if (fields_.size() > 1)
            numberOfPatch_ = group_.memberOfPatches();
    }

    const field::FieldView& view() const { return group_.view(); }

    render::FieldRenderer rendererFor(const gpu::DeviceContext& context,
                                      const render::FieldRendererSettings& settings) const
    {
        if (fields_.size() == 1)
            return {context, fields_[0]->owned(), settings};
        return {context, view(), settings};
    }

    render::FrameLayers layersOf(const render::LayerWords& words) const
    {
        if (fields_.size() > render::LayerId::maxFields)
            fail(ErrorKind::usage, "layers: {} fields are drawn together, more than {}",
                 fields_.size(), render::LayerId::maxFields);
        return render::layersOf(words, view(), numberOfPatch_);
    }

private:
    static std::vector<field::Member> membersOf(const std::vector<std::shared_ptr<Field>>& fields)
    {
        requireUsage(!fields.empty(), "no field is given");
        std::vector<field::Member> members;
        for (const std::shared_ptr<Field>& field : fields)
            members.push_back({field->view(), field->name()});
        return members;
    }

    std::vector<std::shared_ptr<Field>> fields_;
    view::FieldGroup group_;
    std::vector<std::uint32_t> numberOfPatch_; ///< none for one field
};

/// What draws pictures of one kind: on film, or linear. It keeps the state of its blades.
class Drawer {
public:
    Drawer(const gpu::Device& device, const DrawnFields& fields, const view::FrameOptions& options,
           bool isLinear, bool keepsMotion)
        : device_(device)
        , options_(options)
        , isLinear_(isLinear)
        , target_(targetOf(options.size))
        , renderer_(fields.rendererFor(
              device.context(),
              settingsOf(view::rendererFor(options, target_.format(), isLinear), keepsMotion)))
        , keepsMotion_(keepsMotion)
        , ring_(device.context(), 1)
    {
    }

    /// Moves the blades to a time and draws nothing.
    void advance(const render::FrameSettings& settings, double time)
    {
        const gpu::FrameRing::Frame frame = ring_.begin();
        renderer_.recordUpdateOnly(frame.commands, settings, time, onlySlot);
        ring_.submit(frame);
        ring_.finish();
        time_ = time;
    }

    /// Draws, with all blades of a streamed or sown field that the view shows. Blades move on from
    /// the moment before, and flow leads there.
    void draw(const render::FrameSettings& settings, const render::Camera& camera, const Shot& shot,
              const std::optional<Moment>& before)
    {
        if (before && time_ != before->time)
            advance(before->settings, before->time);
        if (const VkExtent2D extent = target_.extent();
            extent.width != shot.size.x || extent.height != shot.size.y)
            target_ = targetOf(shot.size);
        for (bool isThere = false; !isThere;) {
            const gpu::FrameRing::Frame frame = ring_.begin();
            isThere = renderer_.recordStreaming(frame.commands, shot.size, camera, settings,
                                                shot.time, onlySlot);
            ring_.submit(frame);
            ring_.finish();
        }
        const gpu::FrameRing::Frame frame = ring_.begin();
        gpu::transition(frame.commands, target_, gpu::ImageUse::undefined,
                        gpu::ImageUse::colorTarget);
        renderer_.record(frame.commands,
                         {.image = target_.get(),
                          .view = target_.view(),
                          .size = shot.size,
                          .stored = target_.storedView(),
                          .layers = shot.layers,
                          .cameraBefore = before && before->camera ? &*before->camera : nullptr},
                         camera, settings, shot.time, onlySlot);
        ring_.submit(frame);
        ring_.finish();
        time_ = shot.time;
    }

    /// Whether it can draw layers of flow.
    bool keepsMotion() const { return keepsMotion_; }

    /// The layers of the last picture.
    render::FrameLayers layers(const DrawnFields& fields) const
    {
        return fields.layersOf(renderer_.layerWords(fields.view(), onlySlot));
    }

    /// The pixels of the last picture: four numbers each, of 8 or, if linear, of 16 bits.
    std::vector<std::byte> pixels() const
    {
        return gpu::readImage(device_.context(), target_, gpu::ImageUse::colorTarget);
    }

private:
    static render::FieldRendererSettings settingsOf(render::FieldRendererSettings settings,
                                                    bool keepsMotion)
    {
        settings.keepsMotion = keepsMotion;
        return settings;
    }

    gpu::Image targetOf(glm::uvec2 size) const
    {
        return {device_.context(),
                view::targetFor(device_.context(), size, options_.geometry, isLinear_)};
    }

    const gpu::Device& device_;
    const view::FrameOptions& options_;
    bool isLinear_;
    gpu::Image target_;
    render::FieldRenderer renderer_;
    bool keepsMotion_;
    gpu::FrameRing ring_;
    std::optional<double> time_; ///< [s] that its blades have moved to
};

const char* dtypeOf(render::LayerNumber number)
{
    switch (number) {
    case render::LayerNumber::half:
        return "float16";
    case render::LayerNumber::real:
        return "float32";
    case render::LayerNumber::byte:
        return "uint8";
    case render::LayerNumber::whole:
        return "uint32";
    case render::LayerNumber::wide:
        break;
    }
    return "uint64";
}

// A layer as an array: (rows, columns) or (rows, columns, channels).
py::array arrayOf(const render::FrameLayers& layers, render::Layer layer)
{
    const render::LayerForm& form = render::formOf(layer);
    std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(layers.size.y),
                                   static_cast<py::ssize_t>(layers.size.x)};
    if (form.channels > 1)
        shape.push_back(static_cast<py::ssize_t>(form.channels));
    py::array array(py::dtype(dtypeOf(form.number)), shape);
    const std::vector<std::byte>& bytes = layers.arrays[static_cast<std::size_t>(layer)];
    std::memcpy(array.mutable_data(), bytes.data(), bytes.size());
    return array;
}

// Red, green and blue of pixels of four numbers.
void takeFilm(const std::vector<std::byte>& pixels, std::uint8_t* out)
{
    for (std::size_t i = 0; i < pixels.size() / 4; ++i)
        std::memcpy(out + 3 * i, pixels.data() + 4 * i, 3);
}

void takeRadiance(const std::vector<std::byte>& pixels, float* out)
{
    for (std::size_t i = 0; i < pixels.size() / 8; ++i) {
        std::uint16_t half[3];
        std::memcpy(half, pixels.data() + 8 * i, sizeof half);
        for (std::size_t c = 0; c < 3; ++c)
            out[3 * i + c] = glm::unpackHalf1x16(half[c]);
    }
}

/// Draws fields into arrays, on a device that stays open. Calls wait for one another.
class Renderer {
public:
    Renderer(std::vector<std::shared_ptr<Field>> fields, const std::vector<std::string>& arguments,
             const std::string& settings)
        : fields_(std::move(fields))
        , options_(optionsOf(arguments, settings))
        , settings_(options_.settingsFor(fields_.view(), warnings_))
        , instance_(view::createInstance(options_.validation))
        , device_(instance_, {.selection = options_.device})
    {
    }

    /// Of the settings.
    const Diagnostics& warnings() const { return warnings_; }

    py::object render(const Shot& shot, bool isLinear, bool wantsDict)
    {
        render::requireValidTime(shot.time);
        const render::FrameSettings settings = settingsOf(shot.settings, isLinear);
        const auto rows = static_cast<py::ssize_t>(shot.size.y);
        const auto columns = static_cast<py::ssize_t>(shot.size.x);
        if (isLinear) {
            py::array_t<float> picture({rows, columns, py::ssize_t(3)});
            float* const out = picture.mutable_data();
            const auto take = [out](const auto& pixels) { takeRadiance(pixels, out); };
            return withLayers(picture, drawUnlocked(shot, settings, true, take), shot.layers,
                              wantsDict);
        }
        py::array_t<std::uint8_t> picture({rows, columns, py::ssize_t(3)});
        std::uint8_t* const out = picture.mutable_data();
        return withLayers(picture,
                          drawUnlocked(shot, settings, false,
                                       [out](const auto& pixels) { takeFilm(pixels, out); }),
                          shot.layers, wantsDict);
    }

    void advance(double time, bool isLinear)
    {
        render::requireValidTime(time);
        const py::gil_scoped_release released;
        const std::lock_guard lock(mutex_);
        drawer(isLinear, false).advance(settings_, time);
        now_ = Moment{
            .time = time, .settings = settings_, .camera = now_ ? now_->camera : std::nullopt};
    }

    std::string deviceName() const { return device_.context().name; }

private:
    static view::FrameOptions optionsOf(const std::vector<std::string>& arguments,
                                        const std::string& settings)
    {
        CLI::App app;
        view::FrameOptions options;
        options.addShared(app);
        options.addMeasured(app);
        parseOptions(app, arguments);
        if (!settings.empty())
            options.sceneSettings = view::SceneText{settings, "settings", true};
        return options;
    }

    // The picture alone, or a dict of it and the layers.
    static py::object withLayers(const py::array& picture, const render::FrameLayers& layers,
                                 render::LayerMask wanted, bool wantsDict)
    {
        if (!wantsDict)
            return picture;
        py::dict all;
        all["color"] = picture;
        for (std::uint32_t i = 0; i < render::layerCount; ++i) {
            const auto layer = static_cast<render::Layer>(i);
            if ((wanted & render::bitOf(layer)) != 0)
                all[py::str(std::string(render::formOf(layer).name))] = arrayOf(layers, layer);
        }
        return all;
    }

    // Motion is kept from the first picture on that wants flow; blades then settle anew.
    Drawer& drawer(bool isLinear, bool needsMotion)
    {
        std::unique_ptr<Drawer>& one = isLinear ? linear_ : film_;
        if (one == nullptr || (needsMotion && !one->keepsMotion()))
            one = std::make_unique<Drawer>(device_, fields_, options_, isLinear, needsMotion);
        return *one;
    }

    // Issues warnings, before anything is drawn.
    render::FrameSettings settingsOf(const std::string& text, bool isLinear) const
    {
        render::FrameSettings settings = settings_;
        Diagnostics diagnostics;
        if (!text.empty())
            for (const std::string& warning :
                 presentation::readSettings(text, "settings", settings))
                diagnostics.warn("{}", warning);
        issueWarnings(diagnostics);
        if (isLinear)
            settings.exposure = 1.0f;
        return settings;
    }

    render::Camera cameraOf(const Shot& shot, const render::FrameSettings& settings) const
    {
        const field::FieldView& view = fields_.view();
        const float aspect = static_cast<float>(shot.size.x) / static_cast<float>(shot.size.y);
        const view::CameraPath path =
            shot.isJson ? view::readCameraPath(shot.camera, "camera", view::groundUpOf(view))
                        : view::chooseCamera(shot.camera, view, aspect, settings.sunDirection);
        return path.at(shot.time);
    }

    // Whether this is the other kind of picture of the moment that was drawn last.
    bool isOfNow(double time, const render::Camera& camera, bool isLinear) const
    {
        return now_ && now_->time == time && now_->camera == camera && !now_->isDrawn[isLinear] &&
               now_->isDrawn[!isLinear];
    }

    // Without the interpreter's lock; `take` gets the pixels.
    template <typename Take>
    render::FrameLayers drawUnlocked(const Shot& shot, const render::FrameSettings& settings,
                                     bool isLinear, const Take& take)
    {
        const py::gil_scoped_release released;
        const std::lock_guard lock(mutex_);
        const render::Camera camera = cameraOf(shot, settings);
        Drawer& one = drawer(isLinear, needsMotion(shot.layers));
        const bool isOther = isOfNow(shot.time, camera, isLinear);
        one.draw(settings, camera, shot, isOther ? before_ : now_);
        if (!isOther) {
            before_ = std::move(now_);
            now_ = Moment{.time = shot.time, .settings = settings, .camera = camera};
        }
        now_->isDrawn[isLinear] = true;
        take(one.pixels());
        view::failOnValidationMessages(instance_);
        return shot.layers != 0 ? one.layers(fields_) : render::FrameLayers();
    }

    DrawnFields fields_;
    Diagnostics warnings_;
    view::FrameOptions options_;
    render::FrameSettings settings_;
    gpu::Instance instance_;
    gpu::Device device_;
    std::mutex mutex_;
    std::unique_ptr<Drawer> film_;
    std::unique_ptr<Drawer> linear_;
    std::optional<Moment> now_;    ///< the last picture's, or of advance()
    std::optional<Moment> before_; ///< the one before that
};

} // namespace

void addRenderer(py::module_& module)
{
    py::class_<Renderer>(module, "Renderer")
        .def(py::init([](const std::vector<std::shared_ptr<Field>>& fields,
                         const std::vector<std::string>& arguments, const std::string& settings) {
            std::unique_ptr<Renderer> renderer;
            {
                const py::gil_scoped_release released;
                renderer = std::make_unique<Renderer>(fields, arguments, settings);
            }
            issueWarnings(renderer->warnings());
            return renderer;
        }))
        .def("abandon", [](const py::object& self) { self.inc_ref(); })
        .def("render",
             [](Renderer& renderer, const std::string& camera, bool isJson, double time,
                std::uint32_t width, std::uint32_t height, const std::string& settings,
                bool isLinear, const std::string& layers, bool wantsDict) {
                 const render::LayerMask wanted =
                     layers.empty() ? 0 : view::parseLayers("layers", layers);
                 return renderer.render({camera, isJson, time, {width, height}, settings, wanted},
                                        isLinear, wantsDict);
             })
        .def_static("layers",
                    [] {
                        std::vector<std::string> names;
                        for (std::uint32_t i = 0; i < render::layerCount; ++i)
                            names.emplace_back(render::formOf(static_cast<render::Layer>(i)).name);
                        return names;
                    })
        .def("advance", &Renderer::advance)
        .def_property_readonly("device", &Renderer::deviceName);
}

} // namespace sward::python
