#include "oracle/quadratic_program.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <vector>

namespace zwang::oracle {

namespace {

using Eigen::Index;

constexpr Real exact = 1e-16L;

Real largest(const Vector& v) {
  return v.size() ? v.cwiseAbs().maxCoeff() : Real(0);
}

/// The problem without its fixed variables, with unit scale in every variable, and independent equations.
struct Reduced {
  QuadraticProgram problem{0, 0};
  std::vector<Index> kept;
  Vector scale;  ///< x_original = scale * x
  Vector fixed;  ///< the original with 0 at the kept variables

  Vector restore(const Vector& x) const {
    Vector out = fixed;
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const auto r = static_cast<Index>(i);
      out[kept[i]] = scale[r] * x[r];
    }
    return out;
  }
};

Reduced reduce(const QuadraticProgram& p) {
  Reduced out;
  const Index n = p.g.size();
  out.fixed = Vector::Zero(n);
  for (Index i = 0; i < n; ++i) {
    if (p.lo[i] == p.hi[i]) {
      out.fixed[i] = p.lo[i];
    } else {
      out.kept.push_back(i);
    }
  }
  const auto m = static_cast<Index>(out.kept.size());
  out.scale = Vector::Ones(m);
  QuadraticProgram q(m, p.e.size());
  const Vector g = p.g - p.H * out.fixed;
  for (Index i = 0; i < m; ++i) {
    const Index a = out.kept[static_cast<std::size_t>(i)];
    q.g[i] = g[a];
    q.lo[i] = p.lo[a];
    q.hi[i] = p.hi[a];
    q.E.col(i) = p.E.col(a);
    for (Index j = 0; j < m; ++j) q.H(i, j) = p.H(a, out.kept[static_cast<std::size_t>(j)]);
  }
  q.e = p.e - p.E * out.fixed;
  for (Index i = 0; i < m; ++i) {
    const Real size = std::max(std::sqrt(q.H(i, i)), q.E.rows() ? q.E.col(i).norm() : Real(0));
    if (size > 0) out.scale[i] = 1 / size;
  }
  const auto S = out.scale.asDiagonal();
  q.H = S * q.H * S;
  q.g = S * q.g;
  q.E = q.E * S;
  q.lo = q.lo.cwiseQuotient(out.scale);
  q.hi = q.hi.cwiseQuotient(out.scale);
  if (q.E.rows() && q.E.cols()) {
    // Q' E P = R: the leading rows say everything that the equations say.
    Eigen::ColPivHouseholderQR<Matrix> qr(q.E);
    qr.setThreshold(1e-13L);
    const Index rank = qr.rank();
    const Matrix Qt = Matrix(qr.householderQ()).transpose().topRows(rank);
    q.e = (Qt * q.e).eval();
    q.E = (Qt * q.E).eval();
  } else {
    q.E.resize(0, m);
    q.e.resize(0);
  }
  out.problem = q;
  return out;
}

struct Iterate {
  Vector x, y, zl, zu;
};

bool has_low(const QuadraticProgram& p, Index i) {
  return std::isfinite(p.lo[i]);
}
bool has_high(const QuadraticProgram& p, Index i) {
  return std::isfinite(p.hi[i]);
}

Vector start(const QuadraticProgram& p) {
  Vector x(p.g.size());
  for (Index i = 0; i < x.size(); ++i) {
    const bool low = has_low(p, i);
    const bool high = has_high(p, i);
    const Real width = low && high ? p.hi[i] - p.lo[i] : unbounded;
    const Real away = std::min(Real(1), width / 2);
    x[i] = low && high ? std::clamp(Real(0), p.lo[i] + away / 2, p.hi[i] - away / 2)
           : low       ? std::max(Real(0), p.lo[i] + 1)
           : high      ? std::min(Real(0), p.hi[i] - 1)
                       : Real(0);
  }
  return x;
}

/// Mehrotra's predictor and corrector on the primal-dual system, x kept strictly inside its box.
class InteriorPoint {
 public:
  explicit InteriorPoint(const QuadraticProgram& problem) : p_(problem) {
    const Index n = p_.g.size();
    v_.x = start(p_);
    v_.y = Vector::Zero(p_.e.size());
    v_.zl = Vector::Zero(n);
    v_.zu = Vector::Zero(n);
    const Real size = std::max(Real(1), largest(p_.g));
    for (Index i = 0; i < n; ++i) {
      if (has_low(p_, i)) v_.zl[i] = size, ++bounds_;
      if (has_high(p_, i)) v_.zu[i] = size, ++bounds_;
    }
  }

