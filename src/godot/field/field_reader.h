#pragma once

#include "c/field.h"
#include "interchange/blade_groups.h"
#include "interchange/blade_mesh.h"
#include "interchange/instances.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sward::godot {

/// A field file as Godot's MultiMeshes take it: groups of neighbouring blades, and in each of them
/// the blades of one species as instances of its mesh. Meshes, groups and instances are those of
/// `sward export FIELD.glb`. Numbers of groups and species that do not exist have empty results.
class FieldReader {
public:
    /// Numbers of one instance in bladeBuffer(): 12 of the transform, row after row, 4 of the
    /// colour (white), and stiffness, exposure, clump / 255 and height [m].
    static constexpr std::size_t bufferStride = 20;

    /// Opens and verifies the file. Returns an empty text, or what is wrong, with the file's name.
    std::string open(std::string path);
    void close(); ///< frees all of it

    std::int64_t bladeCount();    ///< as they are planted: without ribbons of compound plants
    std::vector<double> origin(); ///< [m] world, 3 numbers
    std::vector<double> bounds(); ///< [m] relative to the origin: 3 numbers below, 3 above
    /// The wind that the field has saved: unit direction, speed [m/s], strength [blade heights per
    /// second].
    std::vector<double> breeze();

    std::int64_t speciesCount();
    std::string speciesName(std::int64_t species);
    double gloss(std::int64_t species); ///< [0, 1] 1 - roughness

    /// The mesh of a species: 12 numbers for each vertex: position, normal, colour (linear), uv and
    /// a 0 (so that a row is a multiple of 16 bytes).
    std::vector<float> meshVertices(std::int64_t species);
    std::vector<std::int32_t> meshIndices(std::int64_t species); ///< three for each triangle

    std::int64_t groupCount();
    std::vector<double> groupPlace(std::int64_t group);  ///< [m] relative to the origin
    std::vector<double> groupBounds(std::int64_t group); ///< [m] relative to the place, as bounds()

    /// The blades of a species in a group. They stand in an order without a pattern, so that each
    /// beginning of the array is an even sample of all.
    std::vector<float> bladeBuffer(std::int64_t group, std::int64_t species);

private:
    struct Destroy {
        void operator()(sward_field* field) const { sward_field_destroy(field); }
    };

    field::FieldView view() const;
    const interchange::BladeMesh* mesh(std::int64_t species);
    const interchange::BladeGroup* group(std::int64_t number) const;

    std::string path_;
    std::unique_ptr<sward_field, Destroy> field_;
    std::vector<interchange::BladeGroup> groups_;
    std::vector<interchange::BladeMesh> meshes_; // of all species, made at the first question
    std::optional<std::int64_t> unpacked_;       // the group of `instances_`
    std::vector<interchange::Instance> instances_;
};

} // namespace sward::godot
