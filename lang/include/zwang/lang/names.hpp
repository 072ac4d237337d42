/// The names of a file: where each is given, and where it is meant.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/diagnostic.hpp"
#include "zwang/lang/file_kind.hpp"

namespace zwang::lang {

enum class NameKind {
  task,
  task_template,
  argument,
  parameter,
  frame,
  signal,
  region,
  feature,
  group,
  object,
  fault_set,
  output
};

/// `task`, `template`, ...: for people.
ZWANG_EXPORT const char* word_of(NameKind kind);

/// Whether names of this kind are known within one task or template alone.
ZWANG_EXPORT bool has_scope(NameKind kind);

struct ZWANG_EXPORT NamePlace {
  /// The kinds that the name may have, the likeliest first; one kind if the file gives the name itself.
  std::vector<NameKind> kinds;
  std::string name;
  /// Of a group its task or template, of an argument its template: `tasks.press`, `templates.go`, `always`.
  std::string scope;
  Span span;
  bool is_given = false;  ///< the name is given here, not meant
  /// Of a parameter, a number signal, a number output or a feature that is given: its unit; empty: it has
  /// none.
  std::optional<std::string> unit{};

  bool may_be(NameKind kind) const;
};

/// In the order of the text. A name that is meant and given in the same file has the kind and the scope of
/// what gives it. Names of scenes, scenarios and connections that their task file gives keep all of their
/// kinds. Empty where the text is no YAML; the diagnostics say why.
ZWANG_EXPORT std::vector<NamePlace> names_of(FileKind kind, const std::filesystem::path& path,
                                             Diagnostics& diagnostics);

/// A path that a file names, at its place.
struct NamedFile {
  std::string written;
  std::filesystem::path path;  ///< seen from the file
  Span span;
};
/// Robots, scenes, tasks and URDFs that a file names.
ZWANG_EXPORT std::vector<NamedFile> files_in(const std::filesystem::path& path, Diagnostics& diagnostics);

/// Whether a text can be a name: a letter or `_`, then letters, digits and `_`.
ZWANG_EXPORT bool is_name(const std::string& text);

}  // namespace zwang::lang
