#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sward::view {

struct MeadowRequests;

/// What the window shows and changes of a species; the rest stays in the meadow's text.
struct MeadowSpecies {
    std::string name = "grass";
    float share = 1.0f;                    ///< relative to the others
    glm::vec2 height{0.25f, 0.55f};        ///< [m] smallest and largest
    glm::vec3 root{0.035f, 0.06f, 0.012f}; ///< linear reflectance at the blade's base …
    glm::vec3 tip{0.24f, 0.36f, 0.06f};    ///< … and at its tip
    std::optional<glm::vec3> flower{};     ///< of a plant with flowers

    bool operator==(const MeadowSpecies&) const = default;
};

/// A meadow of the baker.
struct MeadowPreset {
    const char* name;
    int density; ///< [1/m²] blades that close its sward at blade scale 1
};
inline constexpr MeadowPreset meadowPresets[] = {
    {"meadow", 2348},  {"grass", 2400}, {"hay", 2222},     {"lawn", 9286},   {"daisies", 28580},
    {"alpine", 12343}, {"marsh", 2392}, {"prairie", 1318}, {"steppe", 1540}, {"dunes", 347}};

/// Their names, separated by commas.
std::string presetNames();

/// The text of a preset's meadow file.
std::string textOfPreset(std::size_t preset);

/// The species of a meadow file's text. Throws Error{input} that names `source`.
std::vector<MeadowSpecies> speciesOf(const std::string& text, const std::string& source);

/// Changes species of a meadow.
class MeadowEditor {
public:
    /// Reads the meadow that the requests name. Throws Error{io} or Error{input}.
    explicit MeadowEditor(const MeadowRequests& requests);

    /// Whether it is that of the requests.
    bool isOf(const MeadowRequests& requests) const;

    std::vector<MeadowSpecies> species; ///< as changed
    std::size_t chosen = 0;             ///< index of the species that the panel shows
    bool isChanged() const { return species != read_; }

    /// The meadow's text with the changes, and with all else as it was.
    std::string text() const;

    /// Writes the changed meadow, after which the requests mean that file. Throws Error{io}.
    void save(const std::string& path, bool replaces, MeadowRequests& requests);

    /// Name of a file for the changed meadow: its own if this has written it, else a free one.
    std::string file() const;
    bool ownsFile() const { return isOwn_; }

private:
    std::string source_; ///< a file, or the name of a preset
    std::string text_;
    std::vector<MeadowSpecies> read_;
    bool isOwn_ = false; ///< the file was written here
};

} // namespace sward::view
