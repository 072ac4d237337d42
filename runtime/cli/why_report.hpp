/// Why a run is not `done`, as a table; `json_parts.hpp` has it as JSON.
#pragma once

#include <string>

#include "zwang/lang/diagnostic.hpp"
#include "zwang/runtime/why.hpp"

namespace zwang::cli {

/// Each exit that was waited for, and each of its terms with its last value; an empty line at its end.
std::string why_table(const runtime::Why& why, const lang::Diagnostics& diagnostics);

}  // namespace zwang::cli
