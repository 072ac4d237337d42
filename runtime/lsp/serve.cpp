#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "framing.hpp"
#include "server.hpp"

namespace zwang::lsp {

namespace {

/// False when the reader is gone.
bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

/// Whether a read would return at once.
bool has_input(int descriptor) {
  pollfd waited{descriptor, POLLIN, 0};
  return ::poll(&waited, 1, 0) > 0;
}

/// False at the end of the input.
bool read_some(int descriptor, FrameDecoder& decoder) {
  std::array<char, 65536> bytes{};
  ssize_t count = 0;
  do {
    count = ::read(descriptor, bytes.data(), bytes.size());
  } while (count < 0 && errno == EINTR);
  if (count <= 0) return false;
  decoder.feed({bytes.data(), static_cast<std::size_t>(count)});
  return true;
}

}  // namespace

int serve(int in, int out, const std::filesystem::path& explanations) {
  bool is_heard = true;
  Server server([&](const std::string& content) { is_heard = write_all(out, framed(content)) && is_heard; },
                explanations);
  FrameDecoder decoder;
  while (is_heard && !server.is_over()) {
    const auto content = decoder.take();
    if (decoder.dropped() > 0) server.refuse_too_long();
    if (content) {
      server.receive(*content);
      continue;
    }
    // Of changes that wait in a row only the last one is judged.
    if (!has_input(in)) server.settle();
    if (!read_some(in, decoder)) break;
  }
  return server.exit_code();
}

}  // namespace zwang::lsp
