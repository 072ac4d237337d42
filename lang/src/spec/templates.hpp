/// Templates: a task's body with arguments put in, before anyone reads it as a task.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

#include "tree/node.hpp"
#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang {

class Templates {
 public:
  explicit Templates(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  /// Reads the `templates` mapping.
  void declare(const Node& node);
  /// What the task `task` says: itself, or the body of the template that it uses, with its own keys in the
  /// place of the body's. nullopt when it cannot be told, and was complained of.
  std::optional<Node> expand(const Node& task);
  /// W302 for templates that no task uses.
  void report_unused() const;

 private:
  struct Template {
    std::map<std::string, std::string> arguments;  ///< name -> kind
    const Node* body = nullptr;
    Span span;
    bool is_bad = false;
    bool is_used = false;
  };

  std::optional<Node> expand_from(const Node& task, std::set<std::string>& open);
  bool fill_arguments(const Template& used, const Node& task, const std::string& name,
                      std::map<std::string, Node>& values);
  bool check_argument(const std::string& name, const std::string& kind, const Node& value);

  std::map<std::string, Template> templates_;
  Diagnostics& diagnostics_;
};

}  // namespace zwang::lang
