/// A robot with a long arm, and a task with an axis for each of its tasks: many questions about its model.
#pragma once

#include <string>

namespace zwang::test {

/// Links and joints of a URDF, one on the other.
inline std::string long_arm(int joints) {
  std::string text;
  for (int i = 0; i < joints; ++i) {
    const std::string n = std::to_string(i);
    text += "<link name=\"l" + n +
            "\"><inertial><mass value=\"0.1\"/><inertia ixx=\"1e-3\" ixy=\"0\" ixz=\"0\" iyy=\"1e-3\" "
            "iyz=\"0\" izz=\"1e-3\"/></inertial></link><joint name=\"j" +
            n + "\" type=\"revolute\"><parent link=\"" +
            (i == 0 ? "base_link" : "l" + std::to_string(i - 1)) + "\"/><child link=\"l" + n +
            "\"/><origin xyz=\"0 0 0.01\"/><axis xyz=\"0 1 0\"/><limit lower=\"-1\" upper=\"1\" "
            "effort=\"5\" velocity=\"1\"/></joint>\n";
  }
  return text;
}

/// Each task moves the base along an axis of its own.
inline std::string tasks_along_axes(const std::string& robot, int count, const std::string& params = "") {
  std::string frames = "frames:\n", text = "tasks:\n";
  for (int i = 0; i < count; ++i) {
    const std::string n = std::to_string(i);
    frames += "  f" + n + ": {parent: base_link, at: [0.3 m, " + n + " mm]}\n";
    text += "  t" + n + ": {constraints: {g: {move: f" + n +
            ", in: base_link, x: {velocity: 0.1 m/s}}}, timeout: {after: 3 s, goto: " +
            (i + 1 == count ? std::string("done") : "t" + std::to_string(i + 1)) + "}}\n";
  }
  return "zwang: 1\nrobot: " + robot + "\n" + params + frames + "start: t0\n" + text;
}

}  // namespace zwang::test
