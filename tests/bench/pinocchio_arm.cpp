// The only file of the benchmarks that knows Pinocchio (3.x), built where that is installed.
#include <cstdlib>
#include <memory>
#include <pinocchio/algorithm/contact-info.hpp>
#include <pinocchio/algorithm/proximal.hpp>
#include <pinocchio/algorithm/pv.hpp>
#include <pinocchio/multibody/data.hpp>
#include <pinocchio/multibody/model.hpp>

#include "workload.hpp"

namespace zwang::bench {

namespace {

pinocchio::Model make_model() {
  pinocchio::Model model;
  pinocchio::JointIndex parent = 0;
  for (int j = 0; j < Arm::joints; ++j) {
    const pinocchio::SE3 at(solver::Matrix3::Identity(), solver::Vector3(0.0, 0.0, Arm::length(j)));
    const std::string name = "joint" + std::to_string(j);
    parent = Arm::axis(j).z() != 0.0 ? model.addJoint(parent, pinocchio::JointModelRZ(), at, name)
                                     : model.addJoint(parent, pinocchio::JointModelRY(), at, name);
    model.appendBodyToJoint(parent, pinocchio::Inertia(Arm::mass(j), Arm::com(), Arm::inertia()),
                            pinocchio::SE3::Identity());
  }
  return model;
}

/// Six rows on the last link, held at rest: what the rows ask for does not change the work.
struct PinocchioArm {
  PinocchioArm() : model(make_model()), data(model), settings(1e-12, 0.0, 1) {
    const auto tip = static_cast<pinocchio::JointIndex>(Arm::joints);
    constraints.emplace_back(pinocchio::CONTACT_6D, model, tip, pinocchio::LOCAL);
    constraint_data.emplace_back(constraints.back());
    pinocchio::initPvSolver(model, data, constraints);
    solver::ModelBuilder builder(solver::BaseType::fixed, "base", {});
    Arm::add_to(builder, "base", Arm::joints);
    states = random_states(builder.build(), 1);
  }
  pinocchio::Model model;
  pinocchio::Data data;
  pinocchio::ProximalSettings settings;
  PINOCCHIO_STD_VECTOR_WITH_EIGEN_ALLOCATOR(pinocchio::RigidConstraintModel) constraints;
  PINOCCHIO_STD_VECTOR_WITH_EIGEN_ALLOCATOR(pinocchio::RigidConstraintData) constraint_data;
  std::vector<solver::State> states;

  void solve(std::size_t i) {
    const solver::State& state = states[i % state_count];
    pinocchio::pv(model, data, state.q, state.qd, state.tau_ff, constraints, constraint_data, settings);
  }
};

}  // namespace

Workload arm_pinocchio() {
  auto w = std::make_shared<PinocchioArm>();
  for (std::size_t i = 0; i < state_count; ++i) {
    w->solve(i);
    if (!w->data.ddq.allFinite()) std::abort();  // it tells nobody
  }
  return {"Pinocchio pv, 6 rows", "kinematics, sweeps, all rows as equalities, accelerations",
          [w](std::size_t i) { w->solve(i); }};
}

}  // namespace zwang::bench
