// Algorithm 1 as a plain call: the tool of an arm of seven joints accelerates along its own z, and in no
// other way.
#include <cstdio>
#include <string>
#include <vector>

#include "zwang/solver/popov_vereshchagin.hpp"

int main() {
  using namespace zwang::solver;
  const auto link = RigidInertia::from_com(2.0, {0.0, 0.0, 0.12}, 0.01 * Matrix3::Identity());
  ModelBuilder builder(BaseType::fixed, "base", link);
  for (int i = 0; i < 7; ++i) {  // a joint every 0.25 m, about z and y in turn
    const Joint joint{.name = "joint" + std::to_string(i),
                      .type = JointType::revolute,
                      .axis = i % 2 == 0 ? Vector3::UnitZ() : Vector3::UnitY(),
                      .rotor_inertia = 0.05,
                      .actuated = true};
    const std::string parent = i == 0 ? "base" : "link" + std::to_string(i - 1);
    builder.add_link("link" + std::to_string(i), parent, {Matrix3::Identity(), {0, 0, 0.25}}, joint, link);
  }
  const Model model = builder.set_gravity({0.0, 0.0, -9.81}).build();
  const int tool = model.body_count() - 1;

  State state(model);
  state.q << 0.1, 0.6, -0.3, 0.9, 0.2, -0.7, 0.4;   // [rad]
  state.qd << 0.2, -0.1, 0.3, 0.0, 0.1, -0.2, 0.1;  // [rad/s]
  state.tau_ff << 0, -5, 0, -2, 0, 0, 0;            // [N m]
  state.f_ext[4].linear = {0.0, 0.0, -10.0};        // [N] on link 3, in its axes

  const Vector3 axes[] = {Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ()};
  const Vector3 none = Vector3::Zero();
  std::vector<AccelerationRow> rows;  // A_N, b_N: the six directions of the tool, in its own axes
  for (const Vector3& axis : axes) rows.push_back({.body = tool, .a = {axis, none}});
  for (const Vector3& axis : axes) rows.push_back({.body = tool, .a = {none, axis}});
  rows.back().b = 0.5;  // [m/s^2]

  PopovVereshchagin solver(model);
  ConstrainedMotion motion(model), check(model);
  if (solver.solve(state, rows, motion) != Status::ok) return 1;
  std::printf("       qdd [rad/s^2]  tau_control [N m]\n");
  for (int j = 0; j < 7; ++j) std::printf("joint%d %14.4f %18.4f\n", j, motion.qdd[j], motion.tau_control[j]);
  for (int i = 0; i < 6; ++i) std::printf("nu%d %17.4f %s\n", i, motion.nu[i], i < 3 ? "N m" : "N");

  state.tau_ff = motion.tau_control;  // plain forward dynamics, no rows: the same accelerations
  if (solver.solve(state, {}, check) != Status::ok) return 1;
  const double difference = (check.qdd - motion.qdd).cwiseAbs().maxCoeff();
  std::printf("with tau_control alone: qdd differs by %.1e rad/s^2, the tool's acceleration is\n",
              difference);
  for (const double entry : check.acceleration.back().vector()) std::printf(" %.4f", entry);
  std::printf("\n");
  return difference < 1e-9 && motion.residual.head(6).norm() < 1e-9 ? 0 : 1;
}
