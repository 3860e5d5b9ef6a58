#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace sward::view {

/// Position and value of each control of a frame; tests and other programs find controls by name.
class ControlMap {
public:
    struct Place {
        float x = 0.0f, y = 0.0f, width = 0.0f, height = 0.0f; ///< [pixels of the window]
        std::string shows;
        std::string about; ///< its tooltip
        std::string kind;  ///< "number", "toggle" …; empty for what only tells
    };

    /// Sets the output file; empty: none.
    void writeTo(std::filesystem::path path) { path_ = std::move(path); }

    void add(const std::string& name, Place place) { places_[name] = std::move(place); }

    /// Writes the added controls as JSON, and clears them.
    void finishFrame();

private:
    std::filesystem::path path_;
    std::map<std::string, Place> places_;
};

} // namespace sward::view
