/// A mecanum base in numbers that a test can check by hand, and conditions without a parser.
#pragma once

#include <string>
#include <vector>

#include "constants.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/plant.hpp"

namespace zwang::runtime::test {

using lang::AxisStatements;
using lang::CoordinateQuantity;
using lang::ExpressionNode;
using lang::Op;
using solver::Axis;
using solver::Quantity;

constexpr double body_mass = 40.0;    // [kg]
constexpr double body_yaw = 3.0;      // [kg m^2]
constexpr double wheel_mass = 1.5;    // [kg]
constexpr double wheel_spin = 0.004;  // [kg m^2]
constexpr double wheel_turn = 0.002;  // [kg m^2] about the vertical
constexpr double wheel_radius = 0.075;
constexpr double rotor_inertia = 0.01;
constexpr double half_length = 0.25;
constexpr double half_width = 0.20;
constexpr double effort = 12.0;  // [N m]

inline constexpr const char* wheel_names[] = {"front_left", "front_right", "rear_left", "rear_right"};

solver::Vector3 wheel_position(int i);

/// Angle from the wheel's axis (+y) to that of the roller at the ground: front left and rear right 45 deg.
double roller_angle(int i);

lang::Robot mecanum_robot();

/// The frames of the test base: 0 the world, 1 the base, 2 a bumper 0.4 m ahead.
std::vector<lang::FrameDeclaration> base_frames();
constexpr int world_frame = 0;
constexpr int base_link = 1;
constexpr int bumper = 2;

lang::Program program(std::vector<lang::Task> tasks);

AxisStatements free_axis(const std::string& name, Axis axis);

AxisStatements drive(const std::string& name, Axis axis, Quantity quantity, double target);

lang::ValueRange between(double low, double high);

lang::Task task(const std::string& name, std::vector<AxisStatements> axes, int move = base_link,
                int in = base_link);

// Conditions. Operands stand before their operators, as the parser leaves them.
using Nodes = std::vector<ExpressionNode>;

Nodes number(double x);
Nodes name(Op op, int index = -1);
/// A function of a frame or a task, by its name in the language.
Nodes call(const char* function, int frame_or_task);
Nodes coordinate(int group, int axis, CoordinateQuantity what);
Nodes apply(Op op, Nodes a);
Nodes apply(Op op, const Nodes& a, const Nodes& b);
Nodes unknown();
lang::Condition when(Nodes nodes, const std::string& text = "a condition");
lang::Condition after(double seconds);
lang::Condition always_true();

lang::Target to_task(int index);
inline constexpr lang::Target to_done{lang::TargetKind::done, -1};
inline constexpr lang::Target to_failed{lang::TargetKind::failed, -1};

lang::Exit exit(lang::Condition condition, lang::Target target, double dwell = 0.0);

/// The planar dynamics of the test base, derived apart from the library. V = (vx, vy, wz) in base axes and
/// the wheel rates are w = J V: (M + J' I J) dV/dt + Coriolis = J' tau + F. The centre of mass lies on the
/// vertical through the base's origin.
class PlanarBase {
 public:
  PlanarBase();
  /// Any base on four wheels that hold one direction: its rigid inertia, the wheels' rates and spins.
  explicit PlanarBase(const lang::Robot& robot);

  /// The planar wrench in base axes that the wheels' torques command.
  Eigen::Vector3d commanded(const Eigen::VectorXd& tau) const;
  const Eigen::Matrix3d& inertia() const { return inertia_; }
  Eigen::MatrixXd jacobian() const;

  /// One period under the wheels' torques and an outer force in base axes at the origin.
  void step(const Eigen::VectorXd& tau, const Eigen::Vector3d& force = Eigen::Vector3d::Zero());
  void sense(Sensed& sensed) const;

  Eigen::Vector3d V = Eigen::Vector3d::Zero();     // vx, vy [m/s], wz [rad/s] in base axes
  Eigen::Vector3d pose = Eigen::Vector3d::Zero();  // x, y [m], yaw [rad] in the world
  Eigen::Vector4d wheels = Eigen::Vector4d::Zero();
  double time = 0.0;

 private:
  Eigen::Matrix<double, 4, 3> jacobian_;
  Eigen::Matrix3d rigid_;
  Eigen::Matrix3d inertia_;
};

}  // namespace zwang::runtime::test
