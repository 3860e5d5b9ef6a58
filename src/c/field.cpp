#include "c/field.h"

#include "c/field_handle.h"
#include "c/guard.h"
#include "c/messages.h"
#include "field/measure/blade_rotation.h"

#include <algorithm>
#include <string>

using namespace sward;
using namespace sward::c;

namespace {

thread_local std::string lastError; // NOLINT(cert-err58-cpp): an empty string allocates nothing

} // namespace

sward_status sward::c::failed(sward_status status, const char* message) noexcept
{
    try {
        lastError = message;
    } catch (...) {
        lastError.clear();
    }
    return status;
}

sward_status sward::c::failed(const Error& error) noexcept
{
    const auto status = static_cast<sward_status>(error.exitCode());
    const bool isMisuse = error.kind() == ErrorKind::usage;
    try {
        lastError = inWordsOfC(error.what(), isMisuse);
    } catch (...) {
        lastError.clear();
    }
    return status <= SWARD_ERROR_UNSUPPORTED ? status : SWARD_ERROR_RUNTIME;
}

sward_status sward::c::succeeded() noexcept
{
    lastError.clear();
    return SWARD_OK;
}

const char* sward_last_error(void)
{
    return lastError.c_str();
}

sward_status sward_field_open(const char* path, sward_field** field)
{
    return guarded([&] {
        checked(path, "path");
        checked(field, "field");
        *field =
            new sward_field{std::make_shared<const field::MappedField>(field::readField(path))};
    });
}

void sward_field_destroy(sward_field* field)
{
    delete field;
}

sward_status sward_field_get_info(const sward_field* field, sward_field_info* info)
{
    return guarded([&] {
        const field::FieldView view = checked(field, "field")->mapped->view();
        checked(info, "info");
        const Aabb box = view.bounds();
        sward_field_info result = {};
        result.blade_count = view.blades.size();
        result.patch_count = view.patches.size();
        result.species_count = static_cast<std::uint32_t>(view.species.size());
        for (glm::length_t i = 0; i < 3; ++i) {
            result.origin[i] = view.origin[i];
            result.low[i] = box.low[i];
            result.high[i] = box.high[i];
        }
        *info = result;
    });
}

sward_status sward_field_read_blades(const sward_field* field, uint64_t first, uint64_t count,
                                     sward_blade* blades)
{
    return guarded([&] {
        const field::FieldView view = checked(field, "field")->mapped->view();
        if (first > view.blades.size() || count > view.blades.size() - first)
            fail(ErrorKind::usage, "blades {} to {} of a field of {}", first, first + count,
                 view.blades.size());
        if (count == 0)
            return;
        checked(blades, "blades");
        // Patches follow one another in the order of their blades, empty ones between them.
        for (std::size_t group = 0; group < view.patches.size(); ++group) {
            const shared::Patch& patch = view.patches[group];
            const std::uint64_t begin = std::max<std::uint64_t>(first, patch.firstBlade);
            const std::uint64_t end = std::min<std::uint64_t>(
                first + count, std::uint64_t(patch.firstBlade) + patch.bladeCount);
            for (std::uint64_t i = begin; i < end; ++i) {
                const shared::Blade blade = shared::unpackBlade(view.blades[i], patch);
                sward_blade& out = blades[i - first];
                for (glm::length_t axis = 0; axis < 3; ++axis) {
                    out.root[axis] = view.origin[axis] + double(blade.root[axis]);
                    out.up[axis] = blade.up[axis];
                }
                out.facing = blade.facing;
                out.height = blade.height;
                out.width = blade.width;
                out.stiffness = blade.stiffness;
                out.species = blade.species;
                out.exposure = blade.exposure;
                for (glm::length_t channel = 0; channel < 3; ++channel)
                    out.tint[channel] = blade.tint[channel];
                const bool isPlant = view.species[blade.species].look.organKinds > 0;
                out.clump = isPlant ? 0 : blade.clump;
                out.ribbon = isPlant ? blade.clump : 0;
                out.group = static_cast<std::uint32_t>(group);
                out.id = view.idOf(i);
            }
        }
    });
}

void sward_blade_rotation(const sward_blade* blade, float rotation[4])
{
    if (blade == nullptr || rotation == nullptr)
        return;
    const glm::quat turn =
        field::bladeRotation({blade->up[0], blade->up[1], blade->up[2]}, blade->facing);
    rotation[0] = turn.x;
    rotation[1] = turn.y;
    rotation[2] = turn.z;
    rotation[3] = turn.w;
}

const char* sward_field_species_name(const sward_field* field, uint32_t species)
{
    if (field == nullptr)
        return nullptr;
    const field::FieldView view = field->mapped->view();
    return species < view.species.size() ? view.species[species].name.c_str() : nullptr;
}
