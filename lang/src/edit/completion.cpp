#include "zwang/lang/completion.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "edit/name_walk.hpp"
#include "edit/schema_walk.hpp"
#include "edit/units_that_fit.hpp"
#include "zwang/lang/condition_function.hpp"

namespace zwang::lang {

namespace {

bool is_one_of(const std::string& key, std::initializer_list<const char*> keys) {
  return std::any_of(keys.begin(), keys.end(), [&](const char* one) { return key == one; });
}

/// `tasks.press` or `templates.go`: the task that the place stands in; `always` in that section.
std::string scope_of(const std::vector<std::string>& keys) {
  if (!keys.empty() && keys.front() == "always") return "always";
  const bool is_named = keys.size() > 1 && is_one_of(keys.front(), {"tasks", "templates"});
  return is_named ? keys[0] + "." + keys[1] : "";
}

class Proposer {
 public:
  Proposer(FileKind kind, std::string_view text, const TextPlace& place, const KnownNames& known)
      : kind_(kind),
        text_(text),
        place_(place),
        known_(known),
        key_(place.keys.empty() ? "" : place.keys.back()) {
    for (auto k = place.keys.rbegin(); key_ == "-" && k != place.keys.rend(); ++k) key_ = *k;
  }

  std::vector<Proposal> propose() {
    const SchemaPlace schema = schema_place(kind_, place_.keys);
    if (place_.is_key) {
      add_first_keys();
      for (const SchemaKey& key : schema.keys) add(key.name, ProposalKind::key, key.about);
      add_arguments();
      add_what_is_set();
      return std::move(all_);
    }
    if (is_behind_number()) {
      const UnitSources sources{kind_, text_, known_.given};
      const auto units =
          is_condition() ? units_in_condition(before(), sources) : units_that_fit(place_.keys, sources);
      for (const std::string& unit : units) add(unit, ProposalKind::unit, "");
      return std::move(all_);
    }
    if (is_behind_dollar()) {
      add_names(NameKind::argument);
      add_names(NameKind::parameter);
      return std::move(all_);
    }
    for (const std::string& word : schema.words) add(word, ProposalKind::word, "", true);
    add_files();
    is_condition() ? add_condition() : add_by_key();
    return std::move(all_);
  }

 private:
  /// In front of the word that is being written.
  std::string_view before() const {
    std::string_view text = place_.value;
    while (!text.empty() &&
           (std::isalnum(static_cast<unsigned char>(text.back())) != 0 || text.back() == '_'))
      text.remove_suffix(1);
    return text;
  }

  bool is_behind_number() const {
    std::string_view text = before();
    if (text.empty() || text.back() != ' ') return false;
    text.remove_suffix(1);
    return !text.empty() && text.back() >= '0' && text.back() <= '9';
  }

  bool is_behind_dollar() const { return before().ends_with('$'); }

  bool is_condition() const {
    return is_one_of(key_, {"when", "require", "that", "yield"}) ||
           (kind_ == FileKind::scenario && key_ == "always");
  }

  void add(const std::string& text, ProposalKind kind, const std::string& about, bool is_whole = false) {
    if (seen_.insert(text).second) all_.push_back({text, kind, about, is_whole});
  }

  /// Below a key that names a file: those of its kind. none: the key names no file; inner none: a URDF.
  std::optional<std::optional<FileKind>> kind_of_named_file() const {
    if (is_one_of(key_, {"robot", "based_on"})) return FileKind::robot;
    if (key_ == "scene") return FileKind::scene;
    if (key_ == "task" || (kind_ == FileKind::connection && is_below("tasks"))) return FileKind::task;
    if (key_ == "scenario") return FileKind::scenario;
    if (key_ == "urdf") return std::optional<FileKind>();
    return std::nullopt;
  }

  void add_files() {
    const auto wanted = kind_of_named_file();
    if (!wanted || !known_.files) return;
    for (const KnownFile& file : known_.files()) {
      if (file.kind == *wanted) add(file.name, ProposalKind::file, "", true);
    }
  }

  /// The first key tells what a file is: `zwang` a task file.
  void add_first_keys() {
    if (!begins_a_file(text_)) return;
    add("zwang", ProposalKind::key, "task file");
    for (const FileKind kind :
         {FileKind::robot, FileKind::scene, FileKind::scenario, FileKind::connection, FileKind::study}) {
      const std::string word = word_of(kind);
      add("zwang_" + word, ProposalKind::key, word + " file");
    }
  }

  /// Keys of `set`.
  void add_what_is_set() {
    if (key_ != "set") return;
    for (const auto& [kind, section] : {std::pair(NameKind::frame, "frames."),
                                        {NameKind::parameter, "params."},
                                        {NameKind::output, "outputs."}}) {
      for (const NamePlace& given : known_.given) {
        if (given.is_given && given.kinds.front() == kind)
          add(section + given.name, ProposalKind::key, word_of(kind), true);
      }
    }
  }

  void add_names(NameKind kind) {
    const std::string scope = scope_of(place_.keys);
    for (const NamePlace& given : known_.given) {
      if (!given.is_given || given.kinds.front() != kind) continue;
      if (has_scope(kind) && given.scope != scope && given.scope != "always" && kind_ == FileKind::task)
        continue;
      add(given.name, ProposalKind::name, word_of(kind));
    }
  }

  void add_frames() {
    add_names(NameKind::frame);
    for (const std::string& frame : known_.frames) add(frame, ProposalKind::name, "frame of the robot");
  }

