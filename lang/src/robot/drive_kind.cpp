#include "robot/drive_kind.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace zwang::lang {

namespace {

bool are_parallel(const std::vector<DraftWheel>& wheels) {
  const Eigen::Vector2d& first = wheels.front().axle;
  return std::all_of(wheels.begin(), wheels.end(), [&](const DraftWheel& wheel) {
    return std::abs(first.x() * wheel.axle.y() - first.y() * wheel.axle.x()) < 0.1;
  });
}

}  // namespace

std::map<std::string, int> swivels_of(const std::vector<DraftWheel>& wheels) {
  std::map<std::string, int> count;
  for (const DraftWheel& wheel : wheels) {
    if (!wheel.swivel.empty()) ++count[wheel.swivel];
  }
  return count;
}

DriveKind drive_of(const std::vector<DraftWheel>& wheels) {
  const auto steered =
      std::count_if(wheels.begin(), wheels.end(), [](const DraftWheel& w) { return !w.swivel.empty(); });
  const auto count = static_cast<std::ptrdiff_t>(wheels.size());
  if (count == 0) return DriveKind::none;
  if (steered == count) return DriveKind::swivels;
  if (steered == 0 && count == 2) return DriveKind::differential;
  if (steered == 0 && count >= 3 && !are_parallel(wheels)) return DriveKind::omni;
  if (steered == 0 && count >= 4) return DriveKind::rollers_or_skid;
  if (steered > 0) return DriveKind::car;
  return DriveKind::other;
}

double heading_of(DriveKind drive, const std::vector<DraftWheel>& wheels) {
  const bool has_heading =
      drive == DriveKind::differential || drive == DriveKind::rollers_or_skid || drive == DriveKind::car;
  const auto stiff =
      std::find_if(wheels.begin(), wheels.end(), [](const DraftWheel& w) { return w.swivel.empty(); });
  if (!has_heading || stiff == wheels.end()) return 0.0;
  constexpr double nearly = 0.1;  // [rad] off a straight angle: a drawing's
  double heading = std::atan2(-stiff->axle.x(), stiff->axle.y());
  if (heading > std::numbers::pi / 2.0 + nearly) heading -= std::numbers::pi;
  if (heading < -std::numbers::pi / 2.0 + nearly) heading += std::numbers::pi;
  if (std::abs(heading) < nearly) return 0.0;
  const double degree = std::numbers::pi / 180.0;
  return std::round(heading / degree) * degree;
}

std::string in_words(DriveKind drive, const std::vector<DraftWheel>& wheels) {
  const std::string count = std::to_string(wheels.size()) + " wheels";
  switch (drive) {
    case DriveKind::none:
      return "no wheels";
    case DriveKind::differential:
      return "differential: two plain wheels";
    case DriveKind::rollers_or_skid:
      return (wheels.size() == 4 ? "four wheels" : count) + " that do not steer: mecanum or skid steering";
    case DriveKind::omni:
      return "omni: " + count + " whose axles point different ways";
    case DriveKind::swivels: {
      const auto units = std::to_string(swivels_of(wheels).size());
      const bool pairs = swivels_of(wheels).size() * 2 == wheels.size();
      return pairs ? units + " swivels with two driven wheels each" : units + " steered wheels";
    }
    case DriveKind::car: {
      std::size_t steered = 0;
      for (const auto& [name, carried] : swivels_of(wheels)) steered += static_cast<std::size_t>(carried);
      return "as a car: " + std::to_string(steered) + " of " + count + " steer";
    }
    case DriveKind::other:
      break;
  }
  return count;
}

}  // namespace zwang::lang
