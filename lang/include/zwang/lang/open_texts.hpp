/// Texts that an editor holds and has not saved: they are read in the place of the files on the disk.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "zwang/export.hpp"

namespace zwang::lang {

/// Texts by the files that they belong to. A file is known by its canonical path, so each of its names leads
/// to the same text.
class ZWANG_EXPORT OpenTexts {
 public:
  void put(const std::filesystem::path& file, std::string text);
  void remove(const std::filesystem::path& file);
  /// nullptr when no text is held for the file.
  const std::string* find(const std::filesystem::path& file) const;

 private:
  std::map<std::filesystem::path, std::string> texts_;
};

/// While it lives, the functions of this room that read files on this thread ask `texts` first: tasks,
/// robots, scenes, scenarios, connections and URDFs. A scope rather than a parameter, because a file may lead
/// to any other. Scopes nest: the innermost one counts. `texts` must outlive it.
class ZWANG_EXPORT ReadsOpenTexts {
 public:
  explicit ReadsOpenTexts(const OpenTexts& texts);
  ReadsOpenTexts(const ReadsOpenTexts&) = delete;
  ReadsOpenTexts& operator=(const ReadsOpenTexts&) = delete;
  ~ReadsOpenTexts();

 private:
  const OpenTexts* outer_;
};

/// The text that the innermost scope of this thread holds for the file; nullptr when there is none.
ZWANG_EXPORT const std::string* open_text_of(const std::filesystem::path& file);

/// All that the innermost scope of this thread holds: a copy, to which another scope may add.
ZWANG_EXPORT OpenTexts open_texts();

/// The name by which `OpenTexts` knows a file: links followed, absolute; as given where that fails.
ZWANG_EXPORT std::filesystem::path canonical_name(const std::filesystem::path& file);

}  // namespace zwang::lang
