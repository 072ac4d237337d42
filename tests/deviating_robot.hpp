/// A shipped robot whose wheels and steerings are drawn a little beside their places.
#pragma once

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace zwang::test {

/// Each number is drawn between minus and plus.
struct DrawnDeviation {
  double distance = 0.0;  ///< [m] along x and y of what carries the wheel
  double angle = 0.0;     ///< [rad] of roll and yaw; of a steering of roll and pitch
};

namespace detail {

/// Moves the <origin> of each joint that the robot file lists as a wheel, or that steers one.
inline std::string deviating(std::string urdf, const std::string& robot_file, const DrawnDeviation& most,
                             std::mt19937& random) {
  const std::regex joint(
      "<joint name=\"(\\w+)\"[^>]*>\\s*<parent link=\"\\w+\"/>\\s*<child link=\"\\w+\"/>\\s*"
      "<origin xyz=\"(\\S+) (\\S+) (\\S+)\" rpy=\"(\\S+) (\\S+) (\\S+)\"/>");
  std::string out;
  std::sregex_iterator at(urdf.begin(), urdf.end(), joint);
  std::size_t copied = 0;
  int moved = 0;
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  for (; at != std::sregex_iterator(); ++at) {
    const std::smatch& match = *at;
    const std::string name = match[1];
    const bool is_wheel = robot_file.find("{joint: " + name + ",") != std::string::npos;
    const bool steers = name.find("steering") != std::string::npos || name.ends_with("_drive");
    if (!is_wheel && !steers) continue;
    double number[6];
    for (std::size_t i = 0; i < 6; ++i) number[i] = std::stod(match[i + 2]);
    number[0] += most.distance * share(random);
    number[1] += most.distance * share(random);
    number[3] += most.angle * share(random);
    number[steers ? 4 : 5] += most.angle * share(random);
    char origin[200];
    std::snprintf(origin, sizeof origin, "xyz=\"%.15g %.15g %.15g\" rpy=\"%.15g %.15g %.15g\"", number[0],
                  number[1], number[2], number[3], number[4], number[5]);
    const auto xyz = static_cast<std::size_t>(match.position(2)) - 5;
    const auto end = static_cast<std::size_t>(match.position(7) + match.length(7)) + 1;
    out += urdf.substr(copied, xyz - copied) + origin;
    copied = end;
    ++moved;
  }
  if (moved == 0) throw std::logic_error("no wheel found to move");
  return out + urdf.substr(copied);
}

inline std::string text_of_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace detail

/// Writes `robot` of specs/robots into the folder, with the deviations that `seed` draws; its robot file.
inline std::filesystem::path write_deviating_robot(const std::filesystem::path& folder,
                                                   const std::string& robot, const DrawnDeviation& most,
                                                   unsigned seed) {
  const std::filesystem::path shipped = ZWANG_SOURCE_DIR "/specs/robots";
  const std::string file = detail::text_of_file(shipped / (robot + ".yaml"));
  std::mt19937 random(seed);
  std::ofstream(folder / (robot + ".yaml")) << file;
  std::ofstream(folder / (robot + ".urdf"))
      << detail::deviating(detail::text_of_file(shipped / (robot + ".urdf")), file, most, random);
  return folder / (robot + ".yaml");
}

}  // namespace zwang::test