  int run() {
    const Real size = 1 + largest(p_.g) + largest(p_.e);
    int steps = 0;
    for (; steps < 120; ++steps) {
      const Vector rd = p_.H * v_.x - p_.g + p_.E.transpose() * v_.y - v_.zl + v_.zu;
      const Vector rp = p_.E * v_.x - p_.e;
      const Real mu = complementarity(v_);
      if (std::max({largest(rd), largest(rp), mu}) < 1e-17L * size) break;
      factor();
      const Iterate predictor = direction(rd, rp, 0, nullptr);
      const Real reach = step_to_boundary(predictor, 1);
      Iterate ahead = v_;
      advance(ahead, predictor, reach);
      const Real ratio = mu > 0 ? complementarity(ahead) / mu : Real(0);
      const Real sigma = ratio * ratio * ratio;
      const Iterate corrector = direction(rd, rp, sigma * mu, &predictor);
      const Real length = step_to_boundary(corrector, 0.995L);
      if (!std::isfinite(length) || !corrector.x.allFinite() || !corrector.y.allFinite()) break;
      advance(v_, corrector, length);
    }
    return steps;
  }

  const Iterate& iterate() const { return v_; }

 private:
  Real low_gap(const Iterate& v, Index i) const { return std::max(v.x[i] - p_.lo[i], Real(1e-30L)); }
  Real high_gap(const Iterate& v, Index i) const { return std::max(p_.hi[i] - v.x[i], Real(1e-30L)); }

  Real complementarity(const Iterate& v) const {
    Real sum = 0;
    for (Index i = 0; i < v.x.size(); ++i) {
      if (has_low(p_, i)) sum += low_gap(v, i) * v.zl[i];
      if (has_high(p_, i)) sum += high_gap(v, i) * v.zu[i];
    }
    return bounds_ ? sum / bounds_ : Real(0);
  }

  void factor() {
    const Index n = p_.g.size();
    const Index m = p_.e.size();
    Matrix K = Matrix::Zero(n + m, n + m);
    K.topLeftCorner(n, n) = p_.H;
    for (Index i = 0; i < n; ++i) {
      K(i, i) += 1e-15L;
      if (has_low(p_, i)) K(i, i) += v_.zl[i] / low_gap(v_, i);
      if (has_high(p_, i)) K(i, i) += v_.zu[i] / high_gap(v_, i);
    }
    K.topRightCorner(n, m) = p_.E.transpose();
    K.bottomLeftCorner(m, n) = p_.E;
    K.bottomRightCorner(m, m).diagonal().setConstant(-1e-15L);
    lu_.compute(K);
  }

  Iterate direction(const Vector& rd, const Vector& rp, Real target, const Iterate* second_order) const {
    const Index n = p_.g.size();
    const Index m = p_.e.size();
    Vector rhs(n + m);
    rhs << -rd, -rp;
    Vector cl = Vector::Zero(n);
    Vector cu = Vector::Zero(n);
    for (Index i = 0; i < n; ++i) {
      if (has_low(p_, i)) {
        cl[i] = target - low_gap(v_, i) * v_.zl[i];
        if (second_order) cl[i] -= second_order->x[i] * second_order->zl[i];
        rhs[i] += cl[i] / low_gap(v_, i);
      }
      if (has_high(p_, i)) {
        cu[i] = target - high_gap(v_, i) * v_.zu[i];
        if (second_order) cu[i] += second_order->x[i] * second_order->zu[i];
        rhs[i] -= cu[i] / high_gap(v_, i);
      }
    }
    const Vector d = lu_.solve(rhs);
    Iterate out{d.head(n), d.tail(m), Vector::Zero(n), Vector::Zero(n)};
    for (Index i = 0; i < n; ++i) {
      if (has_low(p_, i)) out.zl[i] = (cl[i] - v_.zl[i] * out.x[i]) / low_gap(v_, i);
      if (has_high(p_, i)) out.zu[i] = (cu[i] + v_.zu[i] * out.x[i]) / high_gap(v_, i);
    }
    return out;
  }

