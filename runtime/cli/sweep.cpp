#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <sstream>
#include <thread>
#include <utility>
#include <vector>

#include "colour.hpp"
#include "commit.hpp"
#include "file_kind.hpp"
#include "interruption.hpp"
#include "output.hpp"
#include "report_page.hpp"
#include "scenario_choice.hpp"
#include "shipped.hpp"
#include "study/ranks.hpp"
#include "study/result_store.hpp"
#include "study/sole_writer.hpp"
#include "study/study_report.hpp"
#include "study/workers.hpp"
#include "sweep_page.hpp"
#include "verbs.hpp"
#include "zwang/version.hpp"

namespace zwang::cli {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// Every `of`-th cell, from `first` on.
struct Shard {
  std::size_t first = 0, of = 1;
};

Shard shard_of(const std::optional<std::string>& text) {
  if (!text) return {};
  std::istringstream in(*text);
  std::size_t number = 0, of = 0;
  char slash = 0;
  const bool is_read = text->find('-') == std::string::npos &&  // a stream makes 2^64 - 1 of -1
                       static_cast<bool>(in >> number >> slash >> of) && in.peek() == EOF && slash == '/';
  if (!is_read || number < 1 || number > of)
    throw Impossible("--shard " + *text + ": write the number of the part and how many there are, as 3/64");
  return {number - 1, of};
}

/// FNV-1a, of 64 bits: it tells files apart, but is no protection against forgery.
class Fingerprint {
 public:
  void add(std::string_view text) {
    for (const char c : text) hash_ = (hash_ ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
    hash_ = (hash_ ^ 0x100U) * 0x100000001b3U;
  }
  std::string text() const {
    std::ostringstream out;
    out << std::hex << hash_;
    return out.str();
  }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325U;
};

/// The fingerprint of the program and of all texts that cells read: with each robot and each scene.
std::string fingerprint_of(const lang::Study& study) {
  Fingerprint print;
  print.add(ZWANG_VERSION);
  print.add(commit);
  const auto add = [&](const lang::Diagnostics& read) {
    for (const lang::Source& source : read.sources()) print.add(source.text);
  };
  add(*study.read);
  std::set<std::pair<fs::path, fs::path>> known;
  const std::vector<lang::ScenarioCell>& cells = study.scenario.cells;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (!known.emplace(cells[i].robot.value_or(""), cells[i].scene.value_or("")).second) continue;
    std::vector<double> middle(study.draws.size() + 1, 0.5);
    middle.back() = (static_cast<double>(i) + 0.5) / static_cast<double>(cells.size());
    lang::Diagnostics of_study, of_task;
    lang::StudyCell cell = lang::draw_cell(study, middle);
    static_cast<void>(lang::load_run(study, cell, of_study, of_task));
    add(of_task);
  }
  return print.text();
}

std::string duration_text(double seconds) {
  const auto whole = static_cast<long>(seconds);
  if (whole < 100) return std::to_string(whole) + " s";
  return whole < 6000 ? std::to_string(whole / 60) + " min" : std::to_string(whole / 3600) + " h";
}

/// One line, mostly written over itself: cells done, their rate, the time left, how many hold, and the
/// expectation that most miss.
class SweepProgress {
 public:
  /// `before`: the cells that an earlier run has done. In a job each line stays: mpirun gives rank 0 a
  /// terminal of its own, wherever its own output goes.
  SweepProgress(const lang::Study& study, const std::vector<study::CellRecord>& before, std::size_t wanted,
                bool shown, bool in_a_job)
      : study_(study),
        wanted_(wanted),
        misses_(study.claims.size(), 0),
        shown_(shown && (in_a_job || stdout_can_be_written_over())),
        is_written_over_(!in_a_job) {
    for (const study::CellRecord& record : before) count(record);
    before_ = done_;
  }
  void count(const study::CellRecord& record) {
    ++done_;
    missed_ += record.holds() ? 0U : 1U;
    for (std::size_t i = 0; i < misses_.size(); ++i) misses_[i] += record.expectations[i].held ? 0U : 1U;
  }
  void show() {
    const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
    if (!shown_ || seconds < next_) return;
    next_ = seconds + (is_written_over_ ? 0.5 : 10.0);
    const double rate = static_cast<double>(done_ - before_) / seconds;
    std::ostringstream line;
    line.precision(3);
    line << done_ << " of " << wanted_ << " cells, " << rate << " a second";
    if (done_ > before_)
      line << ", " << duration_text(static_cast<double>(wanted_ - done_) / rate) << " left";
    line << ", " << done_ - missed_ << " of " << done_ << " hold";
    const auto worst = std::ranges::max_element(misses_);
    if (missed_ > 0 && worst != misses_.end())
      line << "; " << *worst << " miss "
           << study_.claims[static_cast<std::size_t>(worst - misses_.begin())].text;
    if (is_written_over_) {
      print_over(line.str());
    } else {
      print(line.str() + "\n");
    }
  }
  void end() const {
    if (shown_ && is_written_over_) print_over("");
  }

