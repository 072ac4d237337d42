#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "file_kind.hpp"
#include "output.hpp"
#include "verbs.hpp"
#include "zwang/lang/format.hpp"
#include "zwang/lang/upgrade.hpp"

namespace zwang::cli {

namespace {

namespace fs = std::filesystem;

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Writes a new file beside the old one and puts it in its place: a reader meanwhile sees one or the other.
void replace_file(const std::string& path, const std::string& text) {
  const fs::path target = fs::canonical(path);  // a link stays a link
  std::string beside = (target.parent_path() / (".zwang_fmt_XXXXXX")).string();
  const int descriptor = ::mkstemp(beside.data());
  const auto fail = [&](const char* what) {
    const std::string reason = std::strerror(errno);
    if (descriptor >= 0) ::unlink(beside.c_str());
    throw Impossible(path + ": " + what + ": " + reason);
  };
  if (descriptor < 0) fail("cannot write beside it");
  struct stat status {};
  bool written = ::stat(target.c_str(), &status) == 0 && ::fchmod(descriptor, status.st_mode & 07777u) == 0;
  for (std::size_t at = 0; written && at < text.size();) {
    const ssize_t count = ::write(descriptor, text.data() + at, text.size() - at);
    if (count < 0 && errno == EINTR) continue;
    written = count > 0;
    if (written) at += static_cast<std::size_t>(count);
  }
  written = written && ::fsync(descriptor) == 0;
  written = ::close(descriptor) == 0 && written;
  if (!written || ::rename(beside.c_str(), target.c_str()) != 0) fail("cannot be written");
}

}  // namespace

int fmt(const FmtArguments& arguments) {
  bool is_good = true;
  for (const std::string& path : arguments.files) require_file(path);
  for (const std::string& path : arguments.files) {
    lang::Diagnostics diagnostics;
    // A file with errors is left alone: what it will mean once mended is not known.
    const FileKind kind = kind_of_file(path).value_or(FileKind::task);
    const bool is_readable = read_as(kind, path, diagnostics).has_value() && !diagnostics.has_errors();
    lang::Diagnostics layout;
    const bool is_upgraded = arguments.upgrade && kind == FileKind::task;
    std::optional<std::string> text;
    if (is_readable) text = is_upgraded ? lang::upgrade_task(path, layout) : lang::format_file(path, layout);
    if (!text) {
      print(rendered(is_readable ? layout : diagnostics) + path + ": left as it is\n");
      is_good = false;
      continue;
    }
    if (*text == bytes_of(path)) continue;
    if (arguments.check) {
      print(path + ": would be laid out anew\n");
      is_good = false;
    } else {
      replace_file(path, *text);
      print(path + ": laid out\n");
    }
  }
  return is_good ? exit_good : exit_bad;
}

}  // namespace zwang::cli