  Real step_to_boundary(const Iterate& d, Real fraction) const {
    Real t = 1;
    const auto limit = [&](Real value, Real slope) {
      if (slope < 0) t = std::min(t, -fraction * value / slope);
    };
    for (Index i = 0; i < d.x.size(); ++i) {
      if (has_low(p_, i)) limit(low_gap(v_, i), d.x[i]), limit(v_.zl[i], d.zl[i]);
      if (has_high(p_, i)) limit(high_gap(v_, i), -d.x[i]), limit(v_.zu[i], d.zu[i]);
    }
    return t;
  }

  static void advance(Iterate& v, const Iterate& d, Real t) {
    v.x += t * d.x;
    v.y += t * d.y;
    v.zl += t * d.zl;
    v.zu += t * d.zu;
  }

  const QuadraticProgram& p_;
  Iterate v_;
  int bounds_ = 0;
  Eigen::PartialPivLU<Matrix> lu_;
};

enum class Side { inside, low, high };

/// Solves the optimality conditions with the given variables on their bounds, as near to `near` as possible.
void solve_on_face(const QuadraticProgram& p, const std::vector<Side>& side, Vector& x, Vector& y) {
  const Index n = p.g.size();
  const Index m = p.e.size();
  std::vector<Index> inside;
  for (Index i = 0; i < n; ++i) {
    const Side s = side[static_cast<std::size_t>(i)];
    if (s == Side::inside) inside.push_back(i);
    if (s == Side::low) x[i] = p.lo[i];
    if (s == Side::high) x[i] = p.hi[i];
  }
  const auto f = static_cast<Index>(inside.size());
  Matrix K = Matrix::Zero(f + m, f + m);
  for (Index i = 0; i < f; ++i) {
    const Index a = inside[static_cast<std::size_t>(i)];
    for (Index j = 0; j < f; ++j) K(i, j) = p.H(a, inside[static_cast<std::size_t>(j)]);
    K.block(f, i, m, 1) = p.E.col(a);
    K.block(i, f, 1, m) = p.E.col(a).transpose();
  }
  if (f + m == 0) return;
  Eigen::CompleteOrthogonalDecomposition<Matrix> decomposition;
  decomposition.setThreshold(1e-14L);
  decomposition.compute(K);
  for (int refinement = 0; refinement < 3; ++refinement) {
    const Vector rd = p.H * x - p.g + p.E.transpose() * y;
    Vector rhs(f + m);
    for (Index i = 0; i < f; ++i) rhs[i] = -rd[inside[static_cast<std::size_t>(i)]];
    rhs.tail(m) = p.e - p.E * x;
    const Vector d = decomposition.solve(rhs);
    for (Index i = 0; i < f; ++i) x[inside[static_cast<std::size_t>(i)]] += d[i];
    y += d.tail(m);
  }
}

/// On which bounds a primal-dual point within `mu` of the optimum lies.
std::vector<Side> guess(const QuadraticProgram& p, const Iterate& v, Real gap) {
  std::vector<Side> side(static_cast<std::size_t>(v.x.size()), Side::inside);
  for (Index i = 0; i < v.x.size(); ++i) {
    const Real below = has_low(p, i) ? v.x[i] - p.lo[i] : unbounded;
    const Real above = has_high(p, i) ? p.hi[i] - v.x[i] : unbounded;
    if (std::min(below, above) < gap)
      side[static_cast<std::size_t>(i)] = below < above ? Side::low : Side::high;
  }
  return side;
}

/// A bound holds a variable that its force presses harder than the gap is wide.
std::vector<Side> guess_by_force(const QuadraticProgram& p, const Iterate& v, Real weight) {
  std::vector<Side> side(static_cast<std::size_t>(v.x.size()), Side::inside);
  for (Index i = 0; i < v.x.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (has_low(p, i) && v.x[i] - p.lo[i] < weight * v.zl[i]) side[k] = Side::low;
    if (has_high(p, i) && p.hi[i] - v.x[i] < weight * v.zu[i]) side[k] = Side::high;
  }
  return side;
}

/// Puts on its bound what went beyond it and lets go what a bound pulls; false where there is nothing of
/// either.
bool correct(const QuadraticProgram& p, const Vector& x, const Vector& y, std::vector<Side>& side) {
  const Vector gradient = p.H * x - p.g + p.E.transpose() * y;
  const Real force = exact * (1 + largest(p.H * x) + largest(p.g));
  const Real size = exact * (1 + largest(x));
  bool changed = false;
  for (Index i = 0; i < x.size(); ++i) {
    Side& s = side[static_cast<std::size_t>(i)];
    const Side before = s;
    if (s == Side::inside) {
      if (x[i] < p.lo[i] - size) s = Side::low;
      if (x[i] > p.hi[i] + size) s = Side::high;
    } else if ((s == Side::low && gradient[i] < -force) || (s == Side::high && gradient[i] > force)) {
      s = Side::inside;
    }
    changed = changed || s != before;
  }
  return changed;
}

}  // namespace

