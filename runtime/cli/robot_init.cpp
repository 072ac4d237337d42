// Writes a first robot file from a URDF, or an existing one again, and a task with its scene beside it.
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "output.hpp"
#include "shipped.hpp"
#include "verbs.hpp"
#include "zwang/lang/nearest.hpp"
#include "zwang/lang/open_places.hpp"
#include "zwang/lang/robot_draft.hpp"
#include "zwang/lang/robot_update.hpp"
#include "zwang/lang/task_draft.hpp"

namespace zwang::cli {

namespace fs = std::filesystem;

namespace {

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) throw Impossible(file.string() + ": cannot be read");
  return text.str();
}

void require_task(const std::string& task) {
  const std::vector<std::string>& known = lang::fitted_tasks();
  if (std::find(known.begin(), known.end(), task) != known.end()) return;
  std::string names;
  for (const std::string& name : known) names += (names.empty() ? "`" : ", `") + name + "`";
  throw Impossible("--task " + task + ": no use case of that name; there are " + names);
}

/// The files that one call writes, beside each other.
struct Files {
  fs::path robot, task, scene;

  Files(const fs::path& robot_file, const std::string& task_name)
      : robot(robot_file),
        task(fs::path(robot_file).replace_filename(robot_file.stem().string() + "_" + task_name + ".yaml")),
        scene(fs::path(robot_file)
                  .replace_filename(robot_file.stem().string() + "_" + task_name + "_scene.yaml")) {}
};

/// Where the owner names no robot file: letters, digits and `_` of the robot's own name, in this folder.
std::string file_named_after(const std::string& robot) {
  std::string name;
  for (const char c : robot) {
    const bool is_plain = (static_cast<unsigned char>(c) & 0x80U) != 0 ||
                          std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
    name += is_plain ? c : '_';
  }
  return (name.empty() ? "robot" : name) + ".yaml";
}

/// Why no task is written for this base; empty: it can do the task, as far as is known.
std::string why_no_task(const std::string& task, const lang::BaseFit& fit, const lang::RobotDraft& draft) {
  if (draft.assumed.empty() && !draft.missing.empty()) return draft.missing.front();
  return lang::why_unfit(task, fit);
}

/// The robot file was written, and no task.
[[noreturn]] void refuse_task(const std::string& task, const lang::BaseFit& fit,
                              const lang::RobotDraft& draft, const std::string& why) {
  const bool can_stand = !draft.assumed.empty();
  throw Impossible("--task " + task + ": not for `" + fit.robot + "`: " + why +
                   (can_stand && task != "feel_wall" ? ". `--task feel_wall` is for every base" : "") +
                   ". No task was written");
}

/// The task and its scene, as texts.
lang::TaskTexts fitted(const std::string& task, const lang::BaseFit& fit, const Files& files) {
  const std::optional<fs::path> shipped = shipped_folder();
  if (!shipped)
    throw Impossible(
        "the shipped files are not beside this program: install it, or run it from its checkout");
  const lang::TaskTexts texts{text_of(*shipped / (task + ".yaml")),
                              text_of(*shipped / "scenes/corridor.yaml")};
  return lang::draft_task(task, texts, fit, files.robot.filename().string(), files.scene.filename().string());
}

/// In columns: the line, the entry, what to do.
std::string listed(const std::string& title, const std::vector<lang::OpenPlace>& places) {
  if (places.empty()) return "";
  constexpr std::size_t longest = 60;
  const auto short_entry = [](const std::string& entry) {
    return entry.size() <= longest ? entry : entry.substr(0, longest - 4) + " ...";
  };
  std::size_t width = 0;
  for (const lang::OpenPlace& place : places) width = std::max(width, short_entry(place.entry).size());
  std::string text = title + "\n";
  for (const lang::OpenPlace& place : places)
    text += "  line " + padded(std::to_string(place.line), 4) + padded(short_entry(place.entry), width + 2) +
            place.what_to + "\n";
  return text;
}

std::string to_decide(const std::string& file, const std::string& text) {
  const lang::OpenPlaces places = lang::open_places(text);
  return listed("to fill in, in " + file, places.to_fill_in) + listed("proposed, to check", places.to_check);
}

int refused(const lang::Diagnostics& diagnostics) {
  print(rendered(diagnostics));
  return exit_bad;
}

void require_wheels(const std::string& urdf, const lang::RobotDraft& draft) {
  if (!draft.wheels.empty()) return;
  std::string reason = ": no wheels found: a robot file needs some";
  constexpr std::size_t most = 3;
  const std::size_t count = draft.stuck.size();
  for (std::size_t i = 0; i < std::min(count, most); ++i)
    reason += "; `" + draft.stuck[i].joint + "` is " + draft.stuck[i].how;
  if (count > most) reason += "; and " + std::to_string(count - most) + " more are no wheels";
  reason += ". A wheel's joint is `continuous` about a level axle";
  if (count == 0) reason += "; without a wheel's name or a round shape, another one like it stands beside it";
  throw Impossible(urdf + reason);
}

