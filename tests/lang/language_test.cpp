// The parts of the language beyond one wall: signals, templates, regions, features, `always`.
#include <gtest/gtest.h>

#include <numbers>

#include "support.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::lang {
namespace {

using test::rendered;

/// The draft task files: read-only test data that is not part of the project.
class DraftCases : public testing::TestWithParam<const char*> {};

std::optional<Program> load_case(const std::string& name, Diagnostics& diagnostics) {
  const test::Folder folder;
  for (const char* file : {"mecanum_base.yaml", "mecanum_base.urdf"}) {
    folder.write(std::string("robots/") + file, test::slurp(test::source_dir / "specs/robots" / file));
  }
  folder.write("scenes/wall.yaml", test::slurp(test::source_dir / "specs/scenes/wall.yaml"));
  const std::string text = test::slurp(test::source_dir / "../shared/cases" / (name + ".yaml"));
  return load(folder.write(name + ".yaml", text), {}, diagnostics);
}

bool has_cases() {
  return std::filesystem::is_directory(test::source_dir / "../shared/cases");
}

TEST_P(DraftCases, are_accepted_without_a_remark) {
  if (!has_cases()) GTEST_SKIP() << "the draft cases are not here";
  Diagnostics diagnostics;
  EXPECT_TRUE(load_case(GetParam(), diagnostics)) << rendered(diagnostics);
  // The draft of the hospital asks for a pause 0.34 m later than its base can stop. Three of the drafts limit
  // the acceleration in the plane by a range on each axis.
  for (const Diagnostic& d : diagnostics.all())
    EXPECT_TRUE(d.code == "W620" || d.code == "W641") << rendered(diagnostics);
}

INSTANTIATE_TEST_SUITE_P(Files, DraftCases, testing::Values("wall_align", "obstacle", "docking", "hospital"),
                         [](const auto& test_case) { return std::string(test_case.param); });

constexpr const char* whole_language = R"(zwang: 1
robot: robots/mini.yaml
params:
  soft: {value: 60 N, range: [20 N, 100 N]}
signals:
  partner: {type: pose, in: base_link, stale_after: 300 ms}
  wanted:  {type: number, unit: cm/s, stale_after: 100 ms}
  latch:   {type: bool, stale_after: 500 ms}
frames:
  socket: {parent: partner, at: [-0.5 m, 0 m]}
regions:
  hall: {polygon: [[0 m, 0 m], [0 m, 2 m], [3 m, 0 m]]}
  ring: {circle: {at: [1 m, 2 m], radius: 3 m}, parent: socket}
features:
  reach: {distance: [bumper, socket]}
  skew: {angle: [base_link.x, socket.x]}
  slant: {direction: {move: base_link, in: world, x: 1, y: -1}}
always:
  constraints:
    fence: {move: footprint, inside: hall, margin: 10 cm}
    manners: {move: base_link, in: base_link, speed: {velocity: [0 m/s, 0.5 m/s]}, x: {force: +-$soft}}
  exits:
    - {when: reach < 0.8 m, release: 1.2 m, for: 0.1 s, goto: pause}
templates:
  go_to:
    args: {target: frame, pace: velocity, then: task}
    body:
      constraints:
        go: {move: base_link, in: $target, x: {position: 0 m, velocity: +-$pace}, rz: {position: 0 deg}}
      exits:
        - {when: abs(go.x.position) < 5 cm and reach > 1 m, for: 0.3 s, goto: $then}
      timeout: {after: 10 s, goto: failed}
start: near
tasks:
  near: {use: go_to, with: {target: socket, pace: 0.2 m/s, then: spring}, timeout: never}
  spring:
    enter: {require: latch and valid(wanted)}
    attempts: {max: 3, goto: failed}
    constraints:
      hold:
        move: base_link
        in: socket
        level: 2
        weight: 5 kg
        x: {position: 0 m, stiffness: 1 kN/m, damping: 100 N s/m}
        y: {velocity: wanted, level: 3}
      touch: {feature: reach, velocity: 0.1 m/s, force: +-5 N}
    exits:
      - {when: hold.y.saturated or manners.x.velocity > 1 m/s, for: 0.1 s, goto: done}
      - {when: elapsed > 2 s, goto: done}
  pause:
    exits: [{when: reach > 1.2 m, for: 1 s, goto: back}]
    timeout: {after: 5 min, goto: failed}
)";

class WholeLanguage : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* file : {"mini.yaml", "mini.urdf"}) {
      folder_.write(std::string("robots/") + file,
                    test::slurp(test::source_dir / "tests/conformance/robots" / file));
    }
    program_ = load(folder_.write("t.yaml", whole_language), {}, diagnostics_);
    ASSERT_TRUE(program_) << rendered(diagnostics_);
  }

  test::Folder folder_;
  Diagnostics diagnostics_;
  std::optional<Program> program_;
};

