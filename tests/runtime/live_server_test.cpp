// The server of `zwang run --live`, asked by bare sockets: whom it refuses, and that nobody waits for a page.
#include "live_server.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <thread>

#include "output.hpp"

namespace zwang::cli {
namespace {

constexpr int patience = 5000;  // [ms] until a test that waits in vain fails

class Socket {
 public:
  explicit Socket(int port, const char* address = "127.0.0.1") : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(port));
    inet_pton(AF_INET, address, &to.sin_addr);
    is_connected_ = connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0;
  }
  ~Socket() { close(socket_); }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;

  bool is_connected() const { return is_connected_; }
  void send(const std::string& bytes) {
    static_cast<void>(::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL));
  }

  /// Reads on. False: the other side has closed, or nothing came.
  bool more() {
    pollfd waits{socket_, POLLIN, 0};
    if (poll(&waits, 1, patience) <= 0) return false;
    std::array<char, 65536> bytes{};
    const ssize_t count = recv(socket_, bytes.data(), bytes.size(), 0);
    if (count <= 0) return false;
    read_.append(bytes.data(), static_cast<std::size_t>(count));
    return true;
  }
  /// All that comes until there are so many bytes, or the other side closes.
  std::string take(std::size_t size) {
    while (read_.size() < size && more()) {
    }
    std::string taken = read_.substr(0, size);
    read_.erase(0, size);
    return taken;
  }
  std::string take_head() {
    std::size_t end = std::string::npos;
    while ((end = read_.find("\r\n\r\n")) == std::string::npos && more()) {
    }
    return take(end == std::string::npos ? read_.size() : end + 4);
  }
  /// The text of the next message; none: the stream has ended.
  std::optional<std::string> take_message() {
    const std::string head = take(2);
    if (head.size() < 2 || (static_cast<unsigned char>(head[0]) & 15U) == 8U) return std::nullopt;
    std::size_t size = static_cast<unsigned char>(head[1]) & 127U;
    const std::size_t more_bytes = size == 126 ? 2 : size == 127 ? 8 : 0;
    if (more_bytes > 0) {
      size = 0;
      for (const char c : take(more_bytes)) size = size << 8U | static_cast<unsigned char>(c);
    }
    return take(size);
  }
  /// As a browser sends a text: masked.
  void send_text(const std::string& text) {
    std::string frame = "\x81";
    frame += static_cast<char>(128U | (text.size() < 126 ? text.size() : 126U));
    if (text.size() >= 126) {
      frame += static_cast<char>(text.size() >> 8U);
      frame += static_cast<char>(text.size() & 255U);
    }
    frame += std::string(4, '\x55');
    for (const char c : text) frame += static_cast<char>(c ^ '\x55');
    send(frame);
  }

 private:
  int socket_;
  bool is_connected_ = false;
  std::string read_;
};

int port_of(const LiveServer& server) {
  return std::stoi(server.origin().substr(server.origin().rfind(':') + 1));
}
std::string host_of(const LiveServer& server) {
  return server.origin().substr(std::string("http://").size());
}
/// `/TOKEN/`
std::string path_of(const LiveServer& server) {
  return server.address().substr(server.origin().size());
}

std::string get(const LiveServer& server, const std::string& path, const std::string& host) {
  Socket socket(port_of(server));
  socket.send("GET " + path + " HTTP/1.1\r\nHost: " + host + "\r\nConnection: close\r\n\r\n");
  const std::string head = socket.take_head();
  return head + socket.take(1'000'000);
}

/// Asks for the stream; `origin` empty: says none, as what is no browser does.
std::string open_stream(Socket& socket, const std::string& path, const std::string& host,
                        const std::string& origin) {
  socket.send("GET " + path + " HTTP/1.1\r\nHost: " + host +
              "\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n" +
              "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n" +
              (origin.empty() ? "" : "Origin: " + origin + "\r\n") + "\r\n");
  return socket.take_head();
}

bool is(const std::string& answer, const std::string& status) {
  return answer.starts_with("HTTP/1.1 " + status) || answer.starts_with("HTTP/1.0 " + status);
}

struct OpenPage {
  explicit OpenPage(const LiveServer& server) : socket(port_of(server)) {
    EXPECT_TRUE(is(open_stream(socket, path_of(server) + "stream", host_of(server), server.origin()), "101"));
  }
  Socket socket;
};

