#pragma once

#include "c/field.h"
#include "field/read.h"

#include <memory>

struct sward_field {
    std::shared_ptr<const sward::field::MappedField> mapped;
};
