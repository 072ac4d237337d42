// A first robot file from a URDF, or the same again for one that is there; and a task with its scene beside
// it.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "output.hpp"
#include "shipped.hpp"
#include "verbs.hpp"
#include "zwang/lang/nearest.hpp"
#include "zwang/lang/open_places.hpp"
#include "zwang/lang/robot_draft.hpp"
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

/// The task and its scene, as texts. Throws Impossible where this base cannot do the task.
lang::TaskTexts fitted(const std::string& task, const lang::BaseFit& fit, const Files& files) {
  const std::string why = lang::why_unfit(task, fit);
  if (!why.empty())
    throw Impossible("--task " + task + ": not for `" + fit.robot + "`: " + why +
                     ". `--task feel_wall` is for every base. Nothing was written");
  const std::optional<fs::path> shipped = shipped_folder();
  if (!shipped)
    throw Impossible(
        "the shipped files are not beside this program: install it, or run it from its checkout");
  const std::string variant = lang::shipped_variant(task, fit) + ".yaml";
  const lang::TaskTexts texts{text_of(*shipped / variant), text_of(*shipped / "scenes/corridor.yaml")};
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

std::string listed(const std::string& title, const std::vector<std::string>& lines) {
  std::string text = lines.empty() ? "" : title + "\n";
  for (const std::string& line : lines) text += "  " + line + "\n";
  return text;
}

std::string to_decide(const std::string& file, const std::string& text) {
  const lang::OpenPlaces places = lang::open_places(text);
  return listed("to fill in, in " + file, places.to_fill_in) + listed("proposed, to check", places.to_check);
}

int refused(const lang::Diagnostics& diagnostics) {
  std::ostringstream text;
  lang::render_human(diagnostics, text);
  print_data(text.str());
  return exit_bad;
}

void require_wheels(const std::string& urdf, const lang::RobotDraft& draft) {
  if (!draft.wheels.empty()) return;
  std::string reason = ": no wheels found: a robot file needs some";
  if (!draft.wheels_that_stand.empty())
    reason += "; `" + draft.wheels_that_stand.front() + "` is `fixed`, a wheel's joint is `continuous`";
  throw Impossible(urdf + reason);
}

std::optional<lang::RobotDraft> drafted(const RobotInitArguments& arguments,
                                        const std::optional<std::string>& file,
                                        lang::Diagnostics& diagnostics) {
  fs::path named = fs::path(arguments.urdf).filename();
  if (file) named = fs::absolute(arguments.urdf).lexically_relative(fs::absolute(*file).parent_path());
  const bool with_hook = arguments.task == "docking";
  return lang::draft_robot(arguments.urdf, named.generic_string(), diagnostics, with_hook);
}

void require_free(const fs::path& file, const std::string& way_out) {
  if (fs::exists(file))
    throw Impossible(file.string() + ": is there already; " + way_out + ". Nothing was written");
}

}  // namespace

int robot_init(const RobotInitArguments& arguments) {
  require_file(arguments.urdf);
  if (arguments.task) require_task(*arguments.task);
  if (arguments.task && !arguments.out) throw Impossible("--task: name the robot file, too, with -o FILE");
  std::optional<Files> files;
  if (arguments.out) {
    files.emplace(*arguments.out, arguments.task.value_or(""));
    require_free(files->robot, "`--update " + *arguments.out + "` keeps what you filled in");
    if (arguments.task) require_free(files->task, "remove it, or name another robot file");
    if (arguments.task) require_free(files->scene, "remove it, or name another robot file");
  }
  lang::Diagnostics diagnostics;
  const auto draft = drafted(arguments, arguments.out, diagnostics);
  if (!draft) return refused(diagnostics);
  require_wheels(arguments.urdf, *draft);
  if (!arguments.out) {
    print_data(draft->text);
    return exit_good;
  }
  std::string report = *arguments.out + ": written\n";
  if (arguments.task) {
    const lang::TaskTexts texts = fitted(*arguments.task, lang::base_fit(*draft), *files);
    write_file(files->task.string(), texts.task);
    write_file(files->scene.string(), texts.scene);
    report += files->task.string() + ": written\n" + files->scene.string() + ": written\n";
  }
  write_file(*arguments.out, draft->text);
  report += "\n" + to_decide(*arguments.out, draft->text) + listed("not in the URDF", draft->missing) +
            "\nthen\n  ";
  report += arguments.task
                ? "zwang validate " + files->task.string() + "\n  zwang run " + files->task.string() + "\n"
                : "zwang validate " + *arguments.out + "\n";
  print(report);
  return exit_good;
}

}  // namespace zwang::cli
