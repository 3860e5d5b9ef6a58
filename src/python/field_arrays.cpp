#include "core/error.h"
#include "field/measure/resting_blade.h"
#include "field/organs.h"
#include "python/field.h"
#include "shaders/shared/shape.h"

#include <pybind11/numpy.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <tuple>
#include <vector>

namespace sward::python {
namespace {

namespace py = pybind11;

/// A blade as Field.blades() has it.
struct UnpackedBlade {
    std::uint64_t id;
    double root[3];
    float up[3];
    float facing;
    float height;
    float width;
    float stiffness;
    float exposure;
    float tint[3];
    float area;
    float rank;
    std::uint32_t patch;
    std::uint8_t species;
    std::uint8_t clump;
    std::uint8_t ribbon;
    std::uint8_t pad[5];
};
static_assert(sizeof(UnpackedBlade) == 96);

/// A named member of a structured type: name, format of numpy, offset.
using Member = std::tuple<const char*, const char*, std::size_t>;

py::dtype dtypeOf(std::span<const Member> members, std::size_t size)
{
    py::list names;
    py::list formats;
    py::list offsets;
    for (const auto& [name, format, offset] : members) {
        names.append(name);
        formats.append(format);
        offsets.append(offset);
    }
    return py::dtype(names, formats, offsets, static_cast<py::ssize_t>(size));
}

py::dtype packedType()
{
    using shared::PackedBlade;
    constexpr Member members[] = {{"root_xy", "<u4", offsetof(PackedBlade, rootXY)},
                                  {"root_z_up", "<u4", offsetof(PackedBlade, rootZUp)},
                                  {"shape", "<u4", offsetof(PackedBlade, shape)},
                                  {"look", "<u4", offsetof(PackedBlade, look)}};
    return dtypeOf(members, sizeof(PackedBlade));
}

py::dtype keyType()
{
    constexpr Member members[] = {{"triangle", "<u4", offsetof(field::BladeKey, triangle)},
                                  {"candidate", "<u4", offsetof(field::BladeKey, candidate)}};
    return dtypeOf(members, sizeof(field::BladeKey));
}

py::dtype patchType()
{
    using shared::Patch;
    constexpr Member members[] = {{"bounds_low", "(3,)<f4", offsetof(Patch, boundsLow)},
                                  {"first_blade", "<u4", offsetof(Patch, firstBlade)},
                                  {"bounds_high", "(3,)<f4", offsetof(Patch, boundsHigh)},
                                  {"blade_count", "<u4", offsetof(Patch, bladeCount)},
                                  {"root_low", "(3,)<f4", offsetof(Patch, rootLow)},
                                  {"root_step", "<f4", offsetof(Patch, rootStep)},
                                  {"cone_axis", "(3,)<f4", offsetof(Patch, coneAxis)},
                                  {"cone_cosine", "<f4", offsetof(Patch, coneCosine)},
                                  {"height_low", "<f4", offsetof(Patch, heightLow)},
                                  {"height_step", "<f4", offsetof(Patch, heightStep)},
                                  {"width_low", "<f4", offsetof(Patch, widthLow)},
                                  {"width_step", "<f4", offsetof(Patch, widthStep)},
                                  {"parent", "<u4", offsetof(Patch, parent)},
                                  {"first_child", "<u4", offsetof(Patch, firstChild)},
                                  {"child_count", "<u4", offsetof(Patch, childCount)},
                                  {"level", "<u4", offsetof(Patch, level)},
                                  {"rank_low", "<f4", offsetof(Patch, rankLow)},
                                  {"rank_high", "<f4", offsetof(Patch, rankHigh)}};
    return dtypeOf(members, sizeof(Patch));
}

py::dtype bladeType()
{
    constexpr Member members[] = {{"id", "<u8", offsetof(UnpackedBlade, id)},
                                  {"root", "(3,)<f8", offsetof(UnpackedBlade, root)},
                                  {"up", "(3,)<f4", offsetof(UnpackedBlade, up)},
                                  {"facing", "<f4", offsetof(UnpackedBlade, facing)},
                                  {"height", "<f4", offsetof(UnpackedBlade, height)},
                                  {"width", "<f4", offsetof(UnpackedBlade, width)},
                                  {"stiffness", "<f4", offsetof(UnpackedBlade, stiffness)},
                                  {"exposure", "<f4", offsetof(UnpackedBlade, exposure)},
                                  {"tint", "(3,)<f4", offsetof(UnpackedBlade, tint)},
                                  {"area", "<f4", offsetof(UnpackedBlade, area)},
                                  {"rank", "<f4", offsetof(UnpackedBlade, rank)},
                                  {"patch", "<u4", offsetof(UnpackedBlade, patch)},
                                  {"species", "u1", offsetof(UnpackedBlade, species)},
                                  {"clump", "u1", offsetof(UnpackedBlade, clump)},
                                  {"ribbon", "?", offsetof(UnpackedBlade, ribbon)}};
    return dtypeOf(members, sizeof(UnpackedBlade));
}

// An array over the field's memory. It refers to `self`, and cannot be made writable.
template <typename T>
py::object viewOver(const py::object& self, std::span<const T> elements, const py::dtype& type)
{
    py::array array(type, {static_cast<py::ssize_t>(elements.size())},
                    {static_cast<py::ssize_t>(sizeof(T))}, elements.data(), self);
    array.attr("setflags")(py::arg("write") = false);
    return array;
}

void requireRange(const Field& field, std::uint64_t first, std::uint64_t count)
{
    const std::uint64_t blades = field.view().blades.size();
    requireUsage(first <= blades && count <= blades - first,
                 "{}: blades {} to {} are asked for, and it has {}", field.name(), first,
                 first + count, blades);
}

[[noreturn]] void failChanged(const Field& field)
{
    fail(ErrorKind::input,
         "{}: is damaged: its file has been changed in place since it was read and verified",
         field.name());
}

// Calls use(number of the patch, patch, index, blade) for blades `first` to `first + count`, in
// order. Patches and blades are copies with valid indices: the file's pages are read once.
template <typename Use>
void eachBlade(const Field& field, std::uint64_t first, std::uint64_t count, Use use)
{
    const field::FieldView& view = field.view();
    std::uint64_t next = first;
    for (std::uint32_t p = 0; p < view.patches.size(); ++p) {
        const shared::Patch patch = view.patches[p];
        const std::uint64_t begin = std::max<std::uint64_t>(first, patch.firstBlade);
        const std::uint64_t end = std::min<std::uint64_t>(
            first + count, std::uint64_t(patch.firstBlade) + patch.bladeCount);
        if (begin >= end)
            continue;
        if (begin != next)
            failChanged(field);
        for (std::uint64_t i = begin; i < end; ++i) {
            const shared::Blade blade = shared::unpackBlade(view.blades[i], patch);
            if (blade.species >= view.species.size())
                failChanged(field);
            use(p, patch, i, blade);
        }
        next = end;
    }
    if (next != first + count)
        failChanged(field);
}

UnpackedBlade unpacked(const field::FieldView& view, std::uint32_t p, const shared::Patch& patch,
                       std::uint64_t index, const shared::Blade& blade)
{
    const glm::dvec3 root = view.origin + glm::dvec3(blade.root);
    const field::Species& species = view.species[blade.species];
    const field::BladePart part = field::partOf(species, blade);
    const float place = (float(index - patch.firstBlade) + 0.5f) / float(patch.bladeCount);
    return {.id = view.idOf(index),
            .root = {root.x, root.y, root.z},
            .up = {blade.up.x, blade.up.y, blade.up.z},
            .facing = blade.facing,
            .height = blade.height,
            .width = blade.width,
            .stiffness = blade.stiffness,
            .exposure = blade.exposure,
            .tint = {blade.tint.x, blade.tint.y, blade.tint.z},
            .area = part.length * blade.width *
                    shared::outlineArea(part.look->shape, part.look->tipThreshold),
            .rank = patch.rankLow + (patch.rankHigh - patch.rankLow) * place,
            .patch = p,
            .species = static_cast<std::uint8_t>(blade.species),
            .clump = static_cast<std::uint8_t>(blade.clump),
            .ribbon = shared::ribbonNumber(species.look, blade) > 0U,
            .pad = {}};
}

// Both touch no Python object and release the interpreter's lock.
void unpack(const Field& field, std::uint64_t first, std::uint64_t count, UnpackedBlade* out)
{
    const py::gil_scoped_release released;
    eachBlade(field, first, count,
              [&](std::uint32_t p, const shared::Patch& patch, std::uint64_t index,
                  const shared::Blade& blade) {
                  out[index - first] = unpacked(field.view(), p, patch, index, blade);
              });
}

void pose(const Field& field, std::uint64_t first, std::uint64_t count, double* out)
{
    const py::gil_scoped_release released;
    const field::FieldView& view = field.view();
    const std::vector<shared::Organ> organs = field::organTable(view.species);
    const shared::Environment calm = field::calmOf(view);
    eachBlade(
        field, first, count,
        [&](std::uint32_t, const shared::Patch&, std::uint64_t index, const shared::Blade& blade) {
            const shared::PosedBlade posed =
                field::restingBlade(view, field::viewOf(organs), calm, blade);
            double* to = out + 9 * (index - first);
            for (const glm::vec3& point : {posed.v0, posed.v1, posed.v2})
                for (glm::length_t axis = 0; axis < 3; ++axis)
                    *to++ = view.origin[axis] + double(point[axis]);
        });
}

} // namespace

py::object packedBlades(const py::object& self)
{
    return viewOver(self, self.cast<const Field&>().view().blades, packedType());
}

py::object patches(const py::object& self)
{
    return viewOver(self, self.cast<const Field&>().view().patches, patchType());
}

py::object keys(const py::object& self)
{
    return viewOver(self, self.cast<const Field&>().view().keys, keyType());
}

py::object unpackedBlades(const Field& field, std::uint64_t first, std::uint64_t count)
{
    requireRange(field, first, count);
    py::array array(bladeType(), py::array::ShapeContainer{static_cast<py::ssize_t>(count)});
    unpack(field, first, count, static_cast<UnpackedBlade*>(array.mutable_data()));
    return array;
}

py::object restingCurves(const Field& field, std::uint64_t first, std::uint64_t count)
{
    requireRange(field, first, count);
    py::array_t<double> array({static_cast<py::ssize_t>(count), py::ssize_t(3), py::ssize_t(3)});
    pose(field, first, count, array.mutable_data());
    return array;
}

} // namespace sward::python
