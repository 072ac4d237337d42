/// Serves one page and one stream of messages to browsers on this machine. It knows neither task nor robot.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace zwang::cli {

struct LiveServerBounds {
  std::size_t messages = 4096;     ///< that are kept for a page that opens late or is slow
  std::size_t bytes = 32'000'000;  ///< of them
  std::size_t requests = 64;       ///< of pages, not yet taken by the run; more are dropped
};

/// Listens on 127.0.0.1 alone, on a thread of its own. A random token is part of the address. A connection is
/// refused if the token is missing or its `Host` is another one. It is refused, too, if the page that opens
/// the stream came from elsewhere. Messages wait in a ring: a page that does not keep up misses the oldest
/// ones, and the run does not wait for it. All functions may be called from any thread.
class LiveServer {
 public:
  /// `port` 0: any free one. Throws Impossible where it cannot listen.
  explicit LiveServer(int port, const LiveServerBounds& bounds = {});
  ~LiveServer();
  LiveServer(const LiveServer&) = delete;
  LiveServer& operator=(const LiveServer&) = delete;

  std::string origin() const;   ///< `http://127.0.0.1:PORT`
  std::string address() const;  ///< of the page; the stream is `stream` beside it

  void serve(std::string page);
  /// The first message that each page gets from now on. Earlier messages are forgotten.
  void begin(std::string message);
  void send(std::string message);
  /// The latest state alone is sent, to each page once.
  void tell_state(std::string message);

  /// Texts of pages, of at most 1 kB each, the oldest first. Waits for no page.
  std::vector<std::string> take_requests();
  /// Pages whose stream is open.
  std::size_t pages() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace zwang::cli
