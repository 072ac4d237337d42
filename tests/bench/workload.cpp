#include "workload.hpp"

#include <cstdlib>
#include <memory>
#include <random>

#include "../solver/robots.hpp"
#include "zwang/solver/constraint.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::bench {

using namespace solver;

namespace {

void demand(bool ok) {
  if (!ok) std::abort();  // a benchmark of failures measures nothing
}

/// Unit forces along the given axes (0 to 2 linear, 3 to 5 angular) on a body.
void add_rows(int body, const std::vector<int>& axes, std::vector<AccelerationRow>& rows) {
  for (const int axis : axes) {
    AccelerationRow row;
    row.body = body;
    (axis < 3 ? row.a.linear : row.a.angular)(axis % 3) = 1.0;
    row.b = 0.1 * static_cast<double>(rows.size() % 6 + 1);
    rows.push_back(row);
  }
}

/// A mecanum base of 46 kg, with the arm on top of it or without.
Model base(int arm_joints) {
  if (arm_joints == 0) return test::mecanum({});
  const test::MecanumFigures f;
  const Matrix3 base_inertia = Vector3(1.5, 1.6, f.yaw_inertia).asDiagonal();
  ModelBuilder builder(BaseType::ground, "base_link",
                       RigidInertia::from_com(f.base_mass, {0.0, 0.0, 0.1}, base_inertia));
  const double angles[] = {45.0, -45.0, -45.0, 45.0};
  for (int i = 0; i < 4; ++i) {
    const std::string name = "wheel" + std::to_string(i);
    Joint joint{.name = name, .type = JointType::continuous, .axis = Vector3::UnitY()};
    joint.rotor_inertia = f.rotor_inertia;
    joint.actuated = true;
    joint.max_effort = f.effort;
    const Matrix3 inertia = Vector3(f.yaw_inertia_wheel, f.spin_inertia, f.yaw_inertia_wheel).asDiagonal();
    builder.add_link(name + "_link", "base_link",
                     {Matrix3::Identity(), {(i < 2 ? 1 : -1) * f.lx, (i % 2 == 0 ? 1 : -1) * f.ly, 0.0}},
                     joint, RigidInertia::from_com(f.wheel_mass, Vector3::Zero(), inertia));
    Wheel wheel;
    wheel.radius = f.radius;
    wheel.roller_angle = angles[i] * M_PI / 180.0;
    builder.add_wheel(name, wheel);
  }
  Arm::add_to(builder, "base_link", arm_joints);
  return builder.build();
}

/// Equalities alone: `PopovVereshchagin`.
struct Unbounded {
  Unbounded(Model m, unsigned seed)
      : model(std::move(m)), states(random_states(model, seed)), solver(model), motion(model) {}
  Model model;
  std::vector<State> states;
  std::vector<AccelerationRow> rows;
  PopovVereshchagin solver;
  ConstrainedMotion motion;
};

constexpr const char* unbounded_call =
    "kinematics, sweeps, all rows as equalities, torques, accelerations, residuals, checks of the input";

Workload unbounded(const std::string& name, std::shared_ptr<Unbounded> w) {
  return {name, unbounded_call, [w](std::size_t i) {
            demand(w->solver.solve(w->states[i % state_count], w->rows, w->motion) == Status::ok);
          }};
}

/// Everything on: level-0 limits, a force row with a velocity range, bounded drivers, torque limits.
struct Full {
  explicit Full(Model m)
      : model(std::move(m)), states(random_states(model, 2)), solver(model), solution(model), state(model) {
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
    for (const AxisConstraint& constraint : {limit, x, y, rz}) demand(set.add(constraint));
  }
  void add_arm(int body) {
    AxisConstraint constraint;
    constraint.move.body = body;
    constraint.in.body = 0;
    for (const Axis axis : {Axis::x, Axis::y, Axis::z, Axis::rx, Axis::ry, Axis::rz}) {
      constraint.axis = axis;
      constraint.driver = Driver{.quantity = Quantity::velocity, .target = 0.0, .force = {-40.0, 40.0}};
      demand(set.add(constraint));
    }
  }
  void solve(const State& at) {
    demand(set.fill(model, at));
    demand(solver.solve(at, set.rows(), solution) == Status::ok);
  }
  void make_rows() {
    for (const State& at : states) {
      demand(set.fill(model, at));
      rows.push_back(set.rows());
    }
  }
  Model model;
  std::vector<State> states;
  ConstraintSet set;
  std::vector<std::vector<Row>> rows;  ///< by state
  Solver solver;
  Solution solution;
  State state;
};

constexpr const char* full_call =
    "kinematics, sweeps, two levels, force row, bounds, torque limits, accelerations, checks of the input";

Workload full(const std::string& name, std::shared_ptr<Full> w) {
  w->make_rows();
  return {name, full_call, [w](std::size_t i) {
            const std::size_t k = i % state_count;
            demand(w->solver.solve(w->states[k], w->rows[k], w->solution) == Status::ok);
          }};
}

}  // namespace

