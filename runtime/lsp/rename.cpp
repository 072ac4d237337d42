#include <algorithm>
#include <map>
#include <set>

#include "features.hpp"
#include "shared_name.hpp"

namespace zwang::lsp {

namespace fs = std::filesystem;

namespace {

std::string text_with(const FileOfName& file, const std::string& new_name) {
  const std::string& before = file.diagnostics.source(file.spans.front().source).text;
  const Lines lines(before);
  std::string text = before;
  // From the end: what stands in front keeps its place.
  for (auto span = file.spans.rbegin(); span != file.spans.rend(); ++span) {
    const std::size_t begin = lines.offset(lines.to_editor(span->begin));
    const std::size_t end = lines.offset(lines.to_editor(span->end));
    text.replace(begin, end - begin, new_name);
  }
  return text;
}

struct Counts {
  int errors = 0, warnings = 0;
};

Counts counts_of(const fs::path& path, lang::FileKind kind) {
  const Judgement judgement = judge(path, kind);
  return {judgement.diagnostics.error_count(), judgement.diagnostics.count(lang::Severity::warning)};
}

/// The files whose meaning the edits may change: those that are edited, and tasks that read one of them.
std::map<fs::path, lang::FileKind> concerned(const Workspace& workspace, const SharedName& shared) {
  std::map<fs::path, lang::FileKind> files;
  std::set<fs::path> edited;
  for (const FileOfName& file : shared.files) {
    files.emplace(file.path, file.kind);
    edited.insert(file.path);
  }
  for (const auto& [path, kind] : workspace.files_around(shared.files.front().path)) {
    if (!kind) continue;
    lang::Diagnostics unheard;
    for (const lang::NamedFile& named : lang::files_in(path, unheard)) {
      if (edited.contains(lang::canonical_name(named.path))) files.emplace(path, *kind);
    }
  }
  return files;
}

/// The text itself is tried: whatever the language would refuse is refused here, in its own words.
void require_no_harm(const Asked& asked, const SharedName& shared, const std::string& new_name) {
  const std::map<fs::path, lang::FileKind> files = concerned(asked.workspace, shared);
  std::map<fs::path, Counts> before;
  for (const auto& [path, kind] : files) before[path] = counts_of(path, kind);
  lang::OpenTexts texts = asked.workspace.texts();
  for (const FileOfName& file : shared.files) texts.put(file.path, text_with(file, new_name));
  const lang::ReadsOpenTexts reading(texts);
  for (const auto& [path, kind] : files) {
    const Judgement after = judge(path, kind);
    const Counts& old = before[path];
    const bool is_harmed = after.diagnostics.error_count() > old.errors ||
                           after.diagnostics.count(lang::Severity::warning) > old.warnings;
    if (!is_harmed) continue;
    for (const lang::Diagnostic& d : after.diagnostics.sorted()) {
      if (d.severity != lang::Severity::note)
        throw Refused("with `" + new_name + "`, " +
                      (path.parent_path().filename() / path.filename()).string() +
                      " would say: " + d.message);
    }
  }
}

}  // namespace

Json rename(const Asked& asked, const std::string& new_name) {
  if (!lang::is_name(new_name))
    throw Refused("`" + new_name + "` is no name: write a letter or `_`, then letters, digits and `_`");
  const lang::Position place = Lines(asked.document.text).from_editor(asked.position);
  const auto shared = shared_name(asked.workspace, asked.file, asked.kind, place);
  if (!shared) throw Refused("no name stands here that one of zwang's files gives");
  require_no_harm(asked, *shared, new_name);
  Json changes = Json::object();
  for (const FileOfName& file : shared->files) {
    for (const lang::Span& span : file.spans) {
      const Json location = location_of(asked.workspace, file.diagnostics, span);
      changes[location["uri"].get<std::string>()].push_back(
          {{"range", location["range"]}, {"newText", new_name}});
    }
  }
  return {{"changes", std::move(changes)}};
}

}  // namespace zwang::lsp
