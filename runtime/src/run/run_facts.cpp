#include "run/run_facts.hpp"

#include <charconv>
#include <cmath>
#include <stdexcept>

#include "zwang/runtime/with_unit.hpp"
#include "zwang/version.hpp"

namespace zwang::runtime {

namespace {

constexpr const char* period_key = "period [s]";
constexpr const char* slew_key = "max_slew [N m/s]";

double number_of(const std::string& text, const std::string& what) {
  const std::optional<double> value = number_in(text);
  if (!value) throw std::runtime_error("`" + text + "` in the log is not a " + what);
  return *value;
}

std::string eigen_version() {
  return std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
         std::to_string(EIGEN_MINOR_VERSION);
}

}  // namespace

std::optional<double> number_in(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

RunFacts facts_of(const RunnerSettings& settings, double period) {
  RunFacts facts{{"zwang", ZWANG_VERSION},
                 {"compiler", __VERSION__},
                 {"Eigen", eigen_version()},
                 {period_key, exactly(period)}};
  if (std::isfinite(settings.max_slew)) facts[slew_key] = exactly(settings.max_slew);
  return facts;
}

RunnerSettings settings_of(const RunFacts& facts) {
  const auto period = facts.find(period_key), slew = facts.find(slew_key);
  if (period == facts.end()) throw std::runtime_error("the log does not say its control period");
  RunnerSettings settings;
  settings.period = number_of(period->second, "control period");
  if (slew != facts.end()) settings.max_slew = number_of(slew->second, "slew");
  return settings;
}

}  // namespace zwang::runtime