  /// Of the template that a task uses: keys below `with`.
  void add_arguments() {
    if (key_ != "with") return;
    for (const NamePlace& given : known_.given) {
      if (given.is_given && given.kinds.front() == NameKind::argument)
        add(given.name, ProposalKind::name, "argument of " + given.scope);
    }
  }

  void add_by_key() {
    if (is_one_of(key_, {"move", "in", "parent", "holds", "distance", "angle", "bearing"})) add_frames();
    if (key_ == "parent") add_names(NameKind::signal);
    if (key_ == "move" && !place_.keys.empty()) add("footprint", ProposalKind::word, "with `inside`");
    if (is_one_of(key_, {"goto", "start"})) add_names(NameKind::task);
    if (key_ == "goto") {
      for (const char* end : {"done", "failed", "back"}) add(end, ProposalKind::word, "");
    }
    if (key_ == "use") add_names(NameKind::task_template);
    if (key_ == "inside") add_names(NameKind::region);
    if (key_ == "feature") add_names(NameKind::feature);
    if (is_below("set")) add_set_value();
    if (is_below("with")) {
      add_frames();
      for (const NameKind kind : {NameKind::task, NameKind::region, NameKind::signal, NameKind::feature})
        add_names(kind);
    }
    if (is_one_of(key_, {"pose_of", "distance_to", "force_on", "latch"})) add_names(NameKind::object);
  }

  void add_set_value() {
    if (key_.starts_with("frames.")) return add_frames();
    if (!key_.starts_with("outputs.")) return;
    for (const char* word : {"true", "false"}) add(word, ProposalKind::word, "");
  }

  bool is_below(const char* key) const {
    return place_.keys.size() > 1 && place_.keys[place_.keys.size() - 2] == key;
  }

  /// Proposes the names that the function in front of the parenthesis takes.
  void add_argument_of(std::string_view text) {
    text.remove_suffix(1);
    std::size_t begin = text.size();
    while (begin > 0 && std::isalpha(static_cast<unsigned char>(text[begin - 1])) != 0) --begin;
    const ConditionFunction* function = find_function(text.substr(begin));
    if (function == nullptr || function->argument == FunctionArgument::number) {
      for (const NameKind kind : {NameKind::group, NameKind::signal, NameKind::feature}) add_names(kind);
    } else if (function->argument == FunctionArgument::task) {
      add_names(NameKind::task);
    } else if (function->argument == FunctionArgument::signal) {
      add_names(NameKind::signal);
    } else {
      add_frames();
    }
  }

  void add_axes() {
    for (const char* axis : {"x", "y", "z", "rx", "ry", "rz"}) add(axis, ProposalKind::word, "axis");
  }

  /// Behind the points of `estimated.force.x` and `estimated.FRAME.x`.
  void add_estimated(std::ptrdiff_t points) {
    if (points > 1) return add_axes();
    add("force", ProposalKind::word, "on the base, at its origin");
    add_frames();
  }

  /// `contact.x.velocity`: what can follow each point.
  void add_condition() {
    const std::string_view text = before();
    if (text.ends_with('.')) {
      const std::size_t begin = text.find_last_of(" (<>+-*/", text.size() - 1);
      const std::string_view path = text.substr(begin == std::string_view::npos ? 0 : begin + 1);
      const auto points = std::count(path.begin(), path.end(), '.');
      if (path.starts_with("estimated.")) return add_estimated(points);
      if (points == 1) add_axes();
      for (const char* what : {"position", "velocity", "force", "residual", "saturated"})
        add(what, ProposalKind::word, "");
      return;
    }
    if (text.ends_with('(')) return add_argument_of(text);
    for (const NameKind kind : {NameKind::group, NameKind::signal, NameKind::output, NameKind::feature})
      add_names(kind);
    add("elapsed", ProposalKind::word, "time since the task was entered");
    add("estimated", ProposalKind::word, "what the world presses with, by torques and motion alone");
    for (const ConditionFunction& function : condition_functions())
      add(std::string(function.name), ProposalKind::function, std::string(function.of));
    for (const char* word : {"and", "or", "not"}) add(word, ProposalKind::word, "");
  }

  FileKind kind_;
  std::string_view text_;
  const TextPlace& place_;
  const KnownNames& known_;
  std::string key_;
  std::vector<Proposal> all_;
  std::set<std::string> seen_;
};

}  // namespace

std::vector<Proposal> proposals(FileKind kind, std::string_view text, std::size_t offset,
                                const KnownNames& known) {
  const TextPlace place = place_at(text, offset);
  return Proposer(kind, text, place, known).propose();
}

bool begins_a_file(std::string_view text) {
  bool has_word = false;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    const std::size_t first = line.find_first_not_of(' ');
    if (first == std::string_view::npos || line[first] == '#' || line == "---") continue;
    if (has_word || !std::all_of(line.begin(), line.end(), is_word_part)) return false;
    has_word = true;
  }
  return true;
}

std::string about_key(FileKind kind, const std::vector<std::string>& keys) {
  if (keys.empty()) return {};
  const std::vector<std::string> above(keys.begin(), keys.end() - 1);
  for (const SchemaKey& key : schema_place(kind, above).keys) {
    if (key.name == keys.back() && !key.about.empty()) return key.about;
  }
  return schema_place(kind, keys).about;
}

}  // namespace zwang::lang
