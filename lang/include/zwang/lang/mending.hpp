/// Edits that mend: which of the edits that diagnostics offer lead to a better file.
#pragma once

#include <filesystem>

#include "zwang/export.hpp"
#include "zwang/lang/check_file.hpp"
#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang {

/// With all edits of `d` made, `check_file` of the same file no longer tells `d`, and no error is new on the
/// lines that the edit wrote. `before` is what it told first.
ZWANG_EXPORT bool mends(FileKind kind, const std::filesystem::path& path, const CheckOptions& options,
                        const Diagnostics& before, const Diagnostic& d);

/// The same diagnostics without each edit and each choice that does not mend. A file is checked again for
/// each of them, so in files with very many mistakes the last ones lose their edits unasked.
ZWANG_EXPORT Diagnostics with_mending_edits(FileKind kind, const std::filesystem::path& path,
                                            const CheckOptions& options, const Diagnostics& before);

}  // namespace zwang::lang
