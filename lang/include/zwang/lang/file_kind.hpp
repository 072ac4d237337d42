/// Which of zwang's files a text is.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "zwang/export.hpp"

namespace zwang::lang {

enum class FileKind { task, robot, scene, scenario, connection, study };

/// `task`, `robot`, `scene`, `scenario`, `connection` or `study`.
ZWANG_EXPORT const char* word_of(FileKind kind);

/// By the text's first key, a misspelt one, too: its reader says what is wrong. nullopt when it is none of
/// zwang's files.
ZWANG_EXPORT std::optional<FileKind> kind_of_text(std::string_view text);
/// The kind of a file by its first lines, or by its text in an open editor. nullopt as above.
ZWANG_EXPORT std::optional<FileKind> kind_of_file(const std::filesystem::path& path);

}  // namespace zwang::lang
