#include "oracle/random_problem.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace zwang::oracle {

using solver::BaseType;
using solver::ForceVector;
using solver::Joint;
using solver::JointType;
using solver::Matrix3;
using solver::Model;
using solver::ModelBuilder;
using solver::Pose;
using solver::RigidInertia;
using solver::Row;
using solver::RowKind;
using solver::State;
using solver::Vector3;
using solver::Wheel;
using std::numbers::pi;

Vector3 Random::vector(double size) {
  return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
}

Vector3 Random::direction() {
  Vector3 v = vector(1.0);
  while (v.norm() < 0.1) v = vector(1.0);
  return v.normalized();
}

Matrix3 Random::rotation() {
  const Vector3 axis = direction();
  return Eigen::AngleAxisd(uniform(-pi, pi), axis).toRotationMatrix();
}

const char* to_string(Robot robot) {
  switch (robot) {
    case Robot::arm:
      return "arm";
    case Robot::tree:
      return "tree";
    case Robot::floating_tree:
      return "floating_tree";
    case Robot::mecanum:
      return "mecanum";
    case Robot::omni:
      return "omni";
    case Robot::differential:
      return "differential";
    case Robot::kelo:
      return "kelo";
    case Robot::skid:
      return "skid";
    case Robot::mecanum_arm:
      return "mecanum_arm";
    case Robot::tricycle:
      return "tricycle";
    case Robot::swerve:
      return "swerve";
    case Robot::differential_arm:
      return "differential_arm";
    case Robot::kelo_arm:
      return "kelo_arm";
    case Robot::car:
      return "car";
  }
  return "?";
}

RigidInertia random_inertia(Random& random, double mass) {
  const double size = 0.05 * std::cbrt(mass);
  // Second moments of a solid: the triangle rule holds by construction.
  const double depth = random.uniform(0.5, 1.5);
  const double width = random.uniform(0.5, 1.5);
  const double height = random.uniform(0.5, 1.5);
  const Vector3 s(height, width, depth);
  const Vector3 m = mass * size * size * s.cwiseProduct(s);
  const Matrix3 R = random.rotation();
  const Matrix3 I = R * Vector3(m.y() + m.z(), m.x() + m.z(), m.x() + m.y()).asDiagonal() * R.transpose();
  return RigidInertia::from_com(mass, random.vector(size), 0.5 * (I + I.transpose()));
}

namespace {

Joint motor(const std::string& name, const Vector3& axis, double max_effort, double rotor) {
  Joint joint;
  joint.name = name;
  joint.type = JointType::continuous;
  joint.axis = axis;
  joint.rotor_inertia = rotor;
  joint.actuated = true;
  joint.max_effort = max_effort;
  return joint;
}

Joint passive(const std::string& name, const Vector3& axis) {
  Joint joint;
  joint.name = name;
  joint.type = JointType::continuous;
  joint.axis = axis;
  return joint;
}

RigidInertia disc(double mass, double radius) {
  const double across = 0.25 * mass * radius * radius + mass * 0.05 * 0.05 / 12.0;
  return RigidInertia::from_com(mass, Vector3::Zero(),
                                Vector3(across, 0.5 * mass * radius * radius, across).asDiagonal());
}

void add_branch(ModelBuilder& builder, const std::string& prefix, std::string parent, int links,
                double max_effort, double heaviest, Random& random) {
  for (int i = 0; i < links; ++i) {
    const std::string name = prefix + std::to_string(i);
    const double rotor_inertia = random.uniform(0.0, 0.1);
    Joint joint = motor(name + "_joint", random.direction(), max_effort, rotor_inertia);
    joint.type = random.chance(0.2)   ? JointType::prismatic
                 : random.chance(0.5) ? JointType::revolute
                                      : JointType::continuous;
    if (joint.type == JointType::prismatic) joint.rotor_inertia *= 10.0;
    const RigidInertia inertia = random_inertia(random, random.uniform(0.3, 1.0) * heaviest);
    builder.add_link(name, parent, {random.rotation(), random.vector(0.3)}, joint, inertia);
    parent = name;
  }
}

void add_arm(ModelBuilder& builder, double max_effort, Random& random) {
  add_branch(builder, "arm", "base", random.pick(3, 6), max_effort, 3.0, random);
}

RigidInertia chassis(Random& random) {
  const double mass = random.uniform(20.0, 60.0);
  return RigidInertia::from_com(mass, {random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05), 0.1},
                                Vector3(0.03, 0.04, 0.06).asDiagonal() * mass);
}

