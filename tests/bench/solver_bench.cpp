// One call of the solver beside one call of its peers, on the same model, states and rows. Outside the timed
// part on both sides: building the model, the workspace, the states. Inside on both sides: kinematics,
// dynamics, rows, accelerations of all links, and the solver's own torques and checks.
#include <benchmark/benchmark.h>

#include <cmath>
#include <kdl/chain.hpp>
#include <kdl/chainhdsolver_vereshchagin.hpp>
#include <random>
#include <string>
#include <vector>

#include "../solver/robots.hpp"
#include "zwang/solver/popov_vereshchagin.hpp"
#include "zwang/solver/solver.hpp"

namespace {

using namespace zwang::solver;

constexpr int state_count = 64;

/// Alternating axes, link lengths and masses of a light seven-joint arm.
struct Arm {
  Model model = make_model();
  KDL::Chain chain = make_chain();
  static constexpr int joints = 7;

  static Vector3 axis(int j) { return j % 2 == 0 ? Vector3::UnitZ() : Vector3::UnitY(); }
  static double length(int j) { return j % 2 == 0 ? 0.16 : 0.2; }
  static double mass(int j) { return 3.5 - 0.3 * j; }
  static Vector3 com() { return {0.01, -0.02, 0.08}; }
  static Matrix3 inertia() { return Vector3(0.02, 0.018, 0.006).asDiagonal(); }

  static Model make_model() {
    ModelBuilder builder(BaseType::fixed, "base", {});
    std::string parent = "base";
    for (int j = 0; j < joints; ++j) {
      Joint joint;
      joint.name = "joint" + std::to_string(j);
      joint.type = JointType::revolute;
      joint.axis = axis(j);
      joint.actuated = true;
      const std::string name = "link" + std::to_string(j);
      builder.add_link(name, parent, {Matrix3::Identity(), {0.0, 0.0, length(j)}}, joint,
                       RigidInertia::from_com(mass(j), com(), inertia()));
      parent = name;
    }
    return builder.build();
  }

  static KDL::Chain make_chain() {
    KDL::Chain chain;
    for (int j = 0; j < joints; ++j) {
      const Vector3 a = axis(j);
      const KDL::Vector origin(0.0, 0.0, length(j));
      const KDL::Joint joint("joint" + std::to_string(j), origin, {a.x(), a.y(), a.z()}, KDL::Joint::RotAxis);
      const Matrix3 I = inertia();
      chain.addSegment(
          KDL::Segment("link" + std::to_string(j), joint, KDL::Frame(origin),
                       KDL::RigidBodyInertia(mass(j), {com().x(), com().y(), com().z()},
                                             KDL::RotationalInertia(I(0, 0), I(1, 1), I(2, 2)))));
    }
    return chain;
  }

  std::vector<State> states() const {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    std::vector<State> result(state_count, State(model));
    for (State& state : result) {
      for (int j = 0; j < joints; ++j) {
        state.q(j) = number(random);
        state.qd(j) = number(random);
        state.tau_ff(j) = number(random);
      }
    }
    return result;
  }
};

/// The first `count` of six unit forces on the last link.
std::vector<AccelerationRow> rows_on(int body, int count) {
  std::vector<AccelerationRow> rows;
  for (int i = 0; i < count; ++i) {
    AccelerationRow row;
    row.body = body;
    (i < 3 ? row.a.linear : row.a.angular)(i % 3) = 1.0;
    row.b = 0.1 * (i + 1);
    rows.push_back(row);
  }
  return rows;
}

void arm_zwang(benchmark::State& bench) {
  const Arm arm;
  const std::vector<State> states = arm.states();
  const auto rows = rows_on(Arm::joints, static_cast<int>(bench.range(0)));
  PopovVereshchagin solver(arm.model);
  ConstrainedMotion motion(arm.model);
  const MotionVector base_acceleration{Vector3::Zero(), -arm.model.gravity()};
  std::size_t i = 0;
  for (auto _ : bench) {
    const Status status = solver.solve(states[i++ % state_count], rows, base_acceleration, motion);
    benchmark::DoNotOptimize(status);
    benchmark::DoNotOptimize(motion.qdd.data());
  }
}
BENCHMARK(arm_zwang)->Name("arm/zwang")->Arg(1)->Arg(3)->Arg(6);

void arm_kdl(benchmark::State& bench) {
  const Arm arm;
  const auto constraints = static_cast<unsigned>(bench.range(0));
  KDL::ChainHdSolver_Vereshchagin solver(arm.chain, KDL::Twist({0.0, 0.0, 9.81}, KDL::Vector::Zero()),
                                         constraints);
  KDL::Jacobian alpha(constraints);
  KDL::JntArray beta(constraints);
  for (unsigned k = 0; k < constraints; ++k) {
    KDL::Twist unit = KDL::Twist::Zero();
    unit(static_cast<int>(k)) = 1.0;
    alpha.setColumn(k, unit);
    beta(k) = 0.1 * (k + 1);
  }
  std::vector<KDL::JntArray> q, qd, tau;
  for (const State& state : arm.states()) {
    q.emplace_back(Arm::joints);
    qd.emplace_back(Arm::joints);
    tau.emplace_back(Arm::joints);
    q.back().data = state.q;
    qd.back().data = state.qd;
    tau.back().data = state.tau_ff;
  }
  const KDL::Wrenches f_ext(Arm::joints, KDL::Wrench::Zero());
  KDL::JntArray qdd(Arm::joints), constraint_torque(Arm::joints);
  std::size_t i = 0;
  for (auto _ : bench) {
    const std::size_t k = i++ % state_count;
    benchmark::DoNotOptimize(
        solver.CartToJnt(q[k], qd[k], qdd, alpha, beta, f_ext, tau[k], constraint_torque));
    benchmark::DoNotOptimize(qdd.data.data());
  }
}
BENCHMARK(arm_kdl)->Name("arm/kdl_debian")->Arg(1)->Arg(3)->Arg(6);

std::vector<State> base_states(const Model& model) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  Solver solver(model);
  std::vector<State> result(state_count, State(model));
  for (State& state : result) {
    state.base_twist.linear = {0.3 * number(random), 0.3 * number(random), 0.0};
    state.base_twist.angular.z() = number(random);
    for (int j = 0; j < model.joint_count(); ++j) state.q(j) = number(random);
    benchmark::DoNotOptimize(solver.project_velocity(state));
  }
  return result;
}

