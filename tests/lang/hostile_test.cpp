// Malformed variants of the shipped task, robot and URDF files: each is refused, quickly, with a place and a
// code.
#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <functional>

#include "../times_count.hpp"
#include "support.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::lang {
namespace {

using test::replaced;

enum class Victim { task, robot, urdf, scene };

struct Variant {
  std::string name;
  Victim victim;
  std::string code;
  std::function<std::string(const std::string&)> harm;
  bool at_the_change = false;  ///< the message must point at the first line that differs
};

std::ostream& operator<<(std::ostream& out, const Variant& variant) {
  return out << variant.name;
}

int first_changed_line(const std::string& before, const std::string& after) {
  const std::size_t shorter = std::min(before.size(), after.size());
  const auto end = before.begin() + static_cast<std::ptrdiff_t>(shorter);
  const auto [at, other] = std::mismatch(before.begin(), end, after.begin());
  return 1 + static_cast<int>(std::count(before.begin(), at, '\n'));
}

std::function<std::string(const std::string&)> swap(std::string from, std::string to) {
  return [=](const std::string& text) { return replaced(text, from, to); };
}

std::function<std::string(const std::string&)> whole(std::string text) {
  return [=](const std::string&) { return text; };
}

std::string noise() {
  std::string bytes;
  unsigned state = 12345;
  for (int i = 0; i < 4096; ++i) {
    state = state * 1664525u + 1013904223u;
    bytes += static_cast<char>(state >> 24u);
  }
  return bytes;
}

std::string nested_elements(int depth) {
  std::string text = "<robot name=\"r\">";
  for (int i = 0; i < depth; ++i) text += "<a>";
  for (int i = 0; i < depth; ++i) text += "</a>";
  return text + "</robot>";
}

std::string many_attributes(int count) {
  std::string text = "<robot name=\"r\"><link name=\"l\"";
  for (int i = 0; i < count; ++i) text += " a" + std::to_string(i) + "=\"1\"";
  return text + "/></robot>";
}

std::string many_links(int count) {
  std::string text = "<robot name=\"r\"><link name=\"base_link\"/>";
  for (int i = 1; i < count; ++i) {
    const std::string n = std::to_string(i);
    text += "<link name=\"l" + n + "\"/><joint name=\"j" + n +
            "\" type=\"fixed\"><parent link=\"base_link\"/><child link=\"l" + n + "\"/></joint>";
  }
  return text + "</robot>";
}

const char* const first_mass = "<mass value=\"36.8\"/>";
const char* const first_wheel = "type=\"continuous\">\n    <parent link=\"base_link\"/>";

std::vector<Variant> variants() {
  using enum Victim;
  return {
      // --- task files ---
      {"task_empty", task, "E100", whole("")},
      {"task_comma", task, "E100", whole(",")},
      {"task_binary", task, "E100", whole(noise())},
      {"task_nul", task, "E100", [](const std::string& t) { return t + std::string(1, '\0'); }},
      {"task_one_megabyte", task, "E110", whole(std::string(1 << 20, '#'))},
      {"task_one_megabyte_line", task, "E111", whole("a: " + std::string(200000, 'x'))},
      {"task_scalar", task, "E104", whole("hello\n")},
      {"task_list", task, "E104", whole("- a\n- b\n")},
      {"task_brackets", task, "E112", whole(std::string(2000, '['))},
      {"task_tab", task, "E100", swap("  press:\n    constraints", "  press:\n\tconstraints"), true},
      {"task_duplicate_key", task, "E102", swap("        rz: free", "        y:  free"), true},
      {"task_anchor", task, "E106", swap("{velocity: 0 m/s}", "&still {velocity: 0 m/s}"), true},
      {"task_alias", task, "E106", swap("        rz: free", "        rz: *free"), true},
      {"task_tag", task, "E106", swap("press\n", "!!str press\n")},
      {"task_merge", task, "E106", swap("rz: free", "<<: {rz: free}"), true},
      {"task_second_document", task, "E100", [](const std::string& t) { return t + "---\nzwang: 1\n"; }},
      {"task_open_quote", task, "E100", swap("parent: world", "parent: 'world"), true},
      {"task_missing_start", task, "E103", swap("start: press", "# start: press")},
      {"task_missing_robot", task, "E103", swap("robot: robots/mecanum_base.yaml", "")},
      {"task_missing_in", task, "E103", swap("        in: base\n", "")},
      {"task_missing_when", task, "E103", swap("when: elapsed > 2 s, ", "")},
      {"task_unknown_key", task, "E101", swap("velocity: [", "velcity: ["), true},
      {"task_wrong_unit", task, "E202", swap("after: $timeout", "after: 20 m"), true},
      {"task_unknown_unit", task, "E203", swap("value: 20 N", "value: 20 n"), true},
      {"task_no_unit", task, "E201", swap("0.08 m/s", "0.08"), true},
      {"task_nan", task, "E105", swap("0.08 m/s", "nan m/s"), true},
      {"task_huge_number", task, "E105", swap("0.08 m/s", "1e400 m/s"), true},
      {"task_hex", task, "E203", swap("0.08 m/s", "0x10 m/s"), true},
      {"task_driven_twice", task, "E401", swap("velocity: [-0.05 m/s, 0.08 m/s]", "velocity: 0.08 m/s"),
       true},
      {"task_unknown_frame", task, "E301", swap("move: base", "move: bsae"), true},
      {"task_unknown_task", task, "E301", swap("goto: hold", "goto: holt")},
      {"task_unknown_parameter", task, "E301", swap("force: $push", "force: $pusch"), true},
      {"task_condition", task, "E105", swap("elapsed > 2 s", "elapsed > (2 s"), true},
      {"task_split_condition", task, "E107", swap("elapsed > 2 s", "elapsed > 2 s, elapsed < 3 s"), true},
      {"task_position_in_own_axes", task, "E405", swap("y:  {velocity: 0 m/s}", "y:  {position: 0 m}"), true},
      {"task_held_axis", task, "E404", swap("rz: free", "rz: free\n        z: {velocity: 1 m/s}")},
      {"task_version", task, "E108", swap("zwang: 1", "zwang: 3"), true},
      {"task_robot_is_gone", task, "E109", swap("mecanum_base.yaml", "nowhere.yaml"), true},
      {"task_robot_is_outside", task, "E109", swap("robots/mecanum_base.yaml", "/etc/passwd"), true},
      // --- robot files ---
      {"robot_empty", robot, "E100", whole("")},
      {"robot_comma", robot, "E100", whole(",")},
      {"robot_binary", robot, "E100", whole(noise())},
      {"robot_is_a_task", robot, "E103", whole("zwang: 1\n")},
      {"robot_missing_urdf", robot, "E103", swap("urdf: mecanum_base.urdf", "")},
      {"robot_missing_wheels", robot, "E101", swap("wheels:", "whels:")},
      {"robot_unknown_joint", robot, "E301", swap("joint: front_left_wheel", "joint: front_left_whel")},
      {"robot_unknown_base", robot, "E301", swap("base: base_link", "base: base")},
      {"robot_negative_radius", robot, "E105", swap("radius: 75.9 mm", "radius: -75.9 mm")},
      {"robot_no_unit", robot, "E201", swap("radius: 75.9 mm", "radius: 75.9")},
      {"robot_roller_along", robot, "E802", swap("roller: 45 deg", "roller: 180 deg")},
      {"robot_limit_without_rest", robot, "E806", swap("x: +-1 m/s^2", "x: [1 m/s^2, 2 m/s^2]")},
      {"robot_posture_of_a_wheel", robot, "E202", swap("stop:", "posture: {front_left_wheel: 1 m}\nstop:")},
      {"robot_posture_of_nothing", robot, "E301", swap("stop:", "posture: {front_left_whel: 1 rad}\nstop:")},
      {"robot_flat_footprint", robot, "E807",
       swap("[[0.40 m, 0.28 m], [-0.40 m, 0.28 m], [-0.40 m, -0.28 m], [0.40 m, -0.28 m]]",
            "[[0 m, 0 m], [1 m, 0 m], [2 m, 0 m]]")},
      {"robot_urdf_is_gone", robot, "E109", swap("urdf: mecanum_base.urdf", "urdf: gone.urdf")},
      {"robot_package_url", robot, "E109", swap("urdf: mecanum_base.urdf", "urdf: package://x/y.urdf")},
      // --- URDFs ---
      {"urdf_empty", urdf, "E854", whole("")},
      {"urdf_binary", urdf, "E854", whole(noise())},
      {"urdf_five_megabytes", urdf, "E850", whole(std::string(5 << 20, ' '))},
      {"urdf_doctype", urdf, "E854", swap("<robot name", "<!DOCTYPE r [<!ENTITY a \"b\">]><robot name")},
      {"urdf_not_a_robot", urdf, "E854", whole("<html/>")},
      {"urdf_cut_off", urdf, "E854", [](const std::string& t) { return t.substr(0, t.size() / 2); }},
      {"urdf_wrong_end", urdf, "E854", swap("</inertial>", "</inertia>")},
      {"urdf_deep", urdf, "E851", whole(nested_elements(64))},
      {"urdf_very_deep", urdf, "E851", whole(nested_elements(50000))},
      {"urdf_attributes", urdf, "E852", whole(many_attributes(64))},
      {"urdf_links", urdf, "E853", whole(many_links(257))},
      {"urdf_denormal_place", urdf, "E105", swap("<origin xyz=\"0", "<origin xyz=\"1e-310")},
      {"urdf_denormal_inertia", urdf, "E105", swap("ixy=\"0", "ixy=\"4e-320")},
      {"urdf_denormal_limit", urdf, "E105", swap("effort=\"", "effort=\"1e-310\" _=\"")},
      {"urdf_huge_limit", urdf, "E105", swap("velocity=\"", "velocity=\"1e300\" _=\"")},
      {"urdf_infinite_limit", urdf, "E856", swap("effort=\"", "effort=\"inf\" _=\"")},
      {"urdf_huge_angle", urdf, "E858", swap("rpy=\"0 0 0\"", "rpy=\"1e9 0 0\"")},
      {"urdf_nan_mass", urdf, "E856", swap(first_mass, "<mass value=\"nan\"/>")},
      {"urdf_comma_mass", urdf, "E856", swap(first_mass, "<mass value=\"36,8\"/>")},
      {"urdf_unit_mass", urdf, "E856", swap(first_mass, "<mass value=\"36.8kg\"/>")},
      {"urdf_xacro_mass", urdf, "E855", swap(first_mass, "<mass value=\"${base_mass}\"/>")},
      {"urdf_negative_mass", urdf, "E858", swap(first_mass, "<mass value=\"-1\"/>")},
      {"urdf_no_mass", urdf, "E858", swap(first_mass, "")},
      {"urdf_wheel_without_mass", urdf, "E808", swap("<mass value=\"2.3\"/>", "<mass value=\"0\"/>")},
      {"urdf_negative_inertia", urdf, "E858", swap("ixx=\"0.77157\"", "ixx=\"-0.77157\"")},
      {"urdf_triangle_rule", urdf, "E808", swap("izz=\"2.15157\"", "izz=\"9\"")},
      {"urdf_missing_link", urdf, "E857",
       swap("<child link=\"rear_left_wheel_link\"/>", "<child link=\"gone\"/>")},
      {"urdf_doubled_link", urdf, "E857", swap("name=\"rear_left_wheel_link\"", "name=\"base_link\"")},
      {"urdf_two_parents", urdf, "E857",
       swap("<child link=\"rear_left_wheel_link\"/>", "<child link=\"front_left_wheel_link\"/>")},
      {"urdf_self_joint", urdf, "E857",
       swap("<parent link=\"base_link\"/>\n    <child link=\"rear_left_wheel_link\"/>",
            "<parent link=\"rear_left_wheel_link\"/>\n    <child link=\"rear_left_wheel_link\"/>")},
      {"urdf_zero_axis", urdf, "E859", swap("<axis xyz=\"0 1 0\"/>", "<axis xyz=\"0 0 0\"/>")},
      {"urdf_short_axis", urdf, "E856", swap("<axis xyz=\"0 1 0\"/>", "<axis xyz=\"0 1\"/>")},
      {"urdf_joint_type", urdf, "E859",
       swap(first_wheel, "type=\"floating\">\n    <parent link=\"base_link\"/>")},
      {"urdf_negative_effort", urdf, "E859", swap("effort=\"1.92\"", "effort=\"-1.92\"")},
      {"urdf_no_effort", urdf, "E804", swap("effort=\"1.92\"", "effort=\"0\"")},
      {"urdf_prismatic_wheel", urdf, "E802",
       [](const std::string& t) {
         return replaced(replaced(t, "type=\"continuous\"", "type=\"prismatic\""), "<limit effort",
                         "<limit lower=\"0\" upper=\"1\" effort");
       }},
      {"urdf_fixed_wheel", urdf, "E801", swap("type=\"continuous\"", "type=\"fixed\"")},
      // --- scenes ---
      {"scene_comma", scene, "E100", whole(",")},
      {"scene_misspelt_shape", scene, "E101", swap("wall: {length", "wal: {length"), true},
      {"scene_no_shape", scene, "E901", swap("    wall: {length: 4 m, thickness: 0.1 m, height: 1 m}\n", "")},
      {"scene_negative_stiffness", scene, "E105", swap("100 kN/m", "-100 kN/m")},
      {"scene_fixed_with_mass", scene, "E902", swap("fixed: true", "fixed: true\n    mass: 2 kg")},
      {"scene_yes", scene, "E105", swap("fixed: true", "fixed: yes")},
  };
}

std::filesystem::path path_of(const Diagnostics& diagnostics, const Span& span) {
  return std::filesystem::path(diagnostics.source(span.source).path).filename();
}

class Hostile : public testing::TestWithParam<Variant> {};

TEST_P(Hostile, is_refused_with_a_place_and_a_code) {
  const Variant& variant = GetParam();
  const test::Folder folder;
  const auto specs = test::source_dir / "specs";
  std::filesystem::path victim;
  int changed_line = 0;
  const auto copy = [&](Victim kind, const std::string& name) {
    std::string text = test::slurp(specs / name);
    if (kind == variant.victim) {
      const std::string harmed = variant.harm(text);
      changed_line = first_changed_line(text, harmed);
      text = harmed;
    }
    const auto path = folder.write(name, text);
    if (kind == variant.victim) victim = path;
    return path;
  };
  const auto task = copy(Victim::task, "wall_align.yaml");
  copy(Victim::robot, "robots/mecanum_base.yaml");
  copy(Victim::urdf, "robots/mecanum_base.urdf");
  copy(Victim::scene, "scenes/wall.yaml");

  Diagnostics diagnostics;
  const std::clock_t start = std::clock();
  EXPECT_FALSE(load(task, {}, diagnostics));
  if (zwang::test::times_count) {
    EXPECT_LT(std::clock() - start, 2 * CLOCKS_PER_SEC) << "of the processor's time, however busy it is";
  }

  EXPECT_GE(test::count(diagnostics, variant.code), 1) << test::rendered(diagnostics);
  for (const Diagnostic& d : diagnostics.all()) {
    EXPECT_FALSE(d.message.empty());
    ASSERT_TRUE(d.span.exists()) << test::rendered(diagnostics);
    if (d.code != variant.code) continue;
    // A fault of two files together is told where it was written, with the other place beside it.
    bool names_victim = d.span.source >= 0 && path_of(diagnostics, d.span) == victim.filename();
    for (const RelatedSpan& related : d.related) {
      names_victim = names_victim || path_of(diagnostics, related.span) == victim.filename();
    }
    EXPECT_TRUE(names_victim) << test::rendered(diagnostics);
    if (variant.at_the_change) {
      EXPECT_EQ(d.span.begin.line, changed_line) << test::rendered(diagnostics);
    }
  }
  // One cause, one message.
  EXPECT_EQ(diagnostics.error_count(), 1) << test::rendered(diagnostics);
}

INSTANTIATE_TEST_SUITE_P(Files, Hostile, testing::ValuesIn(variants()),
                         [](const auto& test_case) { return test_case.param.name; });

}  // namespace
}  // namespace zwang::lang