 private:
  const lang::Study& study_;
  std::size_t before_ = 0, wanted_, done_ = 0, missed_ = 0;
  std::vector<std::size_t> misses_;  ///< by expectation
  bool shown_, is_written_over_;
  Clock::time_point begin_ = Clock::now();
  double next_ = 0.5;
};

/// The lines of a study's report that begin with a verdict.
std::string with_marked_verdicts(const std::string& report) {
  constexpr std::size_t indent = 2;
  std::istringstream lines(report);
  std::string text;
  for (std::string line; std::getline(lines, line); text += line + "\n") {
    for (const auto& [verdict, hue] :
         {std::pair{study::Verdict::held, Hue::good}, std::pair{study::Verdict::broken, Hue::bad},
          std::pair{study::Verdict::too_few_runs, Hue::warning}}) {
      const std::string word = study::to_string(verdict);
      if (line.starts_with("  " + word + " ")) line.replace(indent, word.size(), marked(hue, word));
    }
  }
  return text;
}

std::string results_path(const SweepArguments& arguments, const Shard& shard) {
  if (arguments.out) return *arguments.out;
  const std::string stem = fs::path(arguments.study).stem().string();
  const std::string part =
      shard.of == 1 ? "" : "." + std::to_string(shard.first + 1) + "-of-" + std::to_string(shard.of);
  return stem + part + ".db";
}

std::string page_path(const std::string& results) {
  return fs::path(results).replace_extension(".html").string();
}

/// Files that are written when all cells have run: a folder that is missing is told before, and a file that
/// would be lost.
void require_places(const SweepArguments& arguments, const std::string& results) {
  if (arguments.report && page_path(results) == results)
    throw Impossible(results + ": the page has this name; name another file with --out");
  if (!arguments.junit) return;
  require_place_of_result(*arguments.junit);
  const auto place = [](const std::string& file) { return fs::weakly_canonical(fs::absolute(file)); };
  for (const std::string& kept : {results, page_path(results), arguments.study}) {
    if (place(*arguments.junit) == place(kept))
      throw Impossible(kept + ": --junit would be written over it; name another file");
  }
}

/// The files that `--merge` reads exist, and `--fresh` does not delete them.
void require_others(const SweepArguments& arguments, const std::string& path) {
  for (const std::string& merged : arguments.merged) {
    if (!fs::is_regular_file(merged)) throw Impossible(merged + ": no such file");
    std::error_code absent;
    if (arguments.fresh && fs::equivalent(merged, path, absent))
      throw Impossible(merged + ": --fresh deletes it before --merge reads it; name another file with --out");
  }
}

/// How the cells come that are not there yet.
std::string missing_text(std::size_t missing, std::size_t wanted, bool has_merged) {
  return std::to_string(missing) + " of " + std::to_string(wanted) + " cells are missing: " +
         (has_merged ? "the same command without --merge runs them\n" : "the same command goes on\n");
}

std::vector<std::size_t> cells_to_run(std::size_t runs, const Shard& shard,
                                      const std::set<std::size_t>& known) {
  std::vector<std::size_t> cells;
  for (std::size_t cell = shard.first; cell < runs; cell += shard.of) {
    if (!known.contains(cell)) cells.push_back(cell);
  }
  return cells;
}

study::WorkSettings settings_of(const SweepArguments& arguments, bool is_in_a_job) {
  // The starter of a job sets the number of its processes.
  const std::size_t cores = is_in_a_job ? 1U : std::max(1U, std::thread::hardware_concurrency());
  return {arguments.jobs > 0 ? static_cast<std::size_t>(arguments.jobs) : cores, arguments.cell_limit};
}

study::WorkCalls calls_of(const lang::Study& study) {
  const std::atomic<bool>& interrupted = catch_interruption();
  study::keep_freed_memory();
  study::WorkCalls calls;
  calls.run = [&](std::size_t cell) { return study::run_cell(study, cell); };
  calls.fail = [&](std::size_t cell, const std::string& outcome, const std::string& because) {
    return study::unrun(study, cell, outcome, because);
  };
  calls.wants_to_stop = [&] { return interrupted.load(); };
  return calls;
}

/// Prints and writes what the cells come to, of `wanted` ones; how the program ends.
int tell_study(const SweepArguments& arguments, const lang::Study& study,
               const std::vector<study::CellRecord>& records, std::size_t wanted, const std::string& path) {
  const study::StudyReport report = study::report_of(study, wanted, records);
  const std::string command = "zwang run " + argument_of_shell(arguments.study) + " --cell ";
  if (arguments.format == Format::json) {
    print_data(study::json_report(study, report));
  } else {
    print(with_marked_verdicts(study::human_report(study, report, command)));
    print("results in " + path + "\n");
    if (report.runs < wanted) print(missing_text(wanted - report.runs, wanted, !arguments.merged.empty()));
  }
  if (arguments.report) {
    const std::string page = write_sweep_page(study, report, records, command, page_path(path));
    if (arguments.format == Format::human) print("page   " + page + "\n");
  }
  if (arguments.junit) write_file(*arguments.junit, study::junit_report(study, report));
  if (report.is_broken()) return exit_bad;
  return report.runs < wanted ? exit_impossible : exit_good;
}

/// `--runs` says how many runs there are: nothing is told of the number that the study has.
lang::Diagnostics without_number_of_runs(const lang::Diagnostics& diagnostics) {
  lang::Diagnostics others;
  for (const lang::Source& source : diagnostics.sources()) others.add_source(source);
  for (const lang::Diagnostic& d : diagnostics.all()) {
    if (d.code != "W934") others.add(d);
  }
  return others;
}

int sweep_among(const SweepArguments& arguments, study::Messages* others) {
  const Shard shard = shard_of(arguments.shard);
  const std::string path = results_path(arguments, shard);
  require_places(arguments, path);
  if (arguments.report) page_parts();  // missing ones are told before the runs, not behind them
  lang::Diagnostics diagnostics;
  const std::optional<lang::Study> study = lang::load_study(arguments.study, diagnostics);
  const bool is_first = !others || others->rank() == 0;
  if (is_first) print_error(rendered(arguments.runs ? without_number_of_runs(diagnostics) : diagnostics));
  if (!study) {
    if (others) study::end_without_study(*others);
    return exit_bad;
  }
  const std::string identity = fingerprint_of(*study);
  const study::WorkSettings settings = settings_of(arguments, others != nullptr);
  study::WorkCalls calls = calls_of(*study);
  if (!is_first) {
    study::serve_rank(settings, calls, identity, *others);
    return exit_good;
  }
  const std::size_t runs = arguments.runs.value_or(study->runs);
  require_others(arguments, path);
  study::SoleWriter writer(path);
  const study::StudyIdentity of_results = study::identity_of(*study, identity);
  if (arguments.fresh) {
    study::ResultStore::require_results_of(of_results, path);
    writer.begin_anew();
  }
  study::ResultStore store(path, of_results);
  for (const std::string& other : arguments.merged) store.merge(other);
  const std::vector<std::size_t> cells =
      arguments.merged.empty() ? cells_to_run(runs, shard, store.ended_cells()) : std::vector<std::size_t>();
  const std::size_t wanted = (runs + shard.of - 1 - shard.first) / shard.of;
  const auto kept = [&] { return store.records(runs, shard.first, shard.of); };
  std::vector<study::CellRecord> before = kept();
  std::erase_if(before,
                [&](const study::CellRecord& r) { return std::ranges::binary_search(cells, r.cell); });
  SweepProgress progress(*study, before, wanted, arguments.format == Format::human, others != nullptr);
  calls.done = [&](const study::CellRecord& record) {
    store.put(record);
    progress.count(record);
  };
  calls.wait = [&] {
    store.keep();
    progress.show();
  };
  if (others) {
    study::run_with_ranks(cells, settings, calls, identity, *others);
  } else {
    study::run_all(cells, settings, calls);
  }
  store.keep();
  progress.end();

  return tell_study(arguments, *study, kept(), wanted, path);
}

}  // namespace

int sweep(const SweepArguments& arguments) {
  require_file(arguments.study);
  const std::unique_ptr<study::Messages> others = study::messages_of_job(optional_part("zwang_mpi.so"));
  if (!others) return sweep_among(arguments, nullptr);
  ::setenv("NO_COLOR", "1", 0);  // the terminal of rank 0 is mpirun's, not the user's
  try {
    return sweep_among(arguments, others.get());
  } catch (const std::exception& error) {
    // A rank that fails ends the job at once, and main would never tell why.
    print_error("zwang: rank " + std::to_string(others->rank()) + ": " + error.what() + "\n");
    throw;
  }
}

}  // namespace zwang::cli
