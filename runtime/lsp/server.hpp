/// The language server: what an editor asks, and what zwang answers.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace zwang::lsp {

/// One session. Not safe for several threads.
class Server {
 public:
  /// Takes the content of one message to the editor.
  using Send = std::function<void(const std::string& content)>;

  /// `explanations`: the folder of the pages `E201.md`, to which diagnostics link; may be empty.
  Server(Send send, std::filesystem::path explanations);
  ~Server();

  /// Takes the content of one message; answers it if it is a request. Content that is no message is answered
  /// with an error, as JSON-RPC has it.
  void receive(std::string_view content);
  /// A message was too long to be read.
  void refuse_too_long();
  /// Judges what has changed and tells the editor. To be called when no message waits.
  void settle();

  bool is_over() const;
  int exit_code() const;  ///< 0 after a `shutdown`, else 1

 private:
  class Session;
  std::unique_ptr<Session> session_;
};

/// Serves over two file descriptors until the editor says `exit` or closes its end. The exit code.
int serve(int in, int out, const std::filesystem::path& explanations);

}  // namespace zwang::lsp
