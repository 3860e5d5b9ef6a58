#pragma once

#include "field/field.h"
#include "interchange/tiles/georeference.h"

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace sward::apps {

/// Options of an export that say where a field lies on the Earth: --at, --crs, --geoid.
class EarthOptions {
public:
    void add(CLI::App& app);

    /// Whether one of them is given.
    bool isGiven() const;

    /// Throws Error{usage} for values that mean nothing or do not go together. `output` is named.
    void check(const std::string& output) const;

    /// The place of the world's origin; none if a map says where everything lies, or nothing does.
    std::optional<interchange::Geodetic> place() const;

    /// Where the field lies on a map: the one that --crs names, or the field's own. Throws
    /// Error{usage} for a system that is none in metres, or --at outside of its area; Error{input}
    /// if the field lies outside of it; Error{unsupported} without GDAL.
    std::optional<interchange::MapToEarth> map(const field::FieldView& field) const;

private:
    std::string systemOf(const field::FieldView& field) const;

    std::string at_;
    std::string crs_;
    std::string geoid_;
};

} // namespace sward::apps
