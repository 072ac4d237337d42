/// Words to numbers: a checked file as the runtime wants it.
#pragma once

#include "check/check.hpp"

namespace zwang::lang {

Program lower(CheckedFile checked);

}  // namespace zwang::lang
