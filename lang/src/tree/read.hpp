/// Text to tree. The only YAML reader.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tree/node.hpp"
#include "tree/prescan.hpp"
#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang {

inline constexpr int deepest_nesting = 32;
inline constexpr int most_nodes = 20000;
inline constexpr std::size_t longest_key = 128;      ///< [bytes]
inline constexpr std::size_t longest_scalar = 4096;  ///< [bytes]

struct Document {
  int source = -1;
  Node root;
  std::vector<Comment> comments;
};

/// The single document of a source. nullopt: there is no tree. An error that concerns one part alone (tags,
/// doubled keys) marks that part as bad.
std::optional<Document> read(int source, Diagnostics& diagnostics);

/// Whether it can be read, whatever it says.
bool is_yaml(const std::string& text);

/// The place of every byte of a scalar's value, and of its end, in the source's text.
std::vector<Position> positions_of(const Node& scalar, std::string_view text);

}  // namespace zwang::lang
