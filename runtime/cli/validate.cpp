#include <algorithm>
#include <filesystem>
#include <iostream>
#include <list>
#include <nlohmann/json.hpp>
#include <sstream>

#include "colour.hpp"
#include "file_kind.hpp"
#include "output.hpp"
#include "verbs.hpp"
#include "zwang/lang/mending.hpp"
#include "zwang/lang/open_texts.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/version.hpp"

namespace zwang::cli {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct Checked {
  std::string path;
  FileKind kind = FileKind::task;
  std::optional<std::string> summary;
  lang::Diagnostics diagnostics;
  bool is_good = false;
};

/// zwang's own files below a folder, in the order of their names.
std::vector<std::string> files_below(const std::string& folder) {
  std::vector<std::string> files = yaml_files_below(folder);
  std::erase_if(files, [](const std::string& path) { return !kind_of_file(path); });
  if (files.empty()) throw Impossible(folder + ": no task, robot or scene file below this folder");
  return files;
}

/// Of the reader's limit one byte more: it then says that the text is too large.
constexpr std::size_t most_of_stdin = 256 * 1024 + 1;

std::string text_of_stdin() {
  std::string text(most_of_stdin, '\0');
  std::cin.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(std::cin.gcount()));
  return text;
}

std::vector<std::string> files_of(const ValidateArguments& arguments, lang::OpenTexts& unsaved) {
  std::vector<std::string> files;
  for (const std::string& path : arguments.files) {
    std::error_code error;
    if (path == "-") {
      if (unsaved.find(arguments.stdin_path) == nullptr) unsaved.put(arguments.stdin_path, text_of_stdin());
      if (is_urdf_text(*unsaved.find(arguments.stdin_path))) refuse_as_urdf(arguments.stdin_path);
      files.push_back(arguments.stdin_path);
    } else if (fs::is_directory(path, error)) {
      const std::vector<std::string> below = files_below(path);
      files.insert(files.end(), below.begin(), below.end());
    } else {
      require_file(path);
      refuse_urdf(path);
      files.push_back(path);
    }
  }
  return files;
}

/// A file of an unknown kind is read as a task file, whose reader names the error.
FileKind kind_of(const std::string& path) {
  return kind_of_file(path).value_or(FileKind::task);
}

bool has_kind(const std::vector<std::string>& paths, FileKind kind) {
  return std::any_of(paths.begin(), paths.end(),
                     [&](const std::string& path) { return kind_of(path) == kind; });
}

/// `--task` speaks of connection files. `-p`, `--robot` and `--scene` speak of task files; `--robot` of scene
/// files, too.
void require_files_for(const ValidateArguments& arguments, const std::vector<std::string>& paths) {
  if (arguments.task) require_file(*arguments.task);
  if (arguments.task && !has_kind(paths, FileKind::connection))
    throw Impossible("--task is for connection files, and there is none among these");
  const TaskOverrides& overrides = arguments.overrides;
  const bool is_robot_alone = overrides.robot && !overrides.scene && overrides.parameters.empty();
  const bool is_for_some = arguments.task || has_kind(paths, FileKind::task) ||
                           (is_robot_alone && has_kind(paths, FileKind::scene));
  if (overrides.any() && !is_for_some)
    throw Impossible("-p, --robot and --scene are for task files, and there is none among these");
}

std::string counts(const lang::Diagnostics& diagnostics) {
  const int warnings = diagnostics.count(lang::Severity::warning);
  return count(static_cast<std::size_t>(diagnostics.error_count()), "error") +
         (warnings > 0 ? ", " + count(static_cast<std::size_t>(warnings), "warning") : std::string());
}

std::string human(const Checked& file, const ValidateArguments& arguments) {
  const std::string text = rendered(file.diagnostics, {.notes = arguments.notes}) + file.path + ": ";
  if (file.is_good) return text + marked(Hue::good, "good") + " (" + *file.summary + ")\n";
  return text + marked(Hue::bad, counts(file.diagnostics)) + "\n";
}

std::string short_lines(const Checked& file, const ValidateArguments& arguments) {
  std::ostringstream text;
  lang::render_short(file.diagnostics, text, {.notes = arguments.notes});
  return text.str();
}

std::string json(const std::list<Checked>& checked, bool is_good, const ValidateArguments& arguments) {
  ordered_json files = ordered_json::array();
  ordered_json all = ordered_json::array();
  for (const Checked& file : checked) {
    files.push_back({{"file", file.path}, {"kind", word_of(file.kind)}, {"ok", file.is_good}});
    const std::string rendered = lang::render_json(file.diagnostics, {.notes = arguments.notes});
    for (auto& d : ordered_json::parse(rendered)) all.push_back(std::move(d));
  }
  const ordered_json whole = {{"ok", is_good}, {"files", files}, {"diagnostics", all}};
  return whole.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string sarif(const std::list<Checked>& checked, const ValidateArguments& arguments) {
  std::vector<const lang::Diagnostics*> all;
  for (const Checked& file : checked) all.push_back(&file.diagnostics);
  return lang::render_sarif(all, ZWANG_VERSION, {.notes = arguments.notes});
}

}  // namespace

int validate(const ValidateArguments& arguments) {
  lang::OpenTexts unsaved;
  const std::vector<std::string> paths = files_of(arguments, unsaved);
  const lang::ReadsOpenTexts reading(unsaved);
  require_files_for(arguments, paths);
  const lang::LoadOptions options = arguments.overrides.load_options();
  std::list<Checked> checked;
  bool is_good = true;
  for (const std::string& path : paths) {
    Checked& file = checked.emplace_back();
    file.path = path;
    file.kind = kind_of(path);
    file.summary =
        read_as(file.kind, path, file.diagnostics, {options, arguments.notes, true, arguments.task});
    // Programs make edits without a look at them.
    const bool is_for_programs =
        arguments.format == ReportFormat::json || arguments.format == ReportFormat::sarif;
    if (is_for_programs)
      file.diagnostics = lang::with_mending_edits(file.kind, path, {options, arguments.notes, arguments.task},
                                                  file.diagnostics);
    const bool is_denied = arguments.deny_warnings && file.diagnostics.count(lang::Severity::warning) > 0;
    file.is_good = file.summary && !file.diagnostics.has_errors() && !is_denied;
    is_good = is_good && file.is_good;
    if (arguments.format == ReportFormat::human) print(human(file, arguments));
    if (arguments.format == ReportFormat::one_line) print(short_lines(file, arguments));
  }
  if (arguments.format == ReportFormat::json) print_data(json(checked, is_good, arguments));
  if (arguments.format == ReportFormat::sarif) print_data(sarif(checked, arguments));
  return is_good ? exit_good : exit_bad;
}

}  // namespace zwang::cli
