// The front end alone: a task file with two mistakes is read, and what zwang has to say about it is data. An
// editor would underline the ranges and offer the replacements; this program puts them in, and reads the file
// again.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "zwang/lang/diagnostic.hpp"
#include "zwang/lang/program.hpp"

namespace {

using namespace zwang::lang;
namespace fs = std::filesystem;

void print(const Diagnostics& diagnostics) {
  for (const Diagnostic& d : diagnostics.sorted()) {
    std::printf("%s at %d:%d to %d:%d: %s", d.code.c_str(), d.span.begin.line, d.span.begin.column,
                d.span.end.line, d.span.end.column, d.message.c_str());
    if (d.replacement) std::printf(" -> write `%s`", d.replacement->c_str());
    std::printf("\n");
  }
}

// The file's text with every replacement in the place of its span. (ASCII text: columns are bytes.)
std::string mended(const std::string& text, const Diagnostics& diagnostics) {
  std::vector<std::size_t> lines{0};
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\n') lines.push_back(i + 1);
  }
  const auto offset = [&](const Position& p) {
    return lines[static_cast<std::size_t>(p.line - 1)] + static_cast<std::size_t>(p.column - 1);
  };
  std::string result = text;
  std::vector<Diagnostic> found = diagnostics.sorted();
  std::reverse(found.begin(), found.end());  // from the end, so that earlier places stay where they are
  for (const Diagnostic& d : found) {
    if (!d.replacement) continue;
    const std::size_t begin = offset(d.span.begin);
    result.replace(begin, offset(d.span.end) - begin, *d.replacement);
  }
  return result;
}

}  // namespace

int main() {
  const fs::path folder = fs::temp_directory_path() / "zwang_example_02";
  fs::remove_all(folder);
  fs::copy(EXAMPLE_FILES, folder, fs::copy_options::recursive);
  const fs::path path = folder / "task.yaml";

  Diagnostics diagnostics;
  if (load(path, {}, diagnostics)) return 1;  // it has mistakes
  print(diagnostics);

  std::ifstream in(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  std::ofstream(path, std::ios::binary) << mended(text, diagnostics);

  Diagnostics of_the_mended;
  const auto program = load(path, {}, of_the_mended);
  print(of_the_mended);
  if (!program) return 1;
  const AxisStatements& x = program->tasks[0].groups[0].axes[0];
  std::printf("%s presses with %g N, at most %g m/s ahead\n", x.name.c_str(), x.target.constant,
              x.velocity->high.constant);
  fs::remove_all(folder);
  return 0;
}