void add_wheel(ModelBuilder& builder, const std::string& name, const std::string& parent, const Vector3& at,
               double yaw, double radius, bool driven, double max_effort, Random& random, Wheel wheel) {
  const Joint joint = driven ? motor(name + "_joint", Vector3::UnitY(), max_effort, random.uniform(0.0, 0.02))
                             : passive(name + "_joint", Vector3::UnitY());
  builder.add_link(name, parent, {solver::rotation_from_rpy(0.0, 0.0, yaw), at}, joint,
                   disc(random.uniform(0.5, 2.0), radius));
  wheel.radius = radius;
  builder.add_wheel(name + "_joint", wheel);
}

/// A swivel with `wheels` wheels behind its vertical axis.
void add_caster(ModelBuilder& builder, const std::string& name, const Vector3& at, double offset, int wheels,
                bool driven, double max_effort, Random& random) {
  const double radius = random.uniform(0.04, 0.08);
  builder.add_link(name, "base", {Matrix3::Identity(), at}, passive(name + "_swivel", Vector3::UnitZ()),
                   random_inertia(random, random.uniform(0.5, 2.0)));
  for (int i = 0; i < wheels; ++i) {
    const double side = wheels == 1 ? 0.0 : (i == 0 ? 0.04 : -0.04);
    add_wheel(builder, name + "_" + std::to_string(i), name, {-offset, side, -0.05}, 0.0, radius, driven,
              max_effort, random, {});
  }
}

/// A driven wheel under a swivel with a motor of its own, the one axis above the other.
void add_steered_wheel(ModelBuilder& builder, const std::string& name, const Vector3& at, double max_effort,
                       Random& random) {
  const RigidInertia inertia = random_inertia(random, random.uniform(0.5, 2.0));
  const Joint steering = motor(name + "_steering", Vector3::UnitZ(), max_effort, random.uniform(0.0, 0.02));
  builder.add_link(name, "base", {Matrix3::Identity(), at}, steering, inertia);
  add_wheel(builder, name + "_wheel", name, Vector3::Zero(), 0.0, random.uniform(0.05, 0.1), true, max_effort,
            random, {});
}

void add_mecanum(ModelBuilder& builder, double max_effort, Random& random) {
  const double lx = random.uniform(0.15, 0.4);
  const double ly = random.uniform(0.15, 0.4);
  const double radius = random.uniform(0.05, 0.12);
  const double tilt = random.uniform(0.6, 0.9);
  for (const int x : {1, -1}) {
    for (const int y : {1, -1}) {
      const std::string name = std::string(x > 0 ? "front" : "rear") + (y > 0 ? "_left" : "_right");
      Wheel wheel;
      wheel.roller_angle = x * y > 0 ? tilt : -tilt;
      add_wheel(builder, name, "base", {x * lx, y * ly, radius - 0.1}, 0.0, radius, true, max_effort, random,
                wheel);
    }
  }
}

}  // namespace

