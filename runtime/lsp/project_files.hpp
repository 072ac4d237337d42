/// The files of a project, which completion proposes and a rename goes over.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "zwang/lang/file_kind.hpp"

namespace zwang::lsp {

struct ProjectFile {
  std::filesystem::path path;          ///< canonical
  std::optional<lang::FileKind> kind;  ///< nullopt: a URDF
};

/// Reads each file once: again only where its time or its size is another one. A folder is listed each time.
class ProjectFiles {
 public:
  /// nullptr: the file is not open, and counts as it is on the disk.
  using OpenText = std::function<const std::string*(const std::filesystem::path&)>;

  /// zwang's own and URDFs below the root folder of a file, in the order of their names. At most
  /// `most_files` are looked at.
  std::vector<ProjectFile> around(const std::filesystem::path& file, const OpenText& open_text);

 private:
  struct Seen {
    std::filesystem::file_time_type time;
    std::uintmax_t size = 0;
    std::optional<lang::FileKind> kind;
  };
  std::optional<lang::FileKind> kind_on_disk(const std::filesystem::path& path);

  std::map<std::filesystem::path, Seen> seen_;
};

}  // namespace zwang::lsp
