/// The content of a YAML file before its meaning is checked: a tree of scalars, lists and maps with their
/// places.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "zwang/lang/source.hpp"

namespace zwang::lang {

enum class NodeKind { null, scalar, sequence, mapping };

struct Entry;

struct Node {
  NodeKind kind = NodeKind::null;
  Span span;
  std::string text;            ///< of a scalar, folded and unquoted
  bool is_quoted = false;      ///< scalar in quotes
  bool is_flow = false;        ///< list or map in brackets
  bool is_bad = false;         ///< already complained of: say no more
  bool is_replaced = false;    ///< a template argument was put in: letters have no places of their own
  std::vector<Node> items;     ///< of a sequence
  std::vector<Entry> entries;  ///< of a mapping, in the order of the text

  bool is_scalar() const { return kind == NodeKind::scalar; }
  bool is_mapping() const { return kind == NodeKind::mapping; }
  bool is_sequence() const { return kind == NodeKind::sequence; }
  const Entry* find(std::string_view key) const;
};

struct Entry {
  Node key;
  Node value;
};

inline const Entry* Node::find(std::string_view key) const {
  for (const Entry& entry : entries) {
    if (entry.key.text == key) return &entry;
  }
  return nullptr;
}

}  // namespace zwang::lang
