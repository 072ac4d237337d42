// MuJoCo as the judge of dynamics: inertia, bias and forward dynamics of the same random trees.
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cstdio>
#include <fstream>
#include <limits>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "../temporary_folder.hpp"
#include "oracle/dense_dynamics.hpp"
#include "oracle/random_problem.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::oracle {
namespace {

std::string numbers(std::initializer_list<double> values) {
  std::string out;
  char text[40];
  for (const double v : values) {
    std::snprintf(text, sizeof text, "%.17g ", v);
    out += text;
  }
  return out;
}

std::string numbers(const solver::Vector3& v) {
  return numbers({v.x(), v.y(), v.z()});
}

void write_body(std::ostream& out, const solver::Model& model, const solver::State& state,
                std::size_t index) {
  const solver::Body& body = model.bodies()[index];
  const solver::Pose& pose = index == 0 ? state.base_pose : body.pose_in_parent;
  const Eigen::Quaterniond quat(pose.rotation);
  out << "<body name='" << body.name << "' pos='" << numbers(pose.position) << "' quat='"
      << numbers({quat.w(), quat.x(), quat.y(), quat.z()}) << "'>";
  const solver::RigidInertia& I = body.inertia;
  const solver::Vector3 c = I.first_moment / I.mass;
  const solver::Matrix3 T =
      I.rotational - I.mass * (c.squaredNorm() * solver::Matrix3::Identity() - c * c.transpose());
  // Principal axes by ourselves: MuJoCo's own search for them stops at 1e-8 or so.
  Eigen::SelfAdjointEigenSolver<solver::Matrix3> principal(T);
  solver::Matrix3 axes = principal.eigenvectors();
  if (axes.determinant() < 0.0) axes.col(0) = -axes.col(0);
  const Eigen::Quaterniond turned(axes);
  out << "<inertial mass='" << numbers({I.mass}) << "' pos='" << numbers(c) << "' quat='"
      << numbers({turned.w(), turned.x(), turned.y(), turned.z()}) << "' diaginertia='"
      << numbers(solver::Vector3(principal.eigenvalues())) << "'/>";
  if (index > 0) {
    out << "<joint name='" << body.joint.name << "' type='"
        << (body.joint.type == solver::JointType::prismatic ? "slide" : "hinge") << "' axis='"
        << numbers(body.joint.axis) << "' armature='" << numbers({body.joint.rotor_inertia}) << "'/>";
  } else if (!model.has_fixed_base()) {
    out << "<freejoint/>";
  }
  for (std::size_t child = index + 1; child < model.bodies().size(); ++child) {
    if (model.bodies()[child].parent == static_cast<int>(index)) write_body(out, model, state, child);
  }
  out << "</body>";
}

void fail(const char* message) {
  throw std::runtime_error(message);
}

/// The same robot in MuJoCo, at the same state.
class Judge {
 public:
  Judge(const solver::Model& model, const solver::State& state) : model_(model) {
    mju_user_error = fail;
    mju_user_warning = fail;
    std::ostringstream text;
    text << "<mujoco><compiler angle='radian' inertiafromgeom='false'/><option gravity='"
         << numbers(model.gravity())
         << "'><flag constraint='disable' contact='disable'/></option><worldbody>";
    write_body(text, model, state, 0);
    text << "</worldbody></mujoco>";
    const test::TemporaryFolder folder;
    const std::string path = (folder.path() / "judge.xml").string();
    std::ofstream(path) << text.str();
    char error[500] = "";
    m_.reset(mj_loadXML(path.c_str(), nullptr, error, sizeof error));
    if (!m_) throw std::runtime_error(error);
    d_.reset(mj_makeData(m_.get()));
    set(state);
  }

  int freedoms() const { return m_->nv; }

