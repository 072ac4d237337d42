#include "zwang/lang/open_places.hpp"

#include <array>
#include <sstream>
#include <string_view>

#include "words/text.hpp"
#include "zwang/lang/robot_draft.hpp"

namespace zwang::lang {

namespace {

struct Reason {
  std::string_view key, what_to;
};

constexpr std::array fill_in_reasons{
    Reason{"radius", "from the axle to the ground, measured; a mesh does not tell"},
    Reason{"kind", "of the wheels, `skid` or `mecanum`: a URDF does not tell"},
    Reason{"effort", "the largest torque on the joint's side, of the data sheet"},
    Reason{"mass", "of the link; the URDF has none"},
    Reason{"force", "of the brake: mass x deceleration; the URDF has no masses"},
    Reason{"polygon", "the outline from above, measured; the URDF has no simple shape"},
    Reason{"at", "x of the middle of the back, as -0.4 m"},
};

constexpr std::array check_reasons{
    Reason{"base", "the link that floats, its x ahead"},
    Reason{"fixed", "what moves in truth must not stand here"},
    Reason{"turns", "the URDF holds them; a caster's wheel has no motor"},
    Reason{"mimic", "`coupled` by a belt, or `ignore`: each has a motor"},
    Reason{"axes", "the URDF has none there, or one that tells nothing"},
    Reason{"posture", "how the arm stands at the start: folded, as far as a URDF tells"},
    Reason{"inertias", "the URDF has none, or none that a body has"},
    Reason{"stop", "how hard the base may brake"},
    Reason{"footprint", "around what collides in the URDF"},
};

/// Without a comment that stands behind it.
std::string entry_of(const std::string& line) {
  return trimmed(line.substr(0, line.find(" #")));
}

/// The key whose value is open.
std::string open_key(const std::string& entry) {
  const std::size_t colon = entry.rfind(':', entry.find(fill_in));
  if (colon == std::string::npos) return "";
  const std::size_t begin = entry.find_last_of(" {,", colon);
  return entry.substr(begin + 1, colon - begin - 1);
}

}  // namespace

OpenPlaces open_places(const std::string& robot_file) {
  OpenPlaces places;
  std::istringstream lines(robot_file);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (trimmed(line).starts_with("#")) continue;
    const std::string entry = entry_of(line);
    if (entry.find(fill_in) != std::string::npos) {
      places.to_fill_in.push_back({number, entry, ""});
      for (const Reason& reason : fill_in_reasons) {
        if (open_key(entry) == reason.key) places.to_fill_in.back().what_to = reason.what_to;
      }
      const std::size_t comment = line.find(" # ", line.find(fill_in));
      if (comment != std::string::npos) places.to_fill_in.back().what_to = trimmed(line.substr(comment + 3));
      continue;
    }
    if (entry.starts_with("- {joint: ") && entry.find(", drop: ") != std::string::npos)
      places.to_check.push_back(
          {number, entry, "the URDF draws it above the lowest wheel, or a radius is wrong"});
    if (line.starts_with(" ")) continue;  // not a key of the file
    for (const Reason& reason : check_reasons) {
      if (entry.starts_with(std::string(reason.key) + ":"))
        places.to_check.push_back({number, entry, std::string(reason.what_to)});
    }
  }
  return places;
}

}  // namespace zwang::lang
