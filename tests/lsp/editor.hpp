/// An editor in the test's own process, which speaks with the language server.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "lsp/lines.hpp"
#include "lsp/server.hpp"
#include "lsp/uri.hpp"

namespace zwang::lsp::test {

using nlohmann::json;

inline std::string slurp(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("nothing to replace: " + from);
  return text.replace(at, from.size(), to);
}

class Editor {
 public:
  Editor()
      : server_([this](const std::string& content) { hear(json::parse(content)); },
                std::filesystem::path(ZWANG_SOURCE_DIR) / "docs/errors") {
    ask("initialize", json::object());
    tell("initialized", json::object());
  }

  Server& server() { return server_; }

  json ask(const std::string& method, const json& parameters) {
    ++id_;
    send({{"jsonrpc", "2.0"}, {"id", id_}, {"method", method}, {"params", parameters}});
    const auto found = answers_.find(id_);
    if (found == answers_.end()) throw std::runtime_error(method + ": no answer");
    return found->second.contains("error") ? found->second["error"] : found->second["result"];
  }
  void tell(const std::string& method, const json& parameters) {
    send({{"jsonrpc", "2.0"}, {"method", method}, {"params", parameters}});
  }

  void open(const std::filesystem::path& path, const std::string& text) {
    texts_[uri_of(path)] = text;
    tell("textDocument/didOpen",
         {{"textDocument", {{"uri", uri_of(path)}, {"languageId", "yaml"}, {"version", 1}, {"text", text}}}});
    server_.settle();
  }
  void change(const std::filesystem::path& path, const std::string& text) {
    texts_[uri_of(path)] = text;
    tell("textDocument/didChange", {{"textDocument", {{"uri", uri_of(path)}, {"version", ++version_}}},
                                    {"contentChanges", json::array({{{"text", text}}})}});
    server_.settle();
  }
  void close(const std::filesystem::path& path) {
    tell("textDocument/didClose", {{"textDocument", {{"uri", uri_of(path)}}}});
    server_.settle();
  }

  /// The last diagnostics of the file; empty if there were none.
  json diagnostics(const std::filesystem::path& path) const {
    const auto found = told_.find(uri_of(path));
    return found == told_.end() ? json::array() : found->second;
  }
  std::vector<std::string> codes(const std::filesystem::path& path, int most_severity = 2) const {
    std::vector<std::string> codes;
    for (const json& d : diagnostics(path)) {
      if (d["severity"] <= most_severity) codes.push_back(d["code"]);
    }
    return codes;
  }
  int errors(const std::filesystem::path& path) const { return static_cast<int>(codes(path, 1).size()); }
  json fixes(const std::filesystem::path& path, const json& range) {
    return ask("textDocument/codeAction",
               {{"textDocument", {{"uri", uri_of(path)}}}, {"range", range}, {"context", json::object()}});
  }
  /// The request's answer at the first place of `words` in the text, `into` bytes behind its begin.
  json at(const std::string& method, const std::filesystem::path& path, const std::string& words,
          std::size_t into = 0, json more = json::object()) {
    more["textDocument"] = {{"uri", uri_of(path)}};
    more["position"] = position(text(path), text(path).find(words) + into);
    return ask(method, more);
  }

  const std::string& text(const std::filesystem::path& path) const { return texts_.at(uri_of(path)); }
  const std::vector<json>& refusals() const { return refusals_; }

  static json position(const std::string& text, std::size_t offset) {
    const std::string before = text.substr(0, offset);
    const Lines lines(before);
    return {{"line", lines.end().line}, {"character", lines.end().character}};
  }

  /// The text after edits, done as an editor does them: the last one first, so that places stay.
  static std::string edited(const std::string& text, json edits) {
    const Lines lines(text);
    const auto offset = [&](const json& p) { return lines.offset({p["line"], p["character"]}); };
    std::sort(edits.begin(), edits.end(), [&](const json& a, const json& b) {
      return offset(a["range"]["start"]) > offset(b["range"]["start"]);
    });
    std::string result = text;
    for (const json& edit : edits) {
      const std::size_t begin = offset(edit["range"]["start"]), end = offset(edit["range"]["end"]);
      result.replace(begin, end - begin, edit["newText"].get<std::string>());
    }
    return result;
  }

 private:
  void send(const json& message) { server_.receive(message.dump()); }
  void hear(const json& message) {
    if (message.value("method", "") == "textDocument/publishDiagnostics") {
      told_[message["params"]["uri"]] = message["params"]["diagnostics"];
    } else if (message.contains("id") && message["id"].is_number()) {
      answers_[message["id"]] = message;
    } else {
      refusals_.push_back(message);
    }
  }

  Server server_;
  int id_ = 0, version_ = 1;
  std::map<int, json> answers_;
  std::map<std::string, json> told_;
  std::map<std::string, std::string> texts_;
  std::vector<json> refusals_;  ///< answers to what had no `id`
};

}  // namespace zwang::lsp::test
