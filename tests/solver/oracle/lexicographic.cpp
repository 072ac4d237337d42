#include "oracle/lexicographic.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "oracle/quadratic_program.hpp"

namespace zwang::oracle {

namespace {

using Eigen::Index;
using solver::RowKind;

bool one_sided(RowKind kind) {
  return kind == RowKind::upper || kind == RowKind::lower;
}

/// A constraint that a level imposes on the levels below: y . c + R mu = e, or a bound on it. Then mu has one
/// sign.
struct Held {
  RowKind kind;  ///< driver stands for an equality
  Vector y;
  Real e;
};

/// A bound on what is pressed along a row's axis, and what the levels above press there.
struct Sum {
  Index row;
  Real above;
};

class Levels {
 public:
  Levels(const ReducedProblem& reduced, const solver::State& state, const std::vector<solver::Row>& rows)
      : p_(reduced), rows_(rows) {
    const LinearRows linear = p_.dynamics.rows(rows);
    Y_ = linear.jacobian * p_.B;
    d_ = linear.rhs - linear.jacobian * p_.free;
    size_ = Vector::Zero(d_.size());
    for (Index i = 0; i < size_.size(); ++i) {
      size_[i] =
          static_cast<Real>(row(i).a.vector().squaredNorm() + row(i).a_reference.vector().squaredNorm());
    }
    without_ground_ = (linear.jacobian * p_.apparent * linear.jacobian.transpose()).diagonal();
    c_ = Vector::Zero(p_.B.cols());
    push_ = Vector::Zero(p_.B.cols());
    out_.rows.resize(rows.size());
    const Index n = p_.dynamics.joints;
    tau_lo_ = tau_hi_ = Vector::Zero(n);
    for (Index j = 0; j < n; ++j) {
      const solver::Joint& joint = p_.model.joint(static_cast<int>(j));
      if (!joint.actuated) continue;
      const auto limit = static_cast<Real>(joint.max_effort);
      tau_lo_[j] = -limit - static_cast<Real>(state.tau_ff[j]);
      tau_hi_[j] = limit - static_cast<Real>(state.tau_ff[j]);
    }
    feed_forward_ = state.tau_ff.cast<Real>();
  }

  OracleSolution run() {
    std::vector<int> levels;
    for (const solver::Row& row : rows_) levels.push_back(row.level);
    std::sort(levels.begin(), levels.end());
    levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
    for (const int level : levels) {
      start_sums(level);
      push(level);
      move(level);
      hold(level);
    }
    finish();
    return out_;
  }

 private:
  std::vector<Index> select(int level, bool force) const {
    std::vector<Index> out;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (rows_[i].kind == RowKind::sum) continue;
      if (rows_[i].level == level && (rows_[i].kind == RowKind::force) == force)
        out.push_back(static_cast<Index>(i));
    }
    return out;
  }
  const solver::Row& row(Index i) const { return rows_[static_cast<std::size_t>(i)]; }
  OracleRow& result(Index i) { return out_.rows[static_cast<std::size_t>(i)]; }
  Vector y(Index i) const { return Y_.row(i).transpose(); }
  /// Whether the ground holds the row's axis, or no motor moves it.
  bool unreachable(Index i) const {
    const Real length = Y_.row(i).squaredNorm();
    if (length < std::max(1e-8L * without_ground_[i], 1e-20L * size_[i])) return true;
    for (Index j = 0; j < p_.G.cols(); ++j) {
      if (!(tau_lo_[j] < tau_hi_[j])) continue;
      const Real along = Y_.row(i).dot(p_.G.col(j));
      if (along * along > 1e-16L * length * p_.G.col(j).squaredNorm()) return false;
    }
    return true;
  }
  /// Whether nothing that the row could do moves its axis: unreachable, or the accelerations that the levels
  /// above have frozen hold it.
  bool idle(Index i) const {
    if (unreachable(i)) return true;
    Matrix frozen(c_.size(), 0);
    for (const Held& held : held_) {
      if (one_sided(held.kind)) continue;
      frozen.conservativeResize(Eigen::NoChange, frozen.cols() + 1);
      frozen.col(frozen.cols() - 1) = held.y;
    }
    if (frozen.cols() == 0) return false;
    Eigen::CompleteOrthogonalDecomposition<Matrix> cod;
    cod.setThreshold(1e-12L);
    cod.compute(frozen);
    const Vector left = y(i) - frozen * cod.solve(y(i));
    return left.squaredNorm() < 1e-8L * y(i).squaredNorm();
  }
  Real softness(Index i) const { return 1 / static_cast<Real>(row(i).weight); }
  Real wrench(Index i) const { return static_cast<Real>(row(i).force); }