/// Base and four wheels: three rows of the ground on the base, four of the wheels, three of the task.
void base_unbounded(benchmark::State& bench) {
  const Model model = test::mecanum({});
  const std::vector<State> states = base_states(model);
  std::vector<AccelerationRow> rows;
  for (const int i : {0, 1, 5}) rows.push_back(rows_on(0, 6)[static_cast<std::size_t>(i)]);
  PopovVereshchagin solver(model);
  ConstrainedMotion motion(model);
  std::size_t i = 0;
  for (auto _ : bench) {
    benchmark::DoNotOptimize(solver.solve(states[i++ % state_count], rows, motion));
    benchmark::DoNotOptimize(motion.qdd.data());
  }
}
BENCHMARK(base_unbounded)->Name("base/zwang_unbounded_10_rows");

/// The same base with everything on: level-0 limits, a force row with a velocity range, bounded drivers,
/// torque limits.
void base_full(benchmark::State& bench) {
  const Model model = test::mecanum({});
  const std::vector<State> states = base_states(model);
  AxisConstraint x, y, rz, limit;
  x.move.body = x.in.body = 0;
  y = rz = limit = x;
  x.driver = Driver{.quantity = Quantity::force, .target = 20.0};
  x.velocity = Range{-0.05, 0.08};
  y.axis = Axis::y;
  y.driver = Driver{.quantity = Quantity::velocity, .target = 0.0, .force = {-30.0, 30.0}};
  rz.axis = Axis::rz;
  rz.driver = Driver{.quantity = Quantity::velocity, .target = 0.2, .force = {-15.0, 15.0}};
  limit.level = 0;
  limit.acceleration = Range{-0.5, 0.5};
  ConstraintSet set;
  for (const AxisConstraint& constraint : {limit, x, y, rz}) benchmark::DoNotOptimize(set.add(constraint));
  Solver solver(model);
  Solution solution(model);
  std::size_t i = 0;
  int iterations = 0;
  for (auto _ : bench) {
    const State& state = states[i++ % state_count];
    benchmark::DoNotOptimize(set.fill(model, state));
    benchmark::DoNotOptimize(solver.solve(state, set.rows(), solution));
    iterations += solution.iterations;
  }
  bench.counters["active_set_iterations"] =
      benchmark::Counter(static_cast<double>(iterations), benchmark::Counter::kAvgIterations);
}
BENCHMARK(base_full)->Name("base/zwang_full_problem");

/// Growth in links: a serial chain under six rows.
void chain_growth(benchmark::State& bench) {
  const int links = static_cast<int>(bench.range(0));
  ModelBuilder builder(BaseType::fixed, "base", {});
  std::string parent = "base";
  for (int j = 0; j < links; ++j) {
    Joint joint;
    joint.name = "joint" + std::to_string(j);
    joint.type = JointType::revolute;
    joint.axis = Arm::axis(j);
    joint.actuated = true;
    const std::string name = "link" + std::to_string(j);
    builder.add_link(name, parent, {Matrix3::Identity(), {0.0, 0.0, 0.1}}, joint,
                     RigidInertia::from_com(1.0, Arm::com(), Arm::inertia()));
    parent = name;
  }
  const Model model = builder.build();
  State state(model);
  for (int j = 0; j < links; ++j) state.q(j) = std::sin(1.0 + j);
  const auto rows = rows_on(links, 6);
  PopovVereshchagin solver(model);
  ConstrainedMotion motion(model);
  for (auto _ : bench) benchmark::DoNotOptimize(solver.solve(state, rows, motion));
  bench.SetComplexityN(links);
}
BENCHMARK(chain_growth)->Name("growth/links")->RangeMultiplier(2)->Range(8, 256)->Complexity(benchmark::oN);

}  // namespace

BENCHMARK_MAIN();
