/// Conditions of the task language, evaluated in three values.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "zwang/lang/program.hpp"

namespace zwang::runtime {

enum class Verdict { no, yes, unknown };

/// What a name in a condition stands for now.
struct Fact {
  double value = std::numeric_limits<double>::quiet_NaN();  ///< SI, or 0 and 1; not finite: unknown
  bool stale = false;  ///< unknown because a signal is older than its `stale_after`
};

/// What a condition may ask about.
class Facts {
 public:
  /// `owner`: the task whose groups the condition speaks of.
  virtual Fact look_up(const lang::ExpressionNode& node, int owner) const noexcept = 0;

 protected:
  ~Facts() = default;
};

struct Judgement {
  Verdict verdict = Verdict::no;
  bool stale = false;  ///< a stale signal is among what the condition asks about
};

/// Does not allocate: `scratch` holds one number for each node and is at least as long. An operand that is
/// not a number is unknown, and so is what it decides. `release` replaces the threshold of a comparison.
Judgement evaluate(const lang::Condition& condition, int owner, const Facts& facts,
                   std::vector<double>& scratch, std::optional<double> release = std::nullopt) noexcept;

}  // namespace zwang::runtime
