#include <algorithm>
#include <tuple>

#include "features.hpp"
#include "shared_name.hpp"

namespace zwang::lsp {

namespace fs = std::filesystem;

namespace {

/// The file that is named at the place: its begin.
Json named_file(const Asked& asked, const lang::Position& place) {
  lang::Diagnostics diagnostics;
  for (const lang::NamedFile& named : lang::files_in(asked.file, diagnostics)) {
    std::error_code error;
    if (!holds(named.span, place) || !fs::is_regular_file(named.path, error)) continue;
    const Json begin = json_of(EditorPosition{});
    return {{"uri", asked.workspace.uri(lang::canonical_name(named.path))},
            {"range", {{"start", begin}, {"end", begin}}}};
  }
  return nullptr;
}

/// SymbolKind.
int number_of(lang::NameKind kind) {
  switch (kind) {
    case lang::NameKind::task:
      return 6;  // Method
    case lang::NameKind::task_template:
      return 5;  // Class
    case lang::NameKind::parameter:
    case lang::NameKind::argument:
      return 14;  // Constant
    case lang::NameKind::signal:
      return 24;  // Event
    case lang::NameKind::group:
      return 8;  // Field
    default:
      return 19;  // Object
  }
}

}  // namespace

Json definition(const Asked& asked) {
  const lang::Position place = Lines(asked.document.text).from_editor(asked.position);
  if (Json file = named_file(asked, place); !file.is_null()) return file;
  const auto name = name_at(asked.file, asked.kind, place);
  if (!name) return nullptr;
  for (const fs::path& file : homes_of(asked.file)) {
    lang::Diagnostics diagnostics;
    const auto kind = kind_of(file);
    if (!kind) continue;
    for (const lang::NamePlace& given : lang::names_of(*kind, file, diagnostics)) {
      if (is_given_for(given, *name)) return location_of(asked.workspace, diagnostics, given.span);
    }
  }
  return nullptr;
}

Json references(const Asked& asked) {
  Json all = Json::array();
  const lang::Position place = Lines(asked.document.text).from_editor(asked.position);
  const auto shared = shared_name(asked.workspace, asked.file, asked.kind, place);
  if (!shared) return all;
  for (const FileOfName& file : shared->files) {
    for (const lang::Span& span : file.spans)
      all.push_back(location_of(asked.workspace, file.diagnostics, span));
  }
  return all;
}

Json symbols(const Asked& asked) {
  Json all = Json::array();
  lang::Diagnostics diagnostics;
  for (const lang::NamePlace& name : lang::names_of(asked.kind, asked.file, diagnostics)) {
    if (!name.is_given) continue;
    all.push_back({{"name", name.name},
                   {"kind", number_of(name.kinds.front())},
                   {"containerName", name.scope.empty() ? lang::word_of(name.kinds.front()) : name.scope},
                   {"location", location_of(asked.workspace, diagnostics, name.span)}});
  }
  return all;
}

Json prepare_rename(const Asked& asked) {
  const Lines lines(asked.document.text);
  const lang::Position place = lines.from_editor(asked.position);
  const auto name = name_at(asked.file, asked.kind, place);
  if (!name || !shared_name(asked.workspace, asked.file, asked.kind, place)) return nullptr;
  return {{"range", range_of(lines, name->span)}, {"placeholder", name->name}};
}

}  // namespace zwang::lsp
