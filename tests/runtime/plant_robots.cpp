#include "plant_robots.hpp"

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

namespace zwang::runtime::testing {

RigidInertia box_inertia(double mass, const Vector3& com, const Vector3& size) {
  const Vector3 sq = size.cwiseProduct(size);
  const Vector3 moments = mass / 12.0 * Vector3(sq.y() + sq.z(), sq.x() + sq.z(), sq.x() + sq.y());
  return RigidInertia::from_com(mass, com, moments.asDiagonal());
}

RigidInertia wheel_inertia(double mass, double radius, double width) {
  const double axial = 0.5 * mass * radius * radius;
  const double across = mass * (3.0 * radius * radius + width * width) / 12.0;
  return RigidInertia::from_com(mass, Vector3::Zero(), Vector3(across, axial, across).asDiagonal());
}

lang::Robot build_base(const BaseDesign& design, const std::vector<WheelPlace>& places) {
  RigidInertia body = box_inertia(design.body_mass, design.body_com, {0.70, 0.50, 0.20});
  body.rotational(0, 1) += design.body_product;
  body.rotational(1, 0) += design.body_product;
  solver::ModelBuilder builder(solver::BaseType::ground, "base_link", body);
  for (const WheelPlace& place : places) {
    solver::Joint joint;
    joint.name = std::string(place.name) + "_joint";
    joint.type = solver::JointType::continuous;
    joint.axis = Vector3::UnitY();
    joint.rotor_inertia = design.rotor_inertia;
    joint.actuated = true;
    builder.add_link(place.name, "base_link",
                     {solver::rotation_from_rpy(0.0, 0.0, place.yaw), {place.x, place.y, 0.0}}, joint,
                     wheel_inertia(design.wheel_mass, design.wheel_radius, design.wheel_width));
    solver::Wheel wheel;
    wheel.radius = design.wheel_radius;
    wheel.roller_angle = place.roller_angle;
    builder.add_wheel(joint.name, wheel);
  }
  lang::Robot robot;
  robot.name = "test";
  robot.model = builder.build();
  robot.base_frame = "base_link";
  robot.footprint = {{0.40, 0.28, 0.0}, {-0.40, 0.28, 0.0}, {-0.40, -0.28, 0.0}, {0.40, -0.28, 0.0}};
  robot.bumper_height = 0.15;
  return robot;
}

lang::Robot mecanum_base(const BaseDesign& design) {
  const double angle = std::numbers::pi / 4.0;
  return build_base(design, {{"front_left", 0.23, 0.20, angle},
                             {"front_right", 0.23, -0.20, -angle},
                             {"rear_left", -0.23, 0.20, -angle},
                             {"rear_right", -0.23, -0.20, angle}});
}

lang::Robot mirrored_mecanum_base() {
  const double angle = std::numbers::pi / 4.0;
  return build_base({}, {{"front_left", 0.26, 0.16, -angle},
                         {"front_right", 0.26, -0.16, angle},
                         {"rear_left", -0.26, 0.16, angle},
                         {"rear_right", -0.26, -0.16, -angle}});
}

lang::Robot steep_mecanum_base() {
  const double angle = std::numbers::pi / 6.0;
  return build_base({}, {{"fl", 0.23, 0.20, angle},
                         {"fr", 0.23, -0.20, -angle},
                         {"rl", -0.23, 0.20, -angle},
                         {"rr", -0.23, -0.20, angle}});
}

lang::Robot omni_base() {
  std::vector<WheelPlace> places;
  const char* const names[] = {"a", "b", "c"};
  for (int i = 0; i < 3; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 3.0 + 0.3;
    places.push_back({names[i], 0.25 * std::cos(angle), 0.25 * std::sin(angle), 0.5 * std::numbers::pi,
                      angle - 0.5 * std::numbers::pi});
  }
  return build_base({}, places);
}

lang::Robot differential_base(BaseDesign design) {
  design.wheel_radius = 0.08;
  return build_base(design, {{"left", 0.0, 0.20, {}}, {"right", 0.0, -0.20, {}}});
}

PlanarReference::PlanarReference(const solver::Model& model) {
  const int wheels = static_cast<int>(model.wheels().size());
  M = Eigen::MatrixXd::Zero(3 + wheels, 3 + wheels);
  RigidInertia whole = model.bodies()[0].inertia;
  std::vector<Eigen::RowVectorXd> rows;
  for (int w = 0; w < wheels; ++w) {
    const solver::Wheel& wheel = model.wheels()[static_cast<std::size_t>(w)];
    const solver::Body& body = model.bodies()[static_cast<std::size_t>(wheel.body)];
    whole = whole + body.inertia.expressed_in(body.pose_in_parent);
    const Vector3 axis = body.pose_in_parent.rotation * body.joint.axis;
    M(3 + w, 3 + w) =
        body.joint.axis.dot(body.inertia.rotational * body.joint.axis) + body.joint.rotor_inertia;
    const Vector3 contact = body.pose_in_parent.position - Vector3(0.0, 0.0, wheel.radius);
    const Vector3 spin = axis.cross(Vector3(0.0, 0.0, -wheel.radius));  // contact velocity at unit rate
    const auto add_row = [&](const Vector3& u) {
      Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(3 + wheels);
      row[0] = u.x();
      row[1] = u.y();
      row[2] = Vector3::UnitZ().cross(contact).dot(u);
      row[3 + w] = spin.dot(u);
      rows.push_back(row);
    };
    if (wheel.roller_angle) {
      add_row(Eigen::AngleAxisd(*wheel.roller_angle, Vector3::UnitZ()) * axis);
    } else {
      add_row(axis);
      add_row(axis.cross(Vector3::UnitZ()));
    }
  }
  mass = whole.mass;
  com = whole.first_moment / whole.mass;
  M.topLeftCorner<3, 3>() << mass, 0.0, -mass * com.y(), 0.0, mass, mass * com.x(), -mass * com.y(),
      mass * com.x(), whole.rotational(2, 2);
  P.resize(static_cast<Eigen::Index>(rows.size()), 3 + wheels);
  for (std::size_t i = 0; i < rows.size(); ++i) P.row(static_cast<Eigen::Index>(i)) = rows[i];
}

Eigen::VectorXd PlanarReference::products(const Vector3& v) const {
  Eigen::VectorXd c = Eigen::VectorXd::Zero(M.rows());
  const double w = v.z();
  c[0] = -mass * w * (v.y() + w * com.x());
  c[1] = mass * w * (v.x() - w * com.y());
  c[2] = mass * w * (com.x() * v.x() + com.y() * v.y());
  return c;
}

Vector3 PlanarReference::acceleration(const Eigen::VectorXd& tau, const Vector3& v) const {
  const Eigen::Index n = M.rows(), m = P.rows();
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n + m, n + m);
  K << M, -P.transpose(), P, Eigen::MatrixXd::Zero(m, m);
  Eigen::VectorXd rhs = Eigen::VectorXd::Zero(n + m);
  rhs.head(n) = -products(v);
  rhs.segment(3, n - 3) += tau;
  return K.completeOrthogonalDecomposition().solve(rhs).head(3);
}

