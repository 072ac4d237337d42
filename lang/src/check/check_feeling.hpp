/// Forces in a task file whose robot feels no force: E630, W635.
#pragma once

#include "check/context.hpp"

namespace zwang::lang {

/// E630: forces in the file, where the drive has a torque limit of its own and measures none. W635: what
/// such a drive pushes with.
void check_feeling(CheckContext& context);

}  // namespace zwang::lang
