#include "live_view.hpp"

#include <algorithm>
#include <cmath>
#include <thread>

#include "json_parts.hpp"
#include "live_sink.hpp"
#include "output.hpp"
#include "report_page.hpp"

namespace zwang::cli {

namespace {

using nlohmann::ordered_json;

constexpr double bucket = 0.02;  // [s] of a run in one message
constexpr double slowest = 0.01, fastest = 1.0;
constexpr auto page_look_every = std::chrono::milliseconds(10);  // while nothing runs
constexpr auto longest_building = std::chrono::seconds(5);  // of a page, for which the run waits at its begin
constexpr double longest_delay = 0.1;                       // [s] that is caught up with

/// The policy of the page allows no connection; this one allows the stream.
std::string with_stream_allowed(std::string page, const std::string& origin) {
  const std::string place = "base-uri 'none'";
  const std::size_t at = page.find(place);
  if (at == std::string::npos) throw Impossible("the parts of the page are of another version of zwang");
  return page.insert(at, "connect-src ws" + origin.substr(std::string("http").size()) + "; ");
}

ordered_json columns_of(const std::vector<runtime::Column>& columns) {
  ordered_json list = ordered_json::array();
  for (const runtime::Column& column : columns) {
    const bool has_line = column.span.exists();
    list.push_back({{"name", column.name},
                    {"unit", column.unit},
                    {"file", has_line ? column.span.source : -1},
                    {"line", has_line ? column.span.begin.line : 0},
                    {"words", !column.words.empty()}});
  }
  return list;
}

ordered_json parameters_of(const std::vector<lang::Parameter>& parameters) {
  ordered_json list = ordered_json::array();
  for (const lang::Parameter& p : parameters) {
    ordered_json one = {
        {"name", p.name}, {"value", p.value}, {"unit", p.unit}, {"scale", p.unit_scale}, {"help", p.help}};
    if (p.range) one["range"] = {p.range->low, p.range->high};
    list.push_back(one);
  }
  return list;
}

}  // namespace

LiveView::LiveView(int port) : server_(port) {
  const ordered_json data = {{"format", 1}, {"live", "stream"}};
  server_.serve(with_stream_allowed(page_with(page_parts(), text_of(data)), server_.origin()));
  print_error("zwang: the run is shown at " + server_.address() + " (this machine only; Ctrl-C ends)\n");
}

std::unique_ptr<runtime::LogSink> LiveView::begin(const lang::Program& program,
                                                  const lang::Diagnostics& diagnostics,
                                                  const runtime::Runner& runner) {
  has_begun_ = true;
  is_over_ = restart_ = is_ready_ = false;
  ticks_ = 1;  // the page is built of the first records
  hand_ = LiveHand(program);
  parameters_ = program.parameters;
  ordered_json files = ordered_json::array();
  for (const lang::Source& source : diagnostics.sources())
    files.push_back({{"path", source.path}, {"text", source.text}});
  const ordered_json first = {{"kind", "begin"},
                              {"facts", runner.facts()},
                              {"files", files},
                              {"columns", columns_of(runner.columns())},
                              {"parameters", parameters_of(parameters_)},
                              {"period", runner.period()},
                              {"world", world_of(program)},
                              {"graph", graph_json(program)},
                              {"bounds", bounds_of(program)},
                              {"hand", hand_.choices()}};
  server_.begin(live_message(text_of(first), {}));
  refused_.clear();
  begin_pace(0.0);
  tell_state();
  return live_sink(bucket, [this](std::string message) { server_.send(std::move(message)); });
}

void LiveView::wait_for_page(const std::atomic<bool>& interrupted) {
  while (!interrupted && server_.pages() == 0) std::this_thread::sleep_for(page_look_every);
  ready_by_ = Clock::now() + longest_building;
}

void LiveView::wait_for_tick(runtime::Runner& runner, double time, const std::atomic<bool>& interrupted) {
  now_ = time;
  look(&runner);
  while (!interrupted && !restart_) {
    if (ticks_ > 0) {
      --ticks_;
      begin_pace(time);
      return;
    }
    if (paused_ || !is_ready_) {
      std::this_thread::sleep_for(page_look_every);
      begin_pace(time);
    } else {
      const std::chrono::duration<double> due((time - since_time_) / speed_);
      const auto left = since_ + std::chrono::duration_cast<Clock::duration>(due) - Clock::now();
      // A run that was held up does not hurry afterwards.
      if (left < -std::chrono::duration<double>(longest_delay)) begin_pace(time);
      if (left <= Clock::duration::zero()) return;
      std::this_thread::sleep_for(std::min<Clock::duration>(left, page_look_every));
    }
    look(&runner);
    if (Clock::now() > ready_by_) is_ready_ = true;
  }
}

void LiveView::end(const std::string& report) {
  is_over_ = true;
  const ordered_json over = {{"kind", "over"}, {"report", ordered_json::parse(report, nullptr, false)}};
  server_.send(live_message(text_of(over), {}));
  tell_state();
}

bool LiveView::wait_for_restart(const std::atomic<bool>& interrupted) {
  while (!interrupted && !restart_) {
    std::this_thread::sleep_for(page_look_every);
    look(nullptr);
  }
  return !interrupted;
}

void LiveView::look(runtime::Runner* runner) {
  const std::vector<std::string> requests = server_.take_requests();
  for (const std::string& request : requests) obey(request, runner);
  if (!requests.empty()) tell_state();
  if (server_.pages() == 0) hand_.let_go();
}

/// Obeys a request of the page. Any other message is ignored.
void LiveView::obey(const std::string& request, runtime::Runner* runner) {
  const nlohmann::json json = nlohmann::json::parse(request, nullptr, false);
  if (!json.is_object()) return;
  const auto text = [&](const char* key) {
    const auto found = json.find(key);
    return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  const auto value = json.find("value");
  const double number = value != json.end() && value->is_number() ? value->get<double>() : std::nan("");
  const std::string what = text("do");
  refused_ = runner != nullptr ? hand_.obey(json) : std::string();
  if (what == "ready") is_ready_ = true;
  if (what == "pause") paused_ = true;
  if (what == "go") paused_ = false;
  if (what == "tick") {
    paused_ = true;
    ticks_ = 1;
  }
  if (what == "restart") restart_ = true;
  if (what == "speed" && number >= slowest && number <= fastest) speed_ = number;
  if (what == "set" && runner != nullptr) set(*runner, text("name"), number);
  begin_pace(now_);
}

void LiveView::set(runtime::Runner& runner, const std::string& name, double value) {
  const auto is_it = [&](const lang::Parameter& one) { return one.name == name; };
  const auto parameter = std::ranges::find_if(parameters_, is_it);
  if (parameter != parameters_.end() && runner.set_parameter(name, value)) {
    parameter->value = value;
  } else {
    refused_ = "no parameter has this name, or the value is outside its range";
  }
}

void LiveView::begin_pace(double time) {
  since_time_ = time;
  since_ = Clock::now();
}

void LiveView::tell_state() {
  ordered_json values = ordered_json::object();
  for (const lang::Parameter& p : parameters_) values[p.name] = p.value;
  const ordered_json state = {
      {"kind", "state"}, {"paused", paused_}, {"speed", speed_},     {"over", is_over_},
      {"time", now_},    {"values", values},  {"refused", refused_}, {"hand", hand_.in_force()}};
  server_.tell_state(live_message(text_of(state), {}));
}

}  // namespace zwang::cli