  /// The force that a contact which blocks the axis of row i, and nothing else, has to answer c with.
  Real pressed(Index i, const Vector& c) const { return y(i).dot(c) / y(i).squaredNorm(); }
  /// A sum counts what is added to the motion from its level on.
  void start_sums(int level) {
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const auto i = static_cast<Index>(r);
      if (row(i).kind != RowKind::sum || row(i).level != level || unreachable(i)) continue;
      sums_.push_back({i, pressed(i, c_)});
    }
  }

  /// Variables [own rows; held multipliers; torques; slacks of held one-sided rows; sums]. Equations: the
  /// torques make the motion c = own forces + held forces + push_; the held rows keep what they achieved; the
  /// sums are those of c.
  struct Layout {
    Index own, held, torques, slacks, sums;
    Index mu() const { return own; }
    Index tau() const { return own + held; }
    Index slack() const { return own + held + torques; }
    Index sum() const { return slack() + slacks; }
    Index size() const { return sum() + sums; }
  };

  QuadraticProgram pose(const Matrix& own, Layout& at) const {
    const Index m = c_.size();
    at = {own.rows(), static_cast<Index>(held_.size()), p_.G.cols(), 0, static_cast<Index>(sums_.size())};
    for (const Held& held : held_) at.slacks += one_sided(held.kind);
    QuadraticProgram qp(at.size(), m + at.held + at.sums);
    // c = own' own_x + Z' mu + push_
    Matrix toC = Matrix::Zero(m, at.size());
    toC.leftCols(at.own) = own.transpose();
    for (Index k = 0; k < at.held; ++k) toC.col(at.mu() + k) = held_[static_cast<std::size_t>(k)].y;
    qp.E.topRows(m) = toC;
    qp.E.block(0, at.tau(), m, at.torques) = -p_.G;
    qp.e.head(m) = -push_;
    Index slack = at.slack();
    for (Index k = 0; k < at.held; ++k) {
      const Held& held = held_[static_cast<std::size_t>(k)];
      qp.E.row(m + k) = held.y.transpose() * toC;
      qp.e[m + k] = held.e - held.y.dot(push_);
      if (!one_sided(held.kind)) continue;
      const bool upper = held.kind == RowKind::upper;
      qp.E(m + k, slack) = upper ? 1 : -1;
      qp.lo[slack++] = 0;
      (upper ? qp.hi : qp.lo)[at.mu() + k] = 0;
    }
    qp.lo.segment(at.tau(), at.torques) = tau_lo_;
    qp.hi.segment(at.tau(), at.torques) = tau_hi_;
    for (Index k = 0; k < at.sums; ++k) {
      const Sum& sum = sums_[static_cast<std::size_t>(k)];
      const Vector along = y(sum.row) / y(sum.row).squaredNorm();
      const Index equation = m + at.held + k;
      qp.E.row(equation) = along.transpose() * toC;
      qp.E(equation, at.sum() + k) = -1;
      qp.e[equation] = sum.above - along.dot(push_);
      qp.lo[at.sum() + k] = static_cast<Real>(row(sum.row).lo);
      qp.hi[at.sum() + k] = static_cast<Real>(row(sum.row).hi);
    }
    return qp;
  }

  QuadraticSolution solve_stage(const QuadraticProgram& qp) {
    const QuadraticSolution s = oracle::solve(qp);
    out_.error = std::max(out_.error, s.error);
    return s;
  }

