#include "robot/based_on.hpp"

#include <set>
#include <utility>

#include "diagnostic/wordings_standing.hpp"
#include "spec/shape.hpp"
#include "tree/file.hpp"

namespace zwang::lang {

namespace fs = std::filesystem;

namespace {

/// The version of each file, and what it is based on, are its own.
bool is_own(const std::string& key) {
  return key == "zwang_robot" || key == "based_on";
}

std::optional<Document> read_base(const fs::path& path, const Word& cause, Diagnostics& diagnostics) {
  const std::optional<int> source = read_file(path, yaml_size_limit, cause.span, diagnostics);
  std::optional<Document> base = source ? read(*source, diagnostics) : std::nullopt;
  if (!base) return std::nullopt;
  MapReader map(base->root, "a robot file", diagnostics);
  if (!map.is_mapping() || !check_version(map, "zwang_robot", 1, diagnostics)) return std::nullopt;
  return base;
}

}  // namespace

std::optional<fs::path> add_based_on(Document& document, const fs::path& path, const fs::path& root,
                                     Diagnostics& diagnostics) {
  fs::path urdf_from = path, nearest = path;
  std::set<fs::path> chain{fs::weakly_canonical(path)};
  const Entry* entry = document.root.find("based_on");
  std::optional<Node> written;
  if (entry != nullptr) written = entry->value;
  while (written) {
    const Word name = parse_word(*written, "`based_on`", diagnostics);
    if (!name.exists()) return std::nullopt;
    const auto next = resolve_path(name.text, nearest, root, name.span, diagnostics);
    if (!next) return std::nullopt;
    const bool is_new = chain.insert(fs::weakly_canonical(*next)).second;
    if (!is_new || chain.size() > longest_chain) {
      diagnostics.add(wording::based_on_itself(name.span, name.text, is_new ? longest_chain : 0));
      return std::nullopt;
    }
    std::optional<Document> base = read_base(*next, name, diagnostics);
    if (!base) return std::nullopt;
    nearest = *next;
    if (document.root.find("urdf") == nullptr) urdf_from = *next;
    written.reset();
    for (Entry& said : base->root.entries) {
      if (said.key.text == "based_on") written = said.value;
      if (is_own(said.key.text) || document.root.find(said.key.text) != nullptr) continue;
      document.root.entries.push_back(std::move(said));
    }
  }
  return urdf_from;
}

}  // namespace zwang::lang
