// What a device takes to grow the blades of a field's seeds, and whether they are those of the CPU.
//
//   sward_sow_bench FIELD.sward [CELLS [CANDIDATES [COMPARED]]]
//
// Grows all units of CELLS × CELLS cells around the middle, CANDIDATES in a batch at most, and
// compares those of each COMPAREDth unit byte for byte with field::growUnit(). Writes JSON.
#include "core/embedded.h"
#include "field/read.h"
#include "field/seeds/seeds.h"
#include "field/seeds/sow_unit.h"
#include "gpu/device/device.h"
#include "gpu/device/instance.h"
#include "gpu/memory/buffer.h"
#include "gpu/memory/readback.h"
#include "gpu/recording/commands.h"
#include "gpu/recording/timestamps.h"
#include "render/sowing/device_sower.h"
#include "render/sowing/unit_order.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <map>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

namespace sward::embedded {
std::span<const EmbeddedFile> shaders();
} // namespace sward::embedded

namespace sward {
namespace {

std::uint32_t numberOf(int count, char** arguments, int index, std::uint32_t otherwise)
{
    return index < count ? static_cast<std::uint32_t>(std::stoul(arguments[index])) : otherwise;
}

void run(int count, char** arguments)
{
    const gpu::Instance instance;
    const gpu::Device device(instance);
    const gpu::DeviceContext& context = device.context();
    const auto mapped = std::make_shared<const field::MappedField>(field::readField(arguments[1]));
    const field::FieldView view = mapped->view();
    if (view.seeds == nullptr)
        throw std::runtime_error("the field has no seeds");
    const std::uint32_t cells = numberOf(count, arguments, 2, 2);
    const std::uint32_t candidates = numberOf(count, arguments, 3, 1U << 19U);
    const std::uint32_t compared = numberOf(count, arguments, 4, 16);
    const field::SeedsView& seeds = *view.seeds;
    const field::Sower sower(*seeds.meadow, view.species, view.origin);

    // The cells around the middle one.
    std::vector<std::size_t> near(seeds.cells.size());
    std::iota(near.begin(), near.end(), std::size_t(0));
    const std::array<std::int32_t, 3> middle = seeds.cells[seeds.cells.size() / 2].cell;
    std::erase_if(near, [&](std::size_t index) {
        const std::array<std::int32_t, 3>& cell = seeds.cells[index].cell;
        const auto beside = [&](std::size_t axis) {
            return cell[axis] < middle[axis] || cell[axis] >= middle[axis] + std::int32_t(cells);
        };
        return beside(0) || beside(2);
    });
    std::vector<render::UnitOrder> orders;
    for (const std::size_t index : near) {
        const auto cell = std::make_shared<const field::UnitCell>(
            field::readSeedCell(seeds, index, "the seeds"), sower);
        for (const field::SowUnit& unit : field::unitsOf(*cell, seeds.meadow->levels))
            orders.push_back(render::orderOf(sower, index, cell, unit));
    }

    render::DeviceSower sowing(context, gpu::ShaderLibrary(embedded::shaders()), sower,
                               {.framesInFlight = 1,
                                .maxCandidates = candidates,
                                .cellBytes = VkDeviceSize(256) << 20U,
                                .stagingBytes = VkDeviceSize(64) << 20U});
    gpu::Timestamps times(context, {.slots = 1});
    std::map<field::SowUnit, std::size_t> numbers;
    std::uint64_t blades = 0;
    std::uint64_t units = 0;
    std::uint64_t refused = 0;
    std::uint64_t comparedBlades = 0;
    std::uint64_t differing = 0;
    for (std::size_t next = 0; next < orders.size() || sowing.isBusy();) {
        const render::DeviceSower::Finished finished = sowing.finish(0);
        sowing.begin(0);
        std::uint32_t places = 0;
        for (const render::DeviceSower::Grown& one : finished.grown) {
            sowing.place(one, places);
            places += one.unit.bladeCount;
        }
        refused += finished.refused.size();
        for (; next < orders.size(); ++next) {
            const render::DeviceSower::Added added = sowing.add(orders[next]);
            if (added == render::DeviceSower::Added::later)
                break;
            refused += added == render::DeviceSower::Added::never ? 1U : 0U;
            numbers[orders[next].unit] = next;
        }
        const gpu::Buffer table(
            context,
            {.name = "table",
             .bytes = (places + 1) * sizeof(shared::PackedBlade),
             .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT});
        gpu::submitAndWait(context, [&](VkCommandBuffer commands) {
            times.beginFrame(commands, 0);
            const gpu::TimedScope scope(times, context, commands, "sow");
            sowing.record({context, commands}, table, &times);
        });
        std::vector<shared::PackedBlade> grown;
        if (compared > 0 && places > 0)
            grown = gpu::readBufferAs<shared::PackedBlade>(context, table);
        std::uint32_t first = 0;
        for (const render::DeviceSower::Grown& one : finished.grown) {
            ++units;
            blades += one.unit.bladeCount;
            const std::size_t number = numbers.at(one.unit.unit);
            if (compared > 0 && number % compared == 0) {
                const field::GrownUnit expected = field::growUnit(
                    sower, view.species, *orders[number].cell, one.unit.unit);
                comparedBlades += expected.blades.size();
                if (expected.blades.size() != one.unit.bladeCount)
                    differing += expected.blades.size();
                for (std::size_t i = 0;
                     i < std::min<std::size_t>(one.unit.bladeCount, expected.blades.size()); ++i)
                    differing += std::memcmp(&grown[first + i], &expected.blades[i],
                                             sizeof grown[0]) != 0
                                     ? 1U
                                     : 0U;
            }
            first += one.unit.bladeCount;
        }
    }
    times.collect();
    const std::vector<double> batches = times.history("sow");
    const double milliseconds = std::accumulate(batches.begin(), batches.end(), 0.0);
    nlohmann::ordered_json out;
    out["device"] = context.name;
    out["cells"] = near.size();
    out["units"] = units;
    out["refused"] = refused;
    out["blades"] = blades;
    out["batches"] = batches.size();
    out["ms"] = milliseconds;
    for (const std::string& name : times.names()) {
        const std::vector<double> pass = times.history(name);
        out["passes_ms"][name] = std::accumulate(pass.begin(), pass.end(), 0.0);
    }
    out["million_blades_per_s"] = double(blades) / (milliseconds * 1e3);
    out["compared"] = comparedBlades;
    out["differing"] = differing;
    fmt::print("{}\n", out.dump(2));
}

} // namespace
} // namespace sward

int main(int count, char** arguments)
{
    if (count < 2)
        return 2;
    try {
        sward::run(count, arguments);
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 1;
    }
    return 0;
}
