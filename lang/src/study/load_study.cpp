#include <algorithm>
#include <cctype>
#include <cmath>

#include "check/check.hpp"
#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_physics.hpp"
#include "diagnostic/wordings_scenario.hpp"
#include "diagnostic/wordings_study.hpp"
#include "load_within.hpp"
#include "scene/check_scene.hpp"
#include "scene/check_start.hpp"
#include "study/drawable.hpp"
#include "study/study_file.hpp"
#include "tree/file.hpp"
#include "words/nearest.hpp"

namespace zwang::lang {

namespace {

namespace fs = std::filesystem;

bool is_name(const std::string& draw) {
  return draw == "robot" || draw == "scene" || draw == "faults";
}

std::optional<Document> document_at(const fs::path& path, const Span& cause, Diagnostics& diagnostics) {
  const std::optional<int> source = read_file(path, yaml_size_limit, cause, diagnostics);
  return source ? read(*source, diagnostics) : std::nullopt;
}

/// The task of the cell, with all that is drawn before it is read.
std::optional<Program> read_task(const StudyCell& cell, Diagnostics& of_task) {
  double budget = whole_budget;
  const ScenarioCell& chosen = cell.cell();
  return load_within(budget, cell.scenario.task, options_of(chosen), start_of(chosen), of_task);
}

/// The run of a task that was read: with all that is drawn behind that. nullopt where a value cannot be.
std::optional<ScenarioRun> with_draws(const Study& study, StudyCell& cell, std::optional<Program> program,
                                      Diagnostics& of_study, Diagnostics& of_task) {
  of_study = *study.read;
  ScenarioCell& chosen = cell.scenario.cells.front();
  ScenarioRun run;
  run.program = std::move(program);
  if (run.program) {
    for (Task& task : run.program->tasks) {
      if (cell.scenario.blend) task.blend = {.constant = *cell.scenario.blend};
    }
    for (std::size_t i = 0; i < study.draws.size(); ++i) {
      const Draw& draw = study.draws[i];
      if (auto bad = put_after(draw, cell.drawn[i], *run.program, chosen))
        of_study.add(wording::bad_draw(draw.span, bad->why, bad->help));
    }
    check_faults(chosen, *run.program, of_study);
    if (run.program->scene) check_faults_for(run.program->scene->faults, run.program->robot, of_study);
    if (of_study.has_errors()) return std::nullopt;
    if (run.program->scene) check_start(*run.program->scene, run.program->robot, of_task);
    if (of_task.has_errors()) run.program.reset();
  }
  if (!run.program) {
    run.expectations = expectations_of_words(*study.file);
    return run;
  }
  auto expectations = check_expectations(*study.file, *run.program, of_study);
  if (!expectations) return std::nullopt;
  run.expectations = std::move(*expectations);
  return run;
}

/// Whether the task is read with the value.
bool is_read_with(const Draw& draw) {
  const std::optional<Drawable> drawable = drawable_named(draw.name);
  return drawable->part == DrawnPart::parameter || drawable->part == DrawnPart::start;
}

/// Reads a study step by step; each of them may end it.
class StudyReader {
 public:
  StudyReader(const fs::path& path, Diagnostics& diagnostics) : path_(path), diagnostics_(diagnostics) {}

  std::optional<Study> read_all() {
    if (!read_files() || !multiply() || !load_first() || !read_draws()) return std::nullopt;
    read_claims();
    study_.read = std::make_shared<const Diagnostics>(diagnostics_);
    if (check_matrix()) check_draws();
    if (diagnostics_.has_errors()) return std::nullopt;
    return study_;
  }

 private:
  bool read_files() {
    const std::optional<Document> document = document_at(path_, {}, diagnostics_);
    if (!document) return false;
    std::optional<StudyFile> text = parse_study_file(*document, diagnostics_);
    if (!text || diagnostics_.has_errors()) return false;
    text_ = std::move(*text);
    study_.path = path_.string();
    study_.runs = text_.runs;
    study_.sequence = text_.sequence;
    scenario_path_ = path_;
    if (!text_.scenario.exists()) {
      file_ = text_.own;
    } else if (!read_scenario_of_study()) {
      return false;
    }
    study_.about = file_.about;
    return true;
  }

