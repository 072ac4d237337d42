#include "project_files.hpp"

#include <algorithm>
#include <utility>

#include "zwang/lang/open_texts.hpp"

namespace zwang::lsp {

namespace fs = std::filesystem;

namespace {

/// Of a folder tree that is no project of zwang's.
constexpr int most_files = 2000;

/// The nearest folder above with a `.zwang-root`, else the file's own.
fs::path root_above(const fs::path& file) {
  std::error_code error;
  for (fs::path folder = file.parent_path(); folder != folder.root_path(); folder = folder.parent_path()) {
    if (fs::exists(folder / ".zwang-root", error)) return folder;
  }
  return file.parent_path();
}

/// Hidden folders, and those of builds and packages, hold no files of an author's.
bool is_passed_over(const fs::path& folder) {
  return folder.filename().string().starts_with(".") || folder.filename() == "node_modules";
}

}  // namespace

std::optional<lang::FileKind> ProjectFiles::kind_on_disk(const fs::path& path) {
  std::error_code error;
  const fs::file_time_type time = fs::last_write_time(path, error);
  const std::uintmax_t size = error ? 0 : fs::file_size(path, error);  // an error of a folder, too
  if (error) return std::nullopt;
  const auto [entry, is_new] = seen_.try_emplace(path);
  Seen& seen = entry->second;
  if (is_new || seen.time != time || seen.size != size) seen = {time, size, lang::kind_of_file(path)};
  return seen.kind;
}

std::vector<ProjectFile> ProjectFiles::around(const fs::path& file, const OpenText& open_text) {
  std::vector<ProjectFile> files;
  std::error_code error;
  int seen = 0;
  // The root is canonical, and links to folders are not followed: links to files are all that is left.
  const fs::path root = lang::canonical_name(root_above(file));
  for (auto entry =
           fs::recursive_directory_iterator(root, fs::directory_options::skip_permission_denied, error);
       !error && entry != fs::recursive_directory_iterator() && seen < most_files; entry.increment(error)) {
    if (is_passed_over(entry->path())) entry.disable_recursion_pending();
    const std::string extension = entry->path().extension().string();
    const bool is_urdf = extension == ".urdf";
    if (!is_urdf && extension != ".yaml" && extension != ".yml") continue;
    ++seen;
    std::error_code unread;
    const fs::path path = entry->is_symlink(unread) ? lang::canonical_name(entry->path()) : entry->path();
    const std::string* open = open_text(path);
    const auto kind = is_urdf           ? std::nullopt
                      : open != nullptr ? lang::kind_of_text(*open)
                                        : kind_on_disk(path);
    if (is_urdf || kind) files.push_back({path, kind});
  }
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
  return files;
}

}  // namespace zwang::lsp
