#include "tree/file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "diagnostic/wordings.hpp"
#include "zwang/lang/open_texts.hpp"

namespace zwang::lang {

namespace {

/// An open file that closes itself.
class Descriptor {
 public:
  explicit Descriptor(const std::filesystem::path& path)
      // O_NONBLOCK: opening a FIFO must not wait for a writer.
      : number_(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY)) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  int number() const { return number_; }

 private:
  int number_;
};

/// At most `most` bytes; nullopt on a read error.
std::optional<std::string> read_bytes(int descriptor, std::size_t most) {
  std::string text;
  std::size_t filled = 0;
  while (filled < most) {
    text.resize(std::min(most, filled + 65536));
    const ssize_t count = ::read(descriptor, text.data() + filled, text.size() - filled);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return std::nullopt;
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
  }
  text.resize(filled);
  return text;
}

}  // namespace

std::filesystem::path root_of(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::path absolute = std::filesystem::weakly_canonical(file, error);
  std::filesystem::path folder = (error ? file : absolute).parent_path();
  for (std::filesystem::path parent = folder; !parent.empty(); parent = parent.parent_path()) {
    if (std::filesystem::is_regular_file(parent / ".zwang-root", error)) return parent;
    if (parent == parent.root_path()) break;
  }
  return folder;
}

namespace {

/// The bytes on the disk, at most one more than the limit; nullopt where they cannot be read.
std::optional<std::string> text_on_disk(const std::filesystem::path& path, const SizeLimit& limit,
                                        const Span& cause, Diagnostics& diagnostics) {
  const Descriptor file(path);
  if (file.number() < 0) {
    diagnostics.add(wording::unreadable_file(cause, path.string(), std::strerror(errno)));
    return std::nullopt;
  }
  struct stat status {};
  if (::fstat(file.number(), &status) != 0 || !S_ISREG(status.st_mode)) {
    diagnostics.add(wording::unreadable_file(cause, path.string(), "not a regular file"));
    return std::nullopt;
  }
  std::optional<std::string> text = read_bytes(file.number(), limit.bytes + 1);
  if (!text) diagnostics.add(wording::unreadable_file(cause, path.string(), std::strerror(errno)));
  return text;
}

}  // namespace

std::optional<int> read_file(const std::filesystem::path& path, const SizeLimit& limit, const Span& cause,
                             Diagnostics& diagnostics) {
  const std::string* unsaved = open_text_of(path);
  std::optional<std::string> text =
      unsaved != nullptr ? std::optional(*unsaved) : text_on_disk(path, limit, cause, diagnostics);
  if (!text) return std::nullopt;
  const bool is_too_large = text->size() > limit.bytes;
  if (is_too_large) text->clear();
  if (text->starts_with("\xEF\xBB\xBF")) text->erase(0, 3);
  // A file that two robots of a scene share is one source, so its errors are reported once.
  const std::vector<Source>& known = diagnostics.sources();
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (known[i].path == path.string() && known[i].text == *text) return static_cast<int>(i);
  }
  const int source = diagnostics.add_source({path.string(), std::move(*text)});
  if (is_too_large) {
    const Position start{1, 1};
    diagnostics.add(wording::file_too_large({source, start, start}, limit.code, limit.bytes));
    return std::nullopt;
  }
  return source;
}

std::optional<std::filesystem::path> resolve_path(const std::string& written,
                                                  const std::filesystem::path& base,
                                                  const std::filesystem::path& root, const Span& cause,
                                                  Diagnostics& diagnostics) {
  // The system ends a path at a NUL. Other control bytes mislead the reader of a message.
  const bool has_control =
      std::any_of(written.begin(), written.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; });
  if (written.empty() || has_control || written.find("://") != std::string::npos) {
    diagnostics.add(wording::not_a_path(cause, written));
    return std::nullopt;
  }
  std::error_code error;
  const std::filesystem::path path = (base.parent_path() / written).lexically_normal();
  // Absolute first: of a path that begins with something that is not there the library gives back a relative
  // one.
  const std::filesystem::path real =
      std::filesystem::weakly_canonical(std::filesystem::absolute(path), error);
  if (error) {
    diagnostics.add(wording::unreadable_file(cause, written, error.message()));
    return std::nullopt;
  }
  const std::filesystem::path real_root = std::filesystem::weakly_canonical(root, error);
  const auto [end_of_root, rest] =
      std::mismatch(real_root.begin(), real_root.end(), real.begin(), real.end());
  (void)rest;
  if (error || end_of_root != real_root.end()) {
    diagnostics.add(wording::path_outside_root(cause, written));
    return std::nullopt;
  }
  return path;
}

}  // namespace zwang::lang
