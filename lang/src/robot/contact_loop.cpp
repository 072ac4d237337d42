// Per kilogram of the real base, with a wall of stiffness K/m and a little damping:
//
//   wall         W = K/s + 0.2 sqrt(K)
//   wheels' loop G = (1 + 1/(T_i s))/T_c          v = G/(s + G + W) c,   F = W v
//   command      c = (1 + T_c s) V                as LoopInput has it in contact
//   felt force   w = -e^(-s (delay + 1/rate)) F/(1 + T_s s)
//   virtual      alpha (s + gamma) V = w
//
// L is the product around. The wheels' integral is a spring in series with the wall: the stiffest walls are
// no worse than K/m = 2e4 1/s^2.
#include "robot/contact_loop.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace zwang::lang {

namespace {

using Complex = std::complex<double>;

constexpr double softest = 10.0, stiffest = 2e4;    // [1/s^2]
constexpr double wall_step = 1.7782794;             // a quarter of a decade
constexpr double slowest = 0.05, fastest = 3000.0;  // [rad/s]
constexpr double frequency_step = 1.03;

/// The factors of the loop that depend neither on the wall nor on the virtual robot.
struct Frequency {
  Complex s, G, around;
};

std::vector<Frequency> frequencies_of(const Drive& drive) {
  const double lag = drive.delay + 1.0 / drive.rate;
  const double filter = felt_filter(drive) + drive.feels.filter;
  std::vector<Frequency> all;
  for (double w = slowest; w < fastest; w *= frequency_step) {
    const Complex s(0.0, w);
    Complex G = 1.0 / drive.time_constant;
    if (drive.integral_time) G *= 1.0 + 1.0 / (*drive.integral_time * s);
    all.push_back({s, G, std::exp(-lag * s) * (1.0 + drive.time_constant * s) * G / (1.0 + filter * s)});
  }
  return all;
}

double peak_at(double K, const std::vector<Frequency>& frequencies, const VirtualMass& virtual_mass,
               double enough) {
  double peak = 0.0, phase = 0.0;
  bool is_first = true;
  double last = 0.0;
  for (const auto& [s, G, around] : frequencies) {
    const Complex wall = K / s + 0.2 * std::sqrt(K);
    const Complex L = around * wall / ((s + G + wall) * virtual_mass.factor * (s + virtual_mass.damping));
    const Complex whole = 1.0 + L;
    peak = std::max(peak, 1.0 / std::abs(whole));
    if (peak > enough) return peak;
    const double angle = std::arg(whole);
    phase += is_first ? angle : std::remainder(angle - last, 2.0 * std::numbers::pi);
    last = angle;
    is_first = false;
  }
  // 1 + L ends at 1. The way there goes around 0 where the loop is not stable.
  return std::abs(phase) < 0.5 * std::numbers::pi ? peak : solver::infinity;
}

double worst_peak(const std::vector<Frequency>& frequencies, const VirtualMass& virtual_mass, double enough) {
  double worst = 0.0;
  for (double K = softest; K < 1.01 * stiffest && worst <= enough; K *= wall_step)
    worst = std::max(worst, peak_at(K, frequencies, virtual_mass, enough));
  return worst;
}

/// All pairs, the fastest in contact first; of equal ones the heavier, which a hit moves less.
std::vector<VirtualMass> pairs() {
  std::vector<VirtualMass> all;
  for (const double damping : {1.5, 2.0, 3.0, 4.0}) {
    for (const double factor : {2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 16.0, 20.0})
      all.push_back({factor, damping});
  }
  std::stable_sort(all.begin(), all.end(), [](const VirtualMass& a, const VirtualMass& b) {
    return a.factor * a.damping < b.factor * b.damping;
  });
  return all;
}

}  // namespace

double felt_filter(const Drive& drive) {
  constexpr double least = 20e-3;  // [s]
  return std::max(least, 1.0 / drive.rate);
}

double felt_after(const Drive& drive) {
  return drive.delay + 1.0 / drive.rate + felt_filter(drive) + drive.feels.filter;
}

double worst_peak(const Drive& drive, const VirtualMass& virtual_mass) {
  return worst_peak(frequencies_of(drive), virtual_mass, solver::infinity);
}

std::optional<VirtualMass> choose_virtual_mass(const Drive& drive) {
  const std::vector<Frequency> frequencies = frequencies_of(drive);
  for (const VirtualMass& pair : pairs()) {
    if (pair.factor * pair.damping > slowest_in_contact) break;
    if (worst_peak(frequencies, pair, largest_peak) <= largest_peak) return pair;
  }
  return std::nullopt;
}

std::optional<double> longest_felt_delay(const Drive& drive) {
  Drive sooner = drive;
  sooner.delay = 0.0;
  if (!choose_virtual_mass(sooner)) return std::nullopt;
  double good = 0.0, bad = drive.delay;
  while (bad - good > 1e-3) {
    sooner.delay = 0.5 * (good + bad);
    (choose_virtual_mass(sooner) ? good : bad) = sooner.delay;
  }
  return good;
}

}  // namespace zwang::lang
