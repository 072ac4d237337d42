#include "shipped.hpp"

#include <vector>

#include "output.hpp"
#include "zwang/lang/nearest.hpp"

namespace zwang::cli {

namespace fs = std::filesystem;

namespace {

bool is_bare_name(const std::string& file) {
  return !file.empty() && file.find('/') == std::string::npos && fs::path(file).extension() != ".mcap";
}

std::vector<std::string> shipped_names(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& file : fs::directory_iterator(folder, error)) {
    if (file.path().extension() == ".yaml") names.push_back(file.path().stem().string());
  }
  return names;
}

}  // namespace

std::optional<fs::path> beside_program(std::initializer_list<const char*> ways) {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error) return std::nullopt;
  for (const char* way : ways) {
    const fs::path path = (program.parent_path() / way).lexically_normal();
    if (fs::exists(path, error)) return path;
  }
  return std::nullopt;
}

std::optional<fs::path> optional_part(const std::string& name) {
  return beside_program({("../libexec/zwang/" + name).c_str(), name.c_str()});
}

std::optional<fs::path> shipped_folder() {
  const auto task = beside_program({"../share/zwang/specs/wall_align.yaml", "../../specs/wall_align.yaml"});
  return task ? std::optional(task->parent_path()) : std::nullopt;
}

std::string file_or_shipped(const std::string& file, const std::string& below) {
  std::error_code error;
  if (!is_bare_name(file) || fs::exists(fs::symlink_status(file, error))) return file;
  const std::optional<fs::path> shipped = shipped_folder();
  if (!shipped) return file;
  const fs::path folder = (*shipped / below).lexically_normal();
  const std::string name = fs::path(file).extension() == ".yaml" ? fs::path(file).stem().string() : file;
  if (fs::exists(folder / (name + ".yaml"), error)) return (folder / (name + ".yaml")).string();
  const std::string meant = lang::nearest(name, shipped_names(folder));
  if (meant.empty()) return file;
  throw Impossible(file + ": no such file; did you mean `" + meant + "`, which ships with zwang?");
}

}  // namespace zwang::cli
