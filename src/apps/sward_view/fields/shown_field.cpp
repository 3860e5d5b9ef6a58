#include "apps/sward_view/fields/shown_field.h"

#include "core/error.h"
#include "core/files/atomic_file.h"
#include "core/files/mapped_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

namespace sward::view {
namespace {

/// Larger files are mapped instead of copied [bytes], to limit the memory.
constexpr std::uintmax_t largestCopy = std::uintmax_t(1) << 30;
constexpr std::size_t copyStep = std::size_t(1) << 20; ///< [bytes]

// Copies a file, so that overwriting it while it is shown does no harm. Empty for a large file.
std::vector<std::byte> bytesOf(const std::filesystem::path& file)
{
    std::error_code unknown;
    const std::uintmax_t size = std::filesystem::file_size(file, unknown);
    return unknown || size > largestCopy ? std::vector<std::byte>() : readFile(file);
}

std::vector<field::Member> membersOf(const OpenedFields& fields)
{
    std::vector<field::Member> members;
    for (const auto& field : fields)
        members.push_back({field->mapped.view(), field->source.input});
    return members;
}

// A single field has its own summary; several get one of the joined view.
field::Summary summaryOf(const OpenedFields& fields, const field::FieldView& together)
{
    return fields.size() == 1 ? fields[0]->summary : field::summarise(together);
}

std::string titleOf(const std::vector<FieldSource>& sources, const OpenedFields& others)
{
    if (sources.empty())
        return fmt::format("{} fields", others.size());
    return sources.size() == 1 ? sources[0].input : fmt::format("{} fields", sources.size());
}

OpenedFields readAmong(std::vector<FieldSource> sources, OpenedFields others, std::size_t place)
{
    for (FieldSource& source : sources) {
        const auto at = static_cast<std::ptrdiff_t>(std::min(place++, others.size()));
        others.insert(others.begin() + at, std::make_shared<OpenedField>(std::move(source)));
    }
    return others;
}

} // namespace

OpenedField::OpenedField(FieldSource from)
    : source(std::move(from))
    , file(source.file, std::ios::binary)
    , bytes(bytesOf(source.file))
    , mapped(bytes.empty() ? field::readField(source.file)
                           : field::readField(bytes, source.file.string()))
    , summary(field::summarise(mapped.view()))
    , name(std::filesystem::path(source.input).filename().string())
{
}

void OpenedField::write(const std::filesystem::path& path, bool overwrite)
{
    AtomicFile out(path, overwrite);
    if (!bytes.empty()) {
        out.write(bytes);
    } else {
        std::vector<char> part(copyStep);
        file.clear();
        file.seekg(0);
        std::uint64_t copied = 0;
        while (file.read(part.data(), static_cast<std::streamsize>(part.size())),
               file.gcount() > 0) {
            out.write(std::string_view(part.data(), static_cast<std::size_t>(file.gcount())));
            copied += static_cast<std::uint64_t>(file.gcount());
        }
        if (copied != mapped.fileBytes())
            fail(ErrorKind::io, "{}: can no longer be read; nothing is saved",
                 source.file.string());
    }
    out.commit();
}

void OpenedField::save(const std::filesystem::path& path, bool overwrite)
{
    write(path, overwrite);
    savedAs = path;
}

ShownField::ShownField(OpenedFields fields)
    : members(std::move(fields))
    , group(membersOf(members))
    , view(group.view())
    , summary(summaryOf(members, view))
    , ground(view)
    , name(members[0]->name)
{
    if (members.size() > 1)
        name += fmt::format(" and {} more", members.size() - 1);
}

bool ShownField::has(const std::string& input) const
{
    return std::any_of(members.begin(), members.end(),
                       [&input](const auto& member) { return member->source.input == input; });
}

OpenedFields ShownField::unsaved() const
{
    OpenedFields fields;
    std::copy_if(members.begin(), members.end(), std::back_inserter(fields),
                 [](const auto& member) { return member->isUnsaved(); });
    return fields;
}

FieldLoader::FieldLoader(std::vector<FieldSource> sources, OpenedFields others, std::size_t place)
    : title_(titleOf(sources, others))
    , thread_([this, sources = std::move(sources), others = std::move(others), place]() mutable {
        std::unique_ptr<ShownField> field;
        std::exception_ptr failure;
        try {
            field = std::make_unique<ShownField>(
                readAmong(std::move(sources), std::move(others), place));
        } catch (...) {
            failure = std::current_exception();
        }
        const std::lock_guard lock(mutex_);
        field_ = std::move(field);
        failure_ = failure;
        done_ = true;
    })
{
}

FieldLoader::~FieldLoader()
{
    thread_.join();
}

bool FieldLoader::isDone()
{
    const std::lock_guard lock(mutex_);
    return done_;
}

std::unique_ptr<ShownField> FieldLoader::take()
{
    const std::lock_guard lock(mutex_);
    if (failure_)
        std::rethrow_exception(failure_);
    return std::move(field_);
}

} // namespace sward::view
