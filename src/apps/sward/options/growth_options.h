#pragma once

#include "bake/seeds/grow_field.h"
#include "core/progress.h"
#include "field/field.h"

#include <cstdint>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace sward::apps {

/// Which blades grow from a field's seeds: --region, --around, --share and --max-blades. Must not
/// move while a CLI::App refers to it.
class GrowthOptions {
public:
    /// Adds the options to `app`, with a heading of the help if `group` is not null.
    void add(CLI::App& app, const char* group = nullptr);

    /// Whether an option says which blades grow.
    bool saysAnything() const { return !region_.empty() || !around_.empty() || share_; }

    /// The growth in a field with this origin. Throws Error{usage} naming the option.
    bake::Growth growthIn(const glm::dvec3& origin) const;

    /// What a program shows that needs the blades themselves: the field grown where --region,
    /// --around and --share say; none if no option says anything, and then a warning for a field
    /// with seeds, of which `done`, as "exported", is the stored share alone. Throws Error{usage}
    /// for an option and a field without seeds, and as bake::growField().
    std::optional<field::Field> grownOf(const field::FieldView& field, int threads,
                                        const std::string& file, const char* done,
                                        Progress& progress) const;

private:
    std::string region_;
    std::string around_;
    std::optional<double> share_;
    std::uint64_t maxBlades_ = 200'000'000;
};

} // namespace sward::apps
