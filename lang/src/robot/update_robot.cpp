// The file stays as its owner left it. New entries go behind the last of their section, new sections to the
// end.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "diagnostic/wordings_standing.hpp"
#include "robot/draft_entries.hpp"
#include "robot/joint_axes.hpp"
#include "robot/text_edits.hpp"
#include "robot/urdf.hpp"
#include "spec/shape.hpp"
#include "tree/file.hpp"
#include "tree/read.hpp"
#include "words/text.hpp"
#include "words/units.hpp"
#include "zwang/lang/robot_update.hpp"

namespace zwang::lang {

namespace {

bool is_of_a_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
}

bool mentions(const std::string& text, const std::string& name) {
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    const bool is_whole =
        (at == 0 || !is_of_a_name(text[at - 1])) && (end == text.size() || !is_of_a_name(text[end]));
    if (is_whole && text.compare(end, std::string_view(stands_nowhere).size(), stands_nowhere) != 0)
      return true;
  }
  return false;
}

int last_line(const Node& node) {
  int line = node.span.end.line;
  for (const Node& item : node.items) line = std::max(line, last_line(item));
  for (const Entry& entry : node.entries)
    line = std::max({line, entry.key.span.end.line, last_line(entry.value)});
  return line;
}

/// A text with its tree.
struct Read {
  std::string text;
  Node root;
  TextIndex index;

  Read(std::string source, Node tree) : text(std::move(source)), root(std::move(tree)), index(text) {}
  Read(const Read&) = delete;
  Read& operator=(const Read&) = delete;

  const Node* find(std::string_view key) const {
    const Entry* entry = root.find(key);
    return entry == nullptr ? nullptr : &entry->value;
  }
  std::size_t offset(Position position) const { return index.offset(position); }
  /// Behind the line, with its newline.
  std::size_t behind(int line) const { return std::min(text.size(), index.offset({line + 1, 1})); }
  std::string written(const Node& node) const {
    const std::size_t begin = offset(node.span.begin);
    return text.substr(begin, offset(node.span.end) - begin);
  }
  std::string indentation(int line) const {
    const std::string_view whole = index.line(line);
    return std::string(whole.substr(0, std::min(whole.size(), whole.find_first_not_of(' '))));
  }
};

/// The name of a section's entry, and its text.
struct Item {
  std::string name, text;
};

class Update {
 public:
  Update(const Read& old, const Read& draft, const Urdf& urdf) : old_(old), draft_(draft), urdf_(urdf) {}

  RobotUpdate run() {
    add_items();
    add_sections();
    fill(old_.root, draft_.root);
    find_vanished();
    find_different();
    RobotUpdate update;
    update.text = edits_.applied_to(old_.text);
    const auto placed = [&](const std::vector<Note>& notes) {
      std::vector<UpdateNote> lines;
      for (const Note& note : notes) {
        const auto above = comment_lines_.find(note.edit);
        lines.push_back(
            {edits_.line(note.edit) + (above == comment_lines_.end() ? 0 : above->second), note.text});
      }
      return lines;
    };
    update.added = placed(added_);
    update.vanished = placed(vanished_);
    update.differ = placed(differ_);
    return update;
  }

 private:
  struct Note {
    std::size_t edit;
    std::string text;
  };

  std::vector<Item> items_of(const Read& read, const Node& section) const {
    std::vector<Item> items;
    for (const Node& item : section.items) {
      const Entry* joint = item.find("joint");
      items.push_back({joint != nullptr ? joint->value.text : item.text, read.written(item)});
    }
    for (const Entry& entry : section.entries)
      items.push_back({entry.key.text, entry.key.text + ": " + read.written(entry.value)});
    return items;
  }

  void add_items() {
    for (const char* key :
         {"fixed", "turns", "mimic", "axes", "wheels", "supports", "actuated", "inertias", "frames"}) {
      const Node* section = old_.find(key);
      const Node* drafted = draft_.find(key);
      if (section == nullptr || drafted == nullptr) continue;
      for (const Item& item : items_of(draft_, *drafted)) {
        // Of the places that a draft proposes, the shipped tasks need these two.
        const bool is_needed =
            std::string_view(key) != "frames" || item.name == "hook" || item.name == "nose";
        if (is_needed && !mentions(old_.text, item.name)) insert(key, *section, item);
      }
    }
  }

