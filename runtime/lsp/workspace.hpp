/// The files that an editor holds, and what zwang says of them.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "project_files.hpp"
#include "zwang/lang/file_kind.hpp"
#include "zwang/lang/names.hpp"
#include "zwang/lang/open_texts.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::lsp {

struct Document {
  std::string uri;  ///< as the editor writes it
  int version = 0;
  std::string text;
};

/// A task file that could be loaded. Its spans are places of the texts of that moment.
struct Loaded {
  lang::Diagnostics diagnostics;
  lang::Program program;
};

/// The result of reading one file with all files that it names.
struct Judgement {
  lang::FileKind kind = lang::FileKind::task;
  lang::Diagnostics diagnostics;
  std::shared_ptr<const Loaded> now;        ///< of a task file without errors
  std::shared_ptr<const Loaded> last;       ///< the same, or the last one before there were errors
  std::vector<lang::NamePlace> last_names;  ///< of the last text that was YAML
  std::set<std::filesystem::path> read;     ///< canonical names
};

/// By the first key of what the file holds, or of its open text. nullopt: it cannot be read, or is none of
/// zwang's.
std::optional<lang::FileKind> kind_of(const std::filesystem::path& path);

/// Reads a file as what its first key says, through the open texts of the scope. Notes are looked for, too.
Judgement judge(const std::filesystem::path& path, lang::FileKind kind);

class Workspace {
 public:
  void open(const std::filesystem::path& path, Document document);
  void change(const std::filesystem::path& path, int version, std::string text);
  void close(const std::filesystem::path& path);
  /// Something on the disk is another one now.
  void look_again();

  /// Judges the open files that a change may concern. True when there were any.
  bool update();
  bool is_up_to_date() const { return stale_.empty(); }

  const std::map<std::filesystem::path, Document>& documents() const { return documents_; }
  const std::map<std::filesystem::path, Judgement>& judgements() const { return judgements_; }
  const Document* document(const std::filesystem::path& path) const;
  const Judgement* judgement(const std::filesystem::path& path) const;
  const lang::OpenTexts& texts() const { return texts_; }
  /// zwang's files and URDFs below the root folder of a file.
  std::vector<ProjectFile> files_around(const std::filesystem::path& file) const;
  /// As an editor knows the file: by the address that it gave.
  std::string uri(const std::filesystem::path& path) const;

 private:
  void concern(const std::filesystem::path& changed);

  std::map<std::filesystem::path, Document> documents_;  ///< by their canonical names
  std::map<std::filesystem::path, Judgement> judgements_;
  std::set<std::filesystem::path> stale_;
  lang::OpenTexts texts_;
  mutable ProjectFiles files_;  ///< what was read of them before
};

}  // namespace zwang::lsp