Real optimality_error(const QuadraticProgram& p, const Vector& x, const Vector& y) {
  const Vector gradient = p.H * x - p.g + p.E.transpose() * y;
  const Real force = 1 + largest(p.H * x) + largest(p.g);
  const Real size = 1 + largest(x);
  Real worst = p.e.size() ? largest(p.E * x - p.e) / (1 + largest(p.e)) : Real(0);
  for (Index i = 0; i < x.size(); ++i) {
    const Real below = x[i] - p.lo[i];
    const Real above = p.hi[i] - x[i];
    worst = std::max({worst, -below / size, -above / size});
    // Off a bound the gradient is 0; at one it pushes against it.
    const Real pushes_down = std::max(gradient[i], Real(0)) / force;
    const Real pushes_up = std::max(-gradient[i], Real(0)) / force;
    worst = std::max(
        {worst, std::min(pushes_down, std::abs(below) / size), std::min(pushes_up, std::abs(above) / size)});
  }
  return worst;
}

namespace {

struct Best {
  Vector x, y;
  Real error;
};

/// Tries the active sets that an interior point suggests, and those that their failures suggest.
void polish(const QuadraticProgram& p, const Iterate& v, Best& best) {
  const Real size = 1 + largest(v.x);
  const auto attempt = [&](std::vector<Side> side) {
    for (int flips = 0; flips < 20 && best.error > exact; ++flips) {
      Vector x = v.x;
      Vector y = v.y;
      solve_on_face(p, side, x, y);
      const Real error = optimality_error(p, x, y);
      if (error < best.error) best = {x, y, error};
      if (!correct(p, x, y, side)) break;
    }
  };
  for (Real weight = 1e-2L; weight < 1e4L; weight *= 10) attempt(guess_by_force(p, v, weight));
  for (Real gap = 1e-4L; gap > 1e-17L; gap /= 10) attempt(guess(p, v, gap * size));
}

}  // namespace

QuadraticSolution solve(const QuadraticProgram& problem) {
  const Reduced reduced = reduce(problem);
  const QuadraticProgram& p = reduced.problem;
  InteriorPoint interior(p);
  QuadraticSolution best;
  best.iterations = interior.run();
  const Iterate& v = interior.iterate();
  Best found{v.x, v.y, optimality_error(p, v.x, v.y)};
  polish(p, v, found);
  // A feasible set without interior leaves the multipliers without bound and stalls the interior point. Boxes
  // a little wider, each by its own amount, have an interior; the exact solve on the face is always of the
  // true one.
  for (Real relax = 1e-4L; relax > 1e-10L && found.error > 1e-15L; relax /= 10) {
    QuadraticProgram wider = p;
    for (Index i = 0; i < p.g.size(); ++i) {
      const Real own = relax * (1 + static_cast<Real>((7 * i) % 11) / 11);
      wider.lo[i] -= own;
      wider.hi[i] += own;
    }
    InteriorPoint second(wider);
    best.iterations += second.run();
    polish(p, second.iterate(), found);
  }
  best.error = found.error;
  const Vector& best_x = found.x;
  const Vector& best_y = found.y;
  best.x = reduced.restore(best_x);
  best.bound_force = Vector::Zero(problem.g.size());
  const Vector gradient = p.H * best_x - p.g + p.E.transpose() * best_y;
  for (std::size_t i = 0; i < reduced.kept.size(); ++i) {
    best.bound_force[reduced.kept[i]] = gradient[static_cast<Index>(i)];
  }
  return best;
}

}  // namespace zwang::oracle
