#include "bake/mask/excluded_area.h"

#include "bake/mask/map_mask.h"
#include "core/diagnostics.h"
#include "core/error.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <utility>

namespace sward::bake {
namespace {

// The two halves of the line overlap by this length, so that a mesh lying on the ground is hit.
constexpr double overlap = 1e-3; // [m]

} // namespace

ExcludedArea parseExcludedArea(const std::string& text)
{
    ExcludedArea area{.file = text};
    std::error_code ignored;
    const std::size_t colon = text.rfind(':');
    if (colon == std::string::npos || std::filesystem::exists(text, ignored))
        return area;
    area.file = text.substr(0, colon);
    std::string number = text.substr(colon + 1);
    for (const char* const word : {"margin ", "margin="})
        if (number.starts_with(word))
            number = number.substr(std::string(word).size());
    const char* const end = number.data() + number.size();
    const auto [read, error] = std::from_chars(number.data(), end, area.margin);
    if (error != std::errc() || read != end || !(area.margin >= 0.0 && area.margin <= 1e9) ||
        area.file.empty())
        fail(ErrorKind::usage,
             "--exclude is \"{}\"; expected FILE or FILE:margin M with a margin from 0 to 1e9 m",
             text);
    return area;
}

bool takeMapArea(ExcludedArea& area)
{
    if (!terrain::isMapShapes(area.file))
        return false;
    area.map = std::make_shared<MapArea>(area.file, area.margin);
    return true;
}

MapArea::MapArea(std::string file, double margin)
    : file_(std::move(file))
    , margin_(margin)
{
}

void MapArea::read(const terrain::GroundMesh& ground)
{
    const std::lock_guard lock(mutex_);
    if (shapes_ != nullptr && system_ == ground.mapSystem)
        return;
    Diagnostics diagnostics;
    shapes_ = terrain::readMapShapes(file_, margin_, ground.mapSystem, diagnostics);
    system_ = ground.mapSystem;
}

terrain::MapBounds MapArea::bounds() const
{
    return shapes_ != nullptr ? shapes_->bounds() : terrain::MapBounds{};
}

bool MapArea::holds(glm::dvec3 place) const
{
    return shapes_ != nullptr && shapes_->holds({place.x, -place.z});
}

Exclusion::Exclusion(const ExcludedArea& area, glm::dvec3 origin)
    : map_(area.map)
    , origin_(origin)
    , margin_(area.margin)
{
    if (map_ != nullptr)
        return;
    query_.emplace(*area.mesh);
    shift_ = origin - area.mesh->origin;
    const Aabb box = area.mesh->bounds();
    middle_ = glm::dvec3(box.centre());
    radius_ = 0.5 * glm::length(glm::dvec3(box.size())) * 1.0001 + overlap;
}

bool Exclusion::holds(glm::dvec3 place, glm::dvec3 groundUp, double below) const
{
    if (map_ != nullptr)
        return map_->holds(origin_ + place);
    // Early out: most lines miss the bounding sphere of the mesh.
    const glm::dvec3 at = place + shift_;
    const glm::dvec3 offset = middle_ - at;
    const double along = glm::dot(offset, groundUp);
    const double aside = std::sqrt(std::max(glm::dot(offset, offset) - along * along, 0.0));
    if (aside > radius_ + margin_)
        return false;

    const double above = along + radius_;
    if (above > 0.0 &&
        query_->occluded(at - overlap * groundUp, groundUp, above + 2.0 * overlap, 0.0))
        return true;
    const double under = std::min(radius_ - along, below);
    if (under > 0.0 && query_->occluded(at + overlap * groundUp, -groundUp, under + overlap, 0.0))
        return true;
    return margin_ > 0.0 && query_->nearest(at, margin_).triangle != terrain::SurfaceQuery::none;
}

} // namespace sward::bake
