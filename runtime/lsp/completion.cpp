#include "zwang/lang/completion.hpp"

#include "features.hpp"

namespace zwang::lsp {

namespace {

/// CompletionItemKind.
int number_of(lang::ProposalKind kind) {
  switch (kind) {
    case lang::ProposalKind::key:
      return 10;  // Property
    case lang::ProposalKind::word:
      return 14;  // Keyword
    case lang::ProposalKind::unit:
      return 11;  // Unit
    case lang::ProposalKind::function:
      return 3;  // Function
    case lang::ProposalKind::name:
      break;
  }
  return 6;  // Variable
}

std::vector<lang::NamePlace> names_of_tasks_in(const std::filesystem::path& file) {
  std::vector<lang::NamePlace> names;
  lang::Diagnostics unheard;
  for (const lang::NamedFile& named : lang::files_in(file, unheard)) {
    if (kind_of(named.path) != lang::FileKind::task) continue;
    for (lang::NamePlace& name : lang::names_of(lang::FileKind::task, named.path, unheard))
      names.push_back(std::move(name));
  }
  return names;
}

/// By the last text that could be read. Scenarios and scenes know the names of the tasks that they name.
lang::KnownNames known_to(const Asked& asked) {
  lang::KnownNames known;
  const Judgement* judgement = asked.workspace.judgement(asked.file);
  if (judgement != nullptr) known.given = judgement->last_names;
  if (asked.kind != lang::FileKind::task) {
    for (const lang::NamePlace& name : names_of_tasks_in(asked.file)) known.given.push_back(name);
  }
  if (judgement == nullptr || !judgement->last) return known;
  for (const lang::FrameDeclaration& frame : judgement->last->program.frames)
    known.frames.push_back(frame.name);
  return known;
}

}  // namespace

Json completion(const Asked& asked) {
  const Lines lines(asked.document.text);
  const std::size_t offset = lines.offset(asked.position);
  const std::size_t begin = lang::place_at(asked.document.text, offset).word_begin;
  EditorPosition start = asked.position;
  start.character -= static_cast<int>(offset - begin);  // a word is of letters of one unit each
  const Json range = {{"start", json_of(start)}, {"end", json_of(asked.position)}};
  Json items = Json::array();
  for (const lang::Proposal& p : lang::proposals(asked.kind, asked.document.text, offset, known_to(asked))) {
    const bool is_key = p.kind == lang::ProposalKind::key;
    char order[16];
    std::snprintf(order, sizeof order, "%04zu", items.size());
    Json item = {{"label", p.text},
                 {"kind", number_of(p.kind)},
                 {"sortText", order},
                 {"textEdit", {{"range", range}, {"newText", is_key ? p.text + ": " : p.text}}}};
    if (!p.about.empty()) item["detail"] = p.about;
    items.push_back(std::move(item));
  }
  return {{"isIncomplete", false}, {"items", std::move(items)}};
}

}  // namespace zwang::lsp
