/// How sure a share is that was counted, and what goes with what. Closed forms only: no simulation.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace zwang::study {

/// The regularised incomplete beta function I_x(a, b), for a, b > 0 and 0 <= x <= 1.
double incomplete_beta(double a, double b, double x);
/// The x with I_x(a, b) = p.
double beta_quantile(double p, double a, double b);

/// Of a share, 0 to 1.
struct Interval {
  double low = 0.0, high = 1.0;
};
/// That of Clopper and Pearson: it holds the true share with the confidence at least, each side with half of
/// what is left.
Interval clopper_pearson(std::size_t held, std::size_t runs, double confidence);
/// The share is at least, or at most, this with the confidence: one side has all of what is left.
double surely_at_least(std::size_t held, std::size_t runs, double confidence);
double surely_at_most(std::size_t held, std::size_t runs, double confidence);

enum class Verdict { held, broken, too_few_runs };
const char* to_string(Verdict verdict);
/// Without a probability each run must hold.
Verdict judge(std::size_t held, std::size_t runs, const std::optional<double>& probability,
              double confidence);

/// The least value that at least the share `p` of all is not above. `sorted` is not empty.
double quantile_of(const std::vector<double>& sorted, double p);

/// Spearman's: -1 to 1; equal values share the mean of their ranks. nullopt where one of the two is constant.
std::optional<double> rank_correlation(const std::vector<double>& x, const std::vector<double>& y);
/// Spearman's, of the ranks within each group. A group whose values are all larger does not hide what goes
/// with them inside of it.
std::optional<double> rank_correlation_within(const std::vector<double>& x, const std::vector<double>& y,
                                              const std::vector<std::size_t>& group);

}  // namespace zwang::study
