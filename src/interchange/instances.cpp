#include "interchange/instances.h"

#include "core/error.h"
#include "field/measure/blade_rotation.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sward::interchange {
namespace {

// 64 MB of a mapped field.
constexpr std::uint64_t restingBlades = std::uint64_t(4) << 20;

bool isFinite(const shared::Blade& blade)
{
    return std::isfinite(blade.root.x) && std::isfinite(blade.root.y) &&
           std::isfinite(blade.root.z) && std::isfinite(blade.height) && std::isfinite(blade.width);
}

} // namespace

shared::Blade bladeOf(const field::FieldView& field, std::uint32_t patch, std::size_t index,
                      const std::string& source)
{
    const shared::Blade blade = shared::unpackBlade(field.blades[index], field.patches[patch]);
    if (!isFinite(blade))
        fail(ErrorKind::input, "{}: blade {} of patch {} is not finite", source, index, patch);
    return blade;
}

Instance instanceOf(const field::FieldView& field, std::uint32_t patch, std::size_t index,
                    const glm::dvec3& place, const std::string& source)
{
    Instance instance;
    instance.blade = bladeOf(field, patch, index, source);
    instance.id = field.idOf(index);
    instance.place = glm::vec3(glm::dvec3(instance.blade.root) - place);
    instance.rotation = field::bladeRotation(instance.blade.up, instance.blade.facing);
    const float across = field.species[instance.blade.species].organs.empty()
                             ? instance.blade.width
                             : instance.blade.height;
    instance.scale = {across, instance.blade.height, instance.blade.height};
    const shared::Patch& own = field.patches[patch];
    const float share = (static_cast<float>(index - own.firstBlade) + 0.5f) / float(own.bladeCount);
    instance.rank = own.rankLow + (own.rankHigh - own.rankLow) * share;
    instance.look = {};
    return instance;
}

std::vector<Instance> instancesOf(const field::FieldView& field, const BladeGroup& group,
                                  const std::string& source)
{
    std::vector<Instance> instances;
    instances.reserve(group.bladeCount);
    for (const std::uint32_t p : group.patches) {
        const shared::Patch& patch = field.patches[p];
        for (std::size_t i = patch.firstBlade; i < patch.firstBlade + patch.bladeCount; ++i) {
            // The mesh of a stalk's species holds its ribbons.
            if (field.isRibbon(i))
                continue;
            instances.push_back(instanceOf(field, p, i, group.place, source));
        }
    }
    return instances;
}

void orderByRank(std::vector<Instance>& instances)
{
    std::ranges::stable_sort(instances, {}, &Instance::rank);
}

BladeCounter::BladeCounter(std::function<void()> rest)
    : rest_(std::move(rest))
{
}

void BladeCounter::add(std::uint64_t blades)
{
    count_ += blades;
    if (count_ < restingBlades)
        return;
    count_ = 0;
    if (rest_)
        rest_();
}

std::vector<MeanBlade> meanBlades(const field::FieldView& field, const std::function<void()>& rest)
{
    struct Sums {
        double stiffness = 0.0;
        double slenderness = 0.0;
        std::uint64_t count = 0;
    };
    std::vector<Sums> sums(field.species.size());
    BladeCounter counter(rest);
    for (const shared::Patch& patch : field.patches) {
        for (std::size_t i = patch.firstBlade; i < patch.firstBlade + patch.bladeCount; ++i) {
            if (field.isRibbon(i))
                continue;
            const shared::Blade blade = shared::unpackBlade(field.blades[i], patch);
            Sums& own = sums[blade.species];
            own.stiffness += double(blade.stiffness);
            own.slenderness += double(blade.width) / double(blade.height);
            ++own.count;
        }
        counter.add(patch.bladeCount);
    }
    std::vector<MeanBlade> means(field.species.size());
    for (std::size_t s = 0; s < means.size(); ++s)
        if (sums[s].count > 0)
            means[s] = {static_cast<float>(sums[s].stiffness / double(sums[s].count)),
                        static_cast<float>(sums[s].slenderness / double(sums[s].count))};
    return means;
}

} // namespace sward::interchange
