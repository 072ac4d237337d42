#include "live_server.hpp"

#include <libwebsockets.h>
#include <sys/random.h>

#include <array>
#include <atomic>
#include <cstring>
#include <deque>
#include <mutex>
#include <thread>

#include "output.hpp"

namespace zwang::cli {

namespace {

constexpr std::size_t longest_request = 1024;  // [bytes]
constexpr std::size_t most_pages = 8;
constexpr unsigned most_sockets = 48;

using Message = std::shared_ptr<const std::string>;

/// 128 random bits as hexadecimal digits.
std::string random_token() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw Impossible("the system gives no random numbers for the address of the page");
  constexpr std::string_view digits = "0123456789abcdef";
  std::string token;
  for (const unsigned char byte : bytes) {
    token += digits[byte >> 4U];
    token += digits[byte & 15U];
  }
  return token;
}

/// Takes as long for any text: the time tells nothing of the token.
bool same_text(const std::string& given, const std::string& wanted) {
  unsigned differs = given.size() == wanted.size() ? 0U : 1U;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const char letter = i < given.size() ? given[i] : '\0';
    differs |= static_cast<unsigned char>(letter ^ wanted[i]);
  }
  return differs == 0U;
}

std::string header(lws* socket, lws_token_indexes which) {
  std::array<char, 512> text{};
  const int length = lws_hdr_copy(socket, text.data(), text.size(), which);
  return length > 0 ? std::string(text.data(), static_cast<std::size_t>(length)) : std::string();
}

/// libwebsockets writes its own frame into the bytes before the message.
std::string with_room(const std::string& message) {
  return std::string(LWS_PRE, '\0') + message;
}

/// libwebsockets keeps it for each socket, filled with zeros.
struct Page {
  std::uint64_t begin, state, next;  ///< numbers of what it got, and of the message that it gets next
  bool is_open;
};

}  // namespace

struct LiveServer::Parts {
  explicit Parts(const LiveServerBounds& asked) : bounds(asked) {}

  LiveServerBounds bounds;
  std::string token = random_token();
  std::string host;  ///< `127.0.0.1:PORT`
  lws_context* context = nullptr;
  std::thread thread;
  std::atomic<bool> is_over = false;
  std::atomic<std::size_t> pages = 0;

  std::mutex mutex;  ///< of what follows; nobody holds it while a socket is written
  Message page, first, state;
  std::uint64_t begins = 0, states = 0;
  std::deque<Message> kept;
  std::uint64_t oldest = 0;  ///< number of the first one that is kept
  std::size_t kept_bytes = 0;

  std::mutex request_mutex;
  std::atomic<bool> has_requests = false;
  std::vector<std::string> requests;

  void forget_oldest() {
    kept_bytes -= kept.front()->size();
    kept.pop_front();
    ++oldest;
  }

  void wake() { lws_cancel_service(context); }

  bool comes_from_our_page(lws* socket) const {
    return same_text(header(socket, WSI_TOKEN_GET_URI), "/" + token + "/stream") &&
           header(socket, WSI_TOKEN_HOST) == host && header(socket, WSI_TOKEN_ORIGIN) == "http://" + host;
  }

  bool asks_for_page(lws* socket) const {
    return same_text(header(socket, WSI_TOKEN_GET_URI), "/" + token + "/") &&
           header(socket, WSI_TOKEN_HOST) == host;
  }

  int refuse(lws* socket, unsigned status) const {
    lws_return_http_status(socket, status, nullptr);
    return -1;
  }

