/// The tasks of a file as nodes, and the ways between them.
#pragma once

#include <string>
#include <vector>

#include "zwang/lang/program.hpp"

namespace zwang::cli {

struct Edge {
  std::string from, to;
  std::string label;
  bool is_interruption =
      false;  ///< from any task, or an end that something else than the author's exit decides
};

struct Graph {
  std::vector<std::string> tasks;
  std::string start;
  std::vector<Edge> edges;
  bool has_always = false;

  bool leads_to(const std::string& node) const {
    for (const Edge& edge : edges) {
      if (edge.to == node) return true;
    }
    return false;
  }
};

/// Names that no task can have.
inline constexpr const char* always_node = "always";
inline constexpr const char* back_node = "back";

/// A task's node is named `task NAME`; `done` and `failed` are nodes, too.
Graph graph_of(const lang::Program& program);

}  // namespace zwang::cli
