#include "workspace.hpp"

#include <utility>
#include <variant>

#include "uri.hpp"
#include "zwang/lang/check_file.hpp"

namespace zwang::lsp {

namespace fs = std::filesystem;

std::optional<lang::FileKind> kind_of(const fs::path& path) {
  std::error_code error;
  const bool can_be_read = lang::open_text_of(path) != nullptr || fs::is_regular_file(path, error);
  return can_be_read ? lang::kind_of_file(path) : std::nullopt;
}

Judgement judge(const fs::path& path, lang::FileKind kind) {
  Judgement judgement;
  judgement.kind = kind;
  lang::FileContent content =
      lang::check_file(kind, path, {.load = {}, .with_notes = true}, judgement.diagnostics);
  if (auto* program = std::get_if<lang::Program>(&content)) {
    judgement.now = std::make_shared<const Loaded>(Loaded{judgement.diagnostics, std::move(*program)});
    judgement.last = judgement.now;
  }
  judgement.read.insert(lang::canonical_name(path));
  for (const lang::Source& source : judgement.diagnostics.sources())
    judgement.read.insert(lang::canonical_name(source.path));
  return judgement;
}

void Workspace::open(const fs::path& path, Document document) {
  texts_.put(path, document.text);
  documents_[path] = std::move(document);
  // A file that was missing may be there now.
  look_again();
}

void Workspace::change(const fs::path& path, int version, std::string text) {
  const auto found = documents_.find(path);
  if (found == documents_.end()) return;
  found->second.version = version;
  found->second.text = std::move(text);
  texts_.put(path, found->second.text);
  concern(path);
}

void Workspace::close(const fs::path& path) {
  texts_.remove(path);
  documents_.erase(path);
  judgements_.erase(path);
  stale_.erase(path);
  look_again();
}

void Workspace::look_again() {
  for (const auto& [path, document] : documents_) stale_.insert(path);
}

void Workspace::concern(const fs::path& changed) {
  stale_.insert(changed);
  for (const auto& [path, judgement] : judgements_) {
    if (judgement.read.contains(changed)) stale_.insert(path);
  }
}

bool Workspace::update() {
  if (stale_.empty()) return false;
  const lang::ReadsOpenTexts reading(texts_);
  for (const fs::path& path : std::exchange(stale_, {})) {
    const auto kind = lang::kind_of_text(documents_.at(path).text);
    if (!kind) {
      judgements_.erase(path);  // a URDF, or another program's file: what reads it is judged
      continue;
    }
    Judgement judgement = judge(path, *kind);
    lang::Diagnostics unheard;
    judgement.last_names = lang::names_of(*kind, path, unheard);
    const auto before = judgements_.find(path);
    if (before != judgements_.end()) {
      if (!judgement.last) judgement.last = std::move(before->second.last);
      if (judgement.last_names.empty()) judgement.last_names = std::move(before->second.last_names);
    }
    judgements_.insert_or_assign(path, std::move(judgement));
  }
  return true;
}

const Document* Workspace::document(const fs::path& path) const {
  const auto found = documents_.find(path);
  return found == documents_.end() ? nullptr : &found->second;
}

const Judgement* Workspace::judgement(const fs::path& path) const {
  const auto found = judgements_.find(path);
  return found == judgements_.end() ? nullptr : &found->second;
}

std::vector<ProjectFile> Workspace::files_around(const fs::path& file) const {
  return files_.around(file, [this](const fs::path& path) {
    const Document* open = document(path);
    return open == nullptr ? nullptr : &open->text;
  });
}

std::string Workspace::uri(const fs::path& path) const {
  const Document* open = document(path);
  return open == nullptr ? uri_of(path) : open->uri;
}

}  // namespace zwang::lsp
