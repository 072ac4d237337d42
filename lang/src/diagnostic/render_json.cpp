// Diagnostics for programs: JSON for editors, SARIF for code scanning.
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "diagnostic/severity.hpp"
#include "zwang/lang/diagnostic.hpp"
#include "zwang/lang/explanation.hpp"

namespace zwang::lang {

namespace {

using nlohmann::ordered_json;

/// Paths and messages may hold bytes that are no UTF-8: they are replaced rather than thrown at.
std::string dump(const ordered_json& json) {
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace);
}

ordered_json position(const Position& p) {
  return {{"line", p.line}, {"column", p.column}};
}

ordered_json range(const Span& span) {
  if (!span.exists()) return nullptr;
  return {{"start", position(span.begin)}, {"end", position(span.end)}};
}

ordered_json file(const Diagnostics& diagnostics, const Span& span) {
  if (!span.exists()) return nullptr;
  return diagnostics.source(span.source).path;
}

ordered_json json_of(const Diagnostics& diagnostics, const Diagnostic& d) {
  ordered_json edits = ordered_json::array();
  const auto add_edit = [&](const Span& span, const std::optional<std::string>& text) {
    if (!text || !span.exists()) return;
    edits.push_back({{"file", file(diagnostics, span)}, {"range", range(span)}, {"text", *text}});
  };
  add_edit(d.span, d.replacement);
  ordered_json related = ordered_json::array();
  for (const RelatedSpan& r : d.related) {
    add_edit(r.span, r.replacement);
    related.push_back({{"file", file(diagnostics, r.span)}, {"range", range(r.span)}, {"text", r.text}});
  }
  return {{"code", d.code},
          {"severity", word_of(d.severity)},
          {"file", file(diagnostics, d.span)},
          {"range", range(d.span)},
          {"message", d.message},
          {"help", d.help},
          {"replacement", d.replacement ? ordered_json(*d.replacement) : ordered_json(nullptr)},
          {"choices", d.choices},
          {"edits", edits},
          {"related", related}};
}

// --- SARIF 2.1.0, https://docs.oasis-open.org/sarif/sarif/v2.1.0/ ---

/// A path as a URI reference: only what may stand in one, the rest as %XX (RFC 3986).
std::string uri_of(const std::string& path) {
  static constexpr const char* digits = "0123456789ABCDEF";
  static constexpr std::string_view plain = "-._~/";
  std::string uri = path.starts_with("/") ? "file://" : "";
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (is_letter || plain.find(c) != std::string_view::npos) {
      uri += c;
    } else {
      uri += {'%', digits[byte >> 4u], digits[byte & 0xFu]};
    }
  }
  return uri;
}

ordered_json sarif_region(const Span& span) {
  return {{"startLine", span.begin.line},
          {"startColumn", span.begin.column},
          {"endLine", span.end.line},
          {"endColumn", span.end.column}};
}

ordered_json sarif_replacement(const Span& span, const std::string& text) {
  return {{"deletedRegion", sarif_region(span)}, {"insertedContent", {{"text", text}}}};
}

ordered_json sarif_artifact(const Diagnostics& diagnostics, const Span& span) {
  return {{"uri", uri_of(diagnostics.source(span.source).path)}};
}

ordered_json sarif_location(const Diagnostics& diagnostics, const Span& span) {
  return {{"physicalLocation",
           {{"artifactLocation", sarif_artifact(diagnostics, span)}, {"region", sarif_region(span)}}}};
}

/// One fix for each text that may replace the span: a reader takes one of them.
ordered_json sarif_fixes(const Diagnostics& diagnostics, const Diagnostic& d) {
  ordered_json fixes = ordered_json::array();
  for (const std::string& text : d.replacement ? std::vector{*d.replacement} : d.choices) {
    ordered_json replacements = ordered_json::array({sarif_replacement(d.span, text)});
    for (const RelatedSpan& r : d.related) {
      if (r.replacement) replacements.push_back(sarif_replacement(r.span, *r.replacement));
    }
    const ordered_json change = {{"artifactLocation", sarif_artifact(diagnostics, d.span)},
                                 {"replacements", std::move(replacements)}};
    fixes.push_back({{"artifactChanges", ordered_json::array({change})}});
  }
  return fixes;
}

ordered_json sarif_result(const Diagnostics& diagnostics, const Diagnostic& d) {
  const std::string text = d.message + (d.help.empty() ? "" : "\n" + d.help);
  ordered_json result = {{"ruleId", d.code}, {"level", word_of(d.severity)}, {"message", {{"text", text}}}};
  if (!d.span.exists()) return result;
  result["locations"] = ordered_json::array({sarif_location(diagnostics, d.span)});
  ordered_json related = ordered_json::array();
  for (const RelatedSpan& r : d.related) {
    if (!r.span.exists()) continue;
    ordered_json location = sarif_location(diagnostics, r.span);
    location["message"] = {{"text", r.text}};
    related.push_back(std::move(location));
  }
  if (!related.empty()) result["relatedLocations"] = std::move(related);
  ordered_json fixes = sarif_fixes(diagnostics, d);
  if (!fixes.empty()) result["fixes"] = std::move(fixes);
  return result;
}

ordered_json sarif_rules(const std::set<std::string>& codes) {
  ordered_json rules = ordered_json::array();
  for (const std::string& code : codes) {
    const Explanation* explanation = find_explanation(code);
    if (explanation == nullptr) {
      rules.push_back({{"id", code}});
      continue;
    }
    rules.push_back({{"id", code},
                     {"shortDescription", {{"text", std::string(explanation->title)}}},
                     {"fullDescription", {{"text", std::string(explanation->why)}}},
                     {"help", {{"text", std::string(explanation->fix)}}}});
  }
  return rules;
}

}  // namespace

std::string render_json(const Diagnostics& diagnostics, const RenderOptions& options) {
  ordered_json all = ordered_json::array();
  for (const Diagnostic& d : diagnostics.sorted()) {
    if (d.severity == Severity::note && !options.notes) continue;
    all.push_back(json_of(diagnostics, d));
  }
  return dump(all);
}

std::string render_sarif(const std::vector<const Diagnostics*>& files, const std::string& version,
                         const RenderOptions& options) {
  ordered_json results = ordered_json::array();
  std::set<std::string> codes;
  for (const Diagnostics* diagnostics : files) {
    for (const Diagnostic& d : diagnostics->sorted()) {
      if (d.severity == Severity::note && !options.notes) continue;
      codes.insert(d.code);
      results.push_back(sarif_result(*diagnostics, d));
    }
    for (const Silenced& silenced : diagnostics->silenced()) {
      codes.insert(silenced.diagnostic.code);
      ordered_json result = sarif_result(*diagnostics, silenced.diagnostic);
      result["suppressions"] =
          ordered_json::array({{{"kind", "inSource"}, {"justification", silenced.reason}}});
      results.push_back(std::move(result));
    }
  }
  const ordered_json driver = {{"name", "zwang"}, {"version", version}, {"rules", sarif_rules(codes)}};
  const ordered_json run = {
      {"tool", {{"driver", driver}}}, {"columnKind", "unicodeCodePoints"}, {"results", std::move(results)}};
  const ordered_json log = {{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
                            {"version", "2.1.0"},
                            {"runs", ordered_json::array({run})}};
  return dump(log) + "\n";
}

}  // namespace zwang::lang
