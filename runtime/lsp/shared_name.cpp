#include "shared_name.hpp"

#include <algorithm>
#include <set>
#include <tuple>

#include "workspace.hpp"

namespace zwang::lsp {

namespace fs = std::filesystem;

namespace {

std::set<fs::path> named_in(const fs::path& file) {
  lang::Diagnostics unheard;
  std::set<fs::path> files;
  for (const lang::NamedFile& named : lang::files_in(file, unheard))
    files.insert(lang::canonical_name(named.path));
  return files;
}

/// Where `place` stands for the given name, seen from another file than the one that gives it.
bool is_meant_elsewhere(const lang::NamePlace& place, const lang::NamePlace& given, bool names_home) {
  if (place.is_given || place.name != given.name || !place.may_be(given.kinds.front())) return false;
  // Of a scene's robots: names of those robots' task files.
  return names_home || !place.scope.starts_with("robots.");
}

class Search {
 public:
  Search(const Workspace& workspace, fs::path home, lang::NamePlace given)
      : workspace_(workspace), home_(std::move(home)), given_(std::move(given)) {}

  SharedName find() {
    SharedName shared{given_.name, given_.kinds.front(), {}};
    add(home_, lang::FileKind::task, true, shared);
    if (has_scope(shared.kind)) return shared;
    std::set<fs::path> scenes = named_in(home_);
    const std::vector<ProjectFile> around = workspace_.files_around(home_);
    for (const auto& [file, kind] : around) {
      if (kind != lang::FileKind::scenario && kind != lang::FileKind::study) continue;
      const std::set<fs::path> named = named_in(file);
      if (!leads_home(named)) continue;
      add(file, *kind, true, shared);
      scenes.insert(named.begin(), named.end());
    }
    for (const auto& [file, kind] : around) {
      if (kind != lang::FileKind::scene) continue;
      const bool names_home = named_in(file).contains(home_);
      if (names_home || scenes.contains(file)) add(file, lang::FileKind::scene, names_home, shared);
    }
    return shared;
  }

 private:
  /// A study names the task itself, or a scenario that does.
  bool leads_home(const std::set<fs::path>& named) const {
    return named.contains(home_) || std::any_of(named.begin(), named.end(), [this](const fs::path& file) {
             return kind_of(file) == lang::FileKind::scenario && named_in(file).contains(home_);
           });
  }

  void add(const fs::path& path, lang::FileKind kind, bool names_home, SharedName& shared) {
    FileOfName file;
    file.path = path;
    const auto real_kind = kind_of(path);
    file.kind = real_kind.value_or(kind);
    for (const lang::NamePlace& place : lang::names_of(file.kind, path, file.diagnostics)) {
      const bool is_it = path == home_ ? is_given_for(given_, place) || is_same_given(place)
                                       : is_meant_elsewhere(place, given_, names_home);
      if (is_it) file.spans.push_back(place.span);
    }
    if (!file.spans.empty()) shared.files.push_back(std::move(file));
  }

  bool is_same_given(const lang::NamePlace& place) const {
    return place.is_given && place.kinds == given_.kinds && place.name == given_.name &&
           place.scope == given_.scope;
  }

  const Workspace& workspace_;
  fs::path home_;
  lang::NamePlace given_;
};

}  // namespace

bool holds(const lang::Span& span, const lang::Position& place) {
  const auto key = [](const lang::Position& p) { return std::tuple(p.line, p.column); };
  return key(span.begin) <= key(place) && key(place) <= key(span.end);
}

std::optional<lang::NamePlace> name_at(const fs::path& file, lang::FileKind kind,
                                       const lang::Position& place) {
  lang::Diagnostics unheard;
  for (const lang::NamePlace& name : lang::names_of(kind, file, unheard)) {
    if (holds(name.span, place)) return name;
  }
  return std::nullopt;
}

bool is_given_for(const lang::NamePlace& given, const lang::NamePlace& meant) {
  if (!given.is_given || given.name != meant.name || !meant.may_be(given.kinds.front())) return false;
  return !has_scope(given.kinds.front()) || given.scope == meant.scope;
}

std::vector<fs::path> homes_of(const fs::path& file) {
  std::vector<fs::path> homes{file};
  for (const fs::path& named : named_in(file)) homes.push_back(named);
  return homes;
}

std::optional<SharedName> shared_name(const Workspace& workspace, const fs::path& file, lang::FileKind kind,
                                      const lang::Position& place) {
  const std::optional<lang::NamePlace> name = name_at(file, kind, place);
  if (!name) return std::nullopt;
  for (const fs::path& home : homes_of(file)) {
    const auto kind_of_home = kind_of(home);
    if (!kind_of_home) continue;
    lang::Diagnostics unheard;
    for (const lang::NamePlace& given : lang::names_of(*kind_of_home, home, unheard)) {
      if (is_given_for(given, *name)) return Search(workspace, home, given).find();
    }
  }
  return std::nullopt;
}

}  // namespace zwang::lsp