TEST_F(WholeLanguage, templates_become_tasks_of_their_own) {
  const Task& near = program_->tasks[0];
  EXPECT_EQ(near.name, "near");
  EXPECT_FALSE(near.timeout) << "the task's own `never` stands in the place of the template's";
  ASSERT_EQ(near.groups.size(), 1u);
  EXPECT_EQ(program_->frames[static_cast<std::size_t>(near.groups[0].in)].name, "socket");
  EXPECT_DOUBLE_EQ(near.groups[0].axes[0].velocity->low.constant, -0.2);
  EXPECT_DOUBLE_EQ(near.groups[0].axes[0].velocity->high.constant, 0.2);
  EXPECT_EQ(near.exits[0].target.task, 1);
}

TEST_F(WholeLanguage, signals_keep_their_units_and_frames) {
  ASSERT_EQ(program_->signals.size(), 3u);
  EXPECT_EQ(program_->signals[0].type, SignalType::pose);
  EXPECT_EQ(program_->frames[static_cast<std::size_t>(program_->signals[0].in)].name, "base_link");
  EXPECT_DOUBLE_EQ(program_->signals[1].unit_scale, 0.01);
  EXPECT_DOUBLE_EQ(program_->signals[2].stale_after.constant, 0.5);
  const FrameDeclaration& socket = program_->frames.back();
  EXPECT_EQ(socket.parent, FrameParent::signal);
  EXPECT_EQ(socket.parent_index, 0);
}

TEST_F(WholeLanguage, regions_run_counter_clockwise) {
  ASSERT_EQ(program_->regions.size(), 2u);
  const auto& corners = program_->regions[0].polygon;
  double area = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto& next = corners[(i + 1) % corners.size()];
    area += 0.5 * (corners[i][0] * next[1] - next[0] * corners[i][1]);
  }
  EXPECT_DOUBLE_EQ(area, 3.0);
  EXPECT_DOUBLE_EQ(program_->regions[1].radius, 3.0);
}

TEST_F(WholeLanguage, features_know_what_they_measure) {
  ASSERT_EQ(program_->features.size(), 3u);
  EXPECT_FALSE(program_->features[0].turns);
  EXPECT_TRUE(program_->features[1].turns);
  EXPECT_DOUBLE_EQ(program_->features[2].direction[1], -1.0);
  const Group& touch = program_->tasks[1].groups[1];
  EXPECT_EQ(touch.kind, GroupKind::feature);
  EXPECT_EQ(touch.feature, 0);
  EXPECT_EQ(touch.axes[0].driver, solver::Quantity::velocity);
}

TEST_F(WholeLanguage, always_stands_at_level_zero) {
  ASSERT_EQ(program_->always.groups.size(), 2u);
  const Group& fence = program_->always.groups[0];
  EXPECT_EQ(fence.kind, GroupKind::inside);
  EXPECT_TRUE(fence.moves_footprint);
  EXPECT_EQ(fence.level, 0);
  EXPECT_DOUBLE_EQ(fence.margin.constant, 0.1);
  const Group& manners = program_->always.groups[1];
  EXPECT_EQ(manners.axes[0].level, 0);
  EXPECT_EQ(manners.axes[0].force->low.parameter, 0);
  EXPECT_DOUBLE_EQ(manners.axes[0].force->low.sign, -1.0);
  EXPECT_TRUE(manners.axes[1].is_planar);
  ASSERT_EQ(program_->always.exits.size(), 1u);
  EXPECT_DOUBLE_EQ(program_->always.exits[0].release->constant, 1.2);
}

TEST_F(WholeLanguage, manner_is_inherited_from_the_group) {
  const Task& spring = program_->tasks[1];
  const Group& hold = spring.groups[0];
  EXPECT_EQ(hold.axes[0].level, 2);
  EXPECT_EQ(hold.axes[1].level, 3);
  EXPECT_DOUBLE_EQ(hold.axes[0].stiffness->constant, 1000.0);
  EXPECT_DOUBLE_EQ(hold.axes[0].damping->constant, 100.0);
  EXPECT_DOUBLE_EQ(hold.axes[1].weight->constant, 5.0);
  EXPECT_EQ(hold.axes[1].target.signal, 1);
  ASSERT_TRUE(spring.require);
  EXPECT_EQ(spring.require->nodes.back().op, Op::logical_and);
  ASSERT_TRUE(spring.attempts);
  EXPECT_EQ(spring.attempts->most, 3);
  EXPECT_EQ(program_->tasks[2].exits[0].target.kind, TargetKind::back);
  const auto& nodes = spring.exits[0].when.nodes;
  EXPECT_FALSE(nodes[0].in_always);
  EXPECT_TRUE(nodes[1].in_always);
  EXPECT_EQ(nodes[1].index, 1);
}

}  // namespace
}  // namespace zwang::lang