Model random_model(Robot robot, Random& random, double max_effort) {
  switch (robot) {
    case Robot::arm: {
      ModelBuilder builder(BaseType::fixed, "base", random_inertia(random, 10.0));
      add_branch(builder, "arm", "base", 7, max_effort, 3.0, random);
      return builder.build();
    }
    case Robot::tree: {
      ModelBuilder builder(BaseType::fixed, "base", random_inertia(random, 10.0));
      add_branch(builder, "trunk", "base", random.pick(1, 3), max_effort, 4.0, random);
      add_branch(builder, "left", "trunk0", random.pick(1, 4), max_effort, 3.0, random);
      add_branch(builder, "right", "trunk0", random.pick(1, 4), max_effort, 3.0, random);
      return builder.build();
    }
    case Robot::floating_tree: {
      ModelBuilder builder(BaseType::floating, "base", random_inertia(random, 8.0));
      add_branch(builder, "left", "base", random.pick(1, 4), max_effort, 3.0, random);
      add_branch(builder, "right", "base", random.pick(1, 4), max_effort, 3.0, random);
      return builder.build();
    }
    case Robot::mecanum:
    case Robot::mecanum_arm: {
      ModelBuilder builder(BaseType::ground, "base", chassis(random));
      add_mecanum(builder, max_effort, random);
      if (robot == Robot::mecanum_arm) add_arm(builder, max_effort, random);
      return builder.build();
    }
    case Robot::omni: {
      ModelBuilder builder(BaseType::ground, "base", chassis(random));
      const double reach = random.uniform(0.15, 0.3);
      for (int i = 0; i < 3; ++i) {
        const double angle = 2.0 * pi * i / 3.0;
        Wheel wheel;
        wheel.roller_angle = pi / 2.0;  // the roller at the ground lies along the rolling direction
        add_wheel(builder, "wheel" + std::to_string(i), "base",
                  {reach * std::cos(angle), reach * std::sin(angle), -0.02}, angle + pi / 2.0, 0.05, true,
                  max_effort, random, wheel);
      }
      return builder.build();
    }
    case Robot::differential:
    case Robot::differential_arm: {
      ModelBuilder builder(BaseType::ground, "base", chassis(random));
      add_wheel(builder, "left", "base", {0.0, 0.2, 0.0}, 0.0, 0.08, true, max_effort, random, {});
      add_wheel(builder, "right", "base", {0.0, -0.2, 0.0}, 0.0, 0.08, true, max_effort, random, {});
      for (const int side : {1, -1}) {
        add_caster(builder, side > 0 ? "caster_left" : "caster_right", {-0.3, 0.15 * side, 0.0}, 0.03, 1,
                   false, max_effort, random);
      }
      if (robot == Robot::differential_arm) add_arm(builder, max_effort, random);
      return builder.build();
    }
    case Robot::kelo:
    case Robot::kelo_arm: {
      ModelBuilder builder(BaseType::ground, "base", chassis(random));
      const int units = random.pick(2, 4);
      for (int i = 0; i < units; ++i) {
        const double angle = 2.0 * pi * i / units + 0.3;
        add_caster(builder, "unit" + std::to_string(i), {0.3 * std::cos(angle), 0.3 * std::sin(angle), 0.0},
                   random.uniform(0.01, 0.04), 2, true, max_effort, random);
      }
      if (robot == Robot::kelo_arm) add_arm(builder, max_effort, random);
      return builder.build();
    }
    case Robot::tricycle: {
      ModelBuilder builder(BaseType::ground, "base", chassis(random));
      add_steered_wheel(builder, "front", {0.4, 0.0, 0.0}, max_effort, random);
      add_wheel(builder, "left", "base", {-0.1, 0.2, 0.0}, 0.0, 0.08, false, max_effort, random, {});
      add_wheel(builder, "right", "base", {-0.1, -0.2, 0.0}, 0.0, 0.08, false, max_effort, random, {});
      return builder.build();
    }
    case Robot::car: {  // the front axle turns as a whole: its wheels and the rear ones have a common centre
      ModelBuilder builder(BaseType::ground, "base", chassis(random));
      const RigidInertia inertia = random_inertia(random, random.uniform(0.5, 2.0));
      const Joint steering = motor("steering", Vector3::UnitZ(), max_effort, random.uniform(0.0, 0.02));
      builder.add_link("axle", "base", {Matrix3::Identity(), {0.35, 0.0, 0.0}}, steering, inertia);
      for (const int side : {1, -1}) {
        const std::string name = side > 0 ? "left" : "right";
        add_wheel(builder, "front_" + name, "axle", {0.0, 0.15 * side, 0.0}, 0.0, 0.06, false, max_effort,
                  random, {});
        add_wheel(builder, "rear_" + name, "base", {0.0, 0.15 * side, 0.0}, 0.0, 0.06, true, max_effort,
                  random, {});
      }
      return builder.build();
    }
    case Robot::swerve: {  // two wheels always have a common centre; three at random angles lock the base
      ModelBuilder builder(BaseType::ground, "base", chassis(random));
      add_steered_wheel(builder, "front", {0.25, 0.1, 0.0}, max_effort, random);
      add_steered_wheel(builder, "rear", {-0.25, -0.1, 0.0}, max_effort, random);
      if (random.chance(0.3)) add_steered_wheel(builder, "side", {0.0, 0.3, 0.0}, max_effort, random);
      return builder.build();
    }
    case Robot::skid: {
      ModelBuilder builder(BaseType::ground, "base", chassis(random));
      for (const int x : {1, -1}) {
        for (const int y : {1, -1}) {
          Wheel wheel;
          wheel.holds_sideways = false;
          add_wheel(builder, "wheel" + std::to_string(2 + 2 * x + y), "base", {0.25 * x, 0.25 * y, 0.0}, 0.0,
                    0.165, true, max_effort, random, wheel);
        }
      }
      return builder.build();
    }
  }
  throw std::invalid_argument("unknown robot");
}

