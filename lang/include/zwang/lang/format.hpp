/// The one layout of zwang's files: what `zwang fmt` writes.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "zwang/export.hpp"
#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang {

/// The file's text, laid out: two spaces an indent, one space where one belongs, comments behind text in one
/// column, no blank line twice. Lines, order and comments stay; what the text means is compared before and
/// after. nullopt when the text cannot be read; the diagnostics say why. Names and units are not checked
/// here. Throws std::logic_error rather than give a text that means something else.
ZWANG_EXPORT std::optional<std::string> format_file(const std::filesystem::path& path,
                                                    Diagnostics& diagnostics);

}  // namespace zwang::lang
