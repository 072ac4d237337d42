// Odd files that hands, editors and word processors make. Each file is accepted with its plain meaning, or
// refused once, in its place, with the text to write instead.
#include <gtest/gtest.h>

#include "support.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::lang {
namespace {

struct Oddity {
  std::string name;
  std::string axis;  ///< what the axis x says
  std::string when = "elapsed > 2 s";
  std::string code;  ///< empty: good
  int line = 0, column = 0;
  std::string help;  ///< part of it
  std::string top;   ///< lines in front of `start`
};

constexpr int axis_line = 10, when_line = 12;  // without `top`
constexpr int value_column = 23, when_column = 15;

std::vector<Oddity> oddities() {
  const auto value = [](std::string name, const std::string& text, std::string code, std::string help) {
    return Oddity{std::move(name), "velocity: " + text, "elapsed > 2 s", std::move(code),
                  axis_line,       value_column,        std::move(help), {}};
  };
  const auto good = [](std::string name, const std::string& text) {
    return Oddity{.name = std::move(name), .axis = "velocity: " + text};
  };
  const auto when = [](std::string name, std::string text, std::string code, int at, std::string help) {
    return Oddity{std::move(name), "velocity: 0.1 m/s", std::move(text), std::move(code),
                  when_line,       when_column + at,    std::move(help), {}};
  };
  const std::string feature =
      "frames:\n  wall: {parent: world, at: [2 m, 0 m]}\nfeatures:\n  gap: {distance: [base_link, wall]}\n";
  return {
      // --- numbers ---
      good("capital_exponent", "1E-1 m/s"),
      good("leading_point", ".1 m/s"),
      good("trailing_point", "1. m/s"),
      good("plus", "+0.1 m/s"),
      good("no_space", "0.1m/s"),
      good("leading_zero", "010 mm/s"),
      good("unit_of_powers", "0.1 m s^-1"),
      value("overflow", "1e400 m/s", "E105", ""),
      value("underflow", "1e-400 m/s", "E105", ""),
      value("denormal", "1e-310 m/s", "E105", ""),
      value("overflow_by_unit", "1e308 km/s", "E105", ""),
      value("infinity", ".inf", "E105", ""),
      value("not_a_number", ".nan", "E105", ""),
      value("hexadecimal", "0x1 m/s", "E203", ""),
      // --- letters of a word processor ---
      value("superscript", "0.1 m\xC2\xB2/s", "E105", "write `0.1 m^2/s`"),
      value("no_break_space", "0.1\xC2\xA0m/s", "E105", "write `0.1 m/s`"),
      value("minus_sign",
            "\xE2\x88\x92"
            "0.1 m/s",
            "E105", "write `-0.1 m/s`"),
      value("plus_minus",
            "\xC2\xB1"
            "0.1 m/s",
            "E105", "write `+-0.1 m/s`"),
      value("decimal_comma", "'0,1 m/s'", "E105", "write `0.1 m/s`"),
      value("decimal_comma_in_brackets", "0,1 m/s", "E104", "write `0.1 m/s`"),
      value("decimal_comma_and_a_sign", "-0,1 m/s, time_constant: 0.2 s", "E104", "write `-0.1 m/s`"),
      value("decimal_comma_and_a_space", "0, 1 m/s", "E104", "write `0.1 m/s`"),
      value("grouped_digits", "1_000 mm/s", "E105", "write `1000 mm/s`"),
      value("micro", "5 \xC2\xB5m/s", "E105", "write `5 um/s`"),
      value("degrees", "5\xC2\xB0/s", "E105", "write `5 deg/s`"),
      // --- ranges ---
      value("one_end", "[0.2 m/s]", "E104", ""),
      {"range_of_ranges", "velocity: [+-0.2 m/s, 1 m/s]", "elapsed > 2 s", "E104", axis_line,
       value_column + 1, "", ""},
      value("twice_negative", "+--0.2 m/s", "E105", ""),
      // --- conditions ---
      {.name = "precedence",
       .axis = "velocity: 0.1 m/s",
       .when = "elapsed > 2 s or elapsed > 1 s and not elapsed > 3 s"},
      when("capitals", "elapsed > 1 s AND elapsed < 2 s", "E105", 14, "write `and`"),
      when("negation_in_capitals", "NOT elapsed > 1 s", "E105", 0, "write `not`"),
      when("arrow", "elapsed => 2 s", "E105", 8, "write `>=`"),
      when("arrow_back", "elapsed =< 2 s", "E105", 8, "write `<=`"),
      when("divided_by_zero", "elapsed / 0 > 3 s", "E105", 10, ""),
      when("unit_behind_parentheses", "elapsed > (1 + 2) s", "E105", 18, ""),
      when("between", "1 s < elapsed < 2 s", "E105", 14, "a < b and b < c"),
      when("other_letters", "elapsed > 1 s \xF0\x9F\x99\x82", "E105", 14, ""),
      when("number_for_a_truth", "go.x.saturated > 1", "E205", 0, ""),
      // --- features ---
      {.name = "measured_by_the_group",
       .axis = "velocity: 0.1 m/s}\n      near: {feature: gap, velocity: +-0.1 m/s",
       .when = "near.velocity < 1 m/s and not near.saturated",
       .top = feature},
      {"measured_by_an_axis_that_is_none",
       "velocity: 0.1 m/s}\n      near: {feature: gap, velocity: +-0.1 m/s", "near.near.velocity < 1 m/s",
       "E301", when_line + 5, when_column, "write `near.velocity`", feature},
      {"measured_as_a_length", "velocity: 0.1 m/s}\n      near: {feature: gap, velocity: +-0.1 m/s",
       "near.velocity < 1 m", "E202", when_line + 5, when_column, "", feature},
  };
}

std::string text_of(const Oddity& odd) {
  return "zwang: 1\nrobot: robots/mini.yaml\n" + odd.top +
         "start: go\ntasks:\n  go:\n    constraints:\n      go:\n        move: base_link\n        in: "
         "base_link\n        "
         "x: {" +
         odd.axis + "}\n    exits:\n      - when: " + odd.when +
         "\n        for: 0.1 s\n        goto: done\n    timeout: {after: 9 s, goto: failed}\n";
}

class Slip : public testing::TestWithParam<Oddity> {};

void put_robot(const test::Folder& folder) {
  for (const char* name : {"robots/mini.yaml", "robots/mini.urdf"})
    folder.write(name, test::slurp(test::source_dir / "tests/conformance" / name));
}

Diagnostics said_about(const std::string& text) {
  const test::Folder folder;
  put_robot(folder);
  Diagnostics diagnostics;
  load(folder.write("task.yaml", text), {}, diagnostics);
  return diagnostics;
}

TEST_P(Slip, is_read_or_told_once_in_its_place) {
  const Oddity& odd = GetParam();
  const Diagnostics diagnostics = said_about(text_of(odd));
  if (odd.code.empty()) {
    EXPECT_FALSE(diagnostics.has_errors()) << test::rendered(diagnostics);
    return;
  }
  ASSERT_EQ(diagnostics.all().size(), 1u) << test::rendered(diagnostics);
  const Diagnostic& said = diagnostics.all()[0];
  EXPECT_EQ(said.code, odd.code) << test::rendered(diagnostics);
  EXPECT_EQ(said.span.begin.line, odd.line) << test::rendered(diagnostics);
  EXPECT_EQ(said.span.begin.column, odd.column) << test::rendered(diagnostics);
  EXPECT_NE(said.help.find(odd.help), std::string::npos) << test::rendered(diagnostics);
}

INSTANTIATE_TEST_SUITE_P(Of, Slip, testing::ValuesIn(oddities()),
                         [](const auto& test_case) { return test_case.param.name; });

const std::string head = "zwang: 1\nrobot: robots/mini.yaml\n";
const std::string body =
    "start: go\ntasks:\n  go:\n    constraints:\n      go: {move: base_link, in: base_link, x: {velocity: "
    "0.1 "
    "m/s}}\n    timeout: {after: 3 s, goto: done}\n";

void expect_once(const std::string& text, const std::string& code, int line) {
  const Diagnostics diagnostics = said_about(text);
  ASSERT_EQ(diagnostics.all().size(), 1u) << text << test::rendered(diagnostics);
  EXPECT_EQ(diagnostics.all()[0].code, code) << text << test::rendered(diagnostics);
  EXPECT_EQ(diagnostics.all()[0].span.begin.line, line) << text << test::rendered(diagnostics);
}

TEST(Slips, other_line_ends_and_a_byte_order_mark_change_nothing) {
  std::string windows = "\xEF\xBB\xBF" + head + body;
  for (std::size_t at = 0; (at = windows.find('\n', at)) != std::string::npos; at += 2)
    windows.insert(at, "\r");
  EXPECT_TRUE(said_about(windows).all().empty()) << test::rendered(said_about(windows));
  expect_once(test::replaced(windows, "0.1 m/s", "0.1 N"), "E202", 7);
}

/// An editor may replace a value by the same number in a unit that fits.
TEST(Slips, what_is_offered_keeps_the_sign_the_size_and_the_dimension) {
  struct Offer {
    const char* axis;
    std::optional<std::string> written;
  };
  const Offer offers[] = {{"velocity: 5 mmps", "5 mm/s"},
                          {"velocity: +-0.05 mps", "+-0.05 m/s"},
                          {"velocity: -0.05 mps", "-0.05 m/s"},
                          {"velocity: 3 ms-1", "3 m/s"},
                          {"velocity: 3 met/s", "3 m/s"},
                          {"velocity: 5 mmm", std::nullopt},  // a length is no velocity
                          {"force: 20 Nm", "20 N"},
                          {"force: +-5 newton", "+-5 N"},
                          {"force: 20 kgf", std::nullopt},     // a mass is no force
                          {"velocity: 3 rpm", std::nullopt}};  // 18 deg/s are not 3 deg/s
  for (const Offer& offer : offers) {
    const Diagnostics said = said_about(text_of({.axis = offer.axis}));
    ASSERT_EQ(said.all().size(), 1u) << test::rendered(said);
    EXPECT_EQ(said.all()[0].replacement, offer.written) << test::rendered(said);
  }
}

TEST(Slips, the_name_that_was_meant_is_offered) {
  const auto offered = [](const std::string& text) {
    const Diagnostics said = said_about(text);
    return said.all().empty() ? std::string("nothing is said") : said.all()[0].replacement.value_or("");
  };
  const std::string text = text_of({.axis = "velocity: 0.1 m/s"});
  EXPECT_EQ(offered(test::replaced(text, "start: go\n", "start: goo\n")), "go");
  EXPECT_EQ(offered(test::replaced(text, "elapsed > 2 s", "go.x.velocty > 0.1 m/s")), "go.x.velocity");
  EXPECT_EQ(offered(test::replaced(text, "elapsed > 2 s", "goo.x.velocity > 0.1 m/s")), "go.x.velocity");
}

TEST(Slips, a_line_without_a_colon_is_told_wherever_it_stands) {
  for (const std::string end : {"", "\n", " # soon", " # soon\n", "  "}) {
    expect_once(head + body + "and so on" + end, "E100", 9);
    expect_once(head + "start: go\nand so on" + end, "E100", 4);
  }
}

TEST(Slips, a_loop_of_frames_on_one_line_is_one_loop) {
  expect_once(head + "frames: {a: {parent: b}, b: {parent: c}, c: {parent: a}}\n" + body, "E304", 3);
}

TEST(Slips, a_parameter_with_an_impossible_name_is_told_where_it_is_declared) {
  for (const std::string name : {"a.b",
                                 "kr\xC3\xA4"
                                 "fte"}) {
    expect_once(head + "params: {" + name + ": 0.1 m/s}\n" + test::replaced(body, "0.1 m/s", "$" + name),
                "E105", 3);
  }
}

TEST(Slips, a_file_without_tasks_has_no_start_to_complain_of) {
  expect_once(head + "start: go\ntasks: {}\n", "E104", 4);
  expect_once(head + "start: go\ntasks: [go]\n", "E104", 4);
}

TEST(Slips, what_hangs_on_an_unreadable_part_is_not_complained_of) {
  const std::string uses =
      "    use: go_on\n    with: {pace: 0.1 m/s}\n    timeout: {after: 3 s, goto: done}\n";
  const std::string tasks = "start: go\ntasks:\n  go:\n" + uses;
  const std::string body_of_it =
      "    body:\n      constraints:\n        go: {move: base_link, in: base_link, x: {velocity: $pace}}\n";
  expect_once(head + "templates:\n  go_on:\n    args: [pace]\n" + body_of_it + tasks, "E104", 5);
  const std::string declared = head + "templates:\n  go_on:\n    args: {pace: velocity}\n" + body_of_it;
  expect_once(declared + test::replaced(tasks, "with: {pace", "args: {pace"), "E101", 13);
  expect_once(declared + test::replaced(tasks, "0.1 m/s", "0.1"), "E303", 13);
  expect_once(head + "regions:\n  hall: {area: [1 m, 1 m]}\n" +
                  test::replaced(body, "go: {move", "stay: {move: base_link, inside: hall}\n      go: {move"),
              "E101", 4);
  expect_once(head + "features:\n  far: {between: [base_link, world]}\n" +
                  test::replaced(body, "goto: done}",
                                 "goto: done}\n    exits: [{when: far > 1 m, for: 1 s, goto: done}]"),
              "E101", 4);
  expect_once(head + "regions:\n  hall: {polygon: [[0, 0], [1 m, 0 m], [1 m, 1 m]]}\n" +
                  test::replaced(body, "go: {move", "stay: {move: base_link, inside: hall}\n      go: {move"),
              "E201", 4);
}

TEST(Slips, a_misspelt_key_is_not_taken_for_one_that_is_not_there) {
  const std::string slow =
      "always: {constraints: {soft: {move: base_link, in: base_link, x: {acceleration: +-0.1 m/s^2}}}}\n";
  const std::string drive = test::replaced(body, "x: {velocity: 0.1 m/s}",
                                           "x: {position: here, velocity: +-0.5 m/s, tmie_constant: 3 s}");
  expect_once(head + slow + drive, "E101", 8);
  const std::string unused = "templates:\n  go_on: {body: {timeout: {after: 1 s, goto: done}}}\n";
  expect_once(head + unused + test::replaced(body, "tasks:", "tsaks:"), "E101", 6);
  expect_once(head + "params:\n  pace: {value: 0.1, range: [0 m/s, 1 m/s]}\n" +
                  "templates:\n  on: {args: {v: velocity}, body: {constraints: {go: {move: base_link, in: "
                  "base_link, x: {velocity: $v}}}, timeout: {after: 1 s, goto: done}}}\n" +
                  "start: go\ntasks:\n  go: {use: on, with: {v: $pace}}\n",
              "E201", 4);
  expect_once(
      head + test::replaced(body, "goto: done}",
                            "goto: done}\n    exits: [{when: valid(eye) and speed(eye) < 1 m/s, for: 1 s, "
                            "goto: done}]"),
      "E301", 9);
}

TEST(Slips, the_weight_of_a_group_is_a_mass_above_zero) {
  const auto weighing = [](const std::string& weight, const std::string& axis) {
    return head + test::replaced(body, "x: {velocity: 0.1 m/s}", "weight: " + weight + ", " + axis);
  };
  const std::string along = "x: {velocity: 0.1 m/s}", turning = "rz: {velocity: 0.1 rad/s}";
  EXPECT_TRUE(said_about(weighing("3 kg", along)).all().empty());
  EXPECT_TRUE(said_about(weighing("3 kg m^2", turning)).all().empty());
  expect_once(weighing("0 kg", along), "E105", 7);
  expect_once(weighing("-1 kg", along), "E105", 7);
  expect_once(weighing("3 N", along), "E202", 7);
  expect_once(weighing("3 kg", along + ", " + turning), "E202", 7);
  EXPECT_TRUE(
      said_about(weighing("3 kg", along + ", rz: {velocity: 0.1 rad/s, weight: 2 kg m^2}")).all().empty());
}

TEST(Slips, a_speed_is_bounded_from_above_and_by_nothing_else) {
  const auto speed = [](const std::string& text) {
    return head +
           test::replaced(body, "x: {velocity: 0.1 m/s}", "x: {velocity: 0.1 m/s}, speed: {" + text + "}");
  };
  EXPECT_TRUE(said_about(speed("velocity: [0 m/s, 1 m/s]")).all().empty());
  expect_once(speed("velocity: [0.5 m/s, 1 m/s]"), "E104", 7);
  expect_once(speed("velocity: +-1 m/s"), "E104", 7);
  expect_once(speed("velocity: 1 m/s"), "E104", 7);
  expect_once(speed("position: [0 m, 1 m]"), "E101", 7);
}

TEST(Slips, a_urdf_is_no_robot_file) {
  const test::Folder folder;
  put_robot(folder);
  Diagnostics diagnostics;
  load(folder.write("task.yaml", "zwang: 1\nrobot: robots/mini.urdf\n" + body), {}, diagnostics);
  ASSERT_EQ(diagnostics.all().size(), 1u) << test::rendered(diagnostics);
  EXPECT_EQ(diagnostics.all()[0].code, "E103");
  EXPECT_NE(diagnostics.all()[0].help.find("robot init"), std::string::npos);
}

}  // namespace
}  // namespace zwang::lang
