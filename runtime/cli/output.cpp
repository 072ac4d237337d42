#include "output.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "zwang/lang/printable.hpp"

namespace zwang::cli {

namespace {

void write(std::string_view bytes) {
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), stdout) == bytes.size();
  if (!written || std::fflush(stdout) != 0) {
    throw Impossible(std::string("cannot write to the standard output: ") + std::strerror(errno));
  }
}

}  // namespace

void print(std::string_view text) {
  write(lang::printable(text));
}

void print_data(std::string_view text) {
  stdout_is_terminal() ? print(text) : write(text);
}

void print_over(std::string_view line) {
  std::string whole = "\r";
  whole += lang::printable(line, "");
  whole += "\033[K";
  write(whole);
}

void print_error(std::string_view text) {
  const std::string shown = lang::printable(text);
  std::fwrite(shown.data(), 1, shown.size(), stderr);
  std::fflush(stderr);
}

bool stdout_is_terminal() noexcept {
  return isatty(STDOUT_FILENO) == 1;
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
  if (out.size() < width) out.append(width - out.size(), ' ');
  return out;
}

std::string titled_list(const std::string& title, const std::vector<std::string>& lines) {
  if (lines.empty()) return "";
  std::string text = title + "\n";
  for (const std::string& line : lines) text += "  " + line + "\n";
  return text;
}

std::string padded_left(std::string_view text, std::size_t width) {
  return text.size() < width ? std::string(width - text.size(), ' ').append(text) : std::string(text);
}

std::string count(std::size_t n, std::string_view thing) {
  return std::to_string(n) + " " + std::string(thing) + (n == 1 ? "" : "s");
}

std::string place(const lang::Diagnostics& diagnostics, const lang::Span& span) {
  if (!span.exists()) return "";
  const std::filesystem::path path = diagnostics.source(span.source).path;
  return path.filename().string() + ":" + std::to_string(span.begin.line);
}

void write_file(const std::string& path, std::string_view text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw Impossible(path + ": cannot be written");
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
