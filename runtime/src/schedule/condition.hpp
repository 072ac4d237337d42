/// Conditions of the task language, evaluated in three values.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "zwang/lang/program.hpp"
#include "zwang/runtime/why.hpp"

namespace zwang::runtime {

/// The present value of a name in a condition.
struct Fact {
  double value = std::numeric_limits<double>::quiet_NaN();  ///< SI, or 0 and 1; not finite: unknown
  bool stale = false;  ///< unknown because a signal is older than its `stale_after`
};

/// The facts that a condition may ask about.
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

/// Does not allocate: `values` is at least as long as there are nodes. Afterwards it holds the value of each:
/// a number, 0 for false and 1 for true, NaN for unknown. An operand that is not a number is unknown, and so
/// is the result that depends on it. `release` replaces the threshold of a comparison.
Judgement evaluate(const lang::Condition& condition, int owner, const Facts& facts, std::span<double> values,
                   std::optional<double> release = std::nullopt) noexcept;

/// The numbers in the conditions of one task, each with the nodes below it: `abs(go.x.position)` is computed
/// once a tick, however many conditions have it.
class SharedNumbers {
 public:
  /// The index of the number; one that is new joins them. Allocates.
  int add(const lang::Condition& condition, int node);
  /// A new tick: nothing but the constants is known.
  void forget() noexcept { ++tick_; }
  const Fact& look_up(int number, int owner, const Facts& facts) noexcept {
    Number& n = numbers_[static_cast<std::size_t>(number)];
    if (n.known_at < tick_) compute(n, owner, facts);
    return n.fact;
  }

 private:
  struct Number {
    lang::ExpressionNode node;  ///< its operands are indices of numbers
    Fact fact;
    std::uint64_t known_at = 0;
  };
  void compute(Number& number, int owner, const Facts& facts) noexcept;
  std::vector<Number> numbers_;
  std::uint64_t tick_ = 1;
};

/// A condition as guards evaluate it: comparison by comparison, until one of them decides it.
class Decision {
 public:
  Decision(const lang::Condition& condition, SharedNumbers& numbers);

  /// The verdict of `evaluate`, without what cannot change it. `values` is at least as long as there are
  /// nodes, and has no meaning afterwards.
  Judgement decide(int owner, const Facts& facts, SharedNumbers& numbers, std::span<double> values,
                   std::optional<double> release) const noexcept;

 private:
  enum class Kind { truth, comparison, combination };
  /// A truth value.
  struct Step {
    Kind kind = Kind::truth;
    lang::Op op = lang::Op::constant;
    int left = -1, right = -1;             ///< numbers; of a combination steps
    std::optional<Verdict> if_false = {};  ///< of the condition, once this one is false
    std::optional<Verdict> if_true = {};
  };
  int add(const lang::Condition& condition, int node, SharedNumbers& numbers);
  void mark(int step, std::optional<Verdict> if_false, std::optional<Verdict> if_true);
  std::vector<Step> steps_;
};

}  // namespace zwang::runtime
