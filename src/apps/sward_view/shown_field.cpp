#include "apps/sward_view/shown_field.h"

#include <exception>
#include <utility>

namespace sward::view {

ShownField::ShownField(const std::filesystem::path& file)
    : mapped(field::readField(file))
    , view(mapped.view())
    , summary(field::summarise(view))
    , ground(view)
    , name(file.filename().string())
    , input(file.string())
{
}

FieldLoader::FieldLoader(std::string input, std::filesystem::path file)
    : input_(std::move(input))
    , thread_([this, file = std::move(file)] {
        std::unique_ptr<ShownField> field;
        std::exception_ptr failure;
        try {
            field = std::make_unique<ShownField>(file);
            field->input = input_;
            field->name = std::filesystem::path(input_).filename().string();
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