State random_state(const Model& model, Random& random) {
  State state(model);
  for (Eigen::Index j = 0; j < state.q.size(); ++j) {
    state.q[j] = random.uniform(-1.5, 1.5);
    state.qd[j] = random.uniform(-1.0, 1.0);
    if (model.joint(static_cast<int>(j)).actuated) {
      const double limit = std::min(model.joint(static_cast<int>(j)).max_effort, 5.0);
      if (random.chance(0.3)) state.tau_ff[j] = random.uniform(-0.5, 0.5) * limit;
    }
  }
  const bool ground = model.base_type() == BaseType::ground;
  state.base_pose.rotation =
      ground ? solver::rotation_from_rpy(0.0, 0.0, random.uniform(-pi, pi)) : random.rotation();
  state.base_pose.position = random.vector(2.0);
  state.base_twist.angular = random.vector(0.7);
  state.base_twist.linear = random.vector(0.7);
  for (ForceVector& f : state.f_ext) {
    if (random.chance(0.2)) f = {random.vector(1.0), random.vector(5.0)};
  }
  return state;
}

std::vector<Row> random_rows(const Model& model, const RowOptions& options, Random& random) {
  std::vector<Row> rows;
  const int bodies = model.body_count();
  const int first = model.has_fixed_base() ? 1 : 0;
  const bool planar = model.base_type() == BaseType::ground;
  const auto direction = [&](int body) {
    ForceVector a;
    if (planar && body == 0) {
      a.linear.y() = random.uniform(-1, 1);
      a.linear.x() = random.uniform(-1, 1);
      a.angular = random.chance(0.5) ? Vector3(0, 0, random.uniform(-1, 1)) : Vector3::Zero();
    } else if (random.chance(0.5)) {
      a.linear = random.direction();
      a.angular = random.vector(0.3);
    } else {
      a.angular = random.direction();
    }
    return a;
  };
  for (int i = 0; i < options.count; ++i) {
    Row row;
    if (!rows.empty() && random.chance(options.duplicate)) {
      row = rows[static_cast<std::size_t>(random.pick(0, static_cast<int>(rows.size()) - 1))];
      row.weight = solver::infinity;
      if (random.chance(options.apart)) row.b += random.uniform(-1.0, 1.0);
    } else {
      row.body = planar && random.chance(0.6) ? 0 : random.pick(first, bodies - 1);
      row.a = direction(row.body);
      if (bodies > 2 && random.chance(options.relative)) {
        row.reference_body = random.pick(0, bodies - 1);
        if (row.reference_body == row.body) {
          row.reference_body = -1;
        } else {
          row.a_reference = direction(row.reference_body);
        }
      }
      row.b = random.uniform(-options.demand, options.demand);
    }
    row.constraint = i;
    row.quantity = solver::Quantity::acceleration;
    const double F = options.bound * random.uniform(0.1, 1.0);
    if (random.chance(options.one_sided)) {
      row.kind = random.chance(0.5) ? RowKind::upper : RowKind::lower;
      row.lo = row.kind == RowKind::upper ? -10.0 * F : 0.0;
      row.hi = row.kind == RowKind::upper ? 0.0 : 10.0 * F;
    } else if (random.chance(options.force)) {
      row.kind = RowKind::force;
      row.force = random.uniform(-1.0, 1.0) * F;
      row.lo = std::min(0.0, row.force);
      row.hi = std::max(0.0, row.force);
    } else {
      row.kind = RowKind::driver;
      row.lo = -F * random.uniform(0.0, 1.0);
      row.hi = F * random.uniform(0.0, 1.0);
    }
    if (options.weight > 0.0 && random.chance(options.weight))
      row.weight = std::pow(10.0, random.uniform(-1.0, 3.0));
    if (options.sum > 0.0 && random.chance(options.sum)) {
      row.kind = RowKind::sum;
      row.lo = -F * random.uniform(0.0, 1.0);
      row.hi = F * random.uniform(0.0, 1.0);
    }
    row.level = random.pick(options.levels == 1 ? 1 : 0, std::max(1, options.levels - 1));
    rows.push_back(row);
  }
  return rows;
}

}  // namespace zwang::oracle
