/// Conditions of the task language, evaluated in three values.
#pragma once

#include <limits>
#include <optional>
#include <span>

#include "zwang/lang/program.hpp"
#include "zwang/runtime/why.hpp"

namespace zwang::runtime {

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

/// Does not allocate: `values` is at least as long as there are nodes, and holds afterwards what each of them
/// is: a number, 0 and 1 of what is false and true, NaN of what is unknown. An operand that is not a number
/// is unknown, and so is what it decides. `release` replaces the threshold of a comparison.
Judgement evaluate(const lang::Condition& condition, int owner, const Facts& facts, std::span<double> values,
                   std::optional<double> release = std::nullopt) noexcept;

}  // namespace zwang::runtime
