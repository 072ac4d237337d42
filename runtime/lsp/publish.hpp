/// The diagnostics of the open files, sorted by the file that each is about.
#pragma once

#include <filesystem>
#include <map>

#include "json.hpp"

namespace zwang::lsp {

/// The parameters of `textDocument/publishDiagnostics`, by file. A file that several open files read has what
/// all of them say of it, once.
std::map<std::filesystem::path, Json> published(const Workspace& workspace,
                                                const std::filesystem::path& explanations);

/// Quick fixes: the `CodeAction`s of the diagnostics of a file that touch a range.
Json quick_fixes(const Workspace& workspace, const std::filesystem::path& file, const EditorPosition& begin,
                 const EditorPosition& end, const std::filesystem::path& explanations);

}  // namespace zwang::lsp
