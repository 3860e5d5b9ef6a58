// Usage: rewrite FIELD.sward COPY.sward …   Reads each field and writes it again: every chunk is
// unpacked and packed anew, so that a copy has the bytes of its field if both are right.
#include "apps/common/program.h"
#include "core/system/arguments.h"
#include "field/field.h"
#include "field/read.h"
#include "field/seeds/seeds.h"
#include "field/write.h"

#include <fmt/core.h>

using namespace sward;

namespace {

std::shared_ptr<const field::SharedSeeds> copyOf(const field::SeedsView& seeds)
{
    field::Seeds copy;
    copy.meadow = *seeds.meadow;
    for (std::size_t i = 0; i < seeds.cells.size(); ++i)
        field::addSeedCell(copy, field::readSeedCell(seeds, i, "seeds"));
    return std::make_shared<const field::SharedSeeds>(std::move(copy));
}

field::Field copyOf(const field::FieldView& view)
{
    field::Field copy;
    copy.origin = view.origin;
    copy.patches.assign(view.patches.begin(), view.patches.end());
    copy.blades.assign(view.blades.begin(), view.blades.end());
    copy.keys.assign(view.keys.begin(), view.keys.end());
    copy.species.assign(view.species.begin(), view.species.end());
    copy.ground = *view.ground;
    copy.thinned = view.thinned;
    if (view.seeds != nullptr)
        copy.seeds = copyOf(*view.seeds);
    copy.defaults = *view.defaults;
    copy.provenance = *view.provenance;
    copy.copyright = *view.copyright;
    return copy;
}

} // namespace

int main(int argc, char** argv)
{
    return apps::runProgram("rewrite", [argc, argv] {
        const std::vector<std::string> arguments = programArguments(argc, argv);
        for (std::size_t i = 1; i + 1 < arguments.size(); i += 2) {
            const field::MappedField read = field::readField(arguments[i]);
            const std::uint64_t bytes =
                field::writeField(copyOf(read.view()), arguments[i + 1], false);
            fmt::print("{}: {} blades, {} bytes\n", arguments[i], read.view().blades.size(), bytes);
        }
        return 0;
    });
}
