/// An editor with a copy of the shipped files, for the tests that ask about a place in a text.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "../temporary_folder.hpp"
#include "editor.hpp"

namespace zwang::lsp::test {

namespace fs = std::filesystem;

inline const fs::path specs = fs::path(ZWANG_SOURCE_DIR) / "specs";

inline std::set<std::string> labels(const json& completion) {
  std::set<std::string> labels;
  for (const json& item : completion["items"]) labels.insert(item["label"]);
  return labels;
}

/// A copy of the shipped files, which a rename may change.
class Features : public ::testing::Test {
 protected:
  Features() {
    const fs::path copy = folder_.path() / "specs";
    fs::create_directories(copy / "scenarios");
    fs::create_directories(copy / "studies");
    for (const char* part :
         {"robots", "scenes", "docking.yaml", "hospital.yaml", "wall_align.yaml", "scenarios/hospital.yaml",
          "scenarios/wall_align.yaml", "studies/wall_align.yaml"})
      fs::copy(specs / part, copy / part, fs::copy_options::recursive);
    std::ofstream(copy / ".zwang-root");
  }

  fs::path open(const std::string& name) {
    const fs::path path = fs::canonical(folder_.path() / "specs" / name);
    editor_.open(path, slurp(path));
    return path;
  }
  /// The proposals where `written` stands in the place of `from`, with the cursor behind it.
  std::set<std::string> proposed(const fs::path& path, const std::string& from, const std::string& written) {
    const std::string text = replaced(slurp(path), from, written);
    editor_.change(path, text);
    const std::size_t at = slurp(path).find(from) + written.size();
    return labels(editor_.ask("textDocument/completion", {{"textDocument", {{"uri", uri_of(path)}}},
                                                          {"position", Editor::position(text, at)}}));
  }
  json rename(const fs::path& path, const std::string& words, std::size_t into, const std::string& name) {
    return editor_.at("textDocument/rename", path, words, into, {{"newName", name}});
  }
  /// Does the edits of a rename on the disk.
  void apply(const json& edit) {
    for (const auto& [uri, edits] : edit["changes"].items()) {
      const fs::path path = path_of(uri).value();
      const std::string text = Editor::edited(slurp(path), edits);
      std::ofstream(path, std::ios::binary) << text;
    }
  }

  const zwang::test::TemporaryFolder folder_;
  Editor editor_;
};

}  // namespace zwang::lsp::test
