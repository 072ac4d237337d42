#include "log/source_paths.hpp"

#include <algorithm>
#include <filesystem>

namespace zwang::runtime {

namespace fs = std::filesystem;

namespace {

/// The text of an option is a source, too, and no file.
bool is_file(const lang::Source& source) {
  return !source.path.empty() && source.path != "-p";
}

fs::path whole(const std::string& path) {
  return fs::absolute(path).lexically_normal();
}

fs::path common_part(const fs::path& a, const fs::path& b) {
  fs::path common;
  for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end() && *i == *j; ++i, ++j) common /= *i;
  return common;
}

}  // namespace

LogContext with_paths_from_one_folder(LogContext context) {
  fs::path folder;
  for (const lang::Source& source : context.sources) {
    if (!is_file(source)) continue;
    const fs::path parent = whole(source.path).parent_path();
    folder = folder.empty() ? parent : common_part(folder, parent);
  }
  if (folder.empty()) return context;
  const fs::path here = fs::current_path().lexically_normal();
  if (common_part(folder, here) == here) folder = here;
  const auto shorten = [&folder](std::string& path) {
    path = whole(path).lexically_relative(folder).generic_string();
  };
  for (const char* name : {"task", "robot", "scene"}) {
    const auto fact = context.facts.find(name);
    if (fact != context.facts.end() && !fact->second.empty()) shorten(fact->second);
  }
  for (lang::Source& source : context.sources) {
    if (is_file(source)) shorten(source.path);
  }
  return context;
}

}  // namespace zwang::runtime
