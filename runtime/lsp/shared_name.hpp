/// A name over the files that share it: a task file gives it, scenarios and scenes mean it.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "zwang/lang/file_kind.hpp"
#include "zwang/lang/names.hpp"

namespace zwang::lsp {

class Workspace;

bool holds(const lang::Span& span, const lang::Position& place);

/// The name at a place of a file.
std::optional<lang::NamePlace> name_at(const std::filesystem::path& file, lang::FileKind kind,
                                       const lang::Position& place);
/// Whether `given` is where the name of `meant` is given.
bool is_given_for(const lang::NamePlace& given, const lang::NamePlace& meant);
/// The files in which names of a file may be given: itself, then what it names.
std::vector<std::filesystem::path> homes_of(const std::filesystem::path& file);

struct FileOfName {
  std::filesystem::path path;  ///< canonical
  lang::FileKind kind = lang::FileKind::task;
  lang::Diagnostics diagnostics;  ///< to whose sources the spans belong
  std::vector<lang::Span> spans;  ///< in the order of the text
};

struct SharedName {
  std::string name;
  lang::NameKind kind = lang::NameKind::task;
  std::vector<FileOfName> files;  ///< the one that gives it first
};
/// All places of the name that stands at a place. nullopt: no name stands there, or no file of zwang's gives
/// it: the URDF gives its links. Looks at the files below the root folder of the name's home.
std::optional<SharedName> shared_name(const Workspace& workspace, const std::filesystem::path& file,
                                      lang::FileKind kind, const lang::Position& place);

}  // namespace zwang::lsp
