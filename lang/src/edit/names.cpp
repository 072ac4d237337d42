#include "zwang/lang/names.hpp"

#include <algorithm>
#include <array>
#include <tuple>

#include "edit/name_walk.hpp"
#include "spec/value.hpp"
#include "tree/file.hpp"

namespace zwang::lang {

namespace fs = std::filesystem;

namespace {

/// The place that gives what is meant; nullptr where this file does not give it.
const NamePlace* given_for(const NamePlace& meant, const std::vector<NamePlace>& all) {
  for (const NameKind kind : meant.kinds) {
    const NamePlace* elsewhere = nullptr;
    for (const NamePlace& place : all) {
      if (!place.is_given || place.kinds.front() != kind || place.name != meant.name) continue;
      if (!has_scope(kind) || place.scope == meant.scope || place.scope == "always") return &place;
      // A task that uses a template may speak of the template's groups.
      if (kind == NameKind::group && elsewhere == nullptr) elsewhere = &place;
    }
    if (elsewhere != nullptr) return elsewhere;
  }
  return nullptr;
}

void collect_files(const Node& node, const fs::path& path, std::vector<NamedFile>& files) {
  static constexpr std::array keys{"robot", "scene", "task", "scenario", "urdf", "based_on"};
  const auto add = [&](const Node& scalar) {
    const std::string extension = fs::path(scalar.text).extension().string();
    if (scalar.is_scalar() && (extension == ".yaml" || extension == ".yml" || extension == ".urdf"))
      files.push_back({scalar.text, (path.parent_path() / scalar.text).lexically_normal(), scalar.span});
  };
  for (const Node& item : node.items) collect_files(item, path, files);
  for (const Entry& entry : node.entries) {
    collect_files(entry.value, path, files);
    if (std::find(keys.begin(), keys.end(), entry.key.text) == keys.end()) continue;
    add(entry.value);
    for (const Node& item : entry.value.items) add(item);
  }
}

std::optional<Document> document_of(const fs::path& path, Diagnostics& diagnostics) {
  const std::optional<int> source = read_file(path, yaml_size_limit, {}, diagnostics);
  if (!source) return std::nullopt;
  return read(*source, diagnostics);
}

}  // namespace

const char* word_of(NameKind kind) {
  static constexpr std::array words{"task",   "template", "argument", "parameter", "frame",         "signal",
                                    "region", "feature",  "group",    "object",    "set of faults", "output"};
  return words[static_cast<std::size_t>(kind)];
}

bool NamePlace::may_be(NameKind kind) const {
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

bool has_scope(NameKind kind) {
  return kind == NameKind::group || kind == NameKind::argument;
}

bool is_name(const std::string& text) {
  return is_identifier(text);
}

std::vector<NamePlace> names_of(FileKind kind, const fs::path& path, Diagnostics& diagnostics) {
  const std::optional<Document> document = document_of(path, diagnostics);
  if (!document) return {};
  std::vector<NamePlace> places = NameWalk(*document, diagnostics.source(document->source).text).walk(kind);
  for (NamePlace& place : places) {
    if (place.is_given) continue;
    const NamePlace* given = given_for(place, places);
    if (given == nullptr) continue;
    place.scope = given->scope;
    place.kinds = given->kinds;
  }
  std::stable_sort(places.begin(), places.end(), [](const NamePlace& a, const NamePlace& b) {
    return std::tie(a.span.begin.line, a.span.begin.column) <
           std::tie(b.span.begin.line, b.span.begin.column);
  });
  return places;
}

std::vector<NamedFile> files_in(const fs::path& path, Diagnostics& diagnostics) {
  std::vector<NamedFile> files;
  if (const std::optional<Document> document = document_of(path, diagnostics))
    collect_files(document->root, path, files);
  return files;
}

}  // namespace zwang::lang