  bool read_scenario_of_study() {
    const auto named =
        resolve_path(text_.scenario.text, path_, root_of(path_), text_.scenario.span, diagnostics_);
    if (!named) return false;
    scenario_path_ = *named;
    const std::optional<Document> document = document_at(*named, text_.scenario.span, diagnostics_);
    if (!document) return false;
    std::optional<ScenarioFile> file = parse_scenario_file(*document, diagnostics_);
    if (!file || diagnostics_.has_errors()) return false;
    file_ = std::move(*file);
    if (!text_.own.about.empty()) file_.about = text_.own.about;
    if (text_.has_seed) file_.seed = text_.own.seed;
    if (text_.has_time_limit) file_.time_limit = text_.own.time_limit;
    if (!text_.own.expectations.empty()) file_.expectations = text_.own.expectations;
    return true;
  }

  /// Of the cells of the matrix the one that is named, or all: with what is drawn by name.
  bool multiply() {
    for (const DrawText& draw : text_.draws) {
      if (!is_name(draw.name.text)) continue;
      auto key = matrix_key_of(draw, path_.parent_path(), scenario_path_.parent_path(), diagnostics_);
      if (!key || complain_of_fixed(draw)) return false;
      std::erase_if(file_.matrix, [&](const MatrixKey& other) { return other.name == key->name; });
      file_.matrix.push_back(std::move(*key));
    }
    auto scenario = scenario_with_parameters(file_, scenario_path_, diagnostics_);
    if (!scenario) return false;
    study_.scenario = std::move(*scenario);
    study_.file = std::make_shared<const ScenarioFile>(file_);
    if (!text_.cell.exists()) return true;
    std::vector<std::string> names;
    for (const ScenarioCell& cell : study_.scenario.cells) names.push_back(cell.name);
    std::erase_if(study_.scenario.cells, [&](const ScenarioCell& c) { return c.name != text_.cell.text; });
    if (!study_.scenario.cells.empty()) return true;
    diagnostics_.add(wording::unknown_name(text_.cell.span, "cell", text_.cell.text, names));
    return false;
  }

  /// A study that says a value itself does not draw it, too.
  bool complain_of_fixed(const DrawText& draw) {
    for (const auto* keys : {&text_.own.fixed, &text_.own.matrix}) {
      for (const MatrixKey& key : *keys) {
        if (key.name != draw.name.text) continue;
        diagnostics_.add(wording::duplicate_key(draw.name.span, key.name, key.span));
        return true;
      }
    }
    return false;
  }

  /// The first cell whose task is not refused tells what can be drawn.
  bool load_first() {
    for (const ScenarioCell& cell : study_.scenario.cells) {
      Diagnostics of_task;
      first_ = load_within(budget_, study_.scenario.task, options_of(cell), start_of(cell), of_task);
      if (!first_) {
        complain_of_refusal(cell, task_span(), of_task);
        if (diagnostics_.has_errors()) return false;
        continue;
      }
      if (first_->scene) study_.start_at = first_->scene->start_at;
      check_faults(cell, *first_, diagnostics_);
      return check_expectations(file_, *first_, diagnostics_).has_value();
    }
    diagnostics_.add(wording::bad_draw(task_span(),
                                       "each cell is refused, as expected: nothing is left to be drawn",
                                       "write a scenario, or draw a robot or a scene that is not refused"));
    return false;
  }

  Span task_span() const { return text_.scenario.exists() ? text_.scenario.span : file_.task.span; }

