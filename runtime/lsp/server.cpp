#include "server.hpp"

#include <map>
#include <utility>

#include "features.hpp"
#include "publish.hpp"
#include "zwang/lang/completion.hpp"
#include "zwang/lang/format.hpp"

namespace zwang::lsp {

namespace fs = std::filesystem;

namespace {

/// JSON-RPC 2.0 and the protocol's own.
enum ErrorCode {
  parse_error = -32700,
  invalid_request = -32600,
  method_not_found = -32601,
  internal_error = -32603,
  not_initialized = -32002,
  request_failed = -32803,
};

Json capabilities() {
  return {{"capabilities",
           {{"positionEncoding", "utf-16"},
            {"textDocumentSync", {{"openClose", true}, {"change", 1}, {"save", true}}},
            {"codeActionProvider", {{"codeActionKinds", Json::array({"quickfix"})}}},
            {"documentFormattingProvider", true},
            {"hoverProvider", true},
            {"completionProvider", {{"triggerCharacters", Json::array({" ", ".", "$", "{"})}}},
            {"definitionProvider", true},
            {"referencesProvider", true},
            {"documentSymbolProvider", true},
            {"renameProvider", {{"prepareProvider", true}}}}},
          {"serverInfo", {{"name", "zwang"}}}};
}

}  // namespace

class Server::Session {
 public:
  Session(Send send, fs::path explanations)
      : send_(std::move(send)), explanations_(std::move(explanations)) {}

  void receive(std::string_view content) {
    const Json message = Json::parse(content, nullptr, false);
    if (message.is_discarded()) return refuse(nullptr, parse_error, "the content is no JSON");
    const bool is_message =
        message.is_object() && message.contains("method") && message["method"].is_string();
    if (!is_message) {
      // An answer to a request of ours has no method: there are none that wait for one.
      const bool is_answer = message.is_object() && (message.contains("result") || message.contains("error"));
      if (!is_answer) refuse(nullptr, invalid_request, "no `method`");
      return;
    }
    const std::string method = message["method"];
    const auto id = message.find("id");
    if (id == message.end()) return notice(method, object_at(message, "params"));
    if (!id->is_number_integer() && !id->is_string())
      return refuse(nullptr, invalid_request, "an `id` is a number or a text");
    answer(*id, method, object_at(message, "params"));
  }

  void refuse(const Json& id, int code, const std::string& why) {
    say({{"id", id}, {"error", {{"code", code}, {"message", why}}}});
  }

  void settle() {
    if (!workspace_.update()) return;
    std::map<fs::path, Json> now = published(workspace_, explanations_);
    for (auto& [file, parameters] : now) {
      const auto before = told_.find(file);
      if (before == told_.end() || before->second != parameters) tell_diagnostics(parameters);
    }
    for (const auto& [file, parameters] : told_) {
      if (now.contains(file)) continue;
      if (!parameters["diagnostics"].empty())
        tell_diagnostics({{"uri", parameters["uri"]}, {"diagnostics", Json::array()}});
    }
    told_ = std::move(now);
  }

  bool is_over() const { return is_over_; }
  int exit_code() const { return is_shut_down_ ? 0 : 1; }

 private:
  using Answer = Json (Session::*)(const Json& parameters);
  using Notice = void (Session::*)(const Json& parameters);

  void say(Json message) {
    message["jsonrpc"] = "2.0";
    send_(dumped(message));
  }

  void tell_diagnostics(const Json& parameters) {
    say({{"method", "textDocument/publishDiagnostics"}, {"params", parameters}});
  }

  void answer(const Json& id, const std::string& method, const Json& parameters) {
    static const std::map<std::string, Answer> answers = {
        {"initialize", &Session::initialize},
        {"shutdown", &Session::shut_down},
        {"textDocument/codeAction", &Session::code_actions},
        {"textDocument/formatting", &Session::format},
        {"textDocument/hover", &Session::ask<hover>},
        {"textDocument/completion", &Session::complete},
        {"textDocument/definition", &Session::ask<definition>},
        {"textDocument/references", &Session::ask<references>},
        {"textDocument/documentSymbol", &Session::ask<symbols>},
        {"textDocument/prepareRename", &Session::ask<prepare_rename>},
        {"textDocument/rename", &Session::rename_all}};
    if (is_shut_down_) return refuse(id, invalid_request, "nothing but `exit` follows `shutdown`");
    if (!is_initialized_ && method != "initialize")
      return refuse(id, not_initialized, "`initialize` comes first");
    const auto found = answers.find(method);
    if (found == answers.end()) return refuse(id, method_not_found, "no method `" + method + "`");
    try {
      settle();
      const lang::ReadsOpenTexts reading(workspace_.texts());
      say({{"id", id}, {"result", (this->*found->second)(parameters)}});
    } catch (const Refused& refused) {
      refuse(id, request_failed, refused.what());
    } catch (const std::exception& error) {
      refuse(id, internal_error, error.what());
    }
  }

