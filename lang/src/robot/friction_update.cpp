#include "zwang/lang/friction_update.hpp"

#include "diagnostic/wordings_physics.hpp"
#include "diagnostic/wordings_standing.hpp"
#include "robot/text_edits.hpp"
#include "tree/file.hpp"
#include "tree/read.hpp"
#include "words/text.hpp"
#include "words/units.hpp"

namespace zwang::lang {

namespace {

std::string measured_keys(const MeasuredFriction& friction) {
  return "coulomb: " + wording::figure(friction.coulomb, "N m") +
         ", viscous: " + wording::figure(friction.viscous, "N m s/rad");
}

/// The entry's map on one line, its other keys as they are written.
std::string entry_text(const MeasuredFriction& friction, const Node* old, const std::string& text,
                       const TextIndex& index) {
  std::string keys = measured_keys(friction);
  if (old == nullptr) return "{" + keys + "}";
  for (const Entry& entry : old->entries) {
    if (entry.key.text == "coulomb" || entry.key.text == "viscous") continue;
    const std::size_t begin = index.offset(entry.value.span.begin);
    keys += ", " + entry.key.text + ": " + text.substr(begin, index.offset(entry.value.span.end) - begin);
  }
  return "{" + keys + "}";
}

}  // namespace

std::optional<std::string> with_friction(const std::filesystem::path& robot_file,
                                         const std::vector<MeasuredFriction>& frictions,
                                         Diagnostics& diagnostics) {
  const std::optional<int> source = read_file(robot_file, yaml_size_limit, {}, diagnostics);
  if (!source) return std::nullopt;
  const std::optional<Document> document = read(*source, diagnostics);
  if (!document) return std::nullopt;
  const std::string text = diagnostics.source(*source).text;
  const TextIndex index(text);
  const Entry* section = document->root.find("friction");
  if (const Entry* based_on = document->root.find("based_on"); based_on != nullptr && section == nullptr) {
    diagnostics.add(wording::update_of_based_on(based_on->value.span, based_on->value.text));
    return std::nullopt;
  }
  TextEdits edits;
  std::string added;
  for (const MeasuredFriction& friction : frictions) {
    const Entry* entry = section != nullptr ? section->value.find(friction.joint) : nullptr;
    if (entry == nullptr) {
      added += "  " + friction.joint + ": " + entry_text(friction, nullptr, text, index) + "\n";
      continue;
    }
    const std::size_t begin = index.offset(entry->value.span.begin);
    edits.add(begin, index.offset(entry->value.span.end) - begin,
              entry_text(friction, &entry->value, text, index));
  }
  if (!added.empty() && section == nullptr) {
    const std::string gap = text.empty() || text.back() == '\n' ? "\n" : "\n\n";
    edits.add(text.size(), 0, gap + "# Measured by `zwang robot identify`.\nfriction:\n" + added);
  } else if (!added.empty()) {
    const int below = section->key.span.begin.line + 1;
    edits.add(std::min(text.size(), index.offset({below, 1})), 0, added);
  }
  std::string changed = edits.applied_to(text);
  if (is_yaml(changed)) return changed;
  diagnostics.add(wording::update_unreadable(section != nullptr ? section->key.span : document->root.span));
  return std::nullopt;
}

}  // namespace zwang::lang