  /// Takes generalised accelerations or forces between the conventions. MuJoCo's base moves by its origin's
  /// velocity in the world and its angular velocity in its own axes; linear part first.
  Eigen::MatrixXd velocity_map(const solver::State& state) const {
    Eigen::MatrixXd map = Eigen::MatrixXd::Identity(m_->nv, m_->nv);
    if (model_.has_fixed_base()) return map;
    map.topLeftCorner(6, 6).setZero();
    map.block(0, 3, 3, 3) = state.base_pose.rotation;
    map.block(3, 0, 3, 3).setIdentity();
    return map;
  }

  /// Joint j of the model is MuJoCo's joint of the same name.
  int address(int joint) const {
    return m_->jnt_dofadr[mj_name2id(m_.get(), mjOBJ_JOINT, model_.joint(joint).name.c_str())];
  }

  void set(const solver::State& state) {
    const int base = model_.has_fixed_base() ? 0 : 6;
    if (base) {
      const Eigen::Quaterniond quat(state.base_pose.rotation);
      const solver::Vector3 v = state.base_pose.rotation * state.base_twist.linear;
      for (int i = 0; i < 3; ++i) {
        d_->qpos[i] = state.base_pose.position[i];
        d_->qvel[i] = v[i];
        d_->qvel[3 + i] = state.base_twist.angular[i];
      }
      d_->qpos[3] = quat.w();
      d_->qpos[4] = quat.x();
      d_->qpos[5] = quat.y();
      d_->qpos[6] = quat.z();
    }
    for (int j = 0; j < model_.joint_count(); ++j) {
      const int at = address(j);
      d_->qpos[at + (base ? 1 : 0)] = state.q[j];
      d_->qvel[at] = state.qd[j];
      d_->qfrc_applied[at] = state.tau_ff[j];
    }
    mj_forward(m_.get(), d_.get());
    for (int k = 0; k < model_.body_count(); ++k) {
      const int id =
          mj_name2id(m_.get(), mjOBJ_BODY, model_.bodies()[static_cast<std::size_t>(k)].name.c_str());
      const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> R =
          Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(d_->xmat + 9 * id);
      const solver::Vector3 origin = Eigen::Map<const solver::Vector3>(d_->xpos + 3 * id);
      const solver::Vector3 centre = Eigen::Map<const solver::Vector3>(d_->xipos + 3 * id);
      const solver::ForceVector& f = state.f_ext[static_cast<std::size_t>(k)];
      const solver::Vector3 force = R * f.linear;
      const solver::Vector3 moment = R * f.angular + (origin - centre).cross(force);
      for (int i = 0; i < 3; ++i) {
        d_->xfrc_applied[6 * id + i] = force[i];
        d_->xfrc_applied[6 * id + 3 + i] = moment[i];
      }
    }
    mj_forward(m_.get(), d_.get());
  }

  /// In the model's order of joints, MuJoCo's conventions on the base.
  Eigen::VectorXd ordered(const double* values) const {
    const int base = model_.has_fixed_base() ? 0 : 6;
    Eigen::VectorXd out(m_->nv);
    for (int i = 0; i < base; ++i) out[i] = values[i];
    for (int j = 0; j < model_.joint_count(); ++j) out[base + j] = values[address(j)];
    return out;
  }
  Eigen::VectorXd acceleration() const { return ordered(d_->qacc); }
  Eigen::VectorXd bias() const { return ordered(d_->qfrc_bias); }
  Eigen::MatrixXd inertia() const {
    const int n = m_->nv;
    Eigen::MatrixXd full(n, n);
    mj_fullM(m_.get(), full.data(), d_->qM);
    Eigen::MatrixXd out(n, n);
    for (int i = 0; i < n; ++i) {
      const Eigen::VectorXd column = full.col(i);
      full.col(i) = ordered(column.data());
    }
    for (int i = 0; i < n; ++i) {
      const Eigen::VectorXd row = full.row(i).transpose();
      out.row(i) = ordered(row.data()).transpose();
    }
    return out;
  }

