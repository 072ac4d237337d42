/// Which of zwang's files a file is, and reading it as that.
#pragma once

#include <optional>
#include <string>

#include "zwang/lang/program.hpp"

namespace zwang::cli {

enum class FileKind { task, robot, scene, scenario };

const char* word_of(FileKind kind);
/// By the file's first key, a misspelt one, too: its reader says what is wrong. nullopt when it is none of
/// zwang's.
std::optional<FileKind> kind_by_key(const std::string& path);
/// What was read, in a few words; nothing when it is bad. `options` are a task file's. `with_notes`: notes
/// are looked for, too.
std::optional<std::string> read_as(FileKind kind, const std::string& path, lang::Diagnostics& diagnostics,
                                   const lang::LoadOptions& options = {}, bool with_notes = false);

}  // namespace zwang::cli
