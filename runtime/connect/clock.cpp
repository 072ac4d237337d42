#include "clock.hpp"

#include <chrono>
#include <cmath>
#include <ctime>

namespace zwang::connect {

double now() noexcept {
  using namespace std::chrono;
  static const auto steady_start = steady_clock::now();
  static const double start = duration<double>(system_clock::now().time_since_epoch()).count();
  return start + duration<double>(steady_clock::now() - steady_start).count();
}

void sleep_until(double time) noexcept {
  const double left = time - now();
  if (left <= 0.0) return;
  timespec span{static_cast<time_t>(left), static_cast<long>(std::fmod(left, 1.0) * 1e9)};
  clock_nanosleep(CLOCK_MONOTONIC, 0, &span, nullptr);
}

}  // namespace zwang::connect