  /// `cause`: where the study says what is refused, unless it chose a file.
  void complain_of_refusal(const ScenarioCell& cell, const Span& cause, const Diagnostics& of_task) {
    const auto d = of_task.first_error();
    if (!d) return;
    std::vector<std::string> codes;
    for (const Diagnostic& other : of_task.all()) {
      if (other.severity == Severity::error) codes.push_back(other.code);
    }
    if (expects_refusal(file_, codes)) return;
    const std::string place = d->span.exists() ? of_task.source(d->span.source).path : std::string();
    Span chosen;
    for (const fs::path& file : {fs::path(place), cell.robot.value_or(""), cell.scene.value_or("")}) {
      if (!chosen.exists()) chosen = choice_of(file);
    }
    diagnostics_.add(wording::refused_draw({chosen.exists() ? chosen : cause}, cell.name, d->code, d->message,
                                           place + ":" + std::to_string(d->span.begin.line)));
  }

  /// Where the study chooses the file; nowhere: it does not.
  Span choice_of(const fs::path& file) const {
    std::error_code error;
    for (const DrawText& draw : text_.draws) {
      if (!is_name(draw.name.text)) continue;
      for (const Node& item : draw.numbers.items) {
        if (fs::equivalent(path_.parent_path() / item.text, file, error)) return item.span;
      }
    }
    return {};
  }

  bool read_draws() {
    for (const DrawText& text : text_.draws) {
      if (is_name(text.name.text)) continue;
      const std::optional<Drawable> drawable = find_drawable(text.name.text, file_, *first_);
      if (!drawable) {
        const std::vector<std::string> known = drawable_names(file_, *first_);
        diagnostics_.add(wording::unknown_draw(text.name.span, text.name.text,
                                               missing_number(text.name.text, *first_),
                                               nearest(text.name.text, known), known));
        continue;
      }
      if (complain_of_factor(text, *drawable) || complain_of_fixed(text) || complain_of_case(text) ||
          complain_of_onset(text, *drawable))
        continue;
      const Dimension measures = text.is_factor ? dimension::none : drawable->dimension;
      auto distribution = distribution_of(text, measures, diagnostics_);
      if (!distribution) continue;
      study_.draws.push_back(
          {text.name.text, std::move(*distribution), text.is_factor, usual_unit(measures), text.name.span});
    }
    return !diagnostics_.has_errors();
  }

  bool complain_of_factor(const DrawText& text, const Drawable& drawable) {
    const std::string name = "`" + text.name.text + "`";
    if (drawable.is_factor_only && !text.is_factor) {
      diagnostics_.add(wording::bad_draw(text.name.span, name + " is a factor on what the model says",
                                         "add `times: true`, and give plain numbers around 1"));
      return true;
    }
    if (text.is_factor && !drawable.can_be_factor) {
      diagnostics_.add(wording::bad_draw(text.factor_span, name + " has nothing that could be multiplied",
                                         "delete `times`, and give values with their unit"));
      return true;
    }
    return false;
  }

  /// A draw is a column of the results: SQL takes names that differ in case for one.
  bool complain_of_case(const DrawText& text) {
    const auto is_same = [](char a, char b) { return std::tolower(a) == std::tolower(b); };
    for (const Draw& other : study_.draws) {
      if (!std::ranges::equal(other.name, text.name.text, is_same)) continue;
      diagnostics_.add(wording::bad_draw(
          text.name.span, "`" + text.name.text + "` and `" + other.name + "` differ in their case alone",
          "rename one of them: both would be the same column of the results"));
      return true;
    }
    return false;
  }

  bool complain_of_onset(const DrawText& text, const Drawable& drawable) {
    const auto has_set = [&](const ScenarioCell& cell) { return cell.fault_set == drawable.owner; };
    if (drawable.part != DrawnPart::onset || std::ranges::any_of(study_.scenario.cells, has_set))
      return false;
    diagnostics_.add(wording::bad_draw(text.name.span, "no cell has the faults `" + drawable.owner + "`",
                                       "draw them, too: `faults: {choice: [none, " + drawable.owner + "]}`"));
    return true;
  }

