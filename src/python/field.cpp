#include "python/field.h"

#include "apps/common/field_input.h"
#include "apps/common/output.h"
#include "apps/sward/files/transform_file.h"
#include "apps/sward/options/growth_options.h"
#include "apps/sward/text/info_text.h"
#include "core/error.h"
#include "core/files/atomic_file.h"
#include "core/files/mapped_file.h"
#include "field/inspect.h"
#include "field/measure/distributions.h"
#include "field/read.h"
#include "field/seeds/seeds.h"
#include "field/write.h"
#include "interchange/formats.h"
#include "python/option_table.h"
#include "python/python_module.h"
#include "python/work.h"

#include <CLI/CLI.hpp>
#include <pybind11/stl.h>

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace sward::python {
namespace {

namespace py = pybind11;

std::uint64_t bytesOf(const std::filesystem::path& path)
{
    return std::filesystem::file_size(path);
}

// Maps a field, or copies its file into memory. The messages are those of the programs.
std::shared_ptr<Field> readField(const std::string& path, bool copies)
{
    apps::requireField(path);
    if (copies)
        return std::make_shared<Field>(readFile(path, std::numeric_limits<std::size_t>::max()),
                                       path);
    return std::make_shared<Field>(path);
}

// A field in memory from the bytes of its file.
std::shared_ptr<Field> fieldOf(const py::bytes& file, std::string name, std::string report)
{
    const std::string_view text = file;
    const auto bytes = std::as_bytes(std::span(text));
    auto field = std::make_shared<Field>(std::vector<std::byte>(bytes.begin(), bytes.end()),
                                         std::move(name));
    field->report = std::move(report);
    return field;
}

std::string infoOf(const Field& field, bool withHistograms)
{
    std::optional<field::Distributions> all;
    if (withHistograms)
        all = field::distributionsOf(field.view());
    return apps::infoJson(field.name(), field.view(), field.bytes(), all ? &*all : nullptr);
}

// What `sward validate` verifies beside reading: cells of seeds.
std::uint64_t validateSeeds(const Field& field)
{
    const field::SeedsView* const seeds = field.view().seeds;
    if (seeds == nullptr)
        return 0;
    for (std::size_t i = 0; i < seeds->cells.size(); ++i)
        field::readSeedCell(*seeds, i, field.name());
    return seeds->cells.size();
}

py::dict comparisonOf(const field::Comparison& found)
{
    py::dict result;
    result["matched"] = found.matched;
    result["only_first"] = found.onlyFirst;
    result["only_second"] = found.onlySecond;
    result["largest_root_distance"] = found.largestRootDistance;
    result["largest_up_angle"] = found.largestUpAngle;
    result["largest_facing_angle"] = found.largestFacingAngle;
    result["largest_height_difference"] = found.largestHeightDifference;
    result["largest_width_difference"] = found.largestWidthDifference;
    result["traits_differ"] = found.traitsDiffer;
    result["compares_seeds"] = found.comparesSeeds;
    result["reasons"] = found.reasons;
    return result;
}

py::dict compareFields(const Field& first, const Field& second, const std::string& transform,
                       const std::string& match, double tolerance)
{
    const glm::dmat4 matrix =
        transform.empty() ? glm::dmat4(1.0) : apps::parseTransform(transform, "transform");
    const auto hasIds = [](const field::FieldView& view) {
        return view.keys.size() == view.blades.size();
    };
    const bool byId = match.empty() ? hasIds(first.view()) && hasIds(second.view()) : match == "id";
    field::Comparison found;
    work(py::none(), [&](Progress&) {
        found = field::compare(first.view(), second.view(), matrix,
                               byId ? field::Match::id : field::Match::order, tolerance);
    });
    return comparisonOf(found);
}

void exportField(const Field& field, const std::string& path, bool withGround, bool overwrite,
                 const std::string& version, const py::object& callback)
{
    interchange::ExportSettings settings;
    settings.source = field.name();
    settings.overwrite = overwrite;
    settings.withGround = withGround;
    settings.generator = version;
    const interchange::Format& format = interchange::formatOf(path, settings);
    forgetReadFiles();
    apps::requireOutput(path, format.extension, overwrite);
    work(callback,
         [&](Progress& progress) { format.write(field.view(), path, settings, progress); });
}

std::shared_ptr<Field> growField(const Field& field, const std::vector<std::string>& arguments,
                                 int threads, const py::object& callback)
{
    CLI::App app;
    apps::GrowthOptions options;
    options.add(app);
    parseOptions(app, arguments);
    const bake::Growth growth = options.growthIn(field.view().origin);
    field::Field grown;
    work(callback, [&](Progress& progress) {
        grown = bake::growField(field.view(), growth, threads, field.name(), progress);
    });
    return std::make_shared<Field>(std::move(grown), field.name() + " (grown)");
}

py::list speciesOf(const Field& field)
{
    py::list names;
    for (const field::Species& species : field.view().species)
        names.append(species.name);
    return names;
}

py::tuple boundsOf(const Field& field)
{
    const Aabb box = field.view().bounds();
    const glm::dvec3 origin = field.view().origin;
    if (box.isEmpty())
        return py::make_tuple();
    const glm::dvec3 low = origin + glm::dvec3(box.low);
    const glm::dvec3 high = origin + glm::dvec3(box.high);
    return py::make_tuple(low.x, low.y, low.z, high.x, high.y, high.z);
}

} // namespace

Field::Field(const std::filesystem::path& path)
    : name_(path.string())
    , bytes_(bytesOf(path))
    , owned_(field::readField(path))
{
}

Field::Field(std::vector<std::byte>&& file, std::string name)
    : name_(std::move(name))
    , file_(std::move(file))
    , bytes_(file_.size())
    , owned_(field::readField(std::span<const std::byte>(file_), name_))
{
}

Field::Field(field::Field&& field, std::string name, std::string bakeReport)
    : report(std::move(bakeReport))
    , name_(std::move(name))
    , memory_(std::make_shared<const field::Field>(std::move(field)))
    , bytes_(field::fieldBytes(*memory_))
    , owned_(memory_)
{
}

void Field::save(const std::filesystem::path& path, bool overwrite) const
{
    if (memory_ != nullptr) {
        field::writeField(*memory_, path, overwrite);
        return;
    }
    AtomicFile out(path, overwrite);
    out.write(std::span<const std::byte>(file_));
    out.commit();
}

void addField(py::module_& module)
{
    py::class_<Field, std::shared_ptr<Field>>(module, "Field")
        .def_property_readonly("name", [](const Field& field) { return py::bytes(field.name()); })
        .def_property_readonly("is_mapped", &Field::isMapped)
        .def_property_readonly("file_bytes", &Field::bytes)
        .def_readwrite("report", &Field::report)
        .def_property_readonly("provenance",
                               [](const Field& field) { return *field.view().provenance; })
        .def_property_readonly("copyright",
                               [](const Field& field) { return *field.view().copyright; })
        .def_property_readonly("origin",
                               [](const Field& field) {
                                   const glm::dvec3 origin = field.view().origin;
                                   return py::make_tuple(origin.x, origin.y, origin.z);
                               })
        .def_property_readonly("bounds", boundsOf)
        .def_property_readonly("species", speciesOf)
        .def_property_readonly("count",
                               [](const Field& field) { return field.view().blades.size(); })
        .def_property_readonly("rooted",
                               [](const Field& field) { return field::rootedBlades(field.view()); })
        .def_property_readonly("has_seeds",
                               [](const Field& field) { return field.view().seeds != nullptr; })
        .def("info", infoOf, py::call_guard<py::gil_scoped_release>())
        .def("validate_seeds", validateSeeds, py::call_guard<py::gil_scoped_release>())
        .def("save",
             [](const Field& field, const std::string& path, bool overwrite) {
                 if (field.isMapped())
                     fail(ErrorKind::usage, "{}: is a file already; copy it", field.name());
                 forgetReadFiles();
                 apps::requireOutput(path, ".sward", overwrite);
                 work(py::none(), [&](Progress&) { field.save(path, overwrite); });
             })
        .def("export", exportField)
        .def("grow", growField)
        .def("unpacked", [](const Field& field, std::uint64_t first,
                            std::uint64_t count) { return unpackedBlades(field, first, count); })
        .def("curves", [](const Field& field, std::uint64_t first, std::uint64_t count) {
            return restingCurves(field, first, count);
        });
    module.def("packed", packedBlades);
    module.def("patches", patches);
    module.def("keys", keys);
    module.def("read", [](const std::string& path, bool copies) {
        std::shared_ptr<Field> field;
        work(py::none(), [&](Progress&) { field = readField(path, copies); });
        return field;
    });
    module.def("from_bytes", fieldOf);
    module.def("compare", compareFields);
}

} // namespace sward::python
