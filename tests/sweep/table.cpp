#include "table.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <ostream>
#include <thread>

namespace zwang::sweep {

namespace {

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

void print_row(const char* name, const std::vector<Result>& results, bool faulty, double least_step,
               double most_step, std::ostream& out) {
  int runs = 0, stops = 0, frozen = 0, probed = 0, beyond = 0, done = 0, untrue = 0;
  double speed = 0.0, force = 0.0, fastest = 0.0, hardest = 0.0;
  std::vector<double> delays;
  for (const Result& r : results) {
    if (r.is_faulty() != faulty || r.encoder_step < least_step || r.encoder_step > most_step) continue;
    ++runs;
    stops += r.stopped ? 1 : 0;
    frozen += r.reason == "frozen" ? 1 : 0;
    probed += r.probed;
    beyond += r.breaks_a_bound() ? 1 : 0;
    done += r.outcome == "done" ? 1 : 0;
    untrue += r.is_untrue() ? 1 : 0;
    if (!faulty) continue;
    if (r.stopped) delays.push_back(*r.stopped - *r.onset);
    speed = std::max(speed, r.speed / r.speed_bound);
    force = std::max(force, r.force / r.force_bound);
    fastest = std::max(fastest, r.speed);
    hardest = std::max(hardest, r.force);
  }
  if (runs == 0) return;
  char line[256];
  std::snprintf(line, sizeof line,
                "%-16s %5d runs  %5d stopped, %5d as frozen, %4d probed  %4d beyond a bound  %4d done  %4d "
                "untrue  delay %.3f %.3f %.3f s  "
                "%.3f m/s, %.2f of its bound  %.0f N, %.2f of its bound\n",
                name, runs, stops, frozen, probed, beyond, done, untrue, quantile(delays, 0.5),
                quantile(delays, 0.95), quantile(delays, 1.0), fastest, speed, hardest, force);
  out << line;
}

const char* name_of(EncoderFault fault) {
  return fault == EncoderFault::none ? "none" : fault == EncoderFault::dead ? "dead" : "frozen";
}

}  // namespace

std::vector<Result> run_all(std::uint64_t seed, int first, int count, Which which, int threads) {
  std::vector<Result> results(static_cast<std::size_t>(count));
  std::atomic<int> next = 0;
  const auto work = [&] {
    for (int i = next++; i < count; i = next++)
      results[static_cast<std::size_t>(i)] = run(draw(seed, first + i, which));
  };
  std::vector<std::thread> others;
  for (int i = 1; i < threads; ++i) others.emplace_back(work);
  work();
  for (std::thread& other : others) other.join();
  return results;
}

void print(std::uint64_t seed, int first, Which which, const std::vector<Result>& results,
           std::ostream& out) {
  constexpr double fine = 5e-5, coarsest = 1.0;  // [rad]
  print_row("healthy, fine", results, false, 0.0, fine, out);
  print_row("healthy, coarse", results, false, std::nextafter(fine, coarsest), coarsest, out);
  print_row("encoders fail", results, true, 0.0, coarsest, out);
  for (std::size_t i = 0; i < results.size(); ++i) {
    const Result& r = results[i];
    if (!r.is_false_stop() && !r.breaks_a_bound() && !r.is_untrue()) continue;
    const int index = first + static_cast<int>(i);
    const Drawn drawn = draw(seed, index, which);
    char line[320];
    std::snprintf(
        line, sizeof line,
        "run %d: %s, step %g rad; %s at %.4f s in %s: %s %s at %.4f s; %.3f m/s of %.3f, %.0f N of %.0f, "
        "moved %.4f m\n",
        index, drawn.name.c_str(), drawn.encoder_step, name_of(drawn.fault), r.onset.value_or(-1.0),
        r.task.c_str(), r.outcome.c_str(), r.reason.c_str(), r.stopped.value_or(-1.0), r.speed, r.speed_bound,
        r.force, r.force_bound, r.moved);
    out << line;
  }
}

}  // namespace zwang::sweep