  void read_claims() {
    std::size_t most_needed = 0;
    const Claim* most_demanding = nullptr;
    study_.claims.reserve(file_.expectations.size());
    for (const ExpectationText& text : file_.expectations) {
      Claim claim;
      claim.text = text_of(text);
      claim.span = text.span;
      claim.probability = text.probability ? text.probability : text_.probability;
      if (text.confidence || text_.confidence) claim.confidence = text.confidence.value_or(*text_.confidence);
      study_.claims.push_back(claim);
      if (!claim.probability) continue;
      const std::size_t needed = clean_runs_for(*claim.probability, claim.confidence);
      if (needed <= most_needed) continue;
      most_needed = needed;
      most_demanding = &study_.claims.back();
    }
    if (most_needed <= study_.runs) return;
    diagnostics_.add(wording::too_few_runs(text_.runs_text.span, percent(*most_demanding->probability),
                                           percent(most_demanding->confidence), study_.runs, most_needed));
  }

  static std::string percent(double share) { return format_number(std::round(share * 1e8) / 1e6) + " %"; }

  /// A task that was read, and the cell that says with which files, parameters and start.
  struct Reading {
    ScenarioCell of;
    Diagnostics of_task;
    std::optional<Program> program;

    bool is_that_of(const ScenarioCell& cell) const {
      return of.robot == cell.robot && of.scene == cell.scene && of.parameters == cell.parameters &&
             of.start_at == cell.start_at && of.start_yaw == cell.start_yaw;
    }
  };

  Reading read_with(const std::vector<double>& shares) const {
    const StudyCell cell = draw_cell(study_, shares);
    Reading reading{cell.cell(), {}, std::nullopt};
    reading.program = read_task(cell, reading.of_task);
    return reading;
  }

  /// Each cell of the matrix in the middle of all draws. False where none is left in which draws have an
  /// effect.
  bool check_matrix() {
    const std::size_t cells = study_.scenario.cells.size();
    std::optional<Reading> last;
    for (std::size_t i = 0; i < cells; ++i) {
      std::vector<double> shares(study_.draws.size() + 1, 0.5);
      shares.back() = (static_cast<double>(i) + 0.5) / static_cast<double>(cells);
      if (!last || !last->is_that_of(draw_cell(study_, shares).cell())) last = read_with(shares);
      if (!check_cell(shares, *last, task_span()) || middle_) continue;
      middle_ = *last;
      middle_shares_ = shares;
    }
    return middle_ && !diagnostics_.has_errors();
  }

  /// Each draw for itself, the others in the middle, in the first cell of the matrix that is not refused.
  void check_draws() {
    for (std::size_t i = 0; i < study_.draws.size(); ++i) {
      const Draw& draw = study_.draws[i];
      for (const double share : looked_at(i)) {
        std::vector<double> shares = middle_shares_;
        shares[i] = share;
        // Most draws change what is read already: reading it again costs as much as a second of a run.
        if (!check_cell(shares, is_read_with(draw) ? read_with(shares) : *middle_, draw.span)) break;
      }
    }
  }

  /// Each choice, both ends of a range, and the ends of what the cells draw of a normal distribution. That
  /// has no ends itself. A hundred thousand cells are drawn in some 10 ms.
  std::vector<double> looked_at(std::size_t draw) const {
    const Distribution& distribution = study_.draws[draw].distribution;
    std::vector<double> shares;
    for (std::size_t i = 0; i < distribution.values.size(); ++i)
      shares.push_back((static_cast<double>(i) + 0.5) / static_cast<double>(distribution.values.size()));
    if (distribution.spread == Spread::choice) return shares;
    if (distribution.spread != Spread::normal) return {0.0, 1.0 - 0x1p-53};
    constexpr std::size_t most_looked_at = 100'000;
    for (std::size_t cell = 0; cell < std::min(study_.runs, most_looked_at); ++cell)
      shares.push_back(drawn_share(study_.sequence, study_.scenario.seed, cell, draw));
    const auto [least, most] = std::ranges::minmax(shares);
    return {least, most};
  }

