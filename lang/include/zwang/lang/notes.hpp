/// Loading with notes: what is no mistake and good to know.
#pragma once

#include "zwang/export.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::lang {

/// As `load`; first impacts (N603) and force budgets (N605) are computed and told as well.
ZWANG_EXPORT std::optional<Program> load_with_notes(const std::filesystem::path& path,
                                                    const LoadOptions& options, Diagnostics& diagnostics);

}  // namespace zwang::lang
