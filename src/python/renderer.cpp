#include "apps/sward_view/graphics.h"
#include "apps/sward_view/headless/picture_target.h"
#include "apps/sward_view/scene/camera_file.h"
#include "apps/sward_view/scene/camera_path.h"
#include "apps/sward_view/scene/frame_options.h"
#include "core/error.h"
#include "core/log.h"
#include "gpu/device/device.h"
#include "gpu/memory/image_use.h"
#include "gpu/memory/readback.h"
#include "gpu/recording/frame_ring.h"
#include "presentation/settings_file.h"
#include "python/field.h"
#include "python/option_table.h"
#include "python/python_module.h"
#include "render/frame/frame_time.h"

#include <CLI/CLI.hpp>
#include <glm/gtc/packing.hpp>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cstring>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace sward::python {
namespace {

namespace py = pybind11;

constexpr std::uint32_t onlySlot = 0; ///< one frame at a time

/// One picture to draw.
struct Shot {
    std::string camera;   ///< a preset's name, a file, or JSON
    bool isJson = false;  ///< of the camera
    double time = 0.0;    ///< [s]
    glm::uvec2 size{0};   ///< [pixels]
    std::string settings; ///< settings of this picture alone, JSON; or empty
};

/// What draws pictures of one kind: on film, or linear. It keeps the state of its blades.
class Drawer {
public:
    Drawer(const gpu::Device& device, const field::OwnedField& field,
           const view::FrameOptions& options, bool isLinear)
        : device_(device)
        , options_(options)
        , isLinear_(isLinear)
        , target_(targetOf(options.size))
        , renderer_(device.context(), field, view::rendererFor(options, target_.format(), isLinear))
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
    }

    /// Draws, with all blades of a streamed or sown field that the view shows.
    void draw(const render::FrameSettings& settings, const render::Camera& camera, const Shot& shot)
    {
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
                         {target_.get(), target_.view(), shot.size, target_.storedView()}, camera,
                         settings, shot.time, onlySlot);
        ring_.submit(frame);
        ring_.finish();
    }

    /// The pixels of the last picture: four numbers each, of 8 or, if linear, of 16 bits.
    std::vector<std::byte> pixels() const
    {
        return gpu::readImage(device_.context(), target_, gpu::ImageUse::colorTarget);
    }

private:
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
    gpu::FrameRing ring_;
};

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

/// Draws a field into arrays, on a device that stays open. Calls wait for one another.
class Renderer {
public:
    Renderer(std::shared_ptr<Field> field, const std::vector<std::string>& arguments,
             const std::string& settings)
        : field_(std::move(field))
        , options_(optionsOf(arguments, settings))
        , settings_(options_.settingsFor(field_->view()))
        , instance_(view::createInstance(options_.validation))
        , device_(instance_, {.selection = options_.device})
    {
    }

    py::object render(const Shot& shot, bool isLinear)
    {
        const auto rows = static_cast<py::ssize_t>(shot.size.y);
        const auto columns = static_cast<py::ssize_t>(shot.size.x);
        if (isLinear) {
            py::array_t<float> picture({rows, columns, py::ssize_t(3)});
            float* const out = picture.mutable_data();
            const auto take = [out](const auto& pixels) { takeRadiance(pixels, out); };
            drawUnlocked(shot, true, take);
            return picture;
        }
        py::array_t<std::uint8_t> picture({rows, columns, py::ssize_t(3)});
        std::uint8_t* const out = picture.mutable_data();
        drawUnlocked(shot, false, [out](const auto& pixels) { takeFilm(pixels, out); });
        return picture;
    }

    void advance(double time, bool isLinear)
    {
        render::requireValidTime(time);
        const py::gil_scoped_release released;
        const std::lock_guard lock(mutex_);
        drawer(isLinear).advance(settingsOf({}, isLinear), time);
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

    Drawer& drawer(bool isLinear)
    {
        std::unique_ptr<Drawer>& one = isLinear ? linear_ : film_;
        if (one == nullptr)
            one = std::make_unique<Drawer>(device_, field_->owned(), options_, isLinear);
        return *one;
    }

    render::FrameSettings settingsOf(const std::string& text, bool isLinear) const
    {
        render::FrameSettings settings = settings_;
        if (!text.empty())
            for (const std::string& warning :
                 presentation::readSettings(text, "settings", settings))
                log::warn("{}", warning);
        if (isLinear)
            settings.exposure = 1.0f;
        return settings;
    }

    render::Camera cameraOf(const Shot& shot, const render::FrameSettings& settings) const
    {
        const field::FieldView& view = field_->view();
        const float aspect = static_cast<float>(shot.size.x) / static_cast<float>(shot.size.y);
        const view::CameraPath path =
            shot.isJson ? view::readCameraPath(shot.camera, "camera", view::groundUpOf(view))
                        : view::chooseCamera(shot.camera, view, aspect, settings.sunDirection);
        return path.at(shot.time);
    }

    // Without the interpreter's lock; `take` gets the pixels.
    template <typename Take>
    void drawUnlocked(const Shot& shot, bool isLinear, const Take& take)
    {
        render::requireValidTime(shot.time);
        const py::gil_scoped_release released;
        const std::lock_guard lock(mutex_);
        const render::FrameSettings settings = settingsOf(shot.settings, isLinear);
        Drawer& one = drawer(isLinear);
        one.draw(settings, cameraOf(shot, settings), shot);
        take(one.pixels());
        view::failOnValidationMessages(instance_);
    }

    std::shared_ptr<Field> field_;
    view::FrameOptions options_;
    render::FrameSettings settings_;
    gpu::Instance instance_;
    gpu::Device device_;
    std::mutex mutex_;
    std::unique_ptr<Drawer> film_;
    std::unique_ptr<Drawer> linear_;
};

} // namespace

void addRenderer(py::module_& module)
{
    py::class_<Renderer>(module, "Renderer")
        .def(
            py::init<std::shared_ptr<Field>, const std::vector<std::string>&, const std::string&>(),
            py::call_guard<py::gil_scoped_release>())
        .def(
            "render",
            [](Renderer& renderer, const std::string& camera, bool isJson, double time,
               std::uint32_t width, std::uint32_t height, const std::string& settings,
               bool isLinear) {
                return renderer.render({camera, isJson, time, {width, height}, settings}, isLinear);
            })
        .def("advance", &Renderer::advance)
        .def_property_readonly("device", &Renderer::deviceName);
}

} // namespace sward::python
