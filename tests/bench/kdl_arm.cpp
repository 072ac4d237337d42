// The only file of the benchmarks that knows Orocos KDL.
#include <cstdlib>
#include <kdl/chain.hpp>
#include <kdl/chainhdsolver_vereshchagin.hpp>
#include <memory>

#include "workload.hpp"

namespace zwang::bench {

namespace {

KDL::Chain make_chain() {
  KDL::Chain chain;
  for (int j = 0; j < Arm::joints; ++j) {
    const solver::Vector3 axis = Arm::axis(j);
    const solver::Vector3 com = Arm::com();
    const solver::Matrix3 I = Arm::inertia();
    const KDL::Vector origin(0.0, 0.0, Arm::length(j));
    const KDL::Joint joint("joint" + std::to_string(j), origin, {axis.x(), axis.y(), axis.z()},
                           KDL::Joint::RotAxis);
    chain.addSegment(KDL::Segment("link" + std::to_string(j), joint, KDL::Frame(origin),
                                  KDL::RigidBodyInertia(Arm::mass(j), {com.x(), com.y(), com.z()},
                                                        KDL::RotationalInertia(I(0, 0), I(1, 1), I(2, 2)))));
  }
  return chain;
}

struct KdlArm {
  explicit KdlArm(unsigned rows)
      : solver(chain, KDL::Twist({0.0, 0.0, 9.81}, KDL::Vector::Zero()), rows),
        alpha(rows),
        beta(rows),
        f_ext(Arm::joints, KDL::Wrench::Zero()),
        qdd(Arm::joints),
        constraint_torque(Arm::joints) {
    for (unsigned k = 0; k < rows; ++k) {
      KDL::Twist unit = KDL::Twist::Zero();
      unit(static_cast<int>(k)) = 1.0;
      alpha.setColumn(k, unit);
      beta(k) = 0.1 * (k + 1);
    }
    solver::ModelBuilder builder(solver::BaseType::fixed, "base", {});
    Arm::add_to(builder, "base", Arm::joints);
    for (const solver::State& state : random_states(builder.build(), 1)) {
      for (auto* list : {&q, &qd, &tau}) list->emplace_back(Arm::joints);
      q.back().data = state.q;
      qd.back().data = state.qd;
      tau.back().data = state.tau_ff;
    }
  }
  KDL::Chain chain = make_chain();
  KDL::ChainHdSolver_Vereshchagin solver;
  KDL::Jacobian alpha;
  KDL::JntArray beta;
  KDL::Wrenches f_ext;
  KDL::JntArray qdd, constraint_torque;
  std::vector<KDL::JntArray> q, qd, tau;
};

}  // namespace

Workload arm_kdl(int rows) {
  auto w = std::make_shared<KdlArm>(static_cast<unsigned>(rows));
  return {"KDL, " + std::to_string(rows) + " rows",
          "kinematics, sweeps, all rows as equalities, accelerations", [w](std::size_t i) {
            const std::size_t k = i % state_count;
            if (w->solver.CartToJnt(w->q[k], w->qd[k], w->qdd, w->alpha, w->beta, w->f_ext, w->tau[k],
                                    w->constraint_torque) != 0) {
              std::abort();
            }
          }};
}

}  // namespace zwang::bench