template <typename Condition>
bool comes_true(const Condition& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(patience);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

TEST(LiveServer, ServesThePageAtItsAddressAlone) {
  LiveServer server(0);
  server.serve("<!doctype html>here");
  const std::string good = get(server, path_of(server), host_of(server));
  EXPECT_TRUE(is(good, "200")) << good;
  EXPECT_NE(good.find("<!doctype html>here"), std::string::npos);
  EXPECT_NE(good.find("frame-ancestors 'none'"), std::string::npos);
  EXPECT_NE(good.find("no-referrer"), std::string::npos);
  const std::string other_token = "/" + std::string(32, '0') + "/";
  for (const std::string& path :
       {std::string("/"), other_token, path_of(server) + "x", std::string("/../etc")}) {
    const std::string answer = get(server, path, host_of(server));
    EXPECT_FALSE(is(answer, "200")) << path;
    EXPECT_EQ(answer.find("here"), std::string::npos) << path;
  }
  // A name that somebody else lets lead to this machine.
  EXPECT_TRUE(is(get(server, path_of(server), "attacker.example:" + std::to_string(port_of(server))), "403"));
}

TEST(LiveServer, HasAnotherTokenEachTime) {
  const LiveServer first(0), second(0);
  EXPECT_NE(path_of(first), path_of(second));
  EXPECT_EQ(path_of(first).size(), 2u + 32u);
}

TEST(LiveServer, ListensOnLoopbackAlone) {
  const LiveServer server(0);
  EXPECT_TRUE(Socket(port_of(server)).is_connected());
  // Whoever listens on every address listens on this one, too.
  EXPECT_FALSE(Socket(port_of(server), "127.0.0.2").is_connected());
}

TEST(LiveServer, SaysThatThePortIsTaken) {
  const LiveServer first(0);
  EXPECT_THROW(LiveServer(port_of(first)), Impossible);
}

TEST(LiveServer, OpensTheStreamToItsOwnPageAlone) {
  LiveServer server(0);
  server.begin("first");
  const std::string stream = path_of(server) + "stream", host = host_of(server);
  const std::string other_token = "/" + std::string(32, '0') + "/stream";
  const std::string others_host = "attacker.example:" + std::to_string(port_of(server));
  for (const auto& [path, to, origin] : std::initializer_list<std::array<std::string, 3>>{
           {stream, host, "http://attacker.example"},
           {stream, host, "http://localhost:" + std::to_string(port_of(server))},
           {stream, host, "null"},
           {stream, host, ""},
           {stream, others_host, "http://" + others_host},
           {other_token, host, server.origin()},
           {"/stream", host, server.origin()}}) {
    Socket socket(port_of(server));
    const std::string answer = open_stream(socket, path, to, origin);
    EXPECT_FALSE(is(answer, "101")) << path << ' ' << origin << '\n' << answer;
  }
  EXPECT_EQ(server.pages(), 0u);
  OpenPage page(server);
  EXPECT_EQ(page.socket.take_message(), "first");
  EXPECT_EQ(server.pages(), 1u);
}

TEST(LiveServer, ALatePageGetsTheBeginThenTheStateThenWhatIsKept) {
  LiveServer server(0, {.messages = 3});
  server.send("of an earlier run");
  server.begin("begin");
  server.tell_state("old state");
  server.tell_state("state");
  for (const char* message : {"1", "2", "3", "4", "5"}) server.send(message);
  OpenPage page(server);
  for (const char* expected : {"begin", "state", "3", "4", "5"})
    EXPECT_EQ(page.socket.take_message(), expected);
}

TEST(LiveServer, NobodyWaitsForAPageThatDoesNotRead) {
  LiveServer server(0, {.messages = 4096, .bytes = 1'000'000});
  server.begin("begin");
  OpenPage dead(server);
  const std::string large(50'000, 'x');
  // Far more than the system's buffers hold.
  for (int i = 0; i < 1000; ++i) server.send(large);
  server.send("last");
  OpenPage other(server);
  std::optional<std::string> message = other.socket.take_message();
  EXPECT_EQ(message, "begin");
  int count = 0;
  while (message && message != "last") {
    message = other.socket.take_message();
    ++count;
  }
  EXPECT_EQ(message, "last");
  EXPECT_LE(count, 21);  // the bound of 1 MB, and `last`
}

TEST(LiveServer, PagesThatLeaveMakeRoom) {
  LiveServer server(0);
  for (int i = 0; i < 20; ++i) {
    const OpenPage page(server);
    ASSERT_TRUE(comes_true([&] { return server.pages() >= 1; }));
  }
  EXPECT_TRUE(comes_true([&] { return server.pages() == 0; }));
}

TEST(LiveServer, TakesShortRequestsAndNotTooMany) {
  LiveServer server(0, {.requests = 3});
  OpenPage page(server);
  page.socket.send_text("hello");
  std::vector<std::string> requests;
  EXPECT_TRUE(comes_true([&] { return !(requests = server.take_requests()).empty(); }));
  EXPECT_EQ(requests, std::vector<std::string>{"hello"});
  for (int i = 0; i < 50; ++i) page.socket.send_text("again");
  // A request that is too long ends the stream, so all requests before it have come.
  page.socket.send_text(std::string(2000, 'x'));
  EXPECT_TRUE(comes_true([&] { return server.pages() == 0; }));
  EXPECT_EQ(server.take_requests(), std::vector<std::string>(3, "again"));
}

}  // namespace
}  // namespace zwang::cli
