#include "schedule/wait_course.hpp"

namespace zwang::runtime {

std::vector<Compared> comparisons(const std::vector<lang::Exit>& exits) {
  using lang::Op;
  std::vector<Compared> all;
  for (std::size_t i = 0; i < exits.size(); ++i) {
    const std::vector<lang::ExpressionNode>& nodes = exits[i].when.nodes;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const Op op = nodes[n].op;
      const bool wants_less = op == Op::less || op == Op::less_equal;
      if (wants_less || op == Op::greater || op == Op::greater_equal)
        all.push_back({i, static_cast<int>(n), nodes[n].left, nodes[n].right, wants_less});
    }
  }
  return all;
}

Trend WaitCourse::trend(std::size_t compared, double now, bool is_turned, double period) const noexcept {
  Trend trend;
  if (kept_ == 0 || !std::isfinite(now)) return trend;
  const double sign = is_turned ? -1.0 : 1.0;
  const auto lack = [&](std::size_t k) { return sign * lacks_[compared * most_kept + k]; };
  const auto since = [&](std::size_t k) { return static_cast<double>(ticks_ - 1 - k * stride_) * period; };
  const double same = 0.01 * std::abs(now);

  // pace = (lack before - lack now) / time between, over half a stride at least
  std::size_t before = kept_ - 1;
  if (before > 0 && 2 * (ticks_ - 1 - before * stride_) < stride_) --before;
  const double nearer = lack(before) - now;
  if (nearer > same && since(before) > 0.0) trend.left = now * since(before) / nearer;

  std::size_t first = kept_;
  while (first > 0 && std::abs(lack(first - 1) - now) <= same) --first;
  if (first + 1 < kept_) {
    trend.stood = since(first);
    trend.is_whole = first == 0;
  }
  trend.grows = kept_ > 2 && now - lack(0) > same;
  for (std::size_t k = 0; k + 1 < kept_; ++k) trend.grows = trend.grows && lack(k + 1) > lack(k);
  trend.grows = trend.grows && now >= lack(kept_ - 1);
  return trend;
}

}  // namespace zwang::runtime
