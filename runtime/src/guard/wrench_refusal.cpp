#include "guard/wrench_refusal.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "zwang/solver/frame.hpp"

namespace zwang::runtime {

namespace {

using solver::Matrix3;
using solver::Row;
using solver::RowKind;
using solver::Vector3;

constexpr double another_direction = 0.05;  // sine of the angle to those that are known

bool limits_a_force(const Row& row) {
  if (row.kind == RowKind::driver) return std::isfinite(row.lo) || std::isfinite(row.hi);
  return row.kind == RowKind::force || row.kind == RowKind::sum;
}

/// Orthogonal unit directions in the world that span those that were added.
class Span {
 public:
  void add(const Vector3& direction) {
    const double size = direction.norm();
    if (count_ == directions_.size() || size == 0.0) return;
    const Vector3 unit = direction / size;
    const Vector3 rest = unit - along(unit);
    const double is_new = rest.norm();
    if (is_new > another_direction) directions_[count_++] = rest / is_new;
  }
  Vector3 along(const Vector3& v) const {
    Vector3 part = Vector3::Zero();
    for (std::size_t i = 0; i < count_; ++i) part += directions_[i].dot(v) * directions_[i];
    return part;
  }
  bool empty() const { return count_ == 0; }

 private:
  std::array<Vector3, 3> directions_;
  std::size_t count_ = 0;
};

}  // namespace

std::optional<Event> WrenchRefusal::look(std::span<const solver::RowSet> sets, solver::State& state,
                                         double time) noexcept {
  const auto is_zero = [](const solver::ForceVector& f) { return f.is_zero(); };
  if (std::all_of(state.f_ext.begin(), state.f_ext.end(), is_zero)) return std::nullopt;
  const auto rotation = [&](int body) {
    return solver::motion_of({body, {}, {}}, model_, state).pose.rotation;
  };
  Span forces, moments;
  for (const solver::RowSet& set : sets) {
    for (const Row& row : *set.rows) {
      if (!limits_a_force(row)) continue;
      const bool turns = row.a.linear.isZero();
      (turns ? moments : forces).add(rotation(row.body) * (turns ? row.a.angular : row.a.linear));
    }
  }
  if (forces.empty() && moments.empty()) return std::nullopt;
  double largest = 0.0;
  int on = 0;
  for (std::size_t k = 0; k < state.f_ext.size(); ++k) {
    solver::ForceVector& f = state.f_ext[k];
    if (f.is_zero()) continue;
    const Matrix3 R = rotation(static_cast<int>(k));
    const Vector3 force = forces.along(R * f.linear), moment = moments.along(R * f.angular);
    f.linear -= R.transpose() * force;
    f.angular -= R.transpose() * moment;
    const double size = std::max(force.norm(), moment.norm());
    if (size <= largest) continue;
    largest = size;
    on = static_cast<int>(k);
  }
  if (largest <= threshold) return std::nullopt;
  const bool begins = !last_ || time - *last_ > pause;
  last_ = time;
  if (!begins) return std::nullopt;
  return Event{EventCode::wrench_refused, time, event_signal::f_ext(model_.joint_count(), on), largest};
}

}  // namespace zwang::runtime