  void insert(const std::string& key, const Node& section, const Item& item) {
    const bool is_empty = section.items.empty() && section.entries.empty();
    std::size_t edit = 0;
    if (section.is_flow || is_empty) {
      const std::size_t close = old_.offset(section.span.end) - (section.is_flow ? 1 : 0);
      edit = edits_.add(close, 0, (is_empty && !has_new_.contains(key) ? "" : ", ") + item.text);
      has_new_.insert(key);
    } else {
      const int first = section.is_sequence() ? section.items.front().span.begin.line
                                              : section.entries.front().key.span.begin.line;
      const std::size_t place = old_.behind(last_line(section));
      const bool lacks_newline = place > 0 && old_.text[place - 1] != '\n';
      edit = edits_.add(place, 0,
                        std::string(lacks_newline ? "\n" : "") + old_.indentation(first) +
                            (section.is_sequence() ? "- " : "") + item.text + (lacks_newline ? "" : "\n"));
    }
    added_.push_back({edit, key + ": " + item.text});
  }

  /// A section that the file must have, or that holds a name which the file holds nowhere.
  bool is_wanted(const Entry& section) const {
    const std::string& key = section.key.text;
    static const std::set<std::string> required = {"zwang_robot", "urdf", "base",     "wheels",
                                                   "actuated",    "stop", "footprint"};
    if (required.contains(key)) return true;
    if (key == "each_wheel" || key == "each_joint") return false;  // they have their own values
    if (key == "axes") return true;
    if (key == "lead") return !mentions(old_.text, "lead");
    const std::vector<Item> items = items_of(draft_, section.value);
    return std::any_of(items.begin(), items.end(),
                       [&](const Item& item) { return !mentions(old_.text, item.name); });
  }

  /// At the end of the file, each with the comment above it.
  void add_sections() {
    for (const Entry& section : draft_.root.entries) {
      if (old_.root.find(section.key.text) != nullptr || !is_wanted(section)) continue;
      int first = section.key.span.begin.line;
      while (first > 1 && draft_.index.line(first - 1).starts_with("#")) --first;
      const std::size_t begin = draft_.offset({first, 1});
      const std::string text = draft_.text.substr(begin, draft_.behind(last_line(section.value)) - begin);
      const std::size_t edit = edits_.add(old_.text.size(), 0, "\n" + text);
      comment_lines_[edit] = section.key.span.begin.line - first;
      added_.push_back({edit, section.key.text});
    }
  }

  /// Fills the open places of the file with values that the draft knows.
  void fill(const Node& open, const Node& known) {
    for (const Entry& entry : open.entries) {
      const Entry* other = known.find(entry.key.text);
      if (other == nullptr) continue;
      if (entry.value.is_scalar() && entry.value.text == fill_in) {
        if (!other->value.is_scalar() || other->value.text != fill_in) fill_one(entry, other->value);
      } else {
        fill(entry.value, other->value);
      }
    }
    for (const Node& item : open.items) {
      const Entry* joint = item.find("joint");
      if (joint == nullptr) continue;
      for (const Node& other : known.items) {
        const Entry* same = other.find("joint");
        if (same != nullptr && same->value.text == joint->value.text) fill(item, other);
      }
    }
  }

  void fill_one(const Entry& open, const Node& known) {
    const std::size_t begin = old_.offset(open.value.span.begin);
    const std::string text = draft_.written(known);
    const std::size_t edit = edits_.add(begin, old_.offset(open.value.span.end) - begin, text);
    added_.push_back({edit, open.key.text + ": " + text});
  }

  void gone(const Node& name, const std::string& what) {
    if (name.is_bad || name.text.empty()) return;
    const bool is_known = urdf_.find_joint(name.text) != nullptr || urdf_.find_link(name.text) != nullptr ||
                          urdf_.left_out.contains(name.text);
    if (!is_known)
      vanished_.push_back({edits_.mark(old_.offset(name.span.begin)), what + "`" + name.text + "`"});
  }

  void find_vanished() {
    if (const Node* base = old_.find("base")) gone(*base, "base: ");
    for (const char* key : {"wheels", "fixed", "turns", "ignore", "supports"}) {
      const Node* section = old_.find(key);
      if (section == nullptr) continue;
      for (const Node& item : section->items) {
        const Entry* joint = item.find("joint");
        gone(joint != nullptr ? joint->value : item, std::string(key) + ": ");
      }
    }
    for (const char* key : {"mimic", "axes", "actuated", "posture", "friction", "inertias"}) {
      const Node* section = old_.find(key);
      if (section == nullptr) continue;
      for (const Entry& entry : section->entries) gone(entry.key, std::string(key) + ": ");
    }
    find_vanished_parents();
  }

