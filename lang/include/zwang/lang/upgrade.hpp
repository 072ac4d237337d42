/// From an older version of the task language to the newest: what `zwang fmt --upgrade` writes.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "zwang/export.hpp"
#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang {

/// The task file's text in the newest version of the language, laid out as by `format_file`, with its
/// comments. The motion is the same: the version's number changes, and `speed` becomes `plane`, in axes and
/// in what conditions name. A text of the newest version is laid out alone. nullopt when the text cannot be
/// read; the diagnostics say why.
ZWANG_EXPORT std::optional<std::string> upgrade_task(const std::filesystem::path& path,
                                                     Diagnostics& diagnostics);

}  // namespace zwang::lang
