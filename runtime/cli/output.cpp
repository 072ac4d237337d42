#include "output.hpp"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <numbers>
#include <sstream>
#include <system_error>
#include <utility>

#include "colour.hpp"
#include "zwang/lang/printable.hpp"

namespace zwang::cli {

namespace {

void write(std::string_view bytes) {
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), stdout) == bytes.size();
  if (!written || std::fflush(stdout) != 0) {
    throw Impossible(std::string("cannot write to the standard output: ") + std::strerror(errno));
  }
}

constexpr std::size_t unknown_width = 80;
constexpr std::size_t room_for_interrupt = 3;  // an echoed `^C` stays in the line, too

/// The last line that `print_over` wrote. Threads of runs and of reloads print while it stands there.
struct LineInPlace {
  std::mutex mutex;
  std::size_t columns = 0;
};
LineInPlace line_in_place;

/// The present width of the window, which may have changed since the last line.
std::size_t terminal_columns() {
  winsize size{};
  const bool is_known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return is_known ? size.ws_col : unknown_width;
}

std::string cut_to(std::string text, std::size_t columns) {
  std::size_t end = 0;
  for (std::size_t seen = 0; end < text.size(); ++end) {
    if (columns_of(std::string_view(text).substr(end, 1)) > 0 && ++seen > columns) break;
  }
  text.resize(end);
  return text;
}

/// Moves to the start of the line in place. A narrower terminal has wrapped it: its start is above.
std::string way_to_its_begin(std::size_t columns, std::size_t width) {
  const std::size_t rows_above = columns > 0 ? (columns - 1) / width : 0;
  return rows_above == 0 ? "\r" : "\r\033[" + std::to_string(rows_above) + "A";
}

/// Other text begins where the line in place began. Does not throw: errors are told, too, when stdout is
/// full.
void erase_line_in_place() {
  const std::lock_guard lock(line_in_place.mutex);
  if (line_in_place.columns == 0) return;
  const std::string bytes = way_to_its_begin(line_in_place.columns, terminal_columns()) + "\033[J";
  line_in_place.columns = 0;
  std::fwrite(bytes.data(), 1, bytes.size(), stdout);
  std::fflush(stdout);
}

}  // namespace

void print(std::string_view text) {
  erase_line_in_place();
  write(shown(lang::printable(text), takes_colour(STDOUT_FILENO)));
}

void print_data(std::string_view text) {
  stdout_is_terminal() ? print(text) : write(text);
}

void print_over(std::string_view line) {
  const std::lock_guard lock(line_in_place.mutex);
  const std::size_t width = terminal_columns();
  const std::string begin = way_to_its_begin(line_in_place.columns, width);
  const std::string cut = cut_to(lang::printable(line, ""), width - std::min(width - 1, room_for_interrupt));
  write(begin + cut + (begin == "\r" ? "\033[K" : "\033[J"));
  line_in_place.columns = columns_of(cut);
}

void print_error(std::string_view text) {
  erase_line_in_place();
  const std::string bytes = shown(lang::printable(text), takes_colour(STDERR_FILENO));
  std::fwrite(bytes.data(), 1, bytes.size(), stderr);
  std::fflush(stderr);
}

bool stdout_is_terminal() noexcept {
  return isatty(STDOUT_FILENO) == 1;
}

bool stdout_can_be_written_over() noexcept {
  const char* terminal = std::getenv("TERM");
  return stdout_is_terminal() && (terminal == nullptr || std::strcmp(terminal, "dumb") != 0);
}

void secure_standard_streams() {
  const bool has_stdout = fcntl(STDOUT_FILENO, F_GETFD) != -1;
  // The lowest free descriptor is taken first: open until the three are in use.
  int descriptor = 0;
  while ((descriptor = open("/dev/null", O_RDWR)) >= 0 && descriptor <= STDERR_FILENO) {
  }
  if (descriptor > STDERR_FILENO) close(descriptor);
  if (!has_stdout) throw Impossible("cannot write to the standard output: it is closed");
}