  void find_vanished_parents() {
    const Node* frames = old_.find("frames");
    if (frames == nullptr) return;
    for (const Entry& frame : frames->entries) {
      const Entry* parent = frame.value.find("parent");
      if (parent != nullptr && frames->find(parent->value.text) == nullptr)
        gone(parent->value, "frames: the parent of `" + frame.key.text + "`, ");
    }
  }

  /// Radii alone: of a torque the file is asked just because the URDF's is not believed.
  void find_different() {
    const Node* wheels = old_.find("wheels");
    const Node* drafted = draft_.find("wheels");
    if (wheels == nullptr || drafted == nullptr) return;
    for (const Node& wheel : wheels->items) {
      const Entry* joint = wheel.find("joint");
      const Entry* radius = wheel.find("radius");
      if (joint == nullptr || radius == nullptr) continue;
      for (const Node& other : drafted->items) {
        const Entry* same = other.find("joint");
        const Entry* now = other.find("radius");
        if (same == nullptr || now == nullptr || same->value.text != joint->value.text) continue;
        const double kept = parse_quantity(radius->value.text).quantity.value;
        const double urdfs = parse_quantity(now->value.text).quantity.value;
        constexpr double rounding = 1e-3;  // of a radius that was written by hand
        if (kept > 0.0 && urdfs > 0.0 && std::abs(kept - urdfs) > rounding * urdfs)
          differ_.push_back({edits_.mark(old_.offset(radius->value.span.begin)),
                             "radius of `" + joint->value.text + "`: " + radius->value.text + " here, " +
                                 now->value.text + " in the URDF"});
      }
    }
  }

  const Read& old_;
  const Read& draft_;
  const Urdf& urdf_;
  TextEdits edits_;
  std::set<std::string> has_new_;             ///< empty sections that hold something by now
  std::map<std::size_t, int> comment_lines_;  ///< of a section's edit, above its key
  std::vector<Note> added_, vanished_, differ_;
};

}  // namespace

std::optional<DraftOptions> options_of(const std::filesystem::path& robot_file, Diagnostics& diagnostics) {
  const std::optional<int> source = read_file(robot_file, yaml_size_limit, {}, diagnostics);
  const std::optional<Document> document = source ? read(*source, diagnostics) : std::nullopt;
  if (!document) return std::nullopt;
  MapReader map(document->root, "a robot file", diagnostics);
  if (!map.is_mapping() || !check_version(map, "zwang_robot", 1, diagnostics)) return std::nullopt;
  DraftOptions options;
  if (const Entry* ignored = document->root.find("ignore")) {
    for (const Node& link : ignored->value.items) options.ignored.push_back(link.text);
  }
  if (const Entry* turns = document->root.find("turns")) {
    for (const Node& joint : turns->value.items) options.turning.push_back(joint.text);
  }
  if (const Entry* axes = document->root.find("axes")) {
    for (const Entry& entry : axes->value.entries) {
      if (const auto text = parse_axis_of_joint(entry, diagnostics))
        options.axes.push_back({text->joint.text, text->axis});
    }
  }
  return options;
}

std::optional<RobotUpdate> update_robot_file(const std::filesystem::path& robot_file,
                                             const std::filesystem::path& urdf_file, const RobotDraft& draft,
                                             Diagnostics& diagnostics) {
  const std::optional<int> source = read_file(robot_file, yaml_size_limit, {}, diagnostics);
  const std::optional<Document> old = source ? read(*source, diagnostics) : std::nullopt;
  if (!old) return std::nullopt;
  if (const Entry* based_on = old->root.find("based_on")) {
    diagnostics.add(wording::update_of_based_on(based_on->value.span, based_on->value.text));
    return std::nullopt;
  }
  const std::optional<DraftOptions> options = options_of(robot_file, diagnostics);
  const std::optional<Urdf> urdf =
      read_urdf(urdf_file, {}, diagnostics, {options->ignored, options->turning});
  const int drafted = diagnostics.add_source({"draft", draft.text});
  const std::optional<Document> fresh = read(drafted, diagnostics);
  if (!urdf || !fresh) return std::nullopt;
  const Read old_text(diagnostics.source(*source).text, old->root), draft_text(draft.text, fresh->root);
  std::optional<RobotUpdate> update = Update(old_text, draft_text, *urdf).run();
  if (!update || is_yaml(update->text)) return update;
  diagnostics.add(wording::update_unreadable(old->root.span));
  return std::nullopt;
}

}  // namespace zwang::lang
