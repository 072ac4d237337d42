#include "json.hpp"

#include "uri.hpp"

namespace zwang::lsp {

std::string dumped(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json json_of(const EditorPosition& position) {
  return {{"line", position.line}, {"character", position.character}};
}

Json range_of(const Lines& lines, const lang::Span& span) {
  return {{"start", json_of(lines.to_editor(span.begin))}, {"end", json_of(lines.to_editor(span.end))}};
}

Json location_of(const Workspace& workspace, const lang::Diagnostics& diagnostics, const lang::Span& span) {
  const lang::Source& source = diagnostics.source(span.source);
  return {{"uri", workspace.uri(lang::canonical_name(source.path))},
          {"range", range_of(Lines(source.text), span)}};
}

const Json& object_at(const Json& object, const char* key) {
  static const Json none = Json::object();
  if (!object.is_object()) return none;
  const auto found = object.find(key);
  return found == object.end() || !found->is_object() ? none : *found;
}

std::string text_at(const Json& object, const char* key) {
  if (!object.is_object()) return {};
  const auto found = object.find(key);
  return found == object.end() || !found->is_string() ? std::string() : found->get<std::string>();
}

std::optional<EditorPosition> position_in(const Json& parameters) {
  constexpr std::int64_t most = 1 << 30;
  const Json& position = object_at(parameters, "position");
  const auto number = [&](const char* key) -> std::optional<int> {
    const auto found = position.find(key);
    if (found == position.end() || !found->is_number_integer()) return std::nullopt;
    const auto value = found->get<std::int64_t>();
    if (value < 0 || value > most) return std::nullopt;
    return static_cast<int>(value);
  };
  const auto line = number("line"), character = number("character");
  if (!line || !character) return std::nullopt;
  return EditorPosition{*line, *character};
}

std::optional<std::filesystem::path> file_in(const Json& parameters) {
  const auto path = path_of(text_at(object_at(parameters, "textDocument"), "uri"));
  if (!path) return std::nullopt;
  return lang::canonical_name(*path);
}

Json edits_of(const Workspace& workspace, const lang::Diagnostics& diagnostics, const lang::Diagnostic& d) {
  Json edits = Json::object();
  const auto add = [&](const lang::Span& span, const std::optional<std::string>& text) {
    if (!text || !span.exists()) return;
    const Json location = location_of(workspace, diagnostics, span);
    edits[location["uri"].get<std::string>()].push_back({{"range", location["range"]}, {"newText", *text}});
  };
  add(d.span, d.replacement);
  for (const lang::RelatedSpan& related : d.related) add(related.span, related.replacement);
  return edits;
}

}  // namespace zwang::lsp