Eigen::VectorXd PlanarReference::torque(const Vector3& rates, const Vector3& v) const {
  const Eigen::Index n = M.rows();
  // Motions that the rows leave: z = N y. Their rates and N' (0, tau) = N' (M z' + c).
  const Eigen::MatrixXd N = Eigen::FullPivLU<Eigen::MatrixXd>(P).kernel();
  const Eigen::VectorXd y = N.topRows(3).completeOrthogonalDecomposition().solve(rates);
  const Eigen::VectorXd needed = N.transpose() * (M * (N * y) + products(v));
  return Eigen::MatrixXd(N.bottomRows(n - 3).transpose()).completeOrthogonalDecomposition().solve(needed);
}

double PlanarReference::apparent_mass(const Vector3& direction) const {
  const Eigen::MatrixXd N = Eigen::FullPivLU<Eigen::MatrixXd>(P).kernel();
  const Eigen::VectorXd along = N.topRows(3).transpose() * direction;
  return 1.0 / along.dot((N.transpose() * M * N).ldlt().solve(along));
}

Eigen::VectorXd PlanarReference::torque_of_wrench(const Vector3& wrench) const {
  const Eigen::MatrixXd N = Eigen::FullPivLU<Eigen::MatrixXd>(P).kernel();
  return Eigen::MatrixXd(N.bottomRows(M.rows() - 3).transpose())
      .completeOrthogonalDecomposition()
      .solve(N.topRows(3).transpose() * wrench);
}

}  // namespace zwang::runtime::testing
