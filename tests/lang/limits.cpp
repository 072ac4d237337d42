#include "limits.hpp"

#include "support.hpp"

namespace zwang::lang::test {

namespace {

const std::filesystem::path robots = source_dir / "tests/conformance/robots";

const std::string head = "zwang: 1\nrobot: robots/mini.yaml\nstart: go\n";
const std::string group = "{move: base_link, in: base_link, x: {velocity: 0.1 m/s}}";
const std::string body = "{constraints: {drive: " + group + "}, timeout: {after: 3 s, goto: done}}";
const std::string good = head + "tasks:\n  go: " + body + "\n";

Files task_file(const std::string& name, std::string text) {
  return {{name + ".yaml", std::move(text)},
          {"robots/mini.yaml", slurp(robots / "mini.yaml")},
          {"robots/mini.urdf", slurp(robots / "mini.urdf")}};
}

Files robot_file(const std::string& name, std::string urdf) {
  const std::string robot = slurp(robots / "mini.yaml");
  return {{name + ".yaml", replaced(robot, "urdf: mini.urdf", "urdf: robots/made.urdf")},
          {"robots/made.urdf", std::move(urdf)}};
}

std::size_t as_size(int size) {
  return static_cast<std::size_t>(size);
}

/// Comments of 100 bytes a line up to the size.
std::string padded(std::string text, std::size_t size) {
  while (text.size() + 200 < size) text += "# " + std::string(97, '-') + "\n";
  return text + "# " + std::string(size - text.size() - 3, '-') + "\n";
}

Files file_of_size(const std::string& name, int bytes) {
  return task_file(name, padded(good, as_size(bytes)));
}

Files line_of_length(const std::string& name, int bytes) {
  return task_file(name, good + "#" + std::string(as_size(bytes) - 1, '-') + "\n");
}

/// The outermost map is the first level.
Files nested(const std::string& name, int depth) {
  const std::size_t brackets = as_size(depth) - 1;
  return task_file(name, good + "about: " + std::string(brackets, '[') + std::string(brackets, ']') + "\n");
}

/// A robot file of so many keys, values, lists and maps: what its own text has, the rest are supports.
Files with_nodes(const std::string& name, int nodes) {
  const std::string robot =
      "zwang_robot: 1\nurdf: robots/made.urdf\nbase: base_link\nwheels: [{joint: left, radius: 0.1 m}]\n"
      "actuated: {left: {}}\nstop: {deceleration: 1 m/s^2, force: 50 N}\n"
      "footprint: {polygon: [[0.3 m, 0.2 m], [-0.3 m, 0 m], [0.3 m, -0.2 m]]}\nsupports:\n";
  const std::string support =
      "<link name=\"s\"/><joint name=\"to_s\" type=\"fixed\"><parent link=\"base_link\"/><child "
      "link=\"s\"/></joint>";
  // The map, three keys with a value; wheels: key, list, map of four; actuated: key, map, key, map; stop:
  // key, map of four; footprint: key, map, key, list, three lists of two; supports: key, list.
  const int own = 1 + 3 * 2 + (2 + 1 + 4) + 4 + (2 + 4) + (4 + 3 * 3) + 2;
  std::string text = robot;
  for (int left = nodes - own; left > 0; --left) text += "- s\n";
  const std::string urdf = replaced(slurp(robots / "mini.urdf"), "</robot>", support + "</robot>");
  return {{name + ".yaml", text}, {"robots/made.urdf", urdf}};
}

/// A template whose body has so many keys, values, lists and maps.
std::string template_of(const std::string& name, int nodes) {
  // The map, the timeout's key and its map of four, the key and the list of the exits. An exit is a map of
  // four nodes, or of six with a note.
  const int left = nodes - 1 - 6 - 2;
  int exits = left / 5;
  while ((left - 5 * exits) % 2 != 0) --exits;
  const int notes = (left - 5 * exits) / 2;
  std::string text = "  " + name + ":\n    body:\n      timeout: {after: 99 s, goto: done}\n      exits:\n";
  for (int i = 0; i < exits; ++i) {
    text += "        - {when: elapsed > " + std::to_string(i + 1) + " s, goto: done" +
            (i < notes ? ", note: n" : "") + "}\n";
  }
  return text;
}

/// 199 uses of a template of 100, and one that makes up the rest.
Files with_expanded_nodes(const std::string& name, int nodes) {
  std::string text = head + "templates:\n" + template_of("hundred", 100) +
                     template_of("rest", nodes - 199 * 100) + "tasks:\n";
  for (int i = 1; i <= 199; ++i) {
    const std::string task = i == 1 ? "go" : "t" + std::to_string(i);
    text += "  " + task + ": {use: hundred, timeout: {after: 99 s, goto: t" + std::to_string(i + 1) + "}}\n";
  }
  return task_file(name, text + "  t200: {use: rest}\n");
}

Files key_of_length(const std::string& name, int bytes) {
  const std::string task(as_size(bytes), 'a');
  return task_file(name,
                   replaced(head, "start: go", "start: " + task) + "tasks:\n  " + task + ": " + body + "\n");
}

/// Folded over many lines, each shorter than a line may be.
Files scalar_of_length(const std::string& name, int bytes) {
  std::string about = "about: " + std::string(95, 'a');
  for (int length = 95; length < bytes;) {
    const int next = std::min(95, bytes - length - 1);
    about += "\n  " + std::string(as_size(next), 'a');
    length += next + 1;  // the line end stands for a space
  }
  return task_file(name, good + about + "\n");
}

Files with_tasks(const std::string& name, int count) {
  std::string text = head + "tasks:\n";
  for (int i = 1; i <= count; ++i) {
    const std::string task = i == 1 ? "go" : "t" + std::to_string(i);
    const std::string next = i == count ? "done" : "t" + std::to_string(i + 1);
    text += "  " + task + ": {timeout: {after: 3 s, goto: " + next + "}}\n";
  }
  return task_file(name, text);
}

Files with_groups(const std::string& name, int count) {
  std::string text = head + "tasks:\n  go:\n    timeout: {after: 3 s, goto: done}\n    constraints:\n";
  for (int i = 1; i <= count; ++i) {
    text += "      g" + std::to_string(i) +
            ": {move: base_link, in: base_link, level: 2, y: {velocity: 0 m/s}}\n";
  }
  return task_file(name, text);
}

std::string with_end(const std::string& addition) {
  return replaced(slurp(robots / "mini.urdf"), "</robot>", addition + "</robot>");
}

Files urdf_of_size(const std::string& name, int bytes) {
  std::string urdf = slurp(robots / "mini.urdf");
  return robot_file(name, urdf + std::string(as_size(bytes) - urdf.size(), '\n'));
}

/// <robot> is the first level; elements that zwang does not know are read over.
Files nested_urdf(const std::string& name, int depth) {
  std::string text;
  for (int i = 1; i < depth; ++i) text += "<extra>";
  for (int i = 1; i < depth; ++i) text += "</extra>";
  return robot_file(name, with_end(text));
}

Files with_attributes(const std::string& name, int count) {
  std::string text = "<extra";
  for (int i = 0; i < count; ++i) text += " a" + std::to_string(i) + "=\"1\"";
  return robot_file(name, with_end(text + "/>"));
}

Files with_links(const std::string& name, int count) {
  std::string text;
  for (int i = 4; i <= count; ++i) {  // mini.urdf has three
    const std::string n = std::to_string(i);
    text += "<link name=\"l" + n + "\"/><joint name=\"j" + n +
            "\" type=\"fixed\"><parent link=\"base_link\"/><child link=\"l" + n + "\"/></joint>\n";
  }
  return robot_file(name, with_end(text));
}

}  // namespace

std::vector<Limit> limits() {
  return {
      {"E110_file", "E110", 256 * 1024, true, file_of_size},
      {"E111_line", "E111", 4096, true, line_of_length},
      {"E112_depth", "E112", 32, false, nested},
      {"robot_E113_nodes", "E113", 20000, true, with_nodes},
      {"E113_templates", "E113", 20000, true, with_expanded_nodes},
      {"E114_key", "E114", 128, true, key_of_length},
      {"E115_scalar", "E115", 4096, true, scalar_of_length},
      {"E116_tasks", "E116", 256, true, with_tasks},
      {"E117_groups", "E117", 32, true, with_groups},
      {"robot_E850_urdf", "E850", 4 * 1024 * 1024, true, urdf_of_size},
      {"robot_E851_depth", "E851", 64, true, nested_urdf},
      {"robot_E852_attributes", "E852", 64, true, with_attributes},
      {"robot_E853_links", "E853", 256, true, with_links},
  };
}

}  // namespace zwang::lang::test
