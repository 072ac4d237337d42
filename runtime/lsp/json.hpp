/// How places and diagnostics look in the protocol.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "lines.hpp"
#include "workspace.hpp"

namespace zwang::lsp {

using Json = nlohmann::json;

/// As a message: bytes that are no UTF-8 are replaced rather than thrown at.
std::string dumped(const Json& json);

Json json_of(const EditorPosition& position);
Json range_of(const Lines& lines, const lang::Span& span);
/// {uri, range}
Json location_of(const Workspace& workspace, const lang::Diagnostics& diagnostics, const lang::Span& span);

/// Of a request's `position`; nullopt where it is none.
std::optional<EditorPosition> position_in(const Json& parameters);
/// The canonical name of the file that a request's `textDocument` names; nullopt where it names none.
std::optional<std::filesystem::path> file_in(const Json& parameters);
/// The text at a key; empty where there is none.
std::string text_at(const Json& object, const char* key);
/// The object at a key; an empty one where there is none.
const Json& object_at(const Json& object, const char* key);

/// An edit of each file that the diagnostic's replacements change: {uri: [{range, newText}]}. Empty: it has
/// none.
Json edits_of(const Workspace& workspace, const lang::Diagnostics& diagnostics, const lang::Diagnostic& d);

}  // namespace zwang::lsp
