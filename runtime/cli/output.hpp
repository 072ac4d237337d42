/// Text for the terminal: checked writing, and numbers with units for people.
#pragma once

#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "zwang/lang/diagnostic.hpp"
#include "zwang/runtime/with_unit.hpp"

namespace zwang::cli {

/// The question could not be answered; what() goes to stderr and the exit code is 2.
class Impossible : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// For people: written to stdout at once, as `lang::printable` has it, its marks as colours where there are
/// any (colour.hpp). Throws Impossible when stdout is closed or full.
void print(std::string_view text);
/// For programs: JSON, a graph, a file's text; without marks. Byte for byte, but on a terminal as `print` has
/// it.
void print_data(std::string_view text);
/// For people, in the place of what it wrote last, cut to the width of the terminal. Any other text erases
/// it.
void print_over(std::string_view line);
void print_error(std::string_view text);  ///< as `print` has it, to stderr

bool stdout_is_terminal() noexcept;
/// Whether `print_over` has its line: on a terminal that is not dumb.
bool stdout_can_be_written_over() noexcept;

/// Keeps the three standard descriptors from being reused by a file that is opened later. Throws Impossible
/// when stdout is closed.
void secure_standard_streams();

using runtime::with_unit;
/// The text that `lang::render_human` writes, with its severities marked.
std::string rendered(const lang::Diagnostics& diagnostics, const lang::RenderOptions& options = {});
std::string padded(std::string_view text, std::size_t width);       ///< to the left
std::string padded_left(std::string_view text, std::size_t width);  ///< to the right
/// The title, and each of the lines below it, indented; nothing where there are none.
std::string titled_list(const std::string& title, const std::vector<std::string>& lines);

std::string count(std::size_t n, std::string_view thing);  ///< `1 error`, `2 errors`

/// `wall_align.yaml:27`; empty when the span does not exist.
std::string place(const lang::Diagnostics& diagnostics, const lang::Span& span);

/// A file that is whole, or as it was before. It is written beside its place and moved there by `finish`.
/// A device or a pipe, as /dev/stdout, is written where it is.
class OutputFile {
 public:
  /// Throws `Impossible` where nothing can be written.
  explicit OutputFile(std::filesystem::path path);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  /// Without `finish` nothing is left behind.
  ~OutputFile();

  void write(std::string_view text);
  /// Throws `Impossible`, with the reason, where not all could be written: a disk may be full.
  void finish();

 private:
  [[noreturn]] void refuse() const;
  bool is_beside() const { return part_ != path_; }

  std::filesystem::path path_, part_;
  std::FILE* file_ = nullptr;
  int reason_ = 0;  ///< errno of the first failure
};

/// The whole text at once, in the place of what the file held.
void write_file(const std::string& path, std::string_view text);

/// Throws Impossible where a result cannot go: its folder is missing, or a file of a kind that zwang reads is
/// there. A user wrote that one, or it took hours.
void require_place_of_result(const std::string& path);

/// Throws Impossible unless the path is a regular file.
void require_file(const std::string& path);

}  // namespace zwang::cli
