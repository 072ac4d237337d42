#include <algorithm>
#include <ctime>
#include <nlohmann/json.hpp>
#include <span>
#include <sstream>

#include "output.hpp"
#include "run_log.hpp"
#include "told_events.hpp"
#include "verbs.hpp"
#include "zwang/runtime/log_reader.hpp"

namespace zwang::cli {

namespace {

using nlohmann::ordered_json;

constexpr std::size_t narrowest = 20;  // of the column of names

struct TaskBegin {
  double time = 0.0;  ///< [s]
  std::string task;
};

/// The events of a log, record by record.
class Story {
 public:
  void begin(const runtime::LogContents& head) {
    columns_ = head.columns;
    task_ = place_of(columns_, "task");
    event_ = place_of(columns_, "event");
    signal_ = place_of(columns_, "event.signal");
  }

  void take(double time, std::span<const double> values) {
    const std::string_view task = word(values, task_), event = word(values, event_);
    if (!event.empty()) events.push_back({time, std::string(event), std::string(word(values, signal_)), 0.0});
    if (!task.empty() && (tasks.empty() || tasks.back().task != task))
      tasks.push_back({time, std::string(task)});
  }

  std::vector<TaskBegin> tasks;
  std::vector<runtime::LoggedEvent> events;

 private:
  std::string_view word(std::span<const double> values, std::size_t place) const {
    return place < values.size() ? columns_[place].word(values[place]) : std::string_view{};
  }
  std::vector<runtime::LoggedColumn> columns_;
  std::size_t task_ = 0, event_ = 0, signal_ = 0;
};

ordered_json said_at_the_end(const runtime::LogContents& log, const std::string& what) {
  const auto said = log.conclusion.find(what);
  return said == log.conclusion.end() ? ordered_json(nullptr) : ordered_json(said->second);
}

ordered_json as_json(const std::string& file, const runtime::LogContents& log,
                     const std::vector<TaskBegin>& tasks, const std::vector<runtime::LoggedEvent>& events) {
  ordered_json files = ordered_json::array();
  for (const lang::Source& s : log.context.sources)
    files.push_back({{"name", s.path}, {"bytes", s.text.size()}});
  ordered_json begins = ordered_json::array();
  for (const TaskBegin& t : tasks) begins.push_back({{"time", t.time}, {"task", t.task}});
  ordered_json told = ordered_json::array();
  for (const runtime::LoggedEvent& e : events)
    told.push_back({{"time", e.time}, {"code", e.code}, {"signal", e.signal}});
  return {{"file", file},
          {"whole", log.closed && log.damage.empty()},
          {"damage", log.damage},
          {"records", log.records},
          {"begin", log.begin},
          {"end", log.end},
          {"facts", log.context.facts},
          {"outcome", said_at_the_end(log, "outcome")},
          {"verdict", said_at_the_end(log, "verdict")},
          {"files", files},
          {"tasks", begins},
          {"events", told}};
}

constexpr double last_date = 253402300800.0;  // [s] of the year 9999
constexpr double longest_run = 1e8;           // [s] three years: a clock beyond counts from 1970

/// `from 0 s to 11.05 s`. A robot's clock counts from 1970: its times are told as a date, and since the
/// begin.
std::string span_of(const runtime::LogContents& log) {
  // A damaged log may hold any number.
  const bool is_date = log.begin >= longest_run && log.begin < last_date;
  if (!is_date) return "from " + with_unit(log.begin, "s") + " to " + with_unit(log.end, "s");
  const auto seconds = static_cast<std::time_t>(log.begin);
  char date[40];
  std::strftime(date, sizeof date, "%Y-%m-%d %H:%M:%S UTC", std::gmtime(&seconds));
  return "over " + with_unit(log.end - log.begin, "s") + " from " + date + "; times since then";
}

std::string as_text(const std::string& file, const runtime::LogContents& log,
                    const std::vector<TaskBegin>& tasks, const std::vector<runtime::LoggedEvent>& events) {
  std::ostringstream out;
  const double zero = log.begin < longest_run ? 0.0 : log.begin;
  out << file << ": " << (log.closed && log.damage.empty() ? "whole" : "damaged") << ", " << log.records
      << " records " << span_of(log) << "\n";
  for (const std::string& what : log.damage) out << "  " << what << "\n";
  std::size_t width = narrowest;
  for (const auto& [name, value] : log.context.facts) width = std::max(width, name.size() + 2);
  const auto line = [&](const std::string& name) -> std::ostream& {
    return out << "  " << padded(name, width);
  };
  for (const auto& [name, value] : log.context.facts) line(name) << value << "\n";
  for (const char* name : {"verdict", "why"}) {
    const auto said = log.conclusion.find(name);
    if (said != log.conclusion.end()) line(name) << said->second << "\n";
  }
  for (const lang::Source& s : log.context.sources) {
    if (s.path == from_command_line) {
      line("command line") << s.path << " " << s.text << "\n";
    } else {
      line("file") << s.path << " (" << s.text.size() << " bytes)\n";
    }
  }
  for (const TaskBegin& t : tasks) {
    line("from " + with_unit(t.time - zero, "s")) << "task `" << t.task << "`\n";
  }
  for (const runtime::LoggedEvent& e : events) {
    line("at " + with_unit(e.time - zero, "s", 6))
        << "event " << e.code << (e.signal.empty() ? "" : ", " + e.signal) << "\n";
  }
  return out.str();
}

}  // namespace

int info(const InfoArguments& arguments) {
  require_log(arguments.file);
  Story story;
  const runtime::LogContents log = runtime::read_log(
      arguments.file, [&story](double time, std::span<const double> values) { story.take(time, values); },
      [&story](const runtime::LogContents& head) { story.begin(head); });
  const std::vector<runtime::LoggedEvent> events = told_events(log, story.events);
  if (arguments.format == Format::json) {
    print_data(as_json(arguments.file, log, story.tasks, events)
                   .dump(2, ' ', false, ordered_json::error_handler_t::replace) +
               "\n");
  } else {
    print(as_text(arguments.file, log, story.tasks, events));
  }
  return log.closed && log.damage.empty() ? exit_good : exit_bad;
}

}  // namespace zwang::cli
