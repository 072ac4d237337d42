#include "publish.hpp"

#include <algorithm>
#include <tuple>

#include "uri.hpp"
#include "zwang/lang/explanation.hpp"
#include "zwang/lang/mending.hpp"
#include "zwang/lang/open_texts.hpp"

namespace zwang::lsp {

namespace fs = std::filesystem;

namespace {

int severity_of(lang::Severity severity) {
  switch (severity) {
    case lang::Severity::error:
      return 1;
    case lang::Severity::warning:
      return 2;
    case lang::Severity::note:
      break;
  }
  return 4;  // a hint: it does not draw the eye
}

Json related_of(const Workspace& workspace, const lang::Diagnostics& diagnostics, const lang::Diagnostic& d) {
  Json related = Json::array();
  for (const lang::RelatedSpan& r : d.related) {
    if (!r.span.exists()) continue;
    related.push_back({{"location", location_of(workspace, diagnostics, r.span)}, {"message", r.text}});
  }
  return related;
}

Json json_of(const Workspace& workspace, const lang::Diagnostics& diagnostics, const lang::Diagnostic& d,
             const fs::path& explanations) {
  constexpr int unnecessary = 1;
  const Json start = {{"line", 0}, {"character", 0}};
  Json json = {{"severity", severity_of(d.severity)},
               {"code", d.code},
               {"source", "zwang"},
               {"message", d.message + (d.help.empty() ? "" : "\nhelp: " + d.help)}};
  json["range"] = d.span.exists() ? range_of(Lines(diagnostics.source(d.span.source).text), d.span)
                                  : Json{{"start", start}, {"end", start}};
  Json related = related_of(workspace, diagnostics, d);
  if (!related.empty()) json["relatedInformation"] = std::move(related);
  if (d.code == "W302") json["tags"] = Json::array({unnecessary});
  if (!explanations.empty() && lang::find_explanation(d.code) != nullptr)
    json["codeDescription"] = {{"href", uri_of(explanations / (d.code + ".md"))}};
  return json;
}

/// The file that a diagnostic is about; that of its reader where it has no place.
fs::path file_of(const fs::path& reader, const lang::Diagnostics& diagnostics, const lang::Diagnostic& d) {
  return d.span.exists() ? lang::canonical_name(diagnostics.source(d.span.source).path) : reader;
}

bool touches(const Lines& lines, const lang::Span& span, const EditorPosition& begin,
             const EditorPosition& end) {
  const auto key = [](const EditorPosition& p) { return std::tuple(p.line, p.character); };
  return key(lines.to_editor(span.begin)) <= key(end) && key(begin) <= key(lines.to_editor(span.end));
}

/// The diagnostic with the edit that it has, else with each of its choices.
std::vector<lang::Diagnostic> with_each_edit(const lang::Diagnostic& d) {
  if (d.choices.empty() || d.replacement) return {d};
  std::vector<lang::Diagnostic> all(d.choices.size(), d);
  for (std::size_t i = 0; i < all.size(); ++i) all[i].replacement = d.choices[i];
  return all;
}

std::string title_of(const lang::Diagnostic& d) {
  constexpr std::size_t widest = 60;
  const bool is_short = d.replacement && !d.replacement->empty() && d.replacement->size() <= widest &&
                        d.replacement->find('\n') == std::string::npos;
  if (is_short) return "write `" + *d.replacement + "`";
  return d.help.empty() ? "mend " + d.code : d.help;
}

}  // namespace

std::map<fs::path, Json> published(const Workspace& workspace, const fs::path& explanations) {
  std::map<fs::path, Json> files;
  const auto parameters_of = [&](const fs::path& file) -> Json& {
    const auto [entry, is_new] = files.try_emplace(file);
    if (!is_new) return entry->second;
    entry->second = {{"uri", workspace.uri(file)}, {"diagnostics", Json::array()}};
    if (const Document* open = workspace.document(file)) entry->second["version"] = open->version;
    return entry->second;
  };
  for (const auto& [path, document] : workspace.documents()) parameters_of(path);
  for (const auto& [reader, judgement] : workspace.judgements()) {
    for (const lang::Diagnostic& d : judgement.diagnostics.sorted()) {
      Json& all = parameters_of(file_of(reader, judgement.diagnostics, d))["diagnostics"];
      Json one = json_of(workspace, judgement.diagnostics, d, explanations);
      if (std::find(all.begin(), all.end(), one) == all.end()) all.push_back(std::move(one));
    }
  }
  return files;
}

Json quick_fixes(const Workspace& workspace, const fs::path& file, const EditorPosition& begin,
                 const EditorPosition& end, const fs::path& explanations) {
  Json actions = Json::array();
  const lang::ReadsOpenTexts reading(workspace.texts());
  for (const auto& [reader, judgement] : workspace.judgements()) {
    for (const lang::Diagnostic& d : judgement.diagnostics.sorted()) {
      if (!d.span.exists() || file_of(reader, judgement.diagnostics, d) != file) continue;
      if (!touches(Lines(judgement.diagnostics.source(d.span.source).text), d.span, begin, end)) continue;
      for (const lang::Diagnostic& edited : with_each_edit(d)) {
        Json edits = edits_of(workspace, judgement.diagnostics, edited);
        if (edits.empty()) continue;
        if (!lang::mends(judgement.kind, reader, {.load = {}, .with_notes = true}, judgement.diagnostics,
                         edited))
          continue;
        Json action = {
            {"title", title_of(edited)},
            {"kind", "quickfix"},
            {"isPreferred", d.choices.empty() || d.replacement},
            {"diagnostics", Json::array({json_of(workspace, judgement.diagnostics, d, explanations)})},
            {"edit", {{"changes", std::move(edits)}}}};
        if (std::find(actions.begin(), actions.end(), action) == actions.end())
          actions.push_back(std::move(action));
      }
    }
  }
  return actions;
}

}  // namespace zwang::lsp
