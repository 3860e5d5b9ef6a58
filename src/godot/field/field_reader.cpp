#include "godot/field/field_reader.h"

#include "c/field_handle.h"
#include "field/organs.h"

#include <glm/mat3x3.hpp>

#include <algorithm>

namespace sward::godot {
namespace {

std::vector<double> numbers(const glm::dvec3& value)
{
    return {value.x, value.y, value.z};
}

std::vector<double> numbers(const Aabb& box, const glm::dvec3& place)
{
    std::vector<double> result = numbers(glm::dvec3(box.low) - place);
    for (const double high : numbers(glm::dvec3(box.high) - place))
        result.push_back(high);
    return result;
}

// A number that has nothing to do with where a blade stands (the finaliser of SplitMix64).
std::uint64_t scattered(std::uint64_t id)
{
    id = (id ^ (id >> 30U)) * 0xbf58476d1ce4e5b9U;
    id = (id ^ (id >> 27U)) * 0x94d049bb133111ebU;
    return id ^ (id >> 31U);
}

void append(std::vector<float>& buffer, const interchange::Instance& instance)
{
    const glm::mat3 turn = glm::mat3_cast(instance.rotation);
    for (glm::length_t row = 0; row < 3; ++row) {
        for (glm::length_t column = 0; column < 3; ++column)
            buffer.push_back(turn[column][row] * instance.scale[column]);
        buffer.push_back(instance.place[row]);
    }
    // Godot's Compatibility renderer reads garbage where an instance has custom data and no colour.
    buffer.insert(buffer.end(), 4, 1.0f);
    const shared::Blade& blade = instance.blade;
    buffer.insert(buffer.end(),
                  {blade.stiffness, blade.exposure, float(blade.clump) / 255.0f, blade.height});
}

} // namespace

std::string FieldReader::open(std::string path)
{
    close();
    sward_field* opened = nullptr;
    if (sward_field_open(path.c_str(), &opened) != SWARD_OK)
        return sward_last_error();
    field_.reset(opened);
    path_ = std::move(path);
    groups_ = interchange::groupBlades(view());
    return {};
}

void FieldReader::close()
{
    unpacked_.reset();
    instances_.clear();
    meshes_.clear();
    groups_.clear();
    field_.reset();
}

field::FieldView FieldReader::view() const
{
    return field_->mapped->view();
}

std::int64_t FieldReader::bladeCount()
{
    return field_ ? static_cast<std::int64_t>(field::rootedBlades(view())) : 0;
}

std::vector<double> FieldReader::origin()
{
    return field_ ? numbers(view().origin) : std::vector<double>{};
}

std::vector<double> FieldReader::bounds()
{
    return field_ ? numbers(view().bounds(), glm::dvec3(0.0)) : std::vector<double>{};
}

std::vector<double> FieldReader::breeze()
{
    if (!field_)
        return {};
    const field::Wind& wind = view().defaults->wind;
    std::vector<double> result = numbers(glm::dvec3(wind.direction));
    result.insert(result.end(), {double(wind.speed), double(wind.strength)});
    return result;
}

std::int64_t FieldReader::speciesCount()
{
    return field_ ? static_cast<std::int64_t>(view().species.size()) : 0;
}

std::string FieldReader::speciesName(std::int64_t species)
{
    return species >= 0 && species < speciesCount()
               ? view().species[static_cast<std::size_t>(species)].name
               : std::string{};
}

double FieldReader::gloss(std::int64_t species)
{
    return species >= 0 && species < speciesCount()
               ? double(view().species[static_cast<std::size_t>(species)].look.gloss)
               : 0.0;
}

const interchange::BladeMesh* FieldReader::mesh(std::int64_t species)
{
    if (species < 0 || species >= speciesCount())
        return nullptr;
    if (meshes_.empty()) {
        const field::FieldView field = view();
        const std::vector<interchange::MeanBlade> means = interchange::meanBlades(field);
        for (std::size_t s = 0; s < field.species.size(); ++s)
            meshes_.push_back(interchange::bladeMesh(field.species[s], *field.defaults, means[s]));
    }
    return &meshes_[static_cast<std::size_t>(species)];
}

std::vector<float> FieldReader::meshVertices(std::int64_t species)
{
    std::vector<float> vertices;
    if (const interchange::BladeMesh* const made = mesh(species))
        for (std::size_t i = 0; i < made->positions.size(); ++i) {
            const glm::vec3 color = made->colors[i] * made->baseColor;
            for (const glm::vec3& triple : {made->positions[i], made->normals[i], color})
                vertices.insert(vertices.end(), {triple.x, triple.y, triple.z});
            vertices.insert(vertices.end(), {made->uvs[i].x, made->uvs[i].y, 0.0f});
        }
    return vertices;
}

std::vector<std::int32_t> FieldReader::meshIndices(std::int64_t species)
{
    const interchange::BladeMesh* const made = mesh(species);
    return made != nullptr ? std::vector<std::int32_t>(made->indices.begin(), made->indices.end())
                           : std::vector<std::int32_t>{};
}

std::int64_t FieldReader::groupCount()
{
    return static_cast<std::int64_t>(groups_.size());
}

const interchange::BladeGroup* FieldReader::group(std::int64_t number) const
{
    return number >= 0 && static_cast<std::size_t>(number) < groups_.size()
               ? &groups_[static_cast<std::size_t>(number)]
               : nullptr;
}

std::vector<double> FieldReader::groupPlace(std::int64_t number)
{
    const interchange::BladeGroup* const found = group(number);
    return found != nullptr ? numbers(found->place) : std::vector<double>{};
}

std::vector<double> FieldReader::groupBounds(std::int64_t number)
{
    const interchange::BladeGroup* const found = group(number);
    return found != nullptr ? numbers(found->bounds, found->place) : std::vector<double>{};
}

std::vector<float> FieldReader::bladeBuffer(std::int64_t number, std::int64_t species)
{
    const interchange::BladeGroup* const found = group(number);
    if (found == nullptr)
        return {};
    if (unpacked_ != number) {
        unpacked_.reset();
        instances_ = interchange::instancesOf(view(), *found, path_);
        std::ranges::sort(instances_, {}, [](const interchange::Instance& instance) {
            return scattered(instance.id);
        });
        unpacked_ = number;
    }
    std::vector<float> buffer;
    for (const interchange::Instance& instance : instances_)
        if (static_cast<std::int64_t>(instance.blade.species) == species)
            append(buffer, instance);
    return buffer;
}

} // namespace sward::godot
