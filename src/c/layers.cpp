#include "c/guard.h"
#include "c/handles.h"
#include "render/layers/frame_layers.h"

#include <bit>
#include <cstring>
#include <vector>

using namespace sward;
using namespace sward::c;

static_assert(SWARD_LAYER_SUN == render::bitOf(render::Layer::sun));
static_assert(SWARD_LAYER_CLASS == render::bitOf(render::Layer::kind));
static_assert(SWARD_LAYER_BLADE == render::bitOf(render::Layer::blade));
static_assert(SWARD_LAYER_FLOW_BACKWARD == render::bitOf(render::Layer::flowBackward));

uint64_t sward_layer_bytes(uint32_t layers, uint32_t width, uint32_t height)
{
    return render::layerBytes(layers & render::allLayers, {width, height}, true);
}

sward_status sward_layer_read(const uint32_t* words, uint32_t layers, uint32_t width,
                              uint32_t height, sward_layer layer,
                              const sward_layer_instance* instances, uint32_t instance_count,
                              void* numbers, uint64_t bytes)
{
    return guarded([&] {
        checked(words, "words");
        checked(numbers, "numbers");
        requireUsage(instance_count == 0 || instances != nullptr, "instances is null");
        const auto wanted = static_cast<render::LayerMask>(layer);
        requireUsage(std::has_single_bit(wanted) && (wanted & layers & render::allLayers) != 0,
                     "layer {:#x} is none of the layers {:#x}", wanted, layers);
        std::vector<field::FieldView> fields(instance_count);
        std::vector<render::LayerInstance> known(instance_count);
        const bool names = (wanted & (SWARD_LAYER_BLADE | SWARD_LAYER_PLANT)) != 0;
        for (std::uint32_t i = 0; names && i < instance_count; ++i) {
            fields[i] = checked(instances[i].field, "field of an instance")->mapped->view();
            known[i].field = &fields[i];
            if (instances[i].resident != nullptr)
                known[i].ids = instances[i].resident->field->layerIds(fields[i]);
        }
        const glm::uvec2 size(width, height);
        const std::size_t count = render::layerBytes(layers, size, true) / sizeof(std::uint32_t);
        const render::FrameLayers all =
            render::layersOf({.size = size, .wanted = layers, .words = {words, count}}, known);
        const auto index = static_cast<std::size_t>(std::countr_zero(wanted));
        const std::vector<std::byte>& array = all.arrays[index];
        requireUsage(array.size() == bytes, "{} bytes for a layer of {}", bytes, array.size());
        std::memcpy(numbers, array.data(), array.size());
    });
}

sward_status sward_grass_get_layer_instances(const sward_grass* grass, sward_instance* instances,
                                             uint32_t capacity, uint32_t* count)
{
    return guarded([&] {
        checked(grass, "grass");
        checked(count, "count");
        requireUsage(capacity == 0 || instances != nullptr, "instances is null");
        const std::vector<render::InstanceId> found = grass->grass.layerInstances();
        *count = static_cast<std::uint32_t>(found.size());
        for (std::size_t i = 0; i < found.size() && i < capacity; ++i)
            instances[i] = static_cast<sward_instance>(found[i]);
    });
}
