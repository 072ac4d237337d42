// A robot of one's own: a planar base on four mecanum wheels before a wall, in a few lines of physics.
//
//   04_own_plant TASK.yaml        specs/wall_align.yaml, which pushes until the wall has turned the base
//   square
#include <Eigen/Dense>
#include <cmath>
#include <cstdio>
#include <exception>
#include <iostream>

#include "zwang/lang/program.hpp"
#include "zwang/runtime/runner.hpp"

namespace {

using namespace zwang;
using Eigen::Vector3d;

/// M dV/dt = J' tau + contact, V = (vx, vy, wz) in the base's axes; the wheels turn with J V.
class PlanarBase : public runtime::Plant {
 public:
  explicit PlanarBase(const lang::Robot& robot) : footprint_(robot.footprint) {
    const solver::Model& model = robot.model;
    const double mass = model.total_mass();
    M_.diagonal() << mass, mass, mass * 0.08;
    J_.resize(model.joint_count(), 3);
    for (const solver::Wheel& wheel : model.wheels()) {
      const solver::Body& body = model.bodies()[static_cast<std::size_t>(wheel.body)];
      const double angle = wheel.roller_angle.value();  // the wheel drives along (-sin, cos) of it
      const double x = body.pose_in_parent.position.x(), y = body.pose_in_parent.position.y();
      const Vector3d row(1.0, -1.0 / std::tan(angle), -y - x / std::tan(angle));
      J_.row(wheel.body - 1) = row.transpose() / wheel.radius;
      const double spin = body.inertia.rotational(1, 1) + body.joint.rotor_inertia;
      M_ += spin * J_.row(wheel.body - 1).transpose() * J_.row(wheel.body - 1);
    }
    q_ = Eigen::VectorXd::Zero(model.joint_count());
  }

  runtime::PlantStatus sense(runtime::Sensed& sensed) noexcept override {
    sensed.time = time_;
    sensed.state.q = q_;
    sensed.state.qd = J_ * V_;
    sensed.state.base_pose.rotation = Eigen::AngleAxisd(pose_.z(), Vector3d::UnitZ()).toRotationMatrix();
    sensed.state.base_pose.position = {pose_.x(), pose_.y(), 0.0};
    sensed.state.base_twist.linear = {V_.x(), V_.y(), 0.0};
    sensed.state.base_twist.angular = {0.0, 0.0, V_.z()};
    sensed.base_measured = true;  // on a robot that only has its wheels leave base and this alone
    return runtime::PlantStatus::ok;
  }

  runtime::PlantStatus apply(const Eigen::VectorXd& tau) noexcept override {
    V_ += period * M_.ldlt().solve(J_.transpose() * tau + contact());
    const double c = std::cos(pose_.z()), s = std::sin(pose_.z());
    pose_ += period * Vector3d(c * V_.x() - s * V_.y(), s * V_.x() + c * V_.y(), V_.z());
    q_ += period * J_ * V_;
    time_ += period;
    return runtime::PlantStatus::ok;
  }

  double yaw() const { return pose_.z(); }
  double pressed() const { return pressed_; }

 private:
  /// The wall at x = 0.8 m: a spring and a damper at each corner that is inside.
  Vector3d contact() noexcept {
    Vector3d wrench = Vector3d::Zero();
    const double c = std::cos(pose_.z()), s = std::sin(pose_.z());
    pressed_ = 0.0;
    for (const solver::Vector3& p : footprint_) {
      const double depth = pose_.x() + c * p.x() - s * p.y() - 0.8;
      if (depth <= 0.0) continue;
      const double speed = c * (V_.x() - V_.z() * p.y()) - s * (V_.y() + V_.z() * p.x());
      const double force = std::max(0.0, 20e3 * depth + 500.0 * speed);
      pressed_ += force;
      const Eigen::Vector2d f(-c * force, s * force);  // along the world's -x, in the base's axes
      wrench += Vector3d(f.x(), f.y(), p.x() * f.y() - p.y() * f.x());
    }
    return wrench;
  }

  static constexpr double period = 1e-3;
  const std::vector<solver::Vector3> footprint_;
  Eigen::Matrix3d M_ = Eigen::Matrix3d::Zero();
  Eigen::MatrixXd J_;
  Eigen::VectorXd q_;
  Vector3d V_ = Vector3d::Zero();
  Vector3d pose_{0.0, 0.0, 0.3};  // x, y, yaw in the world
  double time_ = 0.0, pressed_ = 0.0;
};

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::cerr << "usage: 04_own_plant TASK.yaml\n";
    return 2;
  }
  lang::Diagnostics diagnostics;
  const auto program = lang::load(argv[1], {}, diagnostics);
  lang::render_human(diagnostics, std::cerr);
  if (!program) return 2;
  PlanarBase plant(program->robot);
  runtime::Runner runner(*program);
  runtime::Sensed sensed(*program);
  while (!runner.finished() && sensed.time < 60.0) {
    plant.sense(sensed);
    plant.apply(runner.step(sensed));
    if (const auto& t = runner.scheduler().transition()) {
      std::printf("%.2f s: %s; the wall feels %.1f N, estimated %.1f N\n", t->time,
                  runner.scheduler().why(*t).c_str(), plant.pressed(), -runner.estimated_force().x());
    }
  }
  std::printf("%.2f s: %s, %.3f deg from square\n", sensed.time, runtime::to_string(runner.state()),
              plant.yaw() * 180.0 / 3.14159265);
  return runner.state() == runtime::RunState::done ? 0 : 1;
} catch (const std::exception& e) {
  std::cerr << e.what() << '\n';
  return 2;
}
