#include "zwang/lang/upgrade.hpp"

#include <algorithm>
#include <set>
#include <string_view>
#include <vector>

#include "edit/name_walk.hpp"
#include "format/tokens.hpp"
#include "spec/shape.hpp"
#include "tree/file.hpp"
#include "tree/read.hpp"
#include "words/text.hpp"

namespace zwang::lang {

namespace {

constexpr std::string_view old_axis = "speed", new_axis = "plane";

/// Bytes of the text, and what stands there from now on.
struct Edit {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::string text;
};

class Upgrade {
 public:
  Upgrade(const Document& document, std::string_view text) : document_(document), text_(text), index_(text) {}

  std::string text() {
    const Entry* version = document_.root.find("zwang");
    if (version == nullptr || version->value.text == std::to_string(newest_task_version))
      return std::string(text_);
    replace(version->value.span, std::to_string(newest_task_version));
    rename_axes(document_.root, {});
    rename_in_conditions(document_.root);
    return edited();
  }

 private:
  /// A group's `speed: {velocity: ..}`. A parameter or a task of this name holds no velocity.
  void rename_axes(const Node& node, const std::string& name) {
    for (const Entry& entry : node.entries) {
      if (entry.key.text == old_axis && entry.value.find("velocity") != nullptr) {
        groups_.insert(name);
        replace(entry.key.span, std::string(new_axis));
      }
      rename_axes(entry.value, entry.key.text);
    }
    for (const Node& item : node.items) rename_axes(item, name);
  }

  /// `GROUP.speed.velocity` and its like, in the scalars.
  void rename_in_conditions(const Node& node) {
    for (const Entry& entry : node.entries) rename_in_conditions(entry.value);
    for (const Node& item : node.items) rename_in_conditions(item);
    if (!node.is_scalar()) return;
    const std::string dotted = "." + std::string(old_axis) + ".";
    const std::string_view value = node.text;
    for (std::size_t dot = value.find(dotted); dot != std::string_view::npos;
         dot = value.find(dotted, dot + 1)) {
      std::size_t begin = dot;
      while (begin > 0 && is_word_part(value[begin - 1])) --begin;
      if (!groups_.contains(std::string(value.substr(begin, dot - begin)))) continue;
      const std::vector<Position> places = positions_of(node, text_);
      replace({document_.source, places[dot + 1], places[dot + 1 + old_axis.size()]}, std::string(new_axis));
    }
  }

  void replace(const Span& span, std::string text) {
    edits_.push_back({index_.offset(span.begin), index_.offset(span.end), std::move(text)});
  }

  std::string edited() {
    std::sort(edits_.begin(), edits_.end(), [](const Edit& a, const Edit& b) { return a.begin > b.begin; });
    std::string result(text_);
    for (const Edit& edit : edits_) result.replace(edit.begin, edit.end - edit.begin, edit.text);
    return result;
  }

  const Document& document_;
  std::string_view text_;
  TextIndex index_;
  std::set<std::string> groups_;  ///< that have a `speed`
  std::vector<Edit> edits_;
};

}  // namespace

std::optional<std::string> upgrade_task(const std::filesystem::path& path, Diagnostics& diagnostics) {
  const std::optional<int> source = read_file(path, yaml_size_limit, {}, diagnostics);
  if (!source) return std::nullopt;
  const std::optional<Document> document = read(*source, diagnostics);
  if (!document || diagnostics.has_errors()) return std::nullopt;
  const std::string text = Upgrade(*document, diagnostics.source(*source).text).text();
  return format_source(diagnostics.add_source({path.string(), text}), diagnostics);
}

}  // namespace zwang::lang