std::string padded(std::string_view text, std::size_t width) {
  std::string out(text);
  const std::size_t columns = columns_of(text);
  if (columns < width) out.append(width - columns, ' ');
  return out;
}

std::string rendered(const lang::Diagnostics& diagnostics, const lang::RenderOptions& options) {
  std::ostringstream text;
  lang::render_human(diagnostics, text, options);
  return with_marked_severities(text.str());
}

std::string titled_list(const std::string& title, const std::vector<std::string>& lines) {
  if (lines.empty()) return "";
  std::string text = title + "\n";
  for (const std::string& line : lines) text += "  " + line + "\n";
  return text;
}

std::string padded_left(std::string_view text, std::size_t width) {
  const std::size_t columns = columns_of(text);
  return columns < width ? std::string(width - columns, ' ').append(text) : std::string(text);
}

std::string count(std::size_t n, std::string_view thing) {
  return std::to_string(n) + " " + std::string(thing) + (n == 1 ? "" : "s");
}

OutputFile::OutputFile(std::filesystem::path path) : path_(std::move(path)), part_(path_) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::symlink_status(path_, error);
  const bool may_move =
      status.type() == std::filesystem::file_type::not_found || std::filesystem::is_regular_file(status);
  if (std::filesystem::is_regular_file(status) && ::access(path_.c_str(), W_OK) != 0) {
    reason_ = errno;
    refuse();
  }
  if (may_move) {
    part_ += ".part";
    file_ = std::fopen(part_.c_str(), "wb");
    if (file_ != nullptr && std::filesystem::is_regular_file(status))
      std::filesystem::permissions(part_, status.permissions(), error);
  }
  if (file_ != nullptr) return;
  // A folder in which nobody may make files can hold one that may be written.
  part_ = path_;
  file_ = std::fopen(path_.c_str(), "wb");
  if (file_ != nullptr) return;
  reason_ = errno;
  refuse();
}

OutputFile::~OutputFile() {
  if (file_ != nullptr) std::fclose(file_);
  std::error_code error;
  if (is_beside()) std::filesystem::remove(part_, error);
}

void OutputFile::write(std::string_view text) {
  if (reason_ != 0 || text.empty()) return;
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) reason_ = errno;
}

void OutputFile::finish() {
  if (std::fflush(file_) != 0 && reason_ == 0) reason_ = errno;
  if (std::fclose(std::exchange(file_, nullptr)) != 0 && reason_ == 0) reason_ = errno;
  if (reason_ != 0) refuse();
  if (!is_beside()) return;
  std::error_code error;
  std::filesystem::rename(part_, path_, error);
  if (error) throw Impossible(path_.string() + ": " + error.message());
}

void OutputFile::refuse() const {
  throw Impossible(path_.string() + ": cannot be written: " + std::strerror(reason_));
}

void require_place_of_result(const std::string& path) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(path).parent_path();
  if (!folder.empty() && !fs::is_directory(folder))
    throw Impossible(path + ": there is no folder " + folder.string());
  constexpr std::array read_by_zwang{".yaml", ".yml", ".urdf", ".xacro", ".mcap", ".db"};
  const std::string extension = fs::path(path).extension().string();
  if (fs::is_regular_file(path) && std::ranges::find(read_by_zwang, extension) != read_by_zwang.end())
    throw Impossible(path + ": would be written over; name another file, or delete it first");
}

void write_file(const std::string& path, std::string_view text) {
  OutputFile file(path);
  file.write(text);
  file.finish();
}

void require_file(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw Impossible(path + ": no such file");
  if (std::filesystem::is_directory(status)) throw Impossible(path + ": is a folder, not a file");
  if (!std::filesystem::is_regular_file(status)) throw Impossible(path + ": is not a regular file");
  if (access(path.c_str(), R_OK) != 0) throw Impossible(path + ": " + std::strerror(errno));
}

}  // namespace zwang::cli