std::optional<lang::RobotDraft> drafted(const RobotInitArguments& arguments,
                                        const std::optional<std::string>& file, lang::DraftOptions options,
                                        lang::Diagnostics& diagnostics) {
  fs::path named = fs::path(arguments.urdf).filename();
  if (file) named = fs::absolute(arguments.urdf).lexically_relative(fs::absolute(*file).parent_path());
  options.with_hook = arguments.task == "docking";
  return lang::draft_robot(arguments.urdf, named.generic_string(), diagnostics, options);
}

void require_free(const fs::path& file, const std::string& way_out) {
  if (fs::exists(file))
    throw Impossible(file.string() + ": is there already; " + way_out + ". Nothing was written");
}

/// Written by one call, in this order: nothing is written before everything is known to be good.
struct Written {
  std::vector<std::pair<std::string, std::string>> files;  ///< path, text
  std::string report;

  void add(const std::string& path, const std::string& text, const char* how) {
    files.emplace_back(path, text);
    report += path + ": " + how + "\n";
  }
  void write() const {
    std::vector<std::string> done;
    try {
      for (const auto& [path, text] : files) {
        const bool is_new = !fs::exists(path);
        write_file(path, text);
        if (is_new) done.push_back(path);
      }
    } catch (const Impossible&) {
      std::error_code error;
      for (const std::string& path : done) fs::remove(path, error);
      throw;
    }
  }
};

/// The texts that `init` writes while nothing is filled in. A file that still reads so was changed by nobody.
std::vector<lang::TaskTexts> unfilled_texts(const RobotInitArguments& arguments, const Files& files,
                                            const lang::RobotDraft& with_entries) {
  std::vector<lang::TaskTexts> texts{fitted(*arguments.task, lang::base_fit(with_entries), files)};
  lang::Diagnostics unheard;
  if (const auto draft = drafted(arguments, files.robot.string(), {}, unheard))
    texts.push_back(fitted(*arguments.task, lang::base_fit(*draft), files));
  return texts;
}

/// `unfilled`: none of a new robot file.
void add_task(const std::string& task, const lang::BaseFit& fit, const Files& files,
              const std::vector<lang::TaskTexts>& unfilled, Written& written) {
  const auto add = [&](const fs::path& file, std::string lang::TaskTexts::*part, const std::string& text) {
    if (!fs::exists(file)) return written.add(file.string(), text, "written");
    const std::string old_text = text_of(file);
    const bool is_as_written = std::any_of(unfilled.begin(), unfilled.end(),
                                           [&](const auto& texts) { return texts.*part == old_text; });
    if (is_as_written && old_text != text)
      return written.add(file.string(), text, "fitted to what you filled in; nobody had changed it");
    written.report +=
        file.string() + ": is there already, and kept" + (old_text == text ? "; it fits\n" : "\n");
  };
  const lang::TaskTexts texts = fitted(task, fit, files);
  add(files.task, &lang::TaskTexts::task, texts.task);
  add(files.scene, &lang::TaskTexts::scene, texts.scene);
}

/// The folder that a robot file reads from: the nearest above it with a `.zwang-root`, else its own.
fs::path root_for(const fs::path& robot_file) {
  const fs::path own = fs::absolute(robot_file).lexically_normal().parent_path();
  std::error_code error;
  for (fs::path folder = own;; folder = folder.parent_path()) {
    if (fs::exists(folder / ".zwang-root", error)) return folder;
    if (folder == folder.root_path()) return own;
  }
}

bool is_below(const fs::path& file, const fs::path& folder) {
  const fs::path way = fs::absolute(file).lexically_normal().lexically_relative(folder);
  return !way.empty() && *way.begin() != "..";
}

/// A robot file reads no URDF outside of its root (E109): what to do first.
std::string how_to_reach(const fs::path& robot_file, const std::string& urdf) {
  const fs::path root = root_for(robot_file);
  if (is_below(urdf, root)) return "";
  fs::path common = root;
  while (!is_below(urdf, common)) common = common.parent_path();
  if (common == common.root_path())
    return "  copy the URDF beside " + robot_file.string() + " and name it there: it may not read " + urdf +
           "\n";
  const std::string way = common.lexically_proximate(fs::current_path()).generic_string();
  return "  touch " + (way == "." ? "" : way + "/") +
         ".zwang-root    the robot file may read files below that folder then, as the URDF\n";
}

/// `fit`: the command that fits the task again once the robot file is filled in; empty: no place is open.
std::string what_next(bool has_task, const Files& files, const std::string& urdf, const std::string& fit) {
  const std::string file = (has_task ? files.task : files.robot).string();
  return "\nthen\n" + how_to_reach(files.robot, urdf) +
         (has_task && !fit.empty() ? "  " + fit + "    fits the task to what you filled in\n" : "") +
         "  zwang validate " + file + "\n" + (has_task ? "  zwang run " + file + "\n" : "");
}

