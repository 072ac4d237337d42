/// Helpers of the front end's tests: texts as files, messages as text.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "../temporary_folder.hpp"
#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang::test {

inline std::string slurp(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

inline std::string rendered(const Diagnostics& diagnostics) {
  std::ostringstream out;
  render_human(diagnostics, out);
  return out.str();
}

inline int count(const Diagnostics& diagnostics, const std::string& code) {
  int found = 0;
  for (const Diagnostic& d : diagnostics.all()) found += d.code == code ? 1 : 0;
  return found;
}

class Folder : public zwang::test::TemporaryFolder {
 public:
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((path() / name).parent_path());
    std::ofstream(path() / name, std::ios::binary) << text;
    return path() / name;
  }
};

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("nothing to replace: " + from);
  return text.replace(at, from.size(), to);
}

// Not inline: Clang may set an inline variable later than one of a file that is made of it.
const std::filesystem::path source_dir = ZWANG_SOURCE_DIR;

}  // namespace zwang::lang::test
