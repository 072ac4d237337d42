// Shares with their intervals, against tables, closed forms and sums of the binomial distribution.
#include "study/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "zwang/lang/study.hpp"

namespace zwang::study {
namespace {

/// P(X = k) of n draws with the share p.
double binomial(std::size_t k, std::size_t n, double p) {
  const auto x = static_cast<double>(k), m = static_cast<double>(n);
  const double ways = std::lgamma(m + 1.0) - std::lgamma(x + 1.0) - std::lgamma(m - x + 1.0);
  return std::exp(ways + x * std::log(p) + (m - x) * std::log1p(-p));
}

double at_least(std::size_t k, std::size_t n, double p) {
  double sum = 0.0;
  for (std::size_t i = k; i <= n; ++i) sum += binomial(i, n, p);
  return sum;
}

TEST(IncompleteBeta, HasItsClosedForms) {
  for (const double x : {0.0, 0.01, 0.3, 0.5, 0.77, 0.999, 1.0}) {
    EXPECT_NEAR(incomplete_beta(1.0, 1.0, x), x, 1e-14);
    EXPECT_NEAR(incomplete_beta(3.0, 1.0, x), x * x * x, 1e-14);
    EXPECT_NEAR(incomplete_beta(1.0, 5.0, x), 1.0 - std::pow(1.0 - x, 5.0), 1e-14);
    EXPECT_NEAR(incomplete_beta(0.5, 0.5, x), 2.0 / M_PI * std::asin(std::sqrt(x)), 1e-14);
    EXPECT_NEAR(incomplete_beta(2.5, 7.0, x), 1.0 - incomplete_beta(7.0, 2.5, 1.0 - x), 1e-13);
  }
  EXPECT_NEAR(incomplete_beta(40.0, 25.0, beta_quantile(0.3, 40.0, 25.0)), 0.3, 1e-12);
}

/// R 4.2, help(binom.test): 682 of 925 plants, 95 %. Biometrika Tables for Statisticians I, table 41: 10
/// draws.
TEST(ClopperPearson, IsThatOfTables) {
  const Interval plants = clopper_pearson(682, 925, 0.95);
  EXPECT_NEAR(plants.low, 0.7076683, 5e-8);
  EXPECT_NEAR(plants.high, 0.7654066, 5e-8);
  const Interval one = clopper_pearson(1, 10, 0.95), half = clopper_pearson(5, 10, 0.95);
  EXPECT_NEAR(one.low, 0.0025, 5e-5);
  EXPECT_NEAR(one.high, 0.4450, 5e-5);
  EXPECT_NEAR(half.low, 0.1871, 5e-5);
  EXPECT_NEAR(half.high, 0.8129, 5e-5);
}

/// At each end the binomial distribution has half of what the confidence leaves: by its own sum.
TEST(ClopperPearson, LeavesHalfOfTheRestOnEachSide) {
  for (const std::size_t n : {1U, 7U, 40U, 300U}) {
    for (std::size_t k = 0; k <= n; k += std::max<std::size_t>(1, n / 5)) {
      const Interval share = clopper_pearson(k, n, 0.9);
      if (k > 0) {
        EXPECT_NEAR(at_least(k, n, share.low), 0.05, 1e-10) << k << " of " << n;
      }
      if (k < n) {
        EXPECT_NEAR(1.0 - at_least(k + 1, n, share.high), 0.05, 1e-10) << k << " of " << n;
      }
    }
  }
  EXPECT_EQ(clopper_pearson(0, 9, 0.9).low, 0.0);
  EXPECT_EQ(clopper_pearson(9, 9, 0.9).high, 1.0);
  EXPECT_NEAR(clopper_pearson(0, 10, 0.95).high, 1.0 - std::pow(0.025, 0.1), 1e-14);
}

TEST(ClopperPearson, HoldsTheTrueShareAsOftenAsItSays) {
  constexpr std::size_t n = 25;
  for (double p = 0.01; p < 1.0; p += 0.01) {
    double covered = 0.0;
    for (std::size_t k = 0; k <= n; ++k) {
      const Interval share = clopper_pearson(k, n, 0.95);
      if (share.low <= p && p <= share.high) covered += binomial(k, n, p);
    }
    EXPECT_GE(covered, 0.95) << p;
  }
}

/// 0.999^2995 <= 5 % < 0.999^2994.
TEST(Verdicts, TakeManyCleanRuns) {
  EXPECT_LE(std::pow(0.999, 2995), 0.05);
  EXPECT_GT(std::pow(0.999, 2994), 0.05);
  EXPECT_EQ(lang::clean_runs_for(0.999, 0.95), 2995u);
  EXPECT_EQ(judge(2995, 2995, 0.999, 0.95), Verdict::held);
  EXPECT_EQ(judge(2994, 2994, 0.999, 0.95), Verdict::too_few_runs);
  // With the share p, n cells are all clean with p^n: where that is 95 % and more, a miss is no chance.
  EXPECT_GE(std::pow(0.999, 51), 0.95);
  EXPECT_LT(std::pow(0.999, 52), 0.95);
  EXPECT_EQ(judge(50, 51, 0.999, 0.95), Verdict::broken);
  EXPECT_EQ(judge(51, 52, 0.999, 0.95), Verdict::too_few_runs);
  EXPECT_EQ(judge(0, 0, 0.5, 0.95), Verdict::too_few_runs);
}

TEST(Verdicts, WithoutAProbabilityAllowNoMiss) {
  EXPECT_EQ(judge(7, 7, std::nullopt, 0.95), Verdict::held);
  EXPECT_EQ(judge(6, 7, std::nullopt, 0.95), Verdict::broken);
}

TEST(Quantiles, AreValuesThatOccur) {
  const std::vector<double> sorted{1.0, 2.0, 3.0, 4.0};
  EXPECT_EQ(quantile_of(sorted, 0.0), 1.0);
  EXPECT_EQ(quantile_of(sorted, 0.25), 1.0);
  EXPECT_EQ(quantile_of(sorted, 0.26), 2.0);
  EXPECT_EQ(quantile_of(sorted, 0.5), 2.0);
  EXPECT_EQ(quantile_of(sorted, 1.0), 4.0);
}

/// 1 - 6 sum d^2 / n (n^2 - 1), where no two are equal; anything that rises is 1.
TEST(RankCorrelation, IsSpearmans) {
  EXPECT_NEAR(*rank_correlation({1, 2, 3, 4}, {1, 8, 27, 64}), 1.0, 1e-15);
  EXPECT_NEAR(*rank_correlation({1, 2, 3, 4}, {0, -1, -2, -9}), -1.0, 1e-15);
  const std::vector<double> x{1, 2, 3, 4, 5, 6}, y{3, 1, 2, 6, 4, 5};
  EXPECT_NEAR(*rank_correlation(x, y), 1.0 - 6.0 * (4 + 1 + 1 + 4 + 1 + 1) / (6.0 * 35.0), 1e-15);
  EXPECT_FALSE(rank_correlation({1, 1, 1}, {1, 2, 3}));
  // Within two groups y falls with x; over both it does not: ranks 2 1 4 3 of 1 2 3 4 are 1 - 6 x 4 / 60.
  EXPECT_NEAR(*rank_correlation_within({1, 2, 3, 4}, {11, 10, 21, 20}, {0, 0, 1, 1}), -1.0, 1e-15);
  EXPECT_NEAR(*rank_correlation({1, 2, 3, 4}, {11, 10, 21, 20}), 0.6, 1e-15);
  EXPECT_FALSE(rank_correlation({}, {}));
  // Two that are equal have the mean rank: the sum of products over ranks 1.5, 1.5, 3 and 1, 2, 3.
  EXPECT_NEAR(*rank_correlation({5, 5, 9}, {1, 2, 3}), 1.5 / std::sqrt(1.5 * 2.0), 1e-15);
}

}  // namespace
}  // namespace zwang::study
