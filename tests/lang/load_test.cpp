#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "support.hpp"
#include "words/nearest.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::lang {
namespace {

using solver::Axis;
using test::count;
using test::rendered;
using test::source_dir;

TEST(WallAlign, becomes_the_program_that_it_describes) {
  Diagnostics diagnostics;
  const auto program = load(source_dir / "specs/wall_align.yaml", {}, diagnostics);
  ASSERT_TRUE(program) << rendered(diagnostics);
  EXPECT_TRUE(diagnostics.all().empty()) << rendered(diagnostics);

  ASSERT_EQ(program->parameters.size(), 3u);
  EXPECT_EQ(program->parameters[0].name, "push");
  EXPECT_DOUBLE_EQ(program->parameters[0].value, 20.0);
  EXPECT_DOUBLE_EQ(program->parameters[0].range->high, 40.0);

  EXPECT_EQ(program->frames[0].name, "world");
  EXPECT_EQ(program->frames[0].parent, FrameParent::world);
  const auto& robot_frames = program->robot.model.frames();
  for (std::size_t i = 0; i < robot_frames.size(); ++i) {
    EXPECT_EQ(program->frames[i + 1].name, robot_frames[i].name);
    EXPECT_EQ(program->frames[i + 1].parent, FrameParent::body);
    EXPECT_EQ(program->frames[i + 1].parent_index, robot_frames[i].body);
  }
  EXPECT_EQ(program->frames.back().name, "wall");
  EXPECT_EQ(program->frames.back().parent, FrameParent::world);

  ASSERT_EQ(program->tasks.size(), 2u);
  EXPECT_EQ(program->start, 0);
  const Task& press = program->tasks[0];
  ASSERT_EQ(press.groups.size(), 1u);
  const Group& contact = press.groups[0];
  EXPECT_EQ(program->frames[static_cast<std::size_t>(contact.move)].name, "base");
  EXPECT_EQ(contact.in, contact.move);
  ASSERT_EQ(contact.axes.size(), 3u);
  const AxisStatements& x = contact.axes[0];
  EXPECT_EQ(x.name, "contact.x");
  EXPECT_EQ(x.driver, solver::Quantity::force);
  EXPECT_EQ(x.target.parameter, 0);
  ASSERT_TRUE(x.velocity);
  EXPECT_DOUBLE_EQ(x.velocity->low.constant, -0.05);
  EXPECT_DOUBLE_EQ(x.velocity->high.constant, 0.08);
  EXPECT_FALSE(x.force);
  EXPECT_EQ(x.level, 1);
  EXPECT_EQ(x.statement_spans[static_cast<std::size_t>(solver::Quantity::force)].begin.line, 24);
  EXPECT_EQ(contact.axes[1].driver, solver::Quantity::velocity);
  EXPECT_EQ(contact.axes[2].axis, Axis::rz);
  EXPECT_FALSE(contact.axes[2].driver);

  ASSERT_EQ(press.exits.size(), 1u);
  EXPECT_DOUBLE_EQ(press.exits[0].dwell.constant, 0.2);
  EXPECT_EQ(press.exits[0].target.kind, TargetKind::task);
  EXPECT_EQ(press.exits[0].target.task, 1);
  ASSERT_EQ(press.exits[0].set.size(), 1u);
  EXPECT_EQ(program->frames[static_cast<std::size_t>(press.exits[0].set[0].index)].name, "wall");
  ASSERT_TRUE(press.timeout);
  EXPECT_EQ(press.timeout->after.parameter, 1);
  EXPECT_EQ(press.timeout->target.kind, TargetKind::failed);

  const Task& hold = program->tasks[1];
  EXPECT_DOUBLE_EQ(hold.blend.constant, 0.3);
  ASSERT_EQ(hold.groups.size(), 2u);
  ASSERT_EQ(hold.groups[0].axes.size(), 2u);
  EXPECT_EQ(hold.groups[0].axes[1].axis, Axis::rz);
  EXPECT_DOUBLE_EQ(hold.groups[0].axes[1].time_constant.constant, 0.4);
  ASSERT_EQ(hold.groups[1].axes.size(), 1u);
  EXPECT_EQ(hold.groups[1].axes[0].axis, Axis::y);
  EXPECT_DOUBLE_EQ(hold.groups[1].axes[0].time_constant.constant, 0.5);
  EXPECT_EQ(hold.exits[0].target.kind, TargetKind::done);
}

/// 30 N brake the real base with 30 N / 57 kg = 0.5 m/s^2. A base that is led by a virtual robot of eight
/// times its mass brakes with 0.07 m/s^2: it needs 2.7 m from 0.6 m/s.
TEST(Hospital, warns_a_base_that_feels_late_that_it_stops_too_late) {
  for (const auto& [robot, told] :
       {std::pair{"mecanum_base", 0}, std::pair{"feels/mecanum_wrench_50_hz", 1}}) {
    Diagnostics diagnostics;
    const LoadOptions options{.robot = source_dir / "specs/robots" / (std::string(robot) + ".yaml")};
    EXPECT_TRUE(load(source_dir / "specs/hospital.yaml", options, diagnostics));
    EXPECT_EQ(count(diagnostics, "W620") > 0, told == 1) << robot << rendered(diagnostics);
  }
}

TEST(WallAlign, conditions_keep_operands_before_operators) {
  Diagnostics diagnostics;
  const auto program = load(source_dir / "specs/wall_align.yaml", {}, diagnostics);
  ASSERT_TRUE(program);
  const Condition& when = program->tasks[0].exits[0].when;
  for (std::size_t i = 0; i < when.nodes.size(); ++i) {
    EXPECT_LT(when.nodes[i].left, static_cast<int>(i));
    EXPECT_LT(when.nodes[i].right, static_cast<int>(i));
  }
  EXPECT_EQ(when.nodes.back().op, Op::logical_and);
  const ExpressionNode& first = when.nodes[0];
  EXPECT_EQ(first.op, Op::coordinate);
  EXPECT_EQ(first.index, 0);
  EXPECT_EQ(first.axis, 0);
  EXPECT_EQ(first.what, CoordinateQuantity::velocity);
}

TEST(MecanumBase, is_the_robot_of_its_data_sheets) {
  Diagnostics diagnostics;
  const auto robot = load_robot(source_dir / "specs/robots/mecanum_base.yaml", diagnostics);
  ASSERT_TRUE(robot) << rendered(diagnostics);
  EXPECT_NEAR(robot->model.total_mass(), 36.8 + 4 * 2.3, 1e-12);
  EXPECT_EQ(robot->model.joint_count(), 4);
  EXPECT_EQ(robot->base_frame, "base_link");
  ASSERT_EQ(robot->model.wheels().size(), 4u);
  const double quarter = std::numbers::pi / 4;
  for (const solver::Wheel& wheel : robot->model.wheels()) {
    const solver::Body& body = robot->model.bodies()[static_cast<std::size_t>(wheel.body)];
    EXPECT_DOUBLE_EQ(wheel.radius, 0.0759);
    EXPECT_DOUBLE_EQ(body.pose_in_parent.position.z(), wheel.radius);
    // Front left and rear right have +45 deg: x y > 0 there.
    const double side = body.pose_in_parent.position.x() * body.pose_in_parent.position.y();
    EXPECT_DOUBLE_EQ(*wheel.roller_angle, side > 0 ? quarter : -quarter);
    EXPECT_DOUBLE_EQ(body.joint.rotor_inertia, 26.0 * 26.0 * 13.5e-6);
    EXPECT_DOUBLE_EQ(body.joint.max_effort, 1.92);
    EXPECT_TRUE(body.joint.actuated);
  }
  const solver::RigidInertia& base = robot->model.bodies()[0].inertia;
  EXPECT_NEAR(base.first_moment.x(), 0.0, 1e-12);
  EXPECT_NEAR(base.first_moment.y(), 0.0, 1e-12);
  EXPECT_EQ(robot->limits.size(), 6u);
  EXPECT_EQ(robot->footprint.size(), 4u);
  EXPECT_TRUE(robot->model.find_frame("bumper"));
  EXPECT_DOUBLE_EQ(robot->stop.force, 80.0);
}

TEST(WallScene, stands_half_a_metre_ahead_of_the_first_corner) {
  Diagnostics diagnostics;
  const auto scene = load_scene(source_dir / "specs/scenes/wall.yaml", diagnostics);
  ASSERT_TRUE(scene) << rendered(diagnostics);
  const double yaw = 20.0 * std::numbers::pi / 180.0;
  EXPECT_DOUBLE_EQ(scene->start_yaw, yaw);
  ASSERT_EQ(scene->objects.size(), 1u);
  const SceneObject& wall = scene->objects[0];
  EXPECT_EQ(wall.shape, ShapeKind::wall);
  EXPECT_NEAR(wall.at[0] - (0.40 * std::cos(yaw) + 0.28 * std::sin(yaw)), 0.5, 1e-3);
  EXPECT_DOUBLE_EQ(wall.stiffness, 1e5);
  EXPECT_EQ(wall.friction, 0.0);
  EXPECT_FALSE(wall.mass);
}

TEST(Overrides, take_the_place_of_the_files_own_value) {
  Diagnostics diagnostics;
  LoadOptions options;
  options.parameters["push"] = "35N";
  const auto program = load(source_dir / "specs/wall_align.yaml", options, diagnostics);
  ASSERT_TRUE(program) << rendered(diagnostics);
  EXPECT_DOUBLE_EQ(program->parameters[0].value, 35.0);
}

TEST(Overrides, outside_the_range_name_it_and_its_line) {
  Diagnostics diagnostics;
  LoadOptions options;
  options.parameters["push"] = "200N";
  EXPECT_FALSE(load(source_dir / "specs/wall_align.yaml", options, diagnostics));
  ASSERT_EQ(diagnostics.error_count(), 1);
  const Diagnostic d = diagnostics.sorted()[0];
  EXPECT_EQ(d.code, "E204");
  EXPECT_NE(d.message.find("5 N to 40 N"), std::string::npos) << d.message;
  ASSERT_EQ(d.related.size(), 1u);
  EXPECT_EQ(d.related[0].span.begin.line, 9);
  EXPECT_NE(d.related[0].text.find("line 9"), std::string::npos);
}

TEST(Overrides, are_checked_like_the_file) {
  for (const auto& [name, text, code] :
       {std::tuple{"push", "20", "E201"}, std::tuple{"push", "2 m", "E202"},
        std::tuple{"push", "2 n", "E203"}, std::tuple{"pusch", "20 N", "E301"},
        std::tuple{"push", "", "E105"}, std::tuple{"push", "$push", "E105"}}) {
    Diagnostics diagnostics;
    LoadOptions options;
    options.parameters[name] = text;
    EXPECT_FALSE(load(source_dir / "specs/wall_align.yaml", options, diagnostics));
    EXPECT_EQ(count(diagnostics, code), 1) << name << "=" << text << "\n" << rendered(diagnostics);
    EXPECT_EQ(diagnostics.error_count(), 1) << rendered(diagnostics);
  }
}

/// A program that runs a task may set any parameter: those without a range are bound by their places.
TEST(Parameters, without_a_range_are_bound_by_their_places) {
  const test::Folder folder;
  for (const char* name : {"mecanum_base.yaml", "mecanum_base.urdf"})
    folder.write(name, test::slurp(source_dir / "specs/robots" / name));
  folder.write("task.yaml", R"(zwang: 1
robot: mecanum_base.yaml
params: {k: 200 N/m, pace: 0.1 m/s, low: -1 N, high: 3 N, push: 5 N}
start: a
tasks:
  a:
    constraints:
      c: {move: base_link, in: world, x: {position: 1 m, stiffness: $k, damping: 90 N s/m, force: [$low, $high], velocity: +-$pace}}
      p: {move: base_link, in: base_link, y: {force: $push, velocity: +-0.1 m/s}}
    timeout: {after: 1 s, goto: done}
)");
  Diagnostics diagnostics;
  const auto program = load(folder.path() / "task.yaml", {}, diagnostics);
  ASSERT_TRUE(program) << rendered(diagnostics);
  const auto range = [&](std::size_t i) { return program->parameters[i].range; };
  ASSERT_TRUE(range(0) && range(1) && range(2) && range(3));
  EXPECT_GT(range(0)->low, 0.0);
  EXPECT_EQ(range(1)->low, 0.0);
  EXPECT_EQ(range(2)->high, 0.0) << "a force range holds 0";
  EXPECT_EQ(range(3)->low, 1.0) << "halfway between -1 N and 3 N, which is above 0 N";
  EXPECT_FALSE(range(4)) << "any force drives";
}

TEST(Roots, keep_reading_below_them) {
  const test::Folder folder;
  const std::string task = test::slurp(source_dir / "specs/wall_align.yaml");
  for (const char* name : {"mecanum_base.yaml", "mecanum_base.urdf"}) {
    folder.write(std::string("robots/") + name, test::slurp(source_dir / "specs/robots" / name));
  }
  folder.write("scenes/wall.yaml", test::slurp(source_dir / "specs/scenes/wall.yaml"));
  const auto inside = folder.write("wall_align.yaml", task);
  const auto below =
      folder.write("tasks/up.yaml",
                   test::replaced(test::replaced(task, "robots/", "../robots/"), "scenes/", "../scenes/"));
  std::filesystem::create_symlink(source_dir / "specs/robots/mecanum_base.yaml", folder.path() / "link.yaml");
  const auto linked = folder.write("linked.yaml", test::replaced(task, "robots/mecanum_base", "link"));
  const auto url = folder.write("url.yaml", test::replaced(task, "robots/", "http://example.org/"));
  const auto device = folder.write("device.yaml", test::replaced(task, "robots/mecanum_base.yaml", "robots"));

  const auto errors = [](const std::filesystem::path& path) {
    Diagnostics diagnostics;
    const bool is_loaded = load(path, {}, diagnostics).has_value();
    EXPECT_EQ(is_loaded, !diagnostics.has_errors()) << rendered(diagnostics);
    return count(diagnostics, "E109");
  };
  EXPECT_EQ(errors(inside), 0);
  EXPECT_EQ(errors(below), 2) << "robot and scene lie outside tasks/";
  EXPECT_EQ(errors(linked), 1);
  EXPECT_EQ(errors(url), 1);
  EXPECT_EQ(errors(device), 1);
  folder.write(".zwang-root", "");
  EXPECT_EQ(errors(below), 0);
}

TEST(Roots, tell_what_is_not_there_from_what_is_outside) {
  const test::Folder folder;
  folder.write(".zwang-root", "");
  folder.write("tasks/go.yaml", test::replaced(test::slurp(source_dir / "specs/wall_align.yaml"),
                                               "robots/mecanum_base", "../gone"));
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  Diagnostics diagnostics;
  EXPECT_FALSE(load("tasks/go.yaml", {}, diagnostics));
  std::filesystem::current_path(before);
  EXPECT_NE(rendered(diagnostics).find("cannot read `gone.yaml`"), std::string::npos)
      << rendered(diagnostics);
}

TEST(Json, gives_ranges_and_replacements) {
  Diagnostics diagnostics;
  const test::Folder folder;
  const auto path =
      folder.write("t.yaml", "zwang: 1\nrobt: x.yaml\nstart: a\ntasks: {a: {timeout: never}}\n");
  EXPECT_FALSE(load(path, {}, diagnostics));
  const auto json = nlohmann::json::parse(render_json(diagnostics));
  ASSERT_EQ(json.size(), 1u) << json;
  EXPECT_EQ(json[0]["code"], "E101");
  EXPECT_EQ(json[0]["range"]["start"], (nlohmann::json{{"line", 2}, {"column", 1}}));
  EXPECT_EQ(json[0]["range"]["end"], (nlohmann::json{{"line", 2}, {"column", 5}}));
  EXPECT_EQ(json[0]["replacement"], "robot");
}

TEST(Nearest, suggests_only_what_is_near) {
  EXPECT_EQ(nearest("velcity", {"position", "velocity", "force"}), "velocity");
  EXPECT_EQ(nearest("bumpr", {"base_link", "bumper"}), "bumper");
  EXPECT_EQ(nearest("goot", {"when", "goto", "for"}), "goto");
  EXPECT_EQ(nearest("zebra", {"when", "goto", "for"}), "");
  EXPECT_EQ(nearest("x", {"y", "z"}), "");
}

}  // namespace
}  // namespace zwang::lang