  void notice(const std::string& method, const Json& parameters) {
    static const std::map<std::string, Notice> notices = {
        {"exit", &Session::exit},
        {"textDocument/didOpen", &Session::did_open},
        {"textDocument/didChange", &Session::did_change},
        {"textDocument/didClose", &Session::did_close},
        {"textDocument/didSave", &Session::did_change_on_disk},
        {"workspace/didChangeWatchedFiles", &Session::did_change_on_disk}};
    const auto found = notices.find(method);
    // `initialized`, `$/cancelRequest` and the like ask for nothing.
    if (found != notices.end() && (is_initialized_ || method == "exit")) (this->*found->second)(parameters);
  }

  Json initialize(const Json&) {
    is_initialized_ = true;
    return capabilities();
  }

  Json shut_down(const Json&) {
    is_shut_down_ = true;
    return nullptr;
  }

  void exit(const Json&) { is_over_ = true; }

  void did_open(const Json& parameters) {
    const auto file = file_in(parameters);
    if (!file) return;
    const Json& document = object_at(parameters, "textDocument");
    workspace_.open(*file, {text_at(document, "uri"), version_in(document), text_at(document, "text")});
  }

  void did_change(const Json& parameters) {
    const auto file = file_in(parameters);
    const auto changes = parameters.find("contentChanges");
    if (!file || changes == parameters.end() || !changes->is_array() || changes->empty()) return;
    workspace_.change(*file, version_in(object_at(parameters, "textDocument")),
                      text_at(changes->back(), "text"));
  }

  void did_close(const Json& parameters) {
    if (const auto file = file_in(parameters)) workspace_.close(*file);
    if (workspace_.documents().empty()) forget_all();
  }

  void did_change_on_disk(const Json&) { workspace_.look_again(); }

  /// Nothing is open any more, so nothing is said any more.
  void forget_all() {
    for (const auto& [file, parameters] : std::exchange(told_, {}))
      tell_diagnostics({{"uri", parameters["uri"]}, {"diagnostics", Json::array()}});
  }

  static int version_in(const Json& document) {
    const auto version = document.find("version");
    return version != document.end() && version->is_number_integer() ? version->get<int>() : 0;
  }

  Json code_actions(const Json& parameters) {
    const auto file = file_in(parameters);
    const Json& range = object_at(parameters, "range");
    const auto begin = position_in({{"position", object_at(range, "start")}});
    const auto end = position_in({{"position", object_at(range, "end")}});
    if (!file || !begin || !end) return Json::array();
    return quick_fixes(workspace_, *file, *begin, *end, explanations_);
  }

  /// The place that a request asks about; nullopt where no open file of zwang's is named.
  std::optional<Asked> asked_in(const Json& parameters) const {
    const auto file = file_in(parameters);
    const Document* document = file ? workspace_.document(*file) : nullptr;
    const auto kind = document == nullptr ? std::nullopt : lang::kind_of_text(document->text);
    if (!kind) return std::nullopt;
    return Asked{workspace_, *file, *document, *kind, position_in(parameters).value_or(EditorPosition{})};
  }

  template <Json (*feature)(const Asked&)>
  Json ask(const Json& parameters) {
    const auto asked = asked_in(parameters);
    return asked ? feature(*asked) : Json(nullptr);
  }

  /// A file that is about to be begun may become a task file.
  Json complete(const Json& parameters) {
    if (const auto asked = asked_in(parameters)) return completion(*asked);
    const auto file = file_in(parameters);
    const Document* document = file ? workspace_.document(*file) : nullptr;
    const bool is_yaml = file && (file->extension() == ".yaml" || file->extension() == ".yml");
    if (document == nullptr || !is_yaml || !lang::begins_a_file(document->text)) return nullptr;
    return completion({workspace_, *file, *document, lang::FileKind::task,
                       position_in(parameters).value_or(EditorPosition{})});
  }

  Json rename_all(const Json& parameters) {
    const auto asked = asked_in(parameters);
    return asked ? rename(*asked, text_at(parameters, "newName")) : Json(nullptr);
  }

  Json format(const Json& parameters) {
    const auto file = file_in(parameters);
    const Document* document = file ? workspace_.document(*file) : nullptr;
    if (document == nullptr || !lang::kind_of_text(document->text)) return Json::array();
    lang::Diagnostics diagnostics;
    const auto text = lang::format_file(*file, diagnostics);
    if (!text || *text == document->text) return Json::array();
    const Json whole = {{"start", json_of(EditorPosition{})}, {"end", json_of(Lines(document->text).end())}};
    return Json::array({{{"range", whole}, {"newText", *text}}});
  }

  Send send_;
  fs::path explanations_;
  Workspace workspace_;
  std::map<fs::path, Json> told_;  ///< what the editor knows, by file
  bool is_initialized_ = false, is_shut_down_ = false, is_over_ = false;
};

Server::Server(Send send, fs::path explanations)
    : session_(std::make_unique<Session>(std::move(send), std::move(explanations))) {}

Server::~Server() = default;

void Server::receive(std::string_view content) {
  session_->receive(content);
}

void Server::refuse_too_long() {
  session_->refuse(nullptr, invalid_request, "the message is longer than 16 MiB");
}

void Server::settle() {
  session_->settle();
}

bool Server::is_over() const {
  return session_->is_over();
}

int Server::exit_code() const {
  return session_->exit_code();
}

}  // namespace zwang::lsp
