/// Collects the names of a tree of nodes.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tree/read.hpp"
#include "zwang/lang/names.hpp"

namespace zwang::lang {

/// Whether `c` may stand in a name, behind its first letter.
constexpr bool is_word_part(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// The places of names, as they are found. Knows the text, for places inside of scalars.
class NameWalk {
 public:
  NameWalk(const Document& document, std::string_view text) : document_(document), text_(text) {}

  /// Walks the whole file. Kinds that could be several are left so.
  std::vector<NamePlace> walk(FileKind kind);

 private:
  using Kinds = std::vector<NameKind>;

  void walk_task_file(const Node& root);
  void walk_declarations(const Node& root);
  void walk_frames(const Node& root);
  void walk_features(const Node& features);
  void walk_templates(const Node& templates);
  void walk_task(const Node& task, const std::string& scope);
  void walk_use(const Node& task);
  void walk_groups(const Node& groups, const std::string& scope);
  void walk_group(const Node& group, const std::string& scope);
  void walk_exits(const Node& exits, const std::string& scope);
  void walk_set(const Node& set, const std::string& scope);
  void walk_scene(const Node& root);
  void walk_robots(const Node& robots);
  void walk_signals(const Node& signals);
  void walk_scenario(const Node& root);
  void walk_connection(const Node& root);

  void give(const Node& key, NameKind kind, const std::string& scope = {});
  void mean(const Node& scalar, Kinds kinds, const std::string& scope = {});
  /// A part of a scalar, by bytes of its value.
  void mean_part(const Node& scalar, std::size_t begin, std::size_t end, Kinds kinds,
                 const std::string& scope = {});
  std::optional<Span> span_of(const Node& scalar, std::size_t begin, std::size_t end) const;
  /// The names in a condition.
  void mean_condition(const Node& scalar, const std::string& scope);
  /// `$name`, in all scalars below.
  void mean_parameters(const Node& node, const std::string& scope);
  void mean_key_part(const Node& key, std::string_view prefix, NameKind kind);

  const Document& document_;
  std::string_view text_;
  std::vector<NamePlace> places_;
};

}  // namespace zwang::lang