  /// (a) How much of its wrench each force row of the level gets: its motion rows still silent.
  void push(int level) {
    const std::vector<Index> forces = select(level, true);
    if (forces.empty()) return;
    Matrix own(static_cast<Index>(forces.size()), c_.size());
    for (Index k = 0; k < own.rows(); ++k) {
      const Index i = forces[static_cast<std::size_t>(k)];
      own.row(k) = wrench(i) * Y_.row(i);
    }
    Layout at{};
    QuadraticProgram qp = pose(own, at);
    for (Index k = 0; k < at.own; ++k) {
      qp.H(k, k) = 2;
      qp.g[k] = 2;
      qp.lo[k] = 0;
      qp.hi[k] = idle(forces[static_cast<std::size_t>(k)]) ? 0 : 1;
    }
    const QuadraticSolution s = solve_stage(qp);
    for (Index k = 0; k < at.own; ++k) {
      const Index i = forces[static_cast<std::size_t>(k)];
      result(i).idle = idle(i);
      result(i).phi = std::clamp(s.x[k], Real(0), Real(1));
      result(i).nu = result(i).phi * wrench(i);
      push_ += result(i).nu * y(i);
    }
  }

  /// (b) The level's motion rows. Also run for a level of force rows alone, whose motion the rows above bend.
  void move(int level) {
    const std::vector<Index> motions = select(level, false);
    Matrix own(static_cast<Index>(motions.size()), c_.size());
    for (Index k = 0; k < own.rows(); ++k) own.row(k) = Y_.row(motions[static_cast<std::size_t>(k)]);
    Layout at{};
    QuadraticProgram qp = pose(own, at);
    Matrix toC(c_.size(), at.tau());
    toC.leftCols(at.own) = own.transpose();
    for (Index k = 0; k < at.own; ++k) {
      const Index i = motions[static_cast<std::size_t>(k)];
      qp.H(k, k) = softness(i);
      qp.g[k] = d_[i] - y(i).dot(push_);
      qp.lo[k] = static_cast<Real>(row(i).lo);
      qp.hi[k] = static_cast<Real>(row(i).hi);
      if (idle(i)) qp.lo[k] = qp.hi[k] = 0;
      if (row(i).kind == RowKind::upper) qp.hi[k] = std::min(qp.hi[k], Real(0));
      if (row(i).kind == RowKind::lower) qp.lo[k] = std::max(qp.lo[k], Real(0));
    }
    for (Index k = 0; k < at.held; ++k) {
      const Held& held = held_[static_cast<std::size_t>(k)];
      toC.col(at.mu() + k) = held.y;
      qp.g[at.mu() + k] = held.e - held.y.dot(push_);
    }
    qp.H.topLeftCorner(at.tau(), at.tau()) += toC.transpose() * toC;
    const QuadraticSolution s = solve_stage(qp);
    c_ = toC * s.x.head(at.tau()) + push_;
    shorten(motions, qp, at, s);
  }

  /// The shortest of the multipliers (one-sided rows from above among them) that make the same motion: those
  /// that stay where a bound carries force.
  void shorten(const std::vector<Index>& motions, const QuadraticProgram& qp, const Layout& at,
               const QuadraticSolution& found) {
    if (motions.empty()) return;
    const Index n = at.tau();
    const Vector x = found.x.head(n);
    QuadraticProgram shortest(n, n);
    shortest.H.diagonal().head(at.own).setOnes();
    for (Index k = 0; k < at.held; ++k) {
      if (one_sided(held_[static_cast<std::size_t>(k)].kind)) shortest.H(at.mu() + k, at.mu() + k) = 1;
    }
    shortest.E = qp.H.topLeftCorner(n, n);
    shortest.e = shortest.E * x;
    const Real carries = 1e-13L * (1 + found.bound_force.cwiseAbs().maxCoeff());
    for (Index i = 0; i < n; ++i) {
      const bool fixed = std::abs(found.bound_force[i]) > carries;
      shortest.lo[i] = fixed ? x[i] : qp.lo[i];
      shortest.hi[i] = fixed ? x[i] : qp.hi[i];
    }
    const bool single = only_one(shortest);
    const QuadraticSolution s = single ? found : solve_stage(shortest);
    const Real size = 1 + x.head(at.own).cwiseAbs().maxCoeff();
    for (Index k = 0; k < at.own; ++k) {
      OracleRow& r = result(motions[static_cast<std::size_t>(k)]);
      r.nu = s.x[k];
      r.idle = idle(motions[static_cast<std::size_t>(k)]);
      // The interior point ends in the middle of the optimal multipliers; a single one is the shortest too.
      r.unique = single || std::abs(s.x[k] - x[k]) < 1e-11L * size;
    }
  }

