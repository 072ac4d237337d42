#include "schedule/edge_braking.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::runtime {

double braking_alone(const Eigen::Vector2d& n, const Eigen::Vector2d& box) noexcept {
  constexpr double none = 1e-9;
  const Eigen::Vector2d m = n.cwiseAbs().cwiseMax(none);
  return std::min(box.x() / m.x(), box.y() / m.y());
}

/// By Farkas there is such an a when no weights l1, l2 >= 0 contradict it,
///   t (l1 s1 + l2 s2) <= max over the box of m.a = b_x |m_x| + b_y |m_y|    with m = l1 n1 + l2 n2.
/// The bound of t is linear between the weights at which m_x or m_y vanishes. So t is decided there.
double share_of_two(const Eigen::Vector2d& n1, const Eigen::Vector2d& n2,
                    const Eigen::Vector2d& box) noexcept {
  const double s1 = braking_alone(n1, box), s2 = braking_alone(n2, box);
  double t = 1.0;
  for (int i = 0; i < 2; ++i) {
    if (n1(i) * n2(i) >= 0.0) continue;
    const double l1 = std::abs(n2(i)), l2 = std::abs(n1(i));
    const Eigen::Vector2d m = l1 * n1 + l2 * n2;
    t = std::min(t, box.dot(m.cwiseAbs()) / (l1 * s1 + l2 * s2));
  }
  return t;
}

}  // namespace zwang::runtime