  /// Whether it can run.
  bool check_cell(const std::vector<double>& shares, Reading reading, const Span& cause) {
    StudyCell cell = draw_cell(study_, shares);
    Diagnostics of_study;
    const auto run = with_draws(study_, cell, std::move(reading.program), of_study, reading.of_task);
    if (!run) {
      // A value that cannot be has its place: the draw. An error of the cell itself is told where it began.
      const auto d = of_study.first_error();
      const bool has_place = d && d->code == "E931" && d->span.exists();
      diagnostics_.add(wording::bad_draw(has_place ? d->span : cause, d ? d->message : "this cannot be drawn",
                                         d ? d->help : ""));
      return false;
    }
    if (!run->program) complain_of_refusal(cell.cell(), cause, reading.of_task);
    return run->program.has_value();
  }

  const fs::path path_;
  Diagnostics& diagnostics_;
  StudyFile text_;
  ScenarioFile file_;
  fs::path scenario_path_;
  double budget_ = whole_budget;
  std::optional<Program> first_;
  Study study_;
  std::optional<Reading> middle_;      ///< of the first cell of the matrix that can run
  std::vector<double> middle_shares_;  ///< of that cell
};

std::string words_of(const Study& study, const StudyCell& cell) {
  std::string words = cell.cell().name == "as written" ? "" : cell.cell().name;
  for (std::size_t i = 0; i < study.draws.size(); ++i) {
    const Draw& draw = study.draws[i];
    words += (words.empty() ? "" : ", ") + draw.name + " " + wording::figure(cell.drawn[i], draw.unit);
  }
  return words.empty() ? "as written" : words;
}

}  // namespace

std::optional<Study> load_study(const fs::path& path, Diagnostics& diagnostics) {
  std::optional<Study> study = StudyReader(path, diagnostics).read_all();
  diagnostics.settle();
  if (diagnostics.has_errors()) return std::nullopt;
  return study;
}

StudyCell draw_cell(const Study& study, const std::vector<double>& shares) {
  StudyCell drawn;
  const std::size_t count = study.scenario.cells.size();
  const double place = std::floor(shares.back() * static_cast<double>(count));
  drawn.matrix_cell = std::min(count - 1, static_cast<std::size_t>(place));
  drawn.scenario.path = study.scenario.path;
  drawn.scenario.about = study.scenario.about;
  drawn.scenario.task = study.scenario.task;
  drawn.scenario.time_limit = study.scenario.time_limit;
  drawn.scenario.seed = study.scenario.seed;
  drawn.scenario.blend = study.scenario.blend;
  drawn.scenario.cells = {study.scenario.cells[drawn.matrix_cell]};
  ScenarioCell& cell = drawn.scenario.cells.front();
  for (std::size_t i = 0; i < study.draws.size(); ++i) {
    drawn.drawn.push_back(study.draws[i].distribution.quantile(shares[i]));
    put_before(study.draws[i], drawn.drawn.back(), study.start_at, cell);
  }
  cell.name = words_of(study, drawn);
  return drawn;
}

StudyCell draw_cell(const Study& study, std::size_t index) {
  std::vector<double> shares;
  for (std::size_t i = 0; i <= study.draws.size(); ++i)
    shares.push_back(drawn_share(study.sequence, study.scenario.seed, index, i));
  StudyCell drawn = draw_cell(study, shares);
  drawn.scenario.seed = seed_of_cell(study.scenario.seed, index);
  return drawn;
}

std::optional<ScenarioRun> load_run(const Study& study, StudyCell& cell, Diagnostics& of_study,
                                    Diagnostics& of_task) {
  return with_draws(study, cell, read_task(cell, of_task), of_study, of_task);
}

}  // namespace zwang::lang