  /// Whether the equations leave the variables that may still move no freedom.
  static bool only_one(const QuadraticProgram& qp) {
    Matrix moving(qp.E.rows(), 0);
    for (Index i = 0; i < qp.g.size(); ++i) {
      if (qp.lo[i] == qp.hi[i]) continue;
      if (!(qp.E(i, i) > 0)) return false;
      moving.conservativeResize(Eigen::NoChange, moving.cols() + 1);
      moving.col(moving.cols() - 1) = qp.E.col(i) / qp.E.col(i).norm();
    }
    if (moving.cols() == 0) return true;
    Eigen::ColPivHouseholderQR<Matrix> qr(moving);
    qr.setThreshold(1e-11L);
    return qr.rank() == moving.cols();
  }

  /// Keeps the level's accelerations for those below.
  void hold(int level) {
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const auto i = static_cast<Index>(r);
      if (row(i).level != level || row(i).kind == RowKind::sum || unreachable(i)) continue;
      const RowKind kind = row(i).kind;
      const Real achieved = y(i).dot(c_);
      Held held{one_sided(kind) ? kind : RowKind::driver, y(i), achieved};
      if (kind == RowKind::upper) held.e = std::max(achieved, d_[i]);
      if (kind == RowKind::lower) held.e = std::min(achieved, d_[i]);
      held_.push_back(held);
    }
  }

  /// The shortest torque that makes the motion.
  void finish() {
    const Index n = p_.G.cols();
    QuadraticProgram qp(n, c_.size());
    qp.H.setIdentity();
    qp.E = p_.G;
    qp.e = c_;
    qp.lo = tau_lo_;
    qp.hi = tau_hi_;
    out_.tau = solve_stage(qp).x;
    for (Index j = 0; j < n; ++j) {
      if (p_.model.joint(static_cast<int>(j)).actuated) out_.tau[j] += feed_forward_[j];
    }
    out_.vdot = p_.free + p_.B * c_;
    out_.mobility = static_cast<int>(c_.size());
    Eigen::ColPivHouseholderQR<Matrix> motors(p_.G);
    motors.setThreshold(1e-8L);
    out_.motors_reach_all = motors.rank() == p_.G.rows();
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const auto i = static_cast<Index>(r);
      out_.rows[r].residual = y(i).dot(c_) - d_[i];
      out_.rows[r].demand = d_[i];
      out_.rows[r].unreachable = unreachable(i);
      out_.rows[r].acceleration = out_.rows[r].residual + static_cast<Real>(row(i).b);
    }
    for (const Sum& sum : sums_) result(sum.row).nu = pressed(sum.row, c_) - sum.above;
    for (int k = 0; k < p_.model.body_count(); ++k) {
      out_.spatial_acceleration.push_back(p_.dynamics.spatial_acceleration(k, out_.vdot));
    }
  }

  const ReducedProblem& p_;
  const std::vector<solver::Row>& rows_;
  Matrix Y_;
  Vector size_;            ///< a' a
  Vector without_ground_;  ///< A M^-1 A', the diagonal
  Vector d_;               ///< b - bias - A free
  Vector c_;               ///< the motion so far
  Vector push_;            ///< B' of the force rows' wrenches so far
  std::vector<Held> held_;
  std::vector<Sum> sums_;
  Vector tau_lo_, tau_hi_, feed_forward_;
  OracleSolution out_;
};

}  // namespace

OracleSolution solve(const solver::Model& model, const solver::State& state,
                     const std::vector<solver::Row>& rows, bool project_velocity) {
  const ReducedProblem reduced(model, state, project_velocity);
  return Levels(reduced, state, rows).run();
}

}  // namespace zwang::oracle