void Arm::add_to(ModelBuilder& builder, const std::string& first_parent, int links) {
  std::string parent = first_parent;
  for (int j = 0; j < links; ++j) {
    Joint joint;
    joint.name = "joint" + std::to_string(j);
    joint.type = JointType::revolute;
    joint.axis = axis(j);
    joint.actuated = true;
    joint.max_effort = 80.0;
    const std::string name = "link" + std::to_string(j);
    const int figure = j % joints;
    builder.add_link(name, parent, {Matrix3::Identity(), {0.0, 0.0, length(figure)}}, joint,
                     RigidInertia::from_com(mass(figure), com(), inertia()));
    parent = name;
  }
}

/// Positions, speeds and torques of order 1; what the ground does not allow is taken out.
std::vector<State> random_states(const Model& model, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  Solver solver(model);
  std::vector<State> states(state_count, State(model));
  for (State& state : states) {
    if (model.base_type() == BaseType::ground) {
      state.base_twist.linear = {0.3 * number(random), 0.3 * number(random), 0.0};
      state.base_twist.angular.z() = number(random);
    }
    for (int j = 0; j < model.joint_count(); ++j) {
      state.q(j) = number(random);
      state.qd(j) = number(random);
      if (model.has_fixed_base()) state.tau_ff(j) = number(random);
    }
    demand(solver.project_velocity(state) == Status::ok);
  }
  return states;
}

Workload arm_zwang(int rows) {
  ModelBuilder builder(BaseType::fixed, "base", {});
  Arm::add_to(builder, "base", Arm::joints);
  auto w = std::make_shared<Unbounded>(builder.build(), 1);
  const std::vector<int> axes{0, 1, 2, 3, 4, 5};
  add_rows(Arm::joints, {axes.begin(), axes.begin() + rows}, w->rows);
  const MotionVector up{Vector3::Zero(), -w->model.gravity()};
  return {"arm, " + std::to_string(rows) + " rows", unbounded_call, [w, up](std::size_t i) {
            demand(w->solver.solve(w->states[i % state_count], w->rows, up, w->motion) == Status::ok);
          }};
}

Workload base_rows() {
  auto w = std::make_shared<Unbounded>(base(0), 2);
  add_rows(0, {0, 1, 5}, w->rows);
  return unbounded("base, 10 rows", w);
}

Model base_on_eccentric_wheels() {
  return test::mecanum({.eccentricity = 0.001});
}

Workload eccentric_base_rows() {
  auto w = std::make_shared<Unbounded>(base_on_eccentric_wheels(), 2);
  add_rows(0, {0, 1, 5}, w->rows);
  return unbounded("eccentric base, 10 rows", w);
}

Workload eccentric_base_full() {
  return full("eccentric base, full problem", std::make_shared<Full>(base_on_eccentric_wheels()));
}

Workload mobile_arm_rows() {
  auto w = std::make_shared<Unbounded>(base(Arm::joints), 2);
  add_rows(0, {0, 1, 5}, w->rows);
  add_rows(4 + Arm::joints, {0, 1, 2, 3, 4, 5}, w->rows);
  return unbounded("base + arm, 16 rows", w);
}

std::string chain_name(int links, int rows) {
  return std::to_string(links) + " links, " + std::to_string(rows) + " rows";
}

Workload chain(int links, int rows) {
  ModelBuilder builder(BaseType::fixed, "base", {});
  Arm::add_to(builder, "base", links);
  auto w = std::make_shared<Unbounded>(builder.build(), 3);
  for (int k = 0; k < rows; ++k) add_rows(links - k / 6 * (links / 4), {k % 6}, w->rows);
  // Two states in turn: with one the inertias would be kept, and many would measure the cache.
  return {chain_name(links, rows), unbounded_call, [w](std::size_t i) {
            demand(w->solver.solve(w->states[i % 2], w->rows, w->motion) == Status::ok);
          }};
}

Workload base_full() {
  return full("base, full problem", std::make_shared<Full>(base(0)));
}

Workload mobile_arm_full() {
  auto w = std::make_shared<Full>(base(Arm::joints));
  w->add_arm(4 + Arm::joints);
  return full("base + arm, full problem", w);
}

Workload base_with_rows() {
  auto w = std::make_shared<Full>(base(0));
  return {"base, rows and problem", "coordinates and rows from constraints, and the full problem",
          [w](std::size_t i) { w->solve(w->states[i % state_count]); }};
}

Workload base_tick() {
  auto w = std::make_shared<Full>(base(0));
  return {"base, full tick", "project_velocity and all of the above", [w](std::size_t i) {
            w->state = w->states[i % state_count];
            demand(w->solver.project_velocity(w->state) == Status::ok);
            w->solve(w->state);
          }};
}

}  // namespace zwang::bench