  int answer(lws* socket) {
    if (!asks_for_page(socket)) return refuse(socket, HTTP_STATUS_FORBIDDEN);
    Message body;
    {
      const std::lock_guard lock(mutex);
      body = page;
    }
    if (!body) return refuse(socket, HTTP_STATUS_SERVICE_UNAVAILABLE);
    std::array<unsigned char, LWS_PRE + 2048> bytes{};
    unsigned char* begin = bytes.data() + LWS_PRE;
    unsigned char* at = begin;
    unsigned char* end = bytes.data() + bytes.size() - 1;
    if (lws_add_http_common_headers(socket, HTTP_STATUS_OK, "text/html; charset=utf-8",
                                    body->size() - LWS_PRE, &at, end) != 0)
      return -1;
    // The page's own policy stands in the page. A frame's is obeyed in a header alone.
    constexpr std::array<std::array<const char*, 2>, 5> headers{
        {{"content-security-policy:", "frame-ancestors 'none'"},
         {"x-content-type-options:", "nosniff"},
         {"referrer-policy:", "no-referrer"},
         {"cross-origin-resource-policy:", "same-origin"},
         {"cache-control:", "no-store"}}};
    for (const auto& [name, value] : headers) {
      if (lws_add_http_header_by_name(socket, reinterpret_cast<const unsigned char*>(name),
                                      reinterpret_cast<const unsigned char*>(value),
                                      static_cast<int>(std::strlen(value)), &at, end) != 0)
        return -1;
    }
    if (lws_finalize_write_http_header(socket, begin, &at, end) != 0) return -1;
    lws_callback_on_writable(socket);
    return 0;
  }

  int write_page(lws* socket) {
    std::string body;
    {
      const std::lock_guard lock(mutex);
      body = *page;
    }
    auto* bytes = reinterpret_cast<unsigned char*>(body.data()) + LWS_PRE;
    if (lws_write(socket, bytes, body.size() - LWS_PRE, LWS_WRITE_HTTP_FINAL) < 0) return -1;
    return lws_http_transaction_completed(socket) != 0 ? -1 : 0;
  }

  /// The next message for the page; nothing where it has all.
  Message next_for(Page& of) {
    const std::lock_guard lock(mutex);
    if (first && of.begin != begins) {
      of = {begins, 0, oldest, of.is_open};
      return first;
    }
    if (state && of.state != states) {
      of.state = states;
      return state;
    }
    if (of.next < oldest) of.next = oldest;
    const std::size_t place = of.next - oldest;
    if (!first || place >= kept.size()) return nullptr;
    ++of.next;
    return kept[place];
  }

  int write_next(lws* socket, Page& of) {
    const Message message = next_for(of);
    if (!message) return 0;
    std::string bytes = *message;
    const std::size_t size = bytes.size() - LWS_PRE;
    if (lws_write(socket, reinterpret_cast<unsigned char*>(bytes.data()) + LWS_PRE, size, LWS_WRITE_BINARY) <
        static_cast<int>(size))
      return -1;
    lws_callback_on_writable(socket);
    return 0;
  }

  int take(lws* socket, const char* text, std::size_t size) {
    const bool is_whole = lws_is_first_fragment(socket) != 0 && lws_is_final_fragment(socket) != 0;
    if (!is_whole || size > longest_request) return -1;
    const std::lock_guard lock(request_mutex);
    if (requests.size() < bounds.requests) requests.emplace_back(text, size);
    has_requests = true;
    return 0;
  }

  static int call(lws* socket, lws_callback_reasons reason, void* of, void* in, std::size_t size) {
    lws_context* now = lws_get_context(socket);
    auto* self = static_cast<Parts*>(now != nullptr ? lws_context_user(now) : nullptr);
    if (self == nullptr) return 0;
    switch (reason) {
      case LWS_CALLBACK_HTTP:
        return self->answer(socket);
      case LWS_CALLBACK_HTTP_WRITEABLE:
        return self->write_page(socket);
      case LWS_CALLBACK_FILTER_PROTOCOL_CONNECTION:
        if (!self->comes_from_our_page(socket)) return self->refuse(socket, HTTP_STATUS_FORBIDDEN);
        return self->pages >= most_pages ? self->refuse(socket, HTTP_STATUS_SERVICE_UNAVAILABLE) : 0;
      case LWS_CALLBACK_ESTABLISHED:
        *static_cast<Page*>(of) = {};
        static_cast<Page*>(of)->is_open = true;
        ++self->pages;
        lws_callback_on_writable(socket);
        return 0;
      case LWS_CALLBACK_CLOSED:  // of one that was refused, too
        if (of != nullptr && static_cast<Page*>(of)->is_open) --self->pages;
        return 0;
      case LWS_CALLBACK_SERVER_WRITEABLE:
        return self->write_next(socket, *static_cast<Page*>(of));
      case LWS_CALLBACK_RECEIVE:
        return self->take(socket, static_cast<const char*>(in), size);
      case LWS_CALLBACK_EVENT_WAIT_CANCELLED:
        lws_callback_on_writable_all_protocol(now, lws_get_protocol(socket));
        return 0;
      default:
        return lws_callback_http_dummy(socket, reason, of, in, size);
    }
  }