 private:
  struct Delete {
    void operator()(mjModel* m) const { mj_deleteModel(m); }
    void operator()(mjData* d) const { mj_deleteData(d); }
  };
  solver::Model model_;
  std::unique_ptr<mjModel, Delete> m_;
  std::unique_ptr<mjData, Delete> d_;
};

/// The model's generalised acceleration as MuJoCo writes it: the base's classical acceleration in the world
/// first.
Eigen::VectorXd in_mujoco_words(const solver::Model& model, const solver::State& state,
                                const Eigen::VectorXd& vdot) {
  if (model.has_fixed_base()) return vdot;
  Eigen::VectorXd out = vdot;
  const solver::Vector3 w = state.base_twist.angular;
  const solver::Vector3 v = state.base_twist.linear;
  const solver::Vector3 spatial = vdot.segment(3, 3);
  out.segment(3, 3) = vdot.head(3);
  out.head(3) = state.base_pose.rotation * (spatial + w.cross(v));
  return out;
}

double relative(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / (1.0 + b.cwiseAbs().maxCoeff());
}

class MujocoDynamics : public testing::TestWithParam<Robot> {
 protected:
  static constexpr std::uint64_t trees = 25;
};

TEST_P(MujocoDynamics, InertiaAndBiasOfTheOracle) {
  for (std::uint64_t seed = 1; seed <= trees; ++seed) {
    Random random(seed);
    const solver::Model model = random_model(GetParam(), random, 10.0);
    const solver::State state = random_state(model, random);
    const Judge judge(model, state);
    solver::State unloaded = state;
    for (solver::ForceVector& f : unloaded.f_ext) f = {};
    const DenseDynamics dense(model, unloaded);
    // Kinetic energy and power do not depend on the words: M = map' M_mj map.
    const Eigen::MatrixXd map = judge.velocity_map(state);
    const Eigen::MatrixXd M = map.transpose() * judge.inertia() * map;
    const Eigen::MatrixXd want = dense.M.cast<double>();
    EXPECT_LT((M - want).norm(), 1e-9 * want.norm()) << "seed " << seed;
    // M_mj (map vdot + c) + bias = map^-T tau, c the base's w x v.
    const Eigen::VectorXd c = in_mujoco_words(model, state, Eigen::VectorXd::Zero(judge.freedoms()));
    const Eigen::VectorXd h = map.transpose() * (judge.inertia() * c + judge.bias());
    EXPECT_LT(relative(h, dense.h.cast<double>()), 1e-9) << "seed " << seed;
  }
}

TEST_P(MujocoDynamics, ForwardDynamicsOfTheSolver) {
  for (std::uint64_t seed = 1; seed <= trees; ++seed) {
    Random random(seed);
    const solver::Model model = random_model(GetParam(), random, std::numeric_limits<double>::infinity());
    const solver::State state = random_state(model, random);
    const Judge judge(model, state);
    const DenseDynamics dense(model, state);
    Vector generalised = -dense.h;
    generalised.tail(model.joint_count()) += state.tau_ff.cast<Real>();
    const Eigen::VectorXd want = Vector(Eigen::LLT<Matrix>(dense.M).solve(generalised)).cast<double>();
    EXPECT_LT(relative(in_mujoco_words(model, state, want), judge.acceleration()), 1e-9)
        << "the oracle, seed " << seed;

    solver::Solver solver(model);
    solver::Solution got(model);
    ASSERT_EQ(solver.solve(state, std::vector<solver::Row>{}, got), solver::Status::ok);
    Eigen::VectorXd vdot(judge.freedoms());
    if (!model.has_fixed_base()) vdot.head(6) = got.acceleration[0].vector();
    vdot.tail(model.joint_count()) = got.qdd;
    EXPECT_LT(relative(in_mujoco_words(model, state, vdot), judge.acceleration()), 1e-9) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, MujocoDynamics,
                         testing::Values(Robot::arm, Robot::tree, Robot::floating_tree),
                         [](const auto& robot) { return std::string(to_string(robot.param)); });

}  // namespace
}  // namespace zwang::oracle
