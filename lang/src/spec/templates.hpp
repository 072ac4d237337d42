/// Templates: a task's body with arguments put in, before anyone reads it as a task.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "spec/task_file.hpp"
#include "spec/value.hpp"
#include "tree/node.hpp"
#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang {

class Templates {
 public:
  /// `parameters`: what each parameter of the file measures; none where that is not known.
  Templates(std::map<std::string, std::optional<Dimension>> parameters, Diagnostics& diagnostics)
      : parameters_(std::move(parameters)), diagnostics_(diagnostics) {}

  /// Names that are not known are not complained of: their section could not be read.
  void forgive_unknown() { forgives_unknown_ = true; }
  /// Reads the `templates` mapping.
  void declare(const Node& node);
  /// The expanded `task`. If the task uses a template, it is the template's body, with the task's own keys in
  /// the place of the body's. Otherwise it is the task itself. nullopt on an error.
  std::optional<Node> expand(const Node& task);
  /// Expands the groups under the `constraints` of a task or of `always` that use a template.
  void expand_groups(Node& owner);
  /// W302 for templates that no task uses, and for arguments that their body does not.
  void report_unused() const;
  /// Of all uses so far. Whether a name is what its argument asks for is known once all names are.
  const std::vector<NamedArgument>& named_arguments() const { return named_arguments_; }

 private:
  struct Template {
    std::map<std::string, std::string> arguments;      ///< name -> kind
    std::vector<std::pair<std::string, Span>> unused;  ///< arguments that the body does not name
    const Node* body = nullptr;                        ///< or the group
    bool is_group = false;
    int nodes = 0;  ///< of the body
    Span span;
    bool is_bad = false;
    bool is_used = false;
  };

  bool has_unknown_name(const Node& node, const Template& declared) const;
  /// `is_group`: of a group rather than of a task.
  std::optional<Node> expand_from(const Node& user, bool is_group, std::set<std::string>& open);
  bool fill_arguments(const Template& used, const Node& task, const std::string& name,
                      std::map<std::string, Node>& values);
  bool check_argument(const std::string& name, const std::string& kind, const Node& value);
  bool check_parameter(const std::string& name, const ValueText& value, const Dimension& expected);

  std::map<std::string, Template> templates_;
  std::vector<NamedArgument> named_arguments_;
  std::map<std::string, std::optional<Dimension>> parameters_;
  Diagnostics& diagnostics_;
  bool forgives_unknown_ = false;
  int nodes_ = 0;  ///< that the uses of templates have made
};

}  // namespace zwang::lang
