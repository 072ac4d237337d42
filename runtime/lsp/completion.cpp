#include "zwang/lang/completion.hpp"

#include <algorithm>

#include "features.hpp"
#include "shared_name.hpp"

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
    case lang::ProposalKind::file:
      return 17;  // File
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

/// The files as the asked file would name them. Files below its folder come first.
std::vector<lang::KnownFile> files_to_name(const Asked& asked) {
  std::vector<lang::KnownFile> files;
  for (const auto& [path, kind] : asked.workspace.files_around(asked.file)) {
    if (path != asked.file)
      files.push_back({path.lexically_relative(asked.file.parent_path()).generic_string(), kind});
  }
  std::stable_partition(files.begin(), files.end(),
                        [](const lang::KnownFile& file) { return !file.name.starts_with(".."); });
  return files;
}

/// Of the robot that the text names: for a task file that was never whole.
std::vector<std::string> frames_of_named_robot(const Asked& asked) {
  constexpr std::string_view key = "\nrobot: ";
  const std::string text = "\n" + asked.document.text;
  const std::size_t found = text.find(key);
  if (found == std::string::npos) return {};
  const std::size_t begin = found + key.size();
  lang::Diagnostics unheard;
  const auto robot = lang::load_robot(
      asked.file.parent_path() / text.substr(begin, text.find_first_of(" #\r\n", begin) - begin), unheard);
  if (!robot) return {};
  std::vector<std::string> frames{"world"};
  for (const solver::Frame& frame : robot->model.frames()) frames.push_back(frame.name);
  return frames;
}

/// By the last text that could be read. Scenarios and scenes know the names of the tasks that they name.
lang::KnownNames known_to(const Asked& asked) {
  lang::KnownNames known;
  known.files = [&asked] { return files_to_name(asked); };
  const Judgement* judgement = asked.workspace.judgement(asked.file);
  if (judgement != nullptr) known.given = judgement->last_names;
  if (asked.kind != lang::FileKind::task) {
    for (const lang::NamePlace& name : names_of_tasks_in(asked.file)) known.given.push_back(name);
  }
  if (judgement == nullptr || !judgement->last) {
    known.frames = frames_of_named_robot(asked);
    return known;
  }
  for (const lang::FrameDeclaration& frame : judgement->last->program.frames)
    known.frames.push_back(frame.name);
  return known;
}

/// UTF-16 units of a text within a line.
int units_of(std::string_view text) {
  return Lines(text).end().character;
}

}  // namespace

Json completion(const Asked& asked) {
  const Lines lines(asked.document.text);
  const std::size_t offset = lines.offset(asked.position);
  const lang::TextPlace place = lang::place_at(asked.document.text, offset);
  const auto range_from = [&](std::size_t begin) -> Json {
    EditorPosition start = asked.position;
    start.character -= units_of(std::string_view(asked.document.text).substr(begin, offset - begin));
    return {{"start", json_of(start)}, {"end", json_of(asked.position)}};
  };
  const Json of_word = range_from(place.word_begin), of_value = range_from(place.value_begin);
  Json items = Json::array();
  for (const lang::Proposal& p : lang::proposals(asked.kind, asked.document.text, offset, known_to(asked))) {
    const bool is_key = p.kind == lang::ProposalKind::key;
    char order[16];
    std::snprintf(order, sizeof order, "%04zu", items.size());
    Json item = {
        {"label", p.text},
        {"kind", number_of(p.kind)},
        {"sortText", order},
        {"textEdit",
         {{"range", p.is_whole ? of_value : of_word}, {"newText", is_key ? p.text + ": " : p.text}}}};
    if (!p.about.empty()) item["detail"] = p.about;
    items.push_back(std::move(item));
  }
  return {{"isIncomplete", false}, {"items", std::move(items)}};
}

}  // namespace zwang::lsp