  void listen(int port);
};

void LiveServer::Parts::listen(int port) {
  static const std::array<lws_protocols, 2> protocols{
      {{"zwang", &Parts::call, sizeof(Page), 4096, 0, nullptr, 0}, {nullptr, nullptr, 0, 0, 0, nullptr, 0}}};
  lws_set_log_level(0, nullptr);
  lws_context_creation_info info{};
  info.port = port;
  info.iface = "127.0.0.1";
  info.protocols = protocols.data();
  info.user = this;
  info.uid = info.gid = -1;  // those of the process
  info.fd_limit_per_thread = most_sockets;
  // With IPv6 the library forgets an address of IPv4, and listens everywhere.
  info.options = LWS_SERVER_OPTION_DISABLE_IPV6 | LWS_SERVER_OPTION_EXPLICIT_VHOSTS |
                 LWS_SERVER_OPTION_FAIL_UPON_UNABLE_TO_BIND;
  context = lws_create_context(&info);
  lws_vhost* vhost = context != nullptr ? lws_create_vhost(context, &info) : nullptr;
  const int bound = vhost != nullptr ? lws_get_vhost_listen_port(vhost) : 0;
  if (bound <= 0) {
    if (context != nullptr) lws_context_destroy(context);
    throw Impossible("cannot listen on 127.0.0.1:" + std::to_string(port) +
                     "; is the port taken? Leave --port out for any free one");
  }
  host = "127.0.0.1:" + std::to_string(bound);
  thread = std::thread([this] {
    while (!is_over && lws_service(context, 0) >= 0) {
    }
  });
}

LiveServer::LiveServer(int port, const LiveServerBounds& bounds) : parts_(std::make_unique<Parts>(bounds)) {
  parts_->listen(port);
}

LiveServer::~LiveServer() {
  parts_->is_over = true;
  parts_->wake();
  parts_->thread.join();
  lws_context_destroy(parts_->context);
}

std::string LiveServer::origin() const {
  return "http://" + parts_->host;
}

std::string LiveServer::address() const {
  return origin() + "/" + parts_->token + "/";
}

void LiveServer::serve(std::string page) {
  const std::lock_guard lock(parts_->mutex);
  parts_->page = std::make_shared<const std::string>(with_room(page));
}

void LiveServer::begin(std::string message) {
  {
    const std::lock_guard lock(parts_->mutex);
    parts_->first = std::make_shared<const std::string>(with_room(message));
    ++parts_->begins;
    while (!parts_->kept.empty()) parts_->forget_oldest();
  }
  parts_->wake();
}

void LiveServer::send(std::string message) {
  auto kept = std::make_shared<const std::string>(with_room(message));
  {
    const std::lock_guard lock(parts_->mutex);
    parts_->kept_bytes += kept->size();
    parts_->kept.push_back(std::move(kept));
    while (parts_->kept.size() > parts_->bounds.messages || parts_->kept_bytes > parts_->bounds.bytes)
      parts_->forget_oldest();
  }
  parts_->wake();
}

void LiveServer::tell_state(std::string message) {
  {
    const std::lock_guard lock(parts_->mutex);
    parts_->state = std::make_shared<const std::string>(with_room(message));
    ++parts_->states;
  }
  parts_->wake();
}

std::vector<std::string> LiveServer::take_requests() {
  if (!parts_->has_requests) return {};
  std::vector<std::string> requests;
  const std::lock_guard lock(parts_->request_mutex);
  requests.swap(parts_->requests);
  parts_->has_requests = false;
  return requests;
}

std::size_t LiveServer::pages() const {
  return parts_->pages;
}

}  // namespace zwang::cli