/// Empty where no place of the robot file is open.
std::string how_to_fit(const RobotInitArguments& arguments, const Files& files, const std::string& text) {
  if (!arguments.task || lang::open_places(text).to_fill_in.empty()) return "";
  return "zwang robot init " + arguments.urdf + " --update " + files.robot.string() + " --task " +
         *arguments.task;
}

std::string listed(const std::string& title, const std::vector<lang::UpdateNote>& notes) {
  std::vector<lang::OpenPlace> places;
  for (const lang::UpdateNote& note : notes) places.push_back({note.line, note.text, ""});
  return listed(title, places);
}

int write_new(const RobotInitArguments& arguments) {
  lang::Diagnostics diagnostics;
  const auto draft = drafted(arguments, arguments.out.value_or("robot.yaml"), {}, diagnostics);
  if (!draft) return refused(diagnostics);
  require_wheels(arguments.urdf, *draft);
  const Files files(arguments.out.value_or(file_named_after(draft->name)), arguments.task.value_or(""));
  require_free(files.robot, "`--update " + files.robot.string() + "` keeps what you filled in");
  if (arguments.task) require_free(files.task, "remove it, or name another robot file");
  if (arguments.task) require_free(files.scene, "remove it, or name another robot file");
  const lang::BaseFit fit = lang::base_fit(*draft);
  const std::string why_not = arguments.task ? why_no_task(*arguments.task, fit, *draft) : "";
  const bool has_task = arguments.task && why_not.empty();
  Written written;
  written.add(files.robot.string(), draft->text, "written");
  if (has_task) add_task(*arguments.task, fit, files, {}, written);
  written.write();
  print(written.report + "\n" + to_decide(files.robot.string(), draft->text) +
        titled_list("not in the URDF", draft->missing) +
        what_next(has_task, files, arguments.urdf, how_to_fit(arguments, files, draft->text)));
  if (!why_not.empty()) refuse_task(*arguments.task, fit, *draft, why_not);
  return exit_good;
}

/// The robot as it is filled in; nullopt where something is still open, which `validate` tells.
std::optional<lang::Robot> filled_robot(const fs::path& robot_file) {
  lang::Diagnostics unheard;
  return lang::load_robot(robot_file, unheard);
}

/// x of the back of a robot that is filled in. [m]
std::optional<double> back_of(const std::optional<lang::Robot>& robot) {
  if (!robot || robot->footprint.empty()) return std::nullopt;
  double back = 0.0;
  for (const auto& corner : robot->footprint) back = std::min(back, corner.x());
  return back;
}

int update(const RobotInitArguments& arguments, const Files& files) {
  require_file(files.robot.string());
  lang::Diagnostics diagnostics;
  auto options = lang::options_of(files.robot, diagnostics);
  if (!options) return refused(diagnostics);
  const std::optional<lang::Robot> robot = filled_robot(files.robot);
  options->back = back_of(robot);
  const auto draft = drafted(arguments, files.robot.string(), *options, diagnostics);
  if (!draft) return refused(diagnostics);
  const auto changed = lang::update_robot_file(files.robot, arguments.urdf, *draft, diagnostics);
  if (!changed) return refused(diagnostics);
  Written written;
  if (changed->text == text_of(files.robot)) {
    written.report = files.robot.string() + ": nothing to add\n";
  } else {
    written.add(files.robot.string(), changed->text, "updated; every line of it was kept");
  }
  const lang::BaseFit fit = robot ? lang::base_fit(*robot) : lang::base_fit(*draft);
  std::string why_not;
  if (arguments.task)
    why_not = robot ? lang::why_unfit(*arguments.task, fit) : why_no_task(*arguments.task, fit, *draft);
  const bool has_task = arguments.task && why_not.empty();
  if (has_task) add_task(*arguments.task, fit, files, unfilled_texts(arguments, files, *draft), written);
  written.write();
  print(written.report + "\n" + listed("added, in " + files.robot.string(), changed->added) +
        listed("the URDF has no such joint or link any more: remove it", changed->vanished) +
        listed("kept, and the URDF says otherwise", changed->differ) +
        listed("to fill in", lang::open_places(changed->text).to_fill_in) +
        what_next(has_task, files, arguments.urdf, how_to_fit(arguments, files, changed->text)));
  if (!why_not.empty()) refuse_task(*arguments.task, fit, *draft, why_not);
  return exit_good;
}

}  // namespace

int robot_init(const RobotInitArguments& arguments) {
  require_file(arguments.urdf);
  if (arguments.task) require_task(*arguments.task);
  if (arguments.update) return update(arguments, Files(*arguments.update, arguments.task.value_or("")));
  if (arguments.out || arguments.task) return write_new(arguments);
  lang::Diagnostics diagnostics;
  const auto draft = drafted(arguments, std::nullopt, {}, diagnostics);
  if (!draft) return refused(diagnostics);
  require_wheels(arguments.urdf, *draft);
  print_data(draft->text);
  return exit_good;
}

}  // namespace zwang::cli
